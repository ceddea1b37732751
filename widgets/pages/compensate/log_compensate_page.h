// SPDX-License-Identifier: GPL-3.0-or-later
// Step Compensate of a campaign that is a log alone: the compensator that a control would run, with the model over time
// of the step Model, is run over the log; what it commands and what is left.
#pragma once

#include <memory>

#include "core/thermal/time_series.h"
#include "core/workflows/thermal_tracking.h"
#include "widgets/pages/page.h"

namespace spindrift::gui {

class EmptyState;
class LiveCompensationPanel;
class NumberTile;
class Plot;

/// A compensator that was run over a log.
struct CompensatorRun {
  CompensateResult result;
  std::string output;  ///< the one that is shown
  std::vector<double> time_s;
  std::vector<double> measured;  ///< about its mean, NaN where it is not measured
  std::vector<double> left;      ///< measured plus compensation, about its mean
  TimeRange test;
  double before_rms = 0.0;  ///< in the test range, about the mean there; NaN without values
  double after_rms = 0.0;
};
/// Runs `model` over the series. Throws InputError if inputs are missing.
[[nodiscard]] CompensatorRun runCompensator(const TimeSeries& series, const ThermalModel& model, const TimeRange& test,
                                            const JobContext& job);

class LogCompensatePage : public Page {
  Q_OBJECT
 public:
  explicit LogCompensatePage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return run_button_; }
  void runAll() override { compensate(true); }
  [[nodiscard]] Plot* plot() const { return plot_; }
  [[nodiscard]] const std::shared_ptr<const CompensatorRun>& result() const { return result_; }
  [[nodiscard]] LiveCompensationPanel* live() const { return live_; }

 private:
  void compensate(bool store);
  void showResult();
  [[nodiscard]] std::int64_t modelId();  ///< of the stored model, 0 if there is none

  std::shared_ptr<const CompensatorRun> result_;
  std::shared_ptr<const ThermalModel> model_;
  std::int64_t result_model_ = 0;  ///< the model that result_ is of
  QPushButton* run_button_;
  NumberTile* before_;
  NumberTile* after_;
  NumberTile* largest_;
  Plot* plot_;
  LiveCompensationPanel* live_;
};

}  // namespace spindrift::gui
