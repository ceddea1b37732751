// SPDX-License-Identifier: Apache-2.0
// ARX models (equation error) by least squares, fast.
//
//   y(k) + a_1 y(k-1) + ... + a_na y(k-na) = sum_i sum_j b_ij u_i(k - nk_i - j + 1) + c + e(k),   j = 1 ... nb_i
//
// The normal matrix of such a regression is nearly Toeplitz: entry (i+1, j+1) is entry (i, j) plus two edge products,
// so it costs one inner product per pair of signals and lag difference instead of one per pair of regressors. What
// squaring loses is won back by iterative refinement against the data themselves (corrected semi-normal equations); if
// the matrix is too badly conditioned for that, a Householder QR of the regressors decides. Results equal a QR of the
// full regression matrix to about 1e-9. Uncertainty: covariance of the coefficients for white e. ARX is biased when the
// noise is at the output (then use core/thermal/output_error.h). Units: those of the signals; period s. Failure:
// InputError for samples that do not suffice or inputs that are constant, equal or the output itself; Degenerate names
// what is not determined.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace spindrift {

struct ArxOrder {
  int na = 2;
  std::vector<int> nb;  ///< one per input; number of coefficients
  std::vector<int> nk;  ///< one per input; delay in samples (0: u(k) acts on y(k))
  [[nodiscard]] int parameters(bool with_constant) const;
};

struct ArxOptions {
  bool with_constant = false;  ///< estimate c
};

struct ArxModel {
  FitStatus status = FitStatus::NotRun;
  std::string message;
  double period_s = 1.0;
  ArxOrder order;
  Eigen::VectorXd a;               ///< a_1 ... a_na
  std::vector<Eigen::VectorXd> b;  ///< per input
  double c = 0.0;
  Eigen::MatrixXd covariance;     ///< of (a, b of input 1, b of input 2, ..., c)
  double noise_sigma = 0.0;       ///< of e, one step ahead: a figure of the fit, never of accuracy
  double condition_number = 0.0;  ///< of the scaled normal matrix (estimate)
  std::size_t equations = 0;

  [[nodiscard]] std::vector<std::complex<double>> poles() const;
  [[nodiscard]] bool stable() const;
  /// Steady-state gain of an input and its standard uncertainty (first-order propagation).
  [[nodiscard]] std::pair<double, double> staticGain(std::size_t input) const;
  struct TimeConstant {
    double value_s = 0.0;
    double sigma_s = 0.0;
  };
  /// Of the real poles between 0 and 1, slowest first, with standard uncertainty.
  [[nodiscard]] std::vector<TimeConstant> timeConstants() const;
  /// Free run: begins after `start`, the measured y of the first samples, and never looks at y again. Without any it
  /// begins as the lags of a ThermalModel do: at rest at the first inputs, which held for ever before.
  [[nodiscard]] std::vector<double> simulate(const std::vector<std::vector<double>>& inputs,
                                             std::span<const double> start) const;
  /// Response to a unit step of one input.
  [[nodiscard]] std::vector<double> stepResponse(std::size_t input, std::size_t samples) const;
};

/// y and every u at a constant period, all of one length, no missing values.
[[nodiscard]] ArxModel fitArx(std::span<const double> y, const std::vector<std::span<const double>>& inputs,
                              const ArxOrder& order, double period_s, const ArxOptions& options = {});

/// The same model with its poles drawn into |z| <= limit (factor by factor); gains are kept. Says so in `message`.
[[nodiscard]] ArxModel stabilised(const ArxModel& model, double limit = 0.9999);

}  // namespace spindrift
