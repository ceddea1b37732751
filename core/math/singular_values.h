// SPDX-License-Identifier: Apache-2.0
// Singular value decomposition of a matrix of any shape, and how many of its columns the rows tell apart.
#pragma once

#include <Eigen/Core>

namespace spindrift {

enum class RightVectors {
  Thin,  ///< those that belong to a singular value
  Full,  ///< a basis of all columns: the last ones span the null space
};

/// A = left diag(values) right^T (Golub and Van Loan, Matrix Computations, 8.6).
struct SingularValues {
  Eigen::VectorXd values;  ///< descending, min(rows, columns)
  Eigen::MatrixXd left;    ///< rows x min(rows, columns), orthonormal columns
  Eigen::MatrixXd right;   ///< columns x min(rows, columns), or columns x columns if Full; orthonormal columns

  /// Numerical rank: how many are larger than `tolerance` times the largest. None of a matrix without rows or of zeros.
  [[nodiscard]] Eigen::Index rank(double tolerance) const;
};

/// Decomposes a matrix, which may have no row or no column: to 1e-13 of the largest value where rows or columns are
/// fewer than 64, to 1e-9 where those of a larger one lie close together. A tall one is first reduced to its triangle
/// (R-bidiagonalisation, Golub and Van Loan 8.6.3), which a fit of few parameters to many readings gains most from.
[[nodiscard]] SingularValues singularValues(const Eigen::MatrixXd& matrix, RightVectors right = RightVectors::Thin);

}  // namespace spindrift
