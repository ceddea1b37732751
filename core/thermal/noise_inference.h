// SPDX-License-Identifier: Apache-2.0
// Inference under coloured noise: r = J d + v with v a stationary autoregression whose coefficients and size are not
// known and must come from the same few samples.
//
// A fit takes part of slow noise for signal, and the colour found in what is left is itself uncertain; both make the
// usual covariance (J' V^-1 J)^-1 at the estimated V too small. Here the parameters d and the size of the noise are
// integrated out exactly, which leaves the restricted likelihood of the colour (Patterson and Thompson 1971):
//
//   log L(c) = -1/2 log|V| - 1/2 log|J' V^-1 J| - (n - q)/2 log(r' P r),  P = V^-1 - V^-1 J (J' V^-1 J)^-1 J' V^-1
//
// c are the partial autocorrelations (every point of (-1, 1)^p is stationary), uniform before the data. What is stated
// is the mixture over c: covariance of d = mean of the conditional covariances plus the scatter of the conditional
// estimates, and degrees of freedom from the scatter of the conditional variances, so that a Student interval holds as
// often as it says (the aim of Kenward and Roger 1997). The quadratic forms come from lagged
// products of the columns, formed once, with the exact start of the process (Durbin and Levinson). Units: those of r
// and J.
#pragma once

#include <Eigen/Core>

namespace spindrift {

/// A stationary autoregression v(k) = sum ar_j v(k - j) + e(k).
struct Autoregression {
  Eigen::VectorXd partial;  ///< partial autocorrelations, |.| < 1
  Eigen::VectorXd ar;       ///< ar_1 ... ar_p

  Autoregression() = default;
  explicit Autoregression(const Eigen::VectorXd& partial_autocorrelations);
  /// Columns of independent, equally uncertain values: exact from the first sample on.
  void whiten(Eigen::MatrixXd& columns) const;
  void whiten(Eigen::VectorXd& column) const;
  /// Standard deviation of v over that of e.
  [[nodiscard]] double amplification() const;

 private:
  Eigen::MatrixXd lower_;  ///< row k: coefficients of order k
  Eigen::VectorXd start_;  ///< weight of sample k < p
};

struct NoiseInference {
  Autoregression noise;                ///< most likely colour
  double innovation_sigma = 0.0;       ///< of e
  Eigen::MatrixXd covariance;          ///< squared scale of d, colour and size of the noise not taken as known
  Eigen::VectorXd degrees_of_freedom;  ///< of the variance of each element of d
};

/// `jacobian` n x q of full column rank, `residual` n, `order` 0 (white) ... 4; n > q + 2 order + 2. A column without
/// effect leaves covariances that are not finite.
[[nodiscard]] NoiseInference inferNoise(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual, int order);

}  // namespace spindrift
