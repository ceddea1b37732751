// SPDX-License-Identifier: Apache-2.0
// Noise that observations share, as its causes.
//
// Model: error of row i = own_i + sum_f load_fi z_f, z_f independent of unit variance: a factor is one cause (the
// reference that all rows were compared with, a calibration, an expansion coefficient) and its load what one standard
// deviation of the cause does to the row, um or urad as the row. The sigma of an observation is the total:
//   own variance = sigma_i^2 - sum_f load_fi^2,    cov(i, j) = sum_f load_fi load_fj for i != j.
// Every covariance stated so is one (positive semidefinite) as long as own variances are not negative. Memory and time
// are linear in the number of loads. Source: JCGM 100:2008 (GUM 1995) F.1.2.3.
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <span>
#include <vector>

#include "core/math/split_covariance.h"

namespace spindrift {

class SharedNoise {
 public:
  using Load = NoiseLoad;
  using Factor = NoiseFactor;

  /// Adds a cause. Loads of the same row add up, zeros are dropped; a cause without any load is none. Throws
  /// InternalError for a load that is not finite.
  void addFactor(Factor loads);
  /// Adds the causes of rows that are appended to a set: their row 0 becomes `first_row`.
  void append(const SharedNoise& other, std::size_t first_row);
  /// The causes of some of the rows: row k of the result is rows[k]. `rows` are distinct.
  [[nodiscard]] SharedNoise restrictedTo(const std::vector<std::size_t>& rows) const;

  [[nodiscard]] bool empty() const noexcept { return factors_.empty(); }
  void clear() noexcept;
  [[nodiscard]] const std::vector<Factor>& factors() const noexcept { return factors_; }

  /// Shared part of the variance of a row: sum of its squared loads.
  [[nodiscard]] double variance(std::size_t row) const noexcept;
  /// Shared part of the covariance of two rows; all of it if they differ.
  [[nodiscard]] double covariance(std::size_t a, std::size_t b) const noexcept;
  /// What is not shared of a row of total standard uncertainty `sigma`. Never negative: where the loads make more than
  /// sigma^2, by rounding or because a file states covariances that are none, the loads hold and nothing is own.
  [[nodiscard]] double ownVariance(std::size_t row, double sigma) const noexcept;
  /// Shared part of the variance of sum_k load_k row_k: here `load` is the coefficient of the row.
  [[nodiscard]] double varianceOf(std::span<const Load> combination) const;
  /// Loads of some rows: rows.size() x factors.
  [[nodiscard]] Eigen::SparseMatrix<double> loads(const std::vector<std::size_t>& rows) const;
  /// Covariances of all pairs of different rows that share a cause, in order of rows, without those below 1e-12 of the
  /// product of their sigmas: what an exchange file states. Quadratic in the rows of a cause.
  [[nodiscard]] std::vector<CovarianceEntry> covariances(const std::vector<double>& sigma) const;

 private:
  std::vector<Factor> factors_;
  std::vector<std::vector<Load>> of_row_;  ///< per row: factor (in `row`) and load, in order of factors
};

}  // namespace spindrift
