// SPDX-License-Identifier: Apache-2.0
// Likelihood of the sizes of two groups of random coefficients, at many sizes for the price of a few.
//
// Model: r = S u + X v + e with u ~ N(0, shift^2), v ~ N(0, smooth^2), e ~ N(0, scale^2); S, X and r whitened for
// scale 1. With G the products of [S X r] and D = diag(shift, ..., smooth, ..., 1), the bordered matrix D G D / scale^2
// + I (the 1 not at r) holds all of the likelihood: the logarithm of the determinant of what r borders, and chi^2 as
// the last pivot (Harville 1977; Bates and DebRoy 2004). S is brought to a tridiagonal form once, in which every shift
// is a chain: what is left is as large as X.
#pragma once

#include <Eigen/Core>

namespace spindrift {

/// D G D / scale^2 + I written out. `gram`: of [S X r], symmetric; `shifts`: columns of S.
[[nodiscard]] Eigen::MatrixXd borderedMatrix(const Eigen::MatrixXd& gram, Eigen::Index shifts, double scale,
                                             double shift, double smooth);

class BorderedGram {
 public:
  /// `gram` and `shifts` as above; r is always there.
  BorderedGram(const Eigen::MatrixXd& gram, Eigen::Index shifts);

  /// Log determinant of the cov of r over that of e, plus chi^2: -2 ln likelihood but for what only the scale has;
  /// 1e300 where numbers cannot tell.
  [[nodiscard]] double deviance(double scale, double shift, double smooth) const;

 private:
  Eigen::VectorXd diagonal_;     ///< of the tridiagonal form of S'S
  Eigen::VectorXd beside_;       ///< its subdiagonal
  Eigen::MatrixXd along_;        ///< [X r]'S, turned alike: a column for each link of the chain
  Eigen::MatrixXd smooth_gram_;  ///< of [X r]
};

}  // namespace spindrift
