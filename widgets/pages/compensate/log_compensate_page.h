// SPDX-License-Identifier: GPL-3.0-or-later
// Step Compensate of a campaign that is a log alone: the compensator that a control would run, with the model over time
// of the step Model, is run over the log; what it commands and what is left.
#pragma once

#include <memory>

#include "core/workflows/compensator_run.h"
#include "widgets/pages/page.h"

namespace spindrift::gui {

class EmptyState;
class LiveCompensationPanel;
class NumberTile;
class Plot;

class LogCompensatePage : public Page {
  Q_OBJECT
 public:
  explicit LogCompensatePage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return run_button_; }
  void runAll() override { runTask("log-compensation"); }
  [[nodiscard]] Plot* plot() const { return plot_; }
  [[nodiscard]] const CompensatorRun* result() const { return result_ == nullptr ? nullptr : &result_->run; }
  [[nodiscard]] LiveCompensationPanel* live() const { return live_; }

 private:
  void showResult();

  std::shared_ptr<const LogCompensation> result_;
  QPushButton* run_button_;
  NumberTile* before_;
  NumberTile* after_;
  NumberTile* largest_;
  Plot* plot_;
  LiveCompensationPanel* live_;
};

}  // namespace spindrift::gui
