// SPDX-License-Identifier: Apache-2.0
// Intervals that agree with errors (private to thermal). A model is fitted several times to a part of its training rows
// and judged on the others; there its squared errors should on average be what it states. The stated variance is
// factor * variance + noise: what the noise of the output is, training tells; how wrong the gains are, the rows left
// out tell. Units: those of the output, squared. Source: calibration by cross-validated standardised residuals
// (Rasmussen and Williams 2006, 5.4.2; Le Gratiet et al. 2015).
#pragma once

#include <Eigen/Core>
#include <vector>

namespace spindrift {

/// The rows that one fit did not see.
struct JudgedRun {
  Eigen::ArrayXd squared_error;
  Eigen::ArrayXd variance;  ///< stated for the model's own error
};

/// The factor of the variances with which the mean of squared error over stated variance is 1, every run counting the
/// same and one more the variances as they stand, for errors below the noise say nothing of them; between 1e-3 and 1e2,
/// 1 without runs. `independent`: runs that tell something new (at least 2 are counted):
/// few of them widen the factor by the square of Student's over the normal quantile at 95 %.
[[nodiscard]] double calibratedFactor(const std::vector<JudgedRun>& runs, double noise, double independent);

/// Correlation of neighbours, 0 to 0.98, as far as it tells how many of these values are independent.
[[nodiscard]] double neighbourCorrelation(const Eigen::VectorXd& values);

}  // namespace spindrift
