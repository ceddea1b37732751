// SPDX-License-Identifier: GPL-3.0-or-later
// Captures as they arrive in a watched folder: live list with a verdict each, what to take again, the plan.
#pragma once

#include <QWidget>

#include "widgets/panels/page_context.h"

class QLabel;
class QPushButton;
class QSplitter;
class QTableView;

namespace spindrift::gui {

class Callout;
class Card;
class IncomingService;
class LiveTouchPanel;
class PlanPanel;
class RowsModel;

class ArrivingPanel : public QWidget {
  Q_OBJECT
 public:
  ArrivingPanel(PageContext context, Instrument instrument, QWidget* parent = nullptr);
  void refresh();
  /// Begins to watch a folder, as the button does after a folder was chosen.
  void watch(const QString& folder);
  /// For which instrument: touches have a table of their own.
  void setInstrument(Instrument instrument);
  [[nodiscard]] IncomingService& service() const { return service_; }
  [[nodiscard]] RowsModel* arrived() const { return rows_; }
  [[nodiscard]] PlanPanel* plan() const { return plan_; }
  [[nodiscard]] LiveTouchPanel* touches() const { return touches_; }
  [[nodiscard]] Callout* retake() const { return retake_; }
  [[nodiscard]] Callout* state() const { return state_; }

 protected:
  void showEvent(QShowEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void chooseTemplate();

  PageContext context_;
  IncomingService& service_;
  QPushButton* choose_;
  QPushButton* stop_;
  QPushButton* template_;
  QString template_file_;
  QLabel* folder_;
  Callout* state_;
  Callout* retake_;
  RowsModel* rows_;
  QTableView* table_;
  Card* arrived_;
  Card* touch_card_;
  QSplitter* left_ = nullptr;
  QSplitter* right_ = nullptr;
  PlanPanel* plan_;
  LiveTouchPanel* touches_;
};

}  // namespace spindrift::gui
