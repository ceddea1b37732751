// SPDX-License-Identifier: Apache-2.0
// Least squares where columns depend on each other.
#pragma once

#include <Eigen/QR>

namespace spindrift {

/// The basic least-squares solution of a decomposed matrix (m x n) for `y` (m): columns beyond its rank, under its
/// threshold, have coefficient 0. ColPivHouseholderQR::solve itself heeds no threshold: it divides by every pivot that
/// is not exactly zero. Source: Golub and Van Loan, Matrix Computations, 5.5.7.
[[nodiscard]] inline Eigen::VectorXd basicSolution(const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& qr,
                                                   const Eigen::VectorXd& y) {
  const Eigen::Index rank = qr.rank();
  Eigen::VectorXd rotated = y;
  rotated.applyOnTheLeft(qr.householderQ().setLength(qr.nonzeroPivots()).adjoint());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(qr.cols());
  const Eigen::VectorXd basic =
      qr.matrixR().topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solve(rotated.head(rank));
  for (Eigen::Index i = 0; i < rank; ++i) x[qr.colsPermutation().indices()[i]] = basic[i];
  return x;
}

}  // namespace spindrift
