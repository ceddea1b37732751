// SPDX-License-Identifier: Apache-2.0
// A field through scattered values: what is known of a component between the points at which it was measured.
//
//   v_i = v(p_i) + e_i,   v ~ Gaussian process: unknown mean, variance s^2, correlation exp(-|d|^2 / (2 l^2)),
//   e_i ~ N(0, sigma_i^2)
//
// d is the difference of two places (MCF, mm). A few points do not tell s and l, so predictions are averaged over a
// grid of both (l from a fifth of the extent of the points to three times it), weighted by their restricted likelihood;
// the sigma holds the scatter among them and that of the mean. A smooth process swings beyond its data between and
// beside the points; nothing larger or smaller than was measured is stated: the value ends at the range of the values,
// and how far it was taken back is in its sigma. Values um or urad, places mm. Sources: Cressie, Statistics for Spatial
// Data, 3.4 (kriging); Patterson and Thompson 1971 (restricted likelihood); GUM F.2.4.5 (a correction not applied).
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "core/machine/error_model.h"
#include "core/machine/field.h"

namespace spindrift {

/// One value at a place.
struct ScatteredValue {
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  double value = 0.0;  ///< um or urad
  double sigma = 0.0;  ///< > 0
};

class InterpolatedField : public ErrorModel {
 public:
  /// At least one value, all finite with sigma > 0; several at one place are allowed.
  InterpolatedField(Component component, std::vector<ScatteredValue> values);

  [[nodiscard]] std::string description() const override;
  /// Within the range of the values, um or urad. Zero with infinite sigma for any other component.
  [[nodiscard]] PredictedComponent predict(const DeviationQuery& query, Component component) const override;

 private:
  /// One pair of s and l.
  struct Process {
    double log_likelihood = 0.0;
    double weight = 1.0;
    double length_mm = 1.0;
    double variance = 0.0;
    double mean = 0.0;
    double mean_variance = 0.0;
    Eigen::LLT<Eigen::MatrixXd> covariance;
    Eigen::VectorXd residual;  ///< inverse covariance times (value - mean)
    Eigen::VectorXd ones;      ///< inverse covariance times one
  };
  [[nodiscard]] Eigen::VectorXd correlations(const Eigen::Vector3d& place, double length_mm) const;

  Component component_;
  std::vector<ScatteredValue> values_;
  double lowest_ = 0.0;
  double highest_ = 0.0;
  std::vector<Process> processes_;  ///< weights sum to 1
};

/// Whether places spread over the plane of X and Y: at least three, and not along one line.
[[nodiscard]] bool spreadsOverPlane(const std::vector<ScatteredValue>& values);

/// The field between measured values over a grid, with these as its markers; nodes outside their convex hull are marked
/// as extrapolated. Of more than `most_points` values every n-th is used: more say no more about a smooth field, and
/// cost their number cubed. The places spread over the plane.
[[nodiscard]] Field fieldBetween(Component component, const std::vector<ScatteredValue>& values, const FieldGrid& grid,
                                 std::size_t most_points = 40);

}  // namespace spindrift
