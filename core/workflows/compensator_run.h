// SPDX-License-Identifier: Apache-2.0
// A compensator run over a log, judged where its model was judged: what was measured, what it commands, what is left.
// In the unit of the output (um, urad).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/thermal/time_series.h"
#include "core/workflows/thermal_tracking.h"

namespace spindrift {

struct CompensatorRun {
  CompensateResult result;
  std::string output;  ///< the first of the model: the one that is shown
  std::vector<double> time_s;
  std::vector<double> measured;  ///< about its mean, NaN where it is not measured
  std::vector<double> left;      ///< measured plus compensation, about its mean
  TimeRange test;
  double before_rms = 0.0;  ///< in the test range, about the mean there; NaN without values
  double after_rms = 0.0;
};

/// Runs `model` over the series. Throws InputError: inputs or the output are missing.
[[nodiscard]] CompensatorRun runCompensator(const TimeSeries& series, const ThermalModel& model, const TimeRange& test,
                                            const JobContext& job);

/// The range on which a model was judged: the one that was chosen, else the second half.
[[nodiscard]] TimeRange judgedRange(const std::optional<TimeRange>& chosen, const TimeSeries& series);

}  // namespace spindrift
