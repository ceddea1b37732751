// SPDX-License-Identifier: Apache-2.0
// Replay of the self-optimising compensation (core/thermal/adaptive.h) on what was recorded: a log with errors in
// columns, or a campaign whose probing cycles give the errors and whose log gives the temperatures and speeds.
//
// Uncompensated, static and adaptive stand side by side, with the number of on-machine measurements that were spent and
// a curve of reduction against that number (all limits scaled). Units: those of the columns; time s. Failure:
// InputError for a column or parameter that is not there, a record shorter than its setup, too few measured rows.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/reporting/drawing.h"
#include "core/thermal/adaptive.h"
#include "core/thermal/time_series.h"

namespace spindrift {

struct ReplayRequest {
  std::filesystem::path source;      ///< LOG.csv, or the folder of a campaign
  std::vector<std::string> outputs;  ///< columns, or parameters of the cycles ("EXX" stands for EXX_um_per_m)
  std::vector<std::string> inputs;   ///< candidates; empty: automatic
  /// Action control limit per output name as given; "" holds for all others. Missing: the larger of six measuring
  /// uncertainties and a fifth of the standard deviation in the setup.
  std::map<std::string, double> limits;
  std::optional<double> sigma;  ///< of one measurement; default: as evaluated, or from the scatter of the column
  double setup_s = 16.0 * 3600.0;
  double setup_interval_s = 1200.0;  ///< recorded cycles may be rarer: then every one is used
  double shortest_interval_s = 1800.0;
  double longest_interval_s = 6.0 * 3600.0;
  std::vector<double> curve_scales = {4.0, 2.0, 1.0, 0.5, 0.25};  ///< of limits, triggers and longest interval
};

/// One point of the curve: what a number of measurements buys.
struct ReplayPoint {
  double scale = 1.0;  ///< of the limits; 0: no measurement after the setup (static)
  std::size_t measurements = 0;
  std::size_t reidentifications = 0;
  std::vector<double> reduction_percent;  ///< per output
};

struct ReplayResult {
  std::vector<AdaptiveError> errors;  ///< names, uncertainties and limits in use
  std::vector<std::string> units;
  std::vector<std::string> inputs;  ///< candidates
  AdaptiveResult run;
  std::vector<ReplayPoint> curve;  ///< fewest measurements first
  double setup_s = 0.0;
  double setup_end_s = 0.0;
  std::vector<double> time_s;
  std::vector<std::vector<double>> recorded;  ///< per output; NaN where nothing was recorded
  std::vector<std::string> notes;

  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::string summary() const;
  /// Errors over time, what is left of them, and the curve, one under another.
  [[nodiscard]] Drawing diagram() const;
  /// `false`: an output is left worse by the adaptive compensation than uncompensated or static.
  [[nodiscard]] bool goodEnough() const;
};

[[nodiscard]] ReplayResult replayCompensation(const ReplayRequest& request, JobContext& job);

}  // namespace spindrift
