// SPDX-License-Identifier: Apache-2.0
// Self-optimising compensation (TALC, P1): few on-machine measurements keep the models of several errors true over
// days.
//
//   setup         for `setup_s` the errors are measured every `setup_interval_s`; then models are identified on them
//   free run      temperatures and speeds drive the models; between measurements nothing else is known
//   trigger       a measurement is made when the predicted standard uncertainty of any error passes its
//   `trigger_sigma`, when an input leaves
//                 the range of training (unseen pattern), or when `longest_interval_s` has passed; never sooner than
//                 `shortest_interval_s`
//   state update  every measurement corrects gain and offset of each error (Kalman, core/thermal/measurement_update.h);
//                 a single one far beyond its uncertainty is refused and measured again after `shortest_interval_s`
//   ACL           if a measurement differs from the prediction by more than the action control limit, the models are
//   identified again with
//                 newly chosen inputs (group LASSO over the lags of each input), and the next measurement comes after
//                 `shortest_interval_s`
//
// The replay runs over a recorded (or simulated) series in which the errors are known at every row, or at some (the
// cycles of a campaign; elsewhere NaN): the algorithm sees them only at its measurements, which it can make only where
// something was recorded; the full record is for judging. Beside it: uncompensated, and static (the
// models of the setup, never touched again). Units: errors as their columns say; time s. Failure: InputError for a
// series that ends before the setup or lacks a column. Source: P1 section 4 and its references [2], [10], [11].
#pragma once

#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/thermal/response_fit.h"

namespace spindrift {

struct AdaptiveError {
  std::string name;                ///< column of the series
  double measurement_sigma = 0.2;  ///< of one on-machine measurement
  double action_limit = 3.0;       ///< ACL: |measured - predicted| beyond it is an exceedance
  double trigger_sigma = 1.5;      ///< predicted standard uncertainty that calls for a measurement
};

struct AdaptiveOptions {
  double setup_s = 16.0 * 3600.0;
  double setup_interval_s = 1200.0;
  double shortest_interval_s = 1800.0;
  double longest_interval_s = 6.0 * 3600.0;
  double decision_s = 300.0;  ///< how often triggers are looked at
  bool select_inputs = true;  ///< group LASSO at every identification; false: all candidates
  int maximum_reidentifications = 40;
  /// Noise of `measurement_sigma` is added to every measurement: for series without noise of their own (a simulated
  /// truth). false: the recorded values are measurements as they stand.
  bool add_noise = true;
  std::uint64_t seed = 1;  ///< of the measurement noise

  /// Throws InputError.
  void validate() const;
};

enum class AdaptiveEventKind { Setup, Measurement, Refused, LimitExceeded, Reidentified };
[[nodiscard]] std::string_view toString(AdaptiveEventKind kind) noexcept;

struct AdaptiveEvent {
  double time_s = 0.0;
  AdaptiveEventKind kind = AdaptiveEventKind::Measurement;
  std::string text;  ///< one sentence: what and why
};

struct AdaptiveErrorResult {
  std::string name;
  std::vector<double> static_prediction;  ///< per row; 0 before the end of setup
  std::vector<double> adaptive_prediction;
  double rms_uncompensated = 0.0;  ///< after the setup, relative to the first row
  double rms_static = 0.0;
  double rms_adaptive = 0.0;
  double static_reduction_percent = 0.0;
  double adaptive_reduction_percent = 0.0;
};

struct AdaptiveResult {
  std::vector<AdaptiveErrorResult> errors;
  std::vector<AdaptiveEvent> events;
  std::size_t setup_measurements = 0;
  std::size_t measurements = 0;  ///< after the setup
  std::size_t reidentifications = 0;
};

[[nodiscard]] AdaptiveResult replayAdaptive(const TimeSeries& series, const std::vector<AdaptiveError>& errors,
                                            const std::vector<std::string>& candidates, const AdaptiveOptions& options,
                                            const JobContext& job);

/// The same for several sizes of limits and triggers (and of the longest interval), which share the setup and its
/// models; one result per scale, in their order.
[[nodiscard]] std::vector<AdaptiveResult> replayAdaptive(const TimeSeries& series,
                                                         const std::vector<AdaptiveError>& errors,
                                                         const std::vector<std::string>& candidates,
                                                         const AdaptiveOptions& options,
                                                         const std::vector<double>& scales, const JobContext& job);

}  // namespace spindrift
