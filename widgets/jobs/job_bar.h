// SPDX-License-Identifier: GPL-3.0-or-later
// The bar at the bottom of the window: what runs, how far it is, cancel; and the last thing that happened.
#pragma once

#include <QFrame>

#include "widgets/jobs/job_runner.h"

class QLabel;
class QProgressBar;
class QPushButton;

namespace spindrift::gui {

class IconLabel;

class JobBar : public QFrame {
  Q_OBJECT
 public:
  explicit JobBar(JobRunner& runner, QWidget* parent = nullptr);
  /// A short text at the right end (the value under the cursor).
  void setHint(const QString& text);
  void setMessage(const QString& text);
  [[nodiscard]] QPushButton* cancelButton() const { return cancel_; }
  [[nodiscard]] QString message() const;

 private:
  IconLabel* icon_;
  QLabel* text_;
  QProgressBar* progress_;
  QPushButton* cancel_;
  QLabel* hint_;
};

}  // namespace spindrift::gui
