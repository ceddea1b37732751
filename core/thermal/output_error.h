// SPDX-License-Identifier: Apache-2.0
// Output-error identification in continuous time: the simulation error is minimised, so noise at the output does not
// bias the model.
//
//   y(t) = offset + sum_i sum_k gain_ik x_ik(t) + v(t),   tau_ik dx_ik/dt = u_i - x_ik
//
// Parameters: offset, gains, ln(tau). ln(tau) keeps every model stable and conditions slow poles at fast sampling well.
// Solved by Levenberg-Marquardt with exact simulation of the lags from several starts. v may be coloured: an
// autoregression of order `noise_order` whitens residual and Jacobian, found by restricted likelihood in turn with the
// parameters (core/thermal/noise_inference.h). The covariance carries that the colour is not known either; intervals
// are Student's with the degrees of freedom that this leaves: value +- coverageFactor() * sigma, time constants by
// factors tau * exp(+- coverageFactor() * sigma / tau). Units: y and u as given, time s. Failure: InputError for too
// few samples or unusable inputs; FitStatus NoConvergence or Degenerate with the reason.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/job_context.h"
#include "core/thermal/arx.h"
#include "core/thermal/thermal_model.h"

namespace spindrift {

struct OutputErrorInput {
  std::span<const double> values;
  int lags = 1;       ///< poles of this input
  bool hold = false;  ///< value holds until the next sample (speeds)
};

struct OutputErrorOptions {
  int noise_order = 2;  ///< autoregression of the noise; 0: white
  int maximum_iterations = 60;
  int starts = 3;
};

struct OutputErrorResult {
  FitStatus status = FitStatus::NotRun;
  std::string message;  ///< why not converged; or, converged, what of the result is weak
  double offset = 0.0;
  std::vector<std::vector<double>> gains;   ///< per input, slowest lag first
  std::vector<std::vector<double>> taus_s;  ///< same shape
  Eigen::MatrixXd covariance;               ///< of (offset, gains of all inputs, ln tau of all inputs)
  Eigen::VectorXd noise_ar;                 ///< v(k) = sum noise_ar_j v(k-j) + e(k)
  double noise_sigma = 0.0;                 ///< standard deviation of v
  double rms = 0.0;                         ///< simulation error over the samples of the fit
  int iterations = 0;
  /// Of the stated variances; what long correlation leaves of the samples, the smallest over the parameters.
  double degrees_of_freedom = 1e9;

  /// Half width of the interval of this probability in standard uncertainties.
  [[nodiscard]] double coverageFactor(double probability = 0.95) const;
  [[nodiscard]] double gainSigma(std::size_t input, std::size_t lag) const;
  [[nodiscard]] double tauSigma_s(std::size_t input, std::size_t lag) const;
  /// Steady-state gain of an input and its standard uncertainty.
  [[nodiscard]] std::pair<double, double> staticGain(std::size_t input) const;
};

/// All of one length, no missing values; `time_s` ascending.
[[nodiscard]] OutputErrorResult fitOutputError(std::span<const double> time_s, std::span<const double> y,
                                               const std::vector<OutputErrorInput>& inputs,
                                               const OutputErrorOptions& options = {});

/// Orders tried and their free-run error on the last part of the training data, which the fit did not see.
struct OrderCandidate {
  int na = 0;
  int nb = 0;
  int nk = 0;
  double held_out_rms = 0.0;
};
struct OrderChoice {
  OrderCandidate best;
  std::vector<OrderCandidate> tried;
};
/// ARX: na 1 ... 4, nb 1 ... na, nk 0 ... 3 (all inputs alike). The simplest within 2 % of the best wins.
[[nodiscard]] OrderChoice chooseArxOrder(std::span<const double> y, const std::vector<std::span<const double>>& inputs,
                                         double period_s, double held_out_part = 0.3);
/// Output error: 1 ... 3 lags per input (all inputs alike), by the same rule; in `na`.
[[nodiscard]] OrderChoice chooseOutputErrorOrder(std::span<const double> time_s, std::span<const double> y,
                                                 std::vector<OutputErrorInput> inputs, double held_out_part = 0.3);

/// The lags of an ARX model, exactly: poles and residues of every input, each input followed from sample to sample as
/// ThermalModel does it (`hold`: its value holds until the next), what is left of the static gain as a direct term.
/// Terms count inputs from 0. Empty with a sentence in `message` where there is no such model: a pole is not real and
/// between 0 and 1, or an input has a dead time (nk + nb - 1 > na).
[[nodiscard]] std::vector<LagTerm> lagsOf(const ArxModel& model, const std::vector<bool>& hold, std::string& message);

/// Covariance of (offset, gains, ln tau) of those lags from that of the ARX coefficients, by central differences.
/// Empty if the model has no covariance or no lags near it.
[[nodiscard]] Eigen::MatrixXd lagCovariance(const ArxModel& model, const std::vector<bool>& hold);

}  // namespace spindrift
