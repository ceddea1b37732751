// SPDX-License-Identifier: Apache-2.0
#include "core/math/singular_values.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

namespace spindrift {

namespace {

template <typename Decomposition>
SingularValues decomposedBy(const Eigen::MatrixXd& matrix, RightVectors right) {
  const unsigned int wanted =
      Eigen::ComputeThinU | (right == RightVectors::Full ? Eigen::ComputeFullV : Eigen::ComputeThinV);
  const Decomposition svd(matrix, wanted);
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

SingularValues decomposed(const Eigen::MatrixXd& matrix, RightVectors right) {
  // Eigen's divide and conquer keeps nine digits only where singular values lie close together (3.4); Jacobi keeps them
  // all, and takes too long where there are many.
  constexpr Eigen::Index many = 64;
  return std::min(matrix.rows(), matrix.cols()) < many ? decomposedBy<Eigen::JacobiSVD<Eigen::MatrixXd>>(matrix, right)
                                                       : decomposedBy<Eigen::BDCSVD<Eigen::MatrixXd>>(matrix, right);
}

}  // namespace

Eigen::Index SingularValues::rank(double tolerance) const {
  Eigen::Index rank = 0;
  while (rank < values.size() && values(rank) > 0.0 && values(rank) > tolerance * values(0)) ++rank;
  return rank;
}

SingularValues singularValues(const Eigen::MatrixXd& matrix, RightVectors right) {
  const Eigen::Index rows = matrix.rows();
  const Eigen::Index columns = matrix.cols();
  if (rows == 0 || columns == 0) {
    const Eigen::Index kept = right == RightVectors::Full ? columns : 0;
    return {Eigen::VectorXd(0), Eigen::MatrixXd(rows, 0), Eigen::MatrixXd::Identity(columns, kept)};
  }
  // The vectors on the left cost one multiplication more than they save while the matrix is nearly square.
  if (3 * rows < 5 * columns) return decomposed(matrix, right);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(matrix);
  const Eigen::MatrixXd triangle = qr.matrixQR().topRows(columns).triangularView<Eigen::Upper>();
  SingularValues found = decomposed(triangle, right);
  Eigen::MatrixXd left = Eigen::MatrixXd::Zero(rows, columns);
  left.topRows(columns) = found.left;
  found.left = qr.householderQ() * left;
  return found;
}

}  // namespace spindrift
