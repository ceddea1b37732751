// SPDX-License-Identifier: Apache-2.0
// How far values scatter about a linear model beyond what their covariance explains.
//
//   y = A x + d + e,   cov(e) = V as stated,   d_i ~ N(0, s_g^2): what the model cannot describe, one s per group g
//
// With the gain G of a fit (x = G y) and R = I - A G the residuals are r = R (d + e). Their mean squares give s_g^2 by
// moments (one linear equation per group, no iteration), bounded below by zero:
//   sum_{i in g} r_i^2 / V_ii = sum_{i in g} [(R V R^T)_ii + sum_h s_h^2 sum_{j in h} R_ij^2] / V_ii
// Units are the caller's. Source: DerSimonian and Laird 1986, for correlated values and several groups.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace spindrift {

/// s_g^2 per group. `group[i]` in [0, groups); rows with a negative group take no part (outliers). A group whose
/// residuals hold no information on it gets 0.
[[nodiscard]] Eigen::VectorXd lackOfFitVariance(const Eigen::MatrixXd& A, const Eigen::VectorXd& y,
                                                const Eigen::MatrixXd& covariance, const Eigen::MatrixXd& gain,
                                                const std::vector<int>& group, int groups);

}  // namespace spindrift
