// SPDX-License-Identifier: Apache-2.0
// From touches to features: centre, diameter and form of holes and spheres, height of a surface.
//
// The stylus centre stands off the material by the stylus radius r along the approach n: contact = position + r n.
//   hole    |p_i - c| = D/2 - r across the hole axis, plus surface touches beside it along the axis (their mean height)
//   sphere  |p_i - c| = D/2 + r
// Fits are those of core/geometry/shape_fit.h. One bad touch is left out where the others convict it. Uncertainty:
// touch noise sigma times the geometry of the touches; a centre that the touches do not determine is a status naming
// the direction.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/shape_fit.h"
#include "core/probing/touch.h"

namespace spindrift {

enum class FeatureKind { Hole, Sphere };

struct FeatureOptions {
  double sigma_mm = 0.0;                    ///< touch noise; 0: from the residuals of the feature
  std::optional<double> known_diameter_mm;  ///< else the diameter is fitted
  Eigen::Vector3d axis{0, 0, 1};            ///< of a hole, unit
  bool tolerate_one_bad_touch = true;
  double outlier_threshold = 5.0;
  /// Noise magnified by more than this counts as not determined (badly spread touches).
  double largest_amplification = 30.0;
};

struct ProbedFeature {
  FitStatus status = FitStatus::NotRun;  ///< of the centre
  std::string message = "not run";
  FeatureKind kind = FeatureKind::Sphere;
  std::string cycle, artefact, feature, stylus;
  double c_deg = 0.0;
  double time_s = 0.0;  ///< mean of its touches
  /// Hole: across the axis from the wall touches, along it from the surface touches (contact). Without surface touches
  /// the height is that of the wall touches and `has_surface` is false.
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the centre, mm^2
  double diameter_mm = 0.0;
  double diameter_sigma_mm = 0.0;
  double form_mm = 0.0;  ///< largest minus smallest distance of the touches used
  double rms_mm = 0.0;
  bool has_wall = false;
  bool has_surface = false;
  Eigen::Vector3d weak = Eigen::Vector3d::Zero();  ///< direction that is determined worst
  std::vector<std::size_t> touches;                ///< indices into the list
  std::optional<std::size_t> rejected;             ///< index of the touch left out
};

/// Touches `indices` of `list` as one feature. Throws InternalError if `indices` is empty.
[[nodiscard]] ProbedFeature fitFeature(const TouchList& list, std::span<const std::size_t> indices, FeatureKind kind,
                                       double stylus_radius_mm, const FeatureOptions& options = {});

/// Height of a plane surface along `normal` from touches on it: mean of normal . contact, mm, and its uncertainty.
struct SurfaceHeight {
  FitStatus status = FitStatus::NotRun;
  std::string message = "not run";
  double height_mm = 0.0;
  double sigma_mm = 0.0;
  double form_mm = 0.0;
};
[[nodiscard]] SurfaceHeight fitSurfaceHeight(const TouchList& list, std::span<const std::size_t> indices,
                                             const Eigen::Vector3d& normal, double stylus_radius_mm, double sigma_mm);

/// True if the touch approaches along the axis (a surface touch of a hole feature), false if across it (the wall).
[[nodiscard]] bool isSurfaceTouch(const Touch& touch, const Eigen::Vector3d& axis);

}  // namespace spindrift
