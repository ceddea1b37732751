// SPDX-License-Identifier: Apache-2.0
// A covariance as own variances and a common part of low rank.
//
// Model (one-factor-per-cause form of factor analysis): the error of row i is
//   e_i = own_i + sum_f load_fi z_f,    own_i independent, z_f independent of unit variance,
// so cov(e_i, e_j) = sum_f load_fi load_fj for i != j, and var(e_i) = var(own_i) + sum_f load_fi^2. Every covariance
// made like this is positive semidefinite, and every positive semidefinite covariance can be made like this: of a
// block of rows that hang together, R = correlations, lambda its smallest eigenvalue,
//   R = lambda I + V D V^T,    loads = sigma_i V D^(1/2),    D = eigenvalues - lambda >= 0.
// Sources: JCGM 100:2008 (GUM 1995) F.1.2.3 (correlated inputs through their common causes); Lawley and Maxwell (1971)
// "Factor Analysis as a Statistical Method".
//
// Units: sigma and loads in the unit of their row, covariances in the product of the units of both rows.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace spindrift {

/// Covariance of two rows as a file states it, in units of the rows; a diagonal entry (row = column) is the variance.
struct CovarianceEntry {
  std::size_t row = 0;
  std::size_t column = 0;
  double covariance = 0.0;
};

/// What one standard deviation of a cause does to a row, in the unit of the row.
struct NoiseLoad {
  std::size_t row = 0;
  double load = 0.0;
};

/// One cause of unit variance: its loads in order of rows, each row once.
using NoiseFactor = std::vector<NoiseLoad>;

struct CovarianceSplit {
  /// Total standard deviation of every row: as given, or the root of its diagonal entry.
  std::vector<double> sigma;
  std::vector<NoiseFactor> factors;
  /// Rows of the blocks that are not positive semidefinite, increasing. Their covariances stand in the factors as they
  /// were given, so the loads of a row make more than its sigma^2; whoever takes the larger of both has a covariance,
  /// with the smallest multiple of sigma^2 on its diagonal that makes it one (in large blocks up to ten times that).
  std::vector<std::size_t> indefinite;
};

/// Splits a sparse covariance of rows of total standard deviation `sigma` (> 0), exactly but for rounding (1e-15 of
/// sigma_i sigma_j times the rows of a block). Of entries for the same pair of rows the first counts; a diagonal entry
/// (> 0) replaces sigma^2. Throws InternalError for a row that does not exist, or a sigma or diagonal entry that is
/// not positive.
///
/// Blocks of up to 1000 rows are split by their eigenvalues: as much own variance as there can be, as few factors. In
/// larger ones lambda is the largest of 1/2, 1/4, ... 1/1024 and 0 with which a Cholesky decomposition of R - lambda I
/// succeeds, so own variance may be smaller by half and the factors are as many as rows; the covariance is the same.
/// A block of n rows takes 16 n^2 bytes (1.6 GB for 10,000) and up to n^3 / 3 operations for every lambda.
[[nodiscard]] CovarianceSplit splitCovariance(const std::vector<double>& sigma,
                                              const std::vector<CovarianceEntry>& entries);

/// The same of a small dense covariance (n x n, symmetric, positive semidefinite but for rounding; at a zero variance
/// nothing is shared): n x factors, the loads. What the rows sum_f load_fi^2 leave of the variance is own.
[[nodiscard]] Eigen::MatrixXd sharedLoads(const Eigen::MatrixXd& covariance);

/// M with M M^T = covariance (n x n, symmetric): one column for each eigenvalue above `negligible`, in the unit of the
/// covariance; rows that do not hang together have columns of their own. Smaller eigenvalues count as zero.
[[nodiscard]] Eigen::MatrixXd covarianceRoot(const Eigen::MatrixXd& covariance, double negligible);

}  // namespace spindrift
