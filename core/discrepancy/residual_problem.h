// SPDX-License-Identifier: Apache-2.0
// The residual observation - simulation as a whitened least-squares problem with its nuisances.
//
//   r = constant(series) + simulation * gain(component) + model error of the simulation + X beta + e
//   cov(e) within a series = s^2 [(1 - a) I + a exp(-|dt| / T)] sigma_i sigma_j (+ covariances stated)
//
// A unit is one observation, or, where there are very many, the mean of neighbours in time of one series at one place:
// drivers are averaged over the same times, so this loses only what happens inside a bin. Units are ordered by series
// and time. Vectors "projected" are whitened, have one extra row for each prior, and are orthogonal to all nuisances.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "core/discrepancy/discrepancy.h"

namespace spindrift {

struct NoiseModel {
  double scale = 1.0;               ///< actual / stated sigma
  double correlated_part = 0.0;     ///< a, 0 ... 1
  double correlation_time_s = 0.0;  ///< T
};

/// A nuisance column over the units; prior_sigma = 0: free, else standard deviation of its coefficient.
struct NuisanceColumn {
  Eigen::VectorXd values;
  double prior_sigma = 0.0;
};

/// Columns "projected" through their inner products alone: only the rows on which they are not zero are kept.
struct ProjectedColumns {
  Eigen::MatrixXd rows;           ///< whitened, free of the constants, of the series that take part
  Eigen::MatrixXd dots;           ///< products with the orthonormal basis of the nuisances
  Eigen::VectorXd with_residual;  ///< products with the projected residual
  Eigen::VectorXd whole;          ///< squared norms once whitened, before anything was removed

  /// Gram matrix of `count` columns from `from` on.
  [[nodiscard]] Eigen::MatrixXd gram(Eigen::Index from, Eigen::Index count) const;
  [[nodiscard]] Eigen::MatrixXd gram() const { return gram(0, rows.cols()); }
};

class ResidualProblem {
 public:
  /// `rows` are the observations that may be used (matched, fit). At most about `unit_limit` units.
  ResidualProblem(const DiscrepancyInput& input, const std::vector<std::size_t>& rows, std::size_t unit_limit);

  [[nodiscard]] Eigen::Index size() const noexcept { return static_cast<Eigen::Index>(y.size()); }
  [[nodiscard]] int seriesCount() const noexcept { return static_cast<int>(series_begin.size()) - 1; }

  std::vector<DeviationQuery> place;
  std::vector<Component> component;
  std::vector<int> series;                 ///< of each unit
  std::vector<Eigen::Index> series_begin;  ///< first unit of each series, and the end
  std::vector<std::string> series_point;
  std::vector<double> time_s;  ///< mean time
  std::vector<int> epoch;      ///< index of the thermal state (or time bin)
  int epoch_count = 0;
  std::vector<double> epoch_time_s;
  Eigen::VectorXd y;                ///< residual, um or urad
  Eigen::VectorXd simulated;        ///< um or urad
  Eigen::VectorXd sigma;            ///< stated
  std::vector<double> node_time_s;  ///< distinct times at which drivers are needed, increasing
  /// Mean of values at the nodes over the times of every unit.
  [[nodiscard]] Eigen::VectorXd toUnits(const Eigen::VectorXd& at_nodes) const;

  NoiseModel noise;
  void setNoise(const NoiseModel& model);
  /// Sets all nuisances besides the constants; recomputes the projected residual.
  void setNuisances(const std::vector<NuisanceColumn>& columns);
  [[nodiscard]] const std::vector<NuisanceColumn>& nuisances() const noexcept { return nuisances_; }

  /// Whitened, augmented and orthogonal to the nuisances.
  [[nodiscard]] Eigen::MatrixXd projected(const Eigen::MatrixXd& columns) const;
  [[nodiscard]] const Eigen::VectorXd& projectedResidual() const noexcept { return projected_y_; }
  [[nodiscard]] Eigen::MatrixXd whitened(const Eigen::MatrixXd& columns) const;
  /// Columns courses(:, o) * shapes(:, c), o-major, over the series in `active`, on which the shapes are not zero;
  /// `further`: an orthonormal basis, projected as well, that is removed in addition (no columns: none).
  [[nodiscard]] ProjectedColumns projectedProducts(const Eigen::MatrixXd& courses, const Eigen::MatrixXd& shapes,
                                                   const std::vector<int>& active,
                                                   const Eigen::MatrixXd& further) const;
  [[nodiscard]] int degreesOfFreedom() const noexcept;

  /// The nuisances that belong to the simulation: its gain per component within the stated uncertainty, and as much for
  /// the parts it is made of in space and time and for its lags.
  [[nodiscard]] std::vector<NuisanceColumn> simulationNuisances(double gain_uncertainty) const;

 private:
  void removeConstants(Eigen::MatrixXd& augmented) const;
  std::vector<std::size_t> node_begin_;
  std::vector<int> node_index_;
  std::vector<std::pair<std::pair<Eigen::Index, Eigen::Index>, double>> extra_covariance_;
  std::vector<Eigen::MatrixXd> block_whitener_;  ///< per block of units that are correlated; empty: diagonal
  std::vector<std::pair<Eigen::Index, Eigen::Index>> blocks_;
  Eigen::VectorXd diagonal_whitener_;
  Eigen::MatrixXd constants_;  ///< whitened unit vector of each series, stored in place of its rows (n x 1)
  bool coupled_ = false;
  std::vector<NuisanceColumn> nuisances_;
  Eigen::Index prior_rows_ = 0;
  Eigen::MatrixXd q_;  ///< orthonormal basis of the nuisances, augmented
  Eigen::VectorXd projected_y_;
};

/// Estimates scale and correlation in time from what is not of low rank in the tables points x epochs; `fitted`: the
/// residual is that of a fitted model, so that less signal is in it. Deterministic.
[[nodiscard]] NoiseModel estimateNoise(const ResidualProblem& problem, const Eigen::VectorXd& residual, bool fitted);

}  // namespace spindrift
