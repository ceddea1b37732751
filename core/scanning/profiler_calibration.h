// SPDX-License-Identifier: Apache-2.0
// Where the laser profiler sits in the tool frame, from one scan of a circular pocket (P3 section 3.1, equations 5-9).
//
// Model: P = Rc (x, y, z) + d (rigid) or Rc (x, 0, z) + (0, y, 0) + d (push_broom), Rc = Rx(alpha) Ry(beta) Rz(gamma),
// d = (dx, dy, dz) without the lift. The rim of the pocket lies on (X - X0)^2 + (Y - Y0)^2 = r^2, the plate around it
// on Z = Z0. Data: the plane of the plate (its slopes and height) and the rim in every profile, found between two
// samples. One weighted least squares for all six parameters and a common offset of the rim's radius.
//
// What the data cannot determine. rigid: a circle is invariant under rotation about its axis, so gamma is not seen, and
// with it the part of (dx, dy) that turns with gamma. push_broom: y has no part in the height, so alpha is seen only
// through the depth of the rim below the origin, together with dy. Such an angle is given as 0 with the standard
// uncertainty of the mounting (`mounting_angle_rad`), the lengths carry that along, and its name stands in
// `undetermined`.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/geometry/rigid_transform.h"
#include "core/scanning/cloud.h"
#include "core/scanning/registration.h"

namespace spindrift {

struct CalibrationOptions {
  ScanModel scan_model = ScanModel::Rigid;
  /// Standard uncertainty of an angle of the mounting before anything is measured (rad).
  double mounting_angle_rad = 0.02;
  /// alpha, beta, gamma where they are known from elsewhere (a dial indicator, a jog by a known distance): value and
  /// standard uncertainty (rad).
  std::array<std::optional<std::array<double, 2>>, 3> known_angles_rad;
  /// Standard uncertainty of the pocket's radius as seen by the laser, beyond the samples (mm).
  double radius_uncertainty_mm = 0.005;
  /// Unevenness of the rim and of the carriage between profiles (mm).
  double rim_roughness_mm = 0.001;

  void validate() const;
};

/// One crossing of the rim.
struct RimPoint {
  Eigen::Vector3d point_mm = Eigen::Vector3d::Zero();  ///< profiler's frame, on the plane of the plate
  double sigma_x_mm = 0.0;                             ///< of x
  double residual_um = 0.0;                            ///< distance from the circle after the fit
  bool used = true;
};

struct ProfilerCalibration {
  FitStatus status = FitStatus::NotRun;
  std::string message;
  ScanModel scan_model = ScanModel::Rigid;
  double alpha_rad = 0.0;
  double beta_rad = 0.0;
  double gamma_rad = 0.0;
  Eigen::Vector3d offset_mm = Eigen::Vector3d::Zero();  ///< dx, dy, dz without the lift
  /// Of (alpha, beta, gamma, dx, dy, dz), rad and mm.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  std::vector<std::string> undetermined;  ///< "gamma_rad", ... with the reason in `message`
  std::vector<RimPoint> rim;
  double rim_rms_um = 0.0;
  double plane_rms_um = 0.0;
  /// Slope of the plate along the scan that the model cannot explain (push_broom; rad).
  double unexplained_slope_rad = 0.0;
  double radius_offset_um = 0.0;

  [[nodiscard]] bool usable() const noexcept { return status == FitStatus::Converged; }
  [[nodiscard]] Eigen::Matrix3d rotation() const;
  /// P3 (6), (11): with the lift subtracted from dz.
  [[nodiscard]] RigidTransform tcsFromProfiler(double lift_mm) const;
  [[nodiscard]] double standardUncertainty(int i) const { return std::sqrt(covariance(i, i)); }
};

/// An angle or shift of the profiler for sentences: "alpha_rad" -> "α about X", "dx_mm" -> "dx".
[[nodiscard]] std::string mountingInWords(std::string_view key);

/// circle_mm = (X0, Y0, Z0, r) in the tool frame. Throws InputError for a cloud without profiles or a circle that makes
/// no sense; a scan without a pocket gives a status with its reason.
[[nodiscard]] ProfilerCalibration calibrateProfiler(const PointCloud& scan, const std::array<double, 4>& circle_mm,
                                                    const CalibrationOptions& options = {});

}  // namespace spindrift
