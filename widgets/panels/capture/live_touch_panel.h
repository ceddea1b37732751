// SPDX-License-Identifier: GPL-3.0-or-later
// Touches as they come in: one row each with its verdict at once, the feature that is touched now, how far the cycle
// is, and what to touch again.
#pragma once

#include <QWidget>

#include "widgets/panels/page_context.h"

class QLabel;
class QProgressBar;
class QTableView;

namespace spindrift::gui {

class IncomingService;
class RowsModel;

class LiveTouchPanel : public QWidget {
  Q_OBJECT
 public:
  explicit LiveTouchPanel(SessionModel& session, QWidget* parent = nullptr);
  void refresh();
  [[nodiscard]] RowsModel* rows() const { return rows_; }
  [[nodiscard]] QString progressText() const;

 private:
  IncomingService& service_;
  QLabel* now_;
  QProgressBar* bar_;
  RowsModel* rows_;
  QTableView* table_;
};

}  // namespace spindrift::gui
