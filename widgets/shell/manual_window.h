// SPDX-License-Identifier: GPL-3.0-or-later
// The manual beside the work: its pages, and its chapters to go to. It is the file that the package brings.
#pragma once

#include <QDialog>
#include <memory>

#include "widgets/report/report_pages.h"

class QListWidget;

namespace spindrift::gui {

class PageView;

/// Where the manual of this program is: installed, or in the folder it was built in; empty if at neither place.
[[nodiscard]] QString manualFile();

class ManualWindow : public QDialog {
  Q_OBJECT
 public:
  explicit ManualWindow(const QString& file, QWidget* parent = nullptr);
  /// One a chapter, once the file is opened.
  [[nodiscard]] QListWidget* chapters() const { return chapters_; }
  [[nodiscard]] PageView* pages() const { return view_; }

 Q_SIGNALS:
  /// Empty: it can be read.
  void opened(const QString& failure);

 private:
  void showPages(const std::shared_ptr<ReportPages>& pages);

  std::shared_ptr<ReportPages> opening_;
  QListWidget* chapters_;
  PageView* view_;
};

}  // namespace spindrift::gui
