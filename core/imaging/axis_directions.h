// SPDX-License-Identifier: Apache-2.0
// Directions of the machine's X and Y axes in the fiducial and in the image (P0 (10)-(11)).
//
// While the tool moves along an axis by dc (mm), the place of the fiducial under one fixed pixel moves by w dc in FCF:
// w is fitted by a straight line through all positions. FCF is turned by psi about +Z in MCF: w_x = 1000 R(-psi) x.
// The camera's direction phi (MCF X in the camera's frame, x right, y up, at spindle_deg = 0) is the same for all
// fiducials and states unless the camera turns in its holder: orientation - psi = phi - spindle angle. It is pooled as
// long as a chi-squared test does not speak against it. Angles in rad, counter-clockwise seen from above.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/imaging/image_pose.h"

namespace spindrift {

struct AxisImage {
  ImagePose pose;
  Eigen::Vector2d commanded_mm = Eigen::Vector2d::Zero();
  double spindle_deg = 0.0;
};

/// Images of one fiducial in one state along X and along Y (either may be empty).
struct AxisSet {
  std::string fiducial;
  std::string state;
  std::vector<AxisImage> x;
  std::vector<AxisImage> y;
};

struct AxisOptions {
  double expected_repeatability_um = 0.25;  ///< of a position per coordinate, from experience ...
  double expected_weight = 2.0;             ///< ... worth that many degrees of freedom
  double test_level = 0.01;
};

struct AxisDirection {
  bool measured = false;
  double angle_rad = 0.0;  ///< of the axis in FCF
  double sigma_rad = 0.0;
  double image_angle_rad = 0.0;  ///< in the image, from image x towards image y, as P0 (10)
  double scale_error = 0.0;      ///< measured / commanded travel minus one
  double scale_error_sigma = 0.0;
};

struct SetDirections {
  std::string fiducial;
  std::string state;
  AxisDirection x;
  AxisDirection y;
  bool both = false;
  double orthogonality_rad = 0.0;  ///< angle from X to Y minus a right angle
  double orthogonality_sigma_rad = 0.0;
  double psi_rad = 0.0;  ///< direction of FCF in MCF from this set
  double psi_sigma_rad = 0.0;
  double phi_rad = 0.0;  ///< direction of the camera from this set
};

struct AxisDirections {
  FitStatus status = FitStatus::NotRun;
  std::string message;
  std::vector<SetDirections> sets;
  double repeatability_um = 0.0;  ///< standard deviation of the positions about the lines
  /// Standard uncertainty of it from its degrees of freedom nu (ISO/TR 230-9): s / sqrt(2 nu).
  double repeatability_sigma_um = 0.0;
  bool pooled = false;         ///< phi holds for all
  double phi_rad = 0.0;        ///< weighted mean
  double phi_sigma_rad = 0.0;  ///< widened by the scatter if the test fails
  double p_value = 1.0;        ///< of one phi for all
};

/// Sets need >= 2 positions along at least one axis, else they are left out. Degenerate if none remains; Rejected where
/// all sets have Y clockwise from X, as no machine has it.
[[nodiscard]] AxisDirections fitAxisDirections(const std::vector<AxisSet>& sets, const AxisOptions& options = {});

/// Difference of two angles in (-pi, pi].
[[nodiscard]] double angleDifference(double a_rad, double b_rad);

}  // namespace spindrift
