// SPDX-License-Identifier: GPL-3.0-or-later
// Compensate: live. The closed loop at the control: what the control is, whether the compensation is active, what it
// applies per axis and how sure that is, what the error was without and with it. Looks at ClosedLoopService; works
// without a session.
#pragma once

#include <QWidget>
#include <array>

#include "widgets/services/closed_loop_service.h"

class QLabel;
class QPushButton;
class QTableView;

namespace spindrift::gui {

class Callout;
class Card;
class NumberTile;
class Plot;
class RowsModel;
class Segments;

class ClosedLoopPage : public QWidget {
  Q_OBJECT
 public:
  explicit ClosedLoopPage(SessionModel& session, QWidget* parent = nullptr);

  void openPlan(const QString& file);
  void refresh();

  [[nodiscard]] ClosedLoopService& service() { return service_; }
  [[nodiscard]] Callout* callout() const { return callout_; }
  [[nodiscard]] QPushButton* startButton() const { return start_; }
  [[nodiscard]] QPushButton* confirmButton() const { return confirm_; }
  [[nodiscard]] QPushButton* stopButton() const { return stop_; }
  [[nodiscard]] QPushButton* acceptButton() const { return accept_; }
  [[nodiscard]] QString dryRunText() const;
  [[nodiscard]] NumberTile* axisTile(int axis) const { return axes_[static_cast<std::size_t>(axis)]; }
  [[nodiscard]] NumberTile* ageTile() const { return age_; }
  [[nodiscard]] NumberTile* cyclesTile() const { return spent_; }
  [[nodiscard]] Segments* silence() const { return silence_; }
  [[nodiscard]] Plot* plot() const { return plot_; }
  [[nodiscard]] RowsModel* events() const { return events_; }
  [[nodiscard]] RowsModel* choice() const { return choice_; }

 Q_SIGNALS:
  void closed();

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void showState();
  void showNumbers();
  void showChoice();
  void showCycles();

  ClosedLoopService& service_;
  QString notice_;      ///< of what was refused; until something else happens
  bool asked_ = false;  ///< the dry run is shown, the operator has not answered
  std::size_t shown_events_ = 0;
  std::size_t shown_cycles_ = static_cast<std::size_t>(-1);
  std::vector<std::string> offered_;

  QLabel* plan_;
  QPushButton* open_;
  QPushButton* folder_;
  QPushButton* start_;
  QPushButton* stop_;
  Callout* callout_;
  Card* confirmation_;
  QLabel* dry_run_;
  QPushButton* confirm_;
  Card* decision_;
  Card* happened_;
  RowsModel* choice_;
  QPushButton* accept_;
  std::array<NumberTile*, 3> axes_{};
  NumberTile* age_;
  NumberTile* spent_;
  Segments* silence_;
  QLabel* silence_note_;
  Segments* component_;
  Plot* plot_;
  QLabel* errors_;
  RowsModel* events_;
  QTableView* event_table_;
};

}  // namespace spindrift::gui
