// SPDX-License-Identifier: Apache-2.0
// Identification by a dictionary of lags: the model behind `--inputs auto`.
//
// Every candidate input enters through a fixed grid of time constants (core/thermal/thermal_model.h). The gains are
// found by ridge regression with
//   - a noise model: white innovation driven first-order drift (time constant `noise_tau_s`), so that a slowly drifting
//   zero does
//     not masquerade as a response, and a Huber weight on innovations, so that an isolated step of the probe costs one
//     sample,
//   - a prior that expects slow responses rather than fast ones, weighs a signal by the root of its spread, and leaves
//     speeds freer than temperatures (a speed has no measurement noise),
//   - several priors and exponents of speed (speed^1 ... speed^2) averaged with weights from blocked cross-validation
//   that leaves
//     whole operating plateaus out: what is averaged is a linear model again.
// Uncertainty: posterior covariance plus the scatter of the averaged members; grows outside the range of training by
// itself. It is scaled so that errors and intervals agree over rows left out (core/thermal/interval_calibration.h):
// every block of operation predicted from the others, and the last 60, 45, 30 and 15 % of training from what was
// before. Failure: InputError for data that cannot work (too few samples, no usable input, output copied into an
// input); FitStatus Degenerate if nothing could be determined.
#pragma once

#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/job_context.h"
#include "core/thermal/thermal_model.h"

namespace spindrift {

struct ResponseFitOptions {
  std::vector<double> taus_s = {0.0, 600.0, 1800.0, 5400.0, 16200.0};
  std::vector<double> speed_powers = {1.0, 1.5, 2.0};
  std::vector<double> strengths = {0.15, 0.5, 1.5};    ///< of the prior
  std::vector<double> slow_preferences = {0.0, 0.25};  ///< prior spread ~ tau^this
  double noise_tau_s = 850.0;
  double speed_freedom = 5.0;  ///< prior contribution of a speed relative to that of a temperature
  double period_s = 0.0;       ///< 0: chosen so that training has about 1000 bins, never below the rows' own
  std::size_t minimum_samples = 60;
  bool judge_inputs = true;  ///< what is lost without each input; costs about as much as the fit

  /// Throws InputError.
  void validate() const;
};

/// What became of one candidate input.
struct InputVerdict {
  std::string name;
  bool kept = false;
  std::string reason;
  double contribution_rms = 0.0;       ///< of its part of the prediction over the training data, unit of the output
  double error_without_percent = 0.0;  ///< change of the left-out-block error if it is dropped
};

struct ResponseFitResult {
  FitStatus status = FitStatus::NotRun;
  std::string message;
  ThermalModel model;  ///< one output
  std::vector<InputVerdict> verdicts;
  double calibration = 1.0;   ///< factor of the covariance that rows left out asked for
  double left_out_rms = 0.0;  ///< error in blocks of operation left out of the fit, free run
  double speed_power = 0.0;   ///< mean exponent of speed after averaging; 0 without speeds
  std::size_t samples = 0;
  std::vector<std::string> notes;
};

/// Names that `auto` may choose from: temperatures, speeds, feeds and switches; never displacements, never the output.
[[nodiscard]] std::vector<std::string> automaticInputs(const TimeSeries& series, const std::string& output);

/// Training rows: `from_s` <= t < `to_s`.
[[nodiscard]] ResponseFitResult fitResponse(const TimeSeries& series, const std::string& output,
                                            const std::vector<std::string>& inputs, double from_s, double to_s,
                                            const ResponseFitOptions& options, const JobContext& job);

}  // namespace spindrift
