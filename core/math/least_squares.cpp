// SPDX-License-Identifier: Apache-2.0
#include "core/math/least_squares.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "core/math/singular_values.h"

namespace spindrift {

double LinearFitResult::standardUncertainty(int i) const {
  return std::sqrt(covariance(i, i));
}

namespace {

LinearFitResult solveWhitened(const Eigen::MatrixXd& A, const Eigen::VectorXd& y, const LinearFitOptions& options) {
  const Eigen::Index n = A.cols();
  LinearFitResult fit;
  Eigen::VectorXd scale = A.colwise().norm();
  for (Eigen::Index j = 0; j < n; ++j) {
    if (!(scale(j) > 0.0)) scale(j) = 1.0;
  }
  const Eigen::MatrixXd scaled = A * scale.cwiseInverse().asDiagonal();
  // Full V is wanted even when there are fewer rows than columns: its last columns span the null space.
  const SingularValues decomposition = singularValues(scaled, RightVectors::Full);
  const Eigen::VectorXd& s = decomposition.values;
  const Eigen::MatrixXd& V = decomposition.right;
  const Eigen::Index rank = decomposition.rank(options.rank_tolerance);

  fit.rank = static_cast<int>(rank);
  fit.degrees_of_freedom = static_cast<int>(A.rows() - rank);
  fit.condition_number = rank == n && n > 0 ? s(0) / s(n - 1) : std::numeric_limits<double>::infinity();
  Eigen::VectorXd z = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(n, rank);
  if (rank > 0) {
    const Eigen::VectorXd projected = decomposition.left.leftCols(rank).transpose() * y;
    root = V.leftCols(rank) * s.head(rank).cwiseInverse().asDiagonal();
    z = root * projected;
  }
  fit.x = scale.cwiseInverse().asDiagonal() * z;
  const Eigen::MatrixXd unscaled_root = scale.cwiseInverse().asDiagonal() * root;
  fit.covariance = unscaled_root * unscaled_root.transpose();
  fit.chi2 = (y - A * fit.x).squaredNorm();
  if (options.scale_by_residuals && fit.degrees_of_freedom > 0) fit.covariance *= fit.chi2 / fit.degrees_of_freedom;
  if (rank == n) {
    fit.status = FitStatus::Converged;
    fit.message = "all parameters are determined";
    return fit;
  }
  fit.status = FitStatus::Degenerate;
  fit.null_space = scale.cwiseInverse().asDiagonal() * V.rightCols(n - rank);
  for (Eigen::Index k = 0; k < fit.null_space.cols(); ++k) fit.null_space.col(k).normalize();
  for (Eigen::Index j = 0; j < n; ++j) {
    if (V.rightCols(n - rank).row(j).norm() > 1e-6) {
      fit.undetermined.push_back(static_cast<int>(j));
      fit.covariance.row(j).setZero();
      fit.covariance.col(j).setZero();
      fit.covariance(j, j) = std::numeric_limits<double>::infinity();
    }
  }
  fit.message = std::to_string(n - rank) + " of " + std::to_string(n) + " parameters cannot be determined";
  return fit;
}

}  // namespace

LinearFitResult solveLinear(const Eigen::MatrixXd& A, const Eigen::VectorXd& y, const Eigen::VectorXd& sigma,
                            const LinearFitOptions& options) {
  SPINDRIFT_ASSERT(A.rows() == y.size() && y.size() == sigma.size(), "sizes of a linear fit differ");
  SPINDRIFT_ASSERT(sigma.size() == 0 || sigma.minCoeff() > 0.0, "sigma of a linear fit must be positive");
  const Eigen::VectorXd weight = sigma.cwiseInverse();
  LinearFitResult fit = solveWhitened(weight.asDiagonal() * A, weight.cwiseProduct(y), options);
  fit.residuals = y - A * fit.x;
  return fit;
}

LinearFitResult solveLinearCorrelated(const Eigen::MatrixXd& A, const Eigen::VectorXd& y,
                                      const Eigen::MatrixXd& covariance, const LinearFitOptions& options) {
  SPINDRIFT_ASSERT(A.rows() == y.size() && y.size() == covariance.rows() && covariance.rows() == covariance.cols(),
                   "sizes of a linear fit differ");
  const Eigen::LLT<Eigen::MatrixXd> cholesky(covariance);
  // A pivot at rounding of its variance is none: a covariance that is singular stays so if its numbers are rounded.
  const double rounding = 16.0 * static_cast<double>(y.size()) * std::numeric_limits<double>::epsilon();
  const bool definite =
      cholesky.info() == Eigen::Success &&
      (cholesky.matrixLLT().diagonal().array().square() > rounding * covariance.diagonal().array()).all();
  if (!definite) {
    LinearFitResult fit;
    fit.status = FitStatus::Rejected;
    fit.message = "the covariance of the observations is not positive definite";
    return fit;
  }
  LinearFitResult fit = solveWhitened(cholesky.matrixL().solve(A), cholesky.matrixL().solve(y), options);
  fit.residuals = y - A * fit.x;
  return fit;
}

double huberWeight(double standardised_residual, double threshold) noexcept {
  const double r = std::abs(standardised_residual);
  return r <= threshold ? 1.0 : threshold / r;
}

double tukeyWeight(double standardised_residual, double threshold) noexcept {
  const double u = standardised_residual / threshold;
  if (std::abs(u) >= 1.0) return 0.0;
  const double v = 1.0 - u * u;
  return v * v;
}

}  // namespace spindrift
