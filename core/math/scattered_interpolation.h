// SPDX-License-Identifier: Apache-2.0
// A value at a place from values at scattered places, as weights that depend on the places alone:
//
//   f(p) = sum_i w_i(p) f(p_i),   f = sum_i a_i |p - p_i|^3 + b0 + b . p,   sum a_i = 0, sum a_i p_i = 0
//
// (cubic radial basis function with linear part: of all interpolants the one of least energy of bending in its class).
// Exact at the places and for every f that is linear in p. Of more than `most_places` the nearest `nearest_places` are
// used. Places that lie in a plane, on a line or in one point (to a thousandth of their spread) have a linear part
// along these directions only, and f is constant across. Outside the convex hull, where a cubic runs away, f goes on
// linearly from the nearest point h of the hull: f(p) = f(h) + grad f(h) . (p - h). All in one unit of length. Sources:
// Wendland, Scattered Data Approximation (2005), ch. 8 and 11; Wolfe, Finding the nearest point in a polytope, Math.
// Programming 11 (1976).
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

namespace spindrift {

/// The point of the convex hull of `points` (at least one) that is nearest to `place`.
[[nodiscard]] Eigen::Vector3d nearestInHull(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& place);

class ScatteredInterpolation {
 public:
  static constexpr std::size_t most_places = 600;
  static constexpr std::size_t nearest_places = 120;

  /// At least one place, all finite, no two the same.
  explicit ScatteredInterpolation(std::vector<Eigen::Vector3d> places);

  struct Weights {
    std::vector<std::size_t> place;  ///< indices
    std::vector<double> weight;      ///< sum 1
    double outside = 0.0;            ///< distance to the convex hull; 0 inside
  };
  [[nodiscard]] Weights at(const Eigen::Vector3d& place) const;

 private:
  /// The equations of some of the places.
  struct System {
    std::vector<std::size_t> place;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    Eigen::Matrix<double, 3, Eigen::Dynamic> directions;  ///< columns along which the places spread
    double scale = 1.0;
    Eigen::PartialPivLU<Eigen::MatrixXd> equations;
  };
  [[nodiscard]] System system(std::vector<std::size_t> which) const;
  [[nodiscard]] std::vector<std::size_t> nearest(const Eigen::Vector3d& place, std::size_t count) const;

  std::vector<Eigen::Vector3d> places_;
  double extent_ = 0.0;
  System all_;  ///< of all places, where they are few
};

}  // namespace spindrift
