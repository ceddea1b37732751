// SPDX-License-Identifier: Apache-2.0
// Using a thermal model: keeping it true by on-machine measurements (`thermal track`) and running the compensator over
// a log (`thermal compensate`).
#pragma once

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/reporting/drawing.h"
#include "core/thermal/compensator.h"
#include "core/thermal/measurement_update.h"
#include "core/workflows/thermal_workflow.h"

namespace spindrift {

struct TrackRequest {
  std::filesystem::path log;
  std::filesystem::path model;
  std::string output;  ///< empty: the model's first
  UpdateKind update = UpdateKind::Kalman;
  double interval_s = 3600.0;
  std::optional<double> from_s;  ///< first measurement; default: end of training if the log goes on, else its start
  double measurement_sigma = 0.5;
  double gain_bound = 0.0;  ///< 0: as printed in P2, without a bound
  /// kalman: columns that the gain may depend on, such as pos_z_mm (height of the spindle); scaled by their range.
  std::vector<std::string> context;
};

struct TrackResult {
  std::string output;
  std::string unit;
  double from_s = 0.0;
  RunQuality without;  ///< free run
  RunQuality with;     ///< with updates
  UpdateRun run;
  std::vector<std::pair<TimeRange, RunQuality>> intervals;
  std::vector<IntervalPoint> sweep;  ///< 30 ... 180 min, P2 Fig. 9
  std::vector<double> time_s;
  std::vector<double> measured;
  std::vector<double> simulated;
  std::vector<std::string> notes;

  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::string summary() const;
  /// Series, what is left of them, and fit and p2p against the interval (P2 Figs. 7 to 9).
  [[nodiscard]] Drawing diagram() const;
  void writePrediction(const std::filesystem::path& file) const;
};
[[nodiscard]] TrackResult trackThermalModel(const TrackRequest& request, const JobContext& job);
/// The same on a series and a model in memory.
[[nodiscard]] TrackResult trackThermalModel(const TimeSeries& series, const ThermalModel& model,
                                            const TrackRequest& request, const JobContext& job);

struct CompensateRequest {
  std::filesystem::path log;
  std::filesystem::path model;
  double cycle_s = 0.0;  ///< 0: median distance of the rows
  CompensatorLimits limits;
};
struct CompensateResult {
  struct Output {
    std::string name;
    double rms_before = 0.0;  ///< of the measured deviation about its mean where it is measured; NaN if it is not
    double rms_after = 0.0;   ///< of measured deviation plus compensation, about its mean
    double reduction_percent = 0.0;  ///< of the rms; positive where it became smaller
    /// The same on rows that the model was not identified from, which alone show what it is worth: about their own
    /// mean, since where a compensator sets its zero is not the model's doing. NaN without such rows.
    struct Unseen {
      std::size_t rows = 0;
      double rms_before = std::numeric_limits<double>::quiet_NaN();
      double rms_after = std::numeric_limits<double>::quiet_NaN();
      double reduction_percent = std::numeric_limits<double>::quiet_NaN();
    };
    Unseen unseen;
    /// No better than left alone: where nothing trained the model, or over all rows if there are no such.
    [[nodiscard]] bool worse() const noexcept;
    double largest = 0.0;
    std::vector<double> compensation;  ///< minus the predicted deviation, to be added to the command
  };
  double cycle_s = 0.0;
  std::vector<double> time_s;
  std::vector<Output> outputs;
  std::size_t holding = 0;
  std::size_t fallback = 0;
  std::vector<std::string> warnings;  ///< a model that was called not good enough when it was identified
  bool forced = false;                ///< there is such a model: no control loads it unless it is forced to
  std::string unseen;                 ///< which rows trained nothing, one sentence
  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::string summary() const;
  void write(const std::filesystem::path& file) const;
};
[[nodiscard]] CompensateResult compensateLog(const CompensateRequest& request, const JobContext& job);
/// The same on a series and a model in memory.
[[nodiscard]] CompensateResult compensateLog(const TimeSeries& series, const ThermalModel& model,
                                             const CompensateRequest& request, const JobContext& job);

}  // namespace spindrift
