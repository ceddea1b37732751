// SPDX-License-Identifier: GPL-3.0-or-later
// The measurement plan: what to measure next, how long until the next thermal state, what is done.
#pragma once

#include <QTimer>
#include <QWidget>

#include "widgets/panels/page_context.h"

class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QSpinBox;
class QTableView;

namespace spindrift::gui {

class Callout;
class IncomingService;
class RowsModel;

class PlanPanel : public QWidget {
  Q_OBJECT
 public:
  PlanPanel(PageContext context, Instrument instrument, QWidget* parent = nullptr);
  /// For which instrument a new plan is made.
  void setInstrument(Instrument instrument);
  void refresh();
  /// Makes a plan with the states and the interval in the boxes; can be undone.
  void makePlan();
  [[nodiscard]] RowsModel* rows() const { return rows_; }
  [[nodiscard]] QString sentence() const;

 protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  void showCountdown();

  PageContext context_;
  IncomingService& service_;
  Instrument instrument_;
  QTimer second_;
  Callout* next_;
  RowsModel* rows_;
  QTableView* table_;
  QSpinBox* states_;
  QDoubleSpinBox* interval_;
  QPushButton* make_;
  QLabel* count_;
};

}  // namespace spindrift::gui
