// SPDX-License-Identifier: Apache-2.0
// Lines, planes, circles and spheres through measured points: geometric (orthogonal distance) least squares.
//
// Model: minimise sum d_i^2, d_i = distance of point i from the shape, mm.
//   circle, sphere  d_i = |p_i - c| - r      start: algebraic fit, then damped Gauss-Newton on the distances
//   plane           d_i = n . (p_i - p0)     closed form: smallest principal axis of the scatter matrix
//   line            d_i = |(I - u u^T)(p_i - p0)|   closed form: largest principal axis
// Covariance: sigma^2 (J^T J)^-1 at the solution, first order. sigma is the standard uncertainty of one point along the
// normal: given in the options, else estimated from the residuals (sum d^2 / degrees of freedom).
// Failure: never an exception. Too few points, or points that leave a direction open, give FitStatus::Degenerate, and
// the message and `weak` name that direction; points that contradict each other give FitStatus::Rejected.
// No memory is allocated unless there is something to complain about: fits may run by the hundred thousand.
// Sources: Forbes (1989) "Least-squares best-fit geometric elements", NPL report DITC 140/89; ISO 10360-6.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>

#include "core/base/error.h"

namespace spindrift {

struct ShapeFitOptions {
  /// Standard uncertainty of one point along the normal, mm. 0: estimated from the residuals.
  double sigma_mm = 0.0;
  /// True: the worst point is left out if it contradicts the others (`outlier_threshold`, `rejected`).
  bool tolerate_one_bad_point = false;
  /// A point is bad if its distance from the shape through the others exceeds this many standard uncertainties
  /// (sigma_mm known). With an unknown sigma the limit is that of Student's distribution at 0.1 % over all points.
  double outlier_threshold = 5.0;
  /// Circle and sphere: hold the radius at this value, mm.
  std::optional<double> known_radius_mm;
  /// Circle and sphere: start here instead of at the algebraic fit (needed where points in one plane and a known radius
  /// leave two solutions), mm. The circle uses x and y.
  std::optional<Eigen::Vector3d> start_mm;
  /// The fit is degenerate if noise reaches any direction of the parameters magnified by more than this.
  double largest_amplification = 1e3;
  int max_iterations = 50;

  /// Throws InternalError for values that make no sense.
  void validate() const;
};

/// What every fit says beside its shape.
struct ShapeFitSummary {
  FitStatus status = FitStatus::NotRun;
  std::string message = "not run";
  int points_used = 0;
  int rejected = -1;  ///< index of the point left out, -1 if none
  int degrees_of_freedom = 0;
  double sigma_mm = 0.0;       ///< of one point: given, or estimated from the residuals (0 if neither is possible)
  double rms_mm = 0.0;         ///< root mean square distance of the points used
  double form_mm = 0.0;        ///< largest minus smallest signed distance of the points used (line: largest distance)
  double amplification = 0.0;  ///< largest factor from the noise of a point to a direction of the parameters

  [[nodiscard]] bool usable() const noexcept { return status == FitStatus::Converged; }
};

struct CircleFit : ShapeFitSummary {
  Eigen::Vector2d centre_mm = Eigen::Vector2d::Zero();
  double radius_mm = 0.0;
  Eigen::Matrix3d cofactor = Eigen::Matrix3d::Zero();    ///< (J^T J)^-1 for (cx, cy, r); a known radius has zeros
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< sigma^2 times `cofactor`, mm^2; infinite without sigma
  Eigen::Vector3d weak = Eigen::Vector3d::Zero();        ///< unit direction in (cx, cy, r) that is determined worst
};

struct SphereFit : ShapeFitSummary {
  Eigen::Vector3d centre_mm = Eigen::Vector3d::Zero();
  double radius_mm = 0.0;
  Eigen::Matrix4d cofactor = Eigen::Matrix4d::Zero();  ///< for (cx, cy, cz, r)
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  Eigen::Vector4d weak = Eigen::Vector4d::Zero();
};

struct PlaneFit : ShapeFitSummary {
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();           ///< centroid of the points
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();            ///< unit; its largest component is positive
  double offset_sigma_mm = 0.0;                                 ///< of the plane along its normal, at the centroid
  Eigen::Matrix3d normal_covariance = Eigen::Matrix3d::Zero();  ///< rad^2, in the plane
  Eigen::Vector3d weak = Eigen::Vector3d::Zero();               ///< direction in which the points are narrowest
};

struct LineFit : ShapeFitSummary {
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();    ///< centroid of the points
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit; its largest component is positive
  double offset_sigma_mm = 0.0;                          ///< of the line at the centroid, in each direction across it
  double direction_sigma_rad = 0.0;                      ///< in each direction across it
  Eigen::Matrix3d direction_covariance = Eigen::Matrix3d::Zero();  ///< rad^2
};

/// At least 3 points (2 with a known radius).
[[nodiscard]] CircleFit fitCircle(std::span<const Eigen::Vector2d> points_mm, const ShapeFitOptions& options = {});
/// At least 4 points (3 with a known radius).
[[nodiscard]] SphereFit fitSphere(std::span<const Eigen::Vector3d> points_mm, const ShapeFitOptions& options = {});
/// At least 3 points that are not on a line.
[[nodiscard]] PlaneFit fitPlane(std::span<const Eigen::Vector3d> points_mm, const ShapeFitOptions& options = {});
/// At least 2 points that differ.
[[nodiscard]] LineFit fitLine(std::span<const Eigen::Vector3d> points_mm, const ShapeFitOptions& options = {});

}  // namespace spindrift
