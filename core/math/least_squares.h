// SPDX-License-Identifier: Apache-2.0
// Weighted linear least squares with covariance, rank and the directions the data do not determine.
//
// Model: y = A x + e, cov(e) = diag(sigma^2) or a full matrix. Solved by a singular value decomposition of the
// whitened, column-scaled matrix; never through a normal matrix or an inverse. Units are the caller's.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace spindrift {

struct LinearFitOptions {
  /// Singular values below this part of the largest (after scaling every column to length one) count as zero. > 0.
  double rank_tolerance = 1e-10;
  /// True: multiply the covariance by chi2/dof (sigma known up to a factor). False: sigma is taken as it stands.
  bool scale_by_residuals = false;
};

/// Result of a linear fit. `covariance` is that of the pseudo-inverse solution; if `status` is Degenerate, rows named
/// in `undetermined` have infinite variance (their value is the minimum-norm one and must not be used).
struct LinearFitResult {
  FitStatus status = FitStatus::NotRun;
  std::string message;
  Eigen::VectorXd x;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd residuals;  ///< y - A x, in the units of y
  double chi2 = 0.0;          ///< sum of squared whitened residuals
  int rank = 0;
  int degrees_of_freedom = 0;
  double condition_number = 0.0;  ///< of the whitened, column-scaled matrix
  std::vector<int> undetermined;  ///< columns that take part in the null space
  Eigen::MatrixXd null_space;     ///< columns: unit directions in x that the data do not see (x units as given)

  [[nodiscard]] bool usable() const noexcept { return status == FitStatus::Converged; }
  [[nodiscard]] double standardUncertainty(int i) const;
};

/// A: m x n, y: m, sigma: m (> 0). Throws InternalError for sizes that do not fit. m < n gives Degenerate.
[[nodiscard]] LinearFitResult solveLinear(const Eigen::MatrixXd& A, const Eigen::VectorXd& y,
                                          const Eigen::VectorXd& sigma, const LinearFitOptions& options = {});

/// The same with a full covariance of y (m x m, positive definite; Rejected where it is not, or singular to rounding).
[[nodiscard]] LinearFitResult solveLinearCorrelated(const Eigen::MatrixXd& A, const Eigen::VectorXd& y,
                                                    const Eigen::MatrixXd& covariance,
                                                    const LinearFitOptions& options = {});

/// Weight of Huber's or Tukey's loss for a standardised residual r = residual / sigma (Huber 1964; Beaton and Tukey
/// 1974).
[[nodiscard]] double huberWeight(double standardised_residual, double threshold = 1.345) noexcept;
[[nodiscard]] double tukeyWeight(double standardised_residual, double threshold = 4.685) noexcept;

}  // namespace spindrift
