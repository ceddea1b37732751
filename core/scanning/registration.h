// SPDX-License-Identifier: Apache-2.0
// How the profiler moved between two scans of the same artefact.
//
// Model: a point p of the source (warm) lies on the surface of the target (cold) at
//   p' = p + M^-1 ( u + (R - I) Q (p - c) ),    R = exp([w]x),
// with u (mm) and w (rad) in machine axes: the deviation of the tool at the centroid c of the target, or at another
// place along the scan if the options ask for one. Scan model rigid: the cloud moves as one body, Q = M (rotation
// machine_from_cloud). Scan model push_broom: every profile is taken at its own carriage position, so y has no lever:
// Q = M diag(1, 0, 1), and the second column of M is the carriage's direction.
//
// Method `Surface` (ours): both clouds are compressed into cells, the target becomes a bicubic spline with analytic
// normals, and 6 x 6 normal equations are accumulated over the source cells with Tukey's loss, its scale from the
// median absolute residual; no search tree. A start that does not fit is followed by a coarse search over shifts and
// turns. Methods `NdtIcp` (P3 section 3.3) and `Gicp` use PCL and also take free-form clouds.
//
// Covariance: residuals of both scans, with their short-range correlation (long-run variance from the spatial
// autocovariance beyond what the spline itself makes) and with noise common to a row of cells (profile jitter).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/geometry/rigid_transform.h"
#include "core/scanning/cloud.h"
#include "core/scanning/free_form.h"
#include "core/scanning/height_spline.h"

namespace spindrift {

enum class RegistrationMethod { Surface, NdtIcp, Gicp };
enum class ScanModel { Rigid, PushBroom };

/// "rigid" or "push_broom"; throws InputError for anything else.
[[nodiscard]] ScanModel scanModelFromString(std::string_view name);
[[nodiscard]] std::string_view toString(ScanModel model) noexcept;
/// For sentences: "rigid", "push broom".
[[nodiscard]] std::string_view printedName(ScanModel model) noexcept;

struct RegistrationOptions {
  RegistrationMethod method = RegistrationMethod::Surface;
  ScanModel scan_model = ScanModel::Rigid;
  /// Rotation of the profiler in the machine (P3 (6)): columns are the profiler's axes in machine axes.
  Eigen::Matrix3d machine_from_profiler = Eigen::Matrix3d::Identity();
  /// Start: translation at the target's centroid (mm) and rotation (rad), machine axes.
  Eigen::Vector3d start_translation_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d start_rotation_rad = Eigen::Vector3d::Zero();
  /// Place along the scan (profiler's y, mm) at which u is asked; the centroid of the target where there is none.
  std::optional<double> at_y_mm;
  /// push_broom: order of the drift of u along the scan, 0 to 2. The second order is held by `smooth_length_mm`.
  int drift_order = 2;
  /// Length l over which errors of the axis change (mm): with an error A sin(y / l + phase) the second order is at most
  /// A (L / l)^2 / 2, L half of the scan. Taken as its standard deviation; A from u and its slope.
  double smooth_length_mm = 300.0;
  int most_iterations = 30;
  double tukey_threshold = 6.0;
  /// Search after a start that does not fit: shifts up to +-search_mm, turns up to +-search_rad about Z.
  double search_mm = 3.0;
  double search_rad = 0.045;
  /// Part of the overlapping cells that must agree, and part of the target that must be seen.
  double least_inliers = 0.5;
  double least_overlap = 0.3;
  /// Directions in which the surface determines less than this part of the best direction are free.
  double degenerate_ratio = 1e-5;
  /// Take a source that fits nowhere once more as an unordered free-form cloud (PCL) before rejecting it.
  bool fall_back = false;
  /// Method Surface: where the evidence says that the surface has changed its shape (free_form.h), find the change
  /// beside the motion. A scan that no motion explains is not rejected for it then.
  bool free_form = false;
  /// Natural logarithm of the evidence from which on there is a change of shape: a hundred to one.
  double clear_evidence = 4.6;

  void validate() const;
};

struct RegistrationResult {
  FitStatus status = FitStatus::NotRun;
  std::string message;
  ScanModel scan_model = ScanModel::Rigid;
  std::string method;                                        ///< "surface", "ndt-icp", "gicp"
  Eigen::Vector3d centroid_mm = Eigen::Vector3d::Zero();     ///< c, profiler's frame (its y as the options ask)
  Eigen::Vector3d translation_mm = Eigen::Vector3d::Zero();  ///< u
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();    ///< w
  /// Shift between the scans that was commanded (machine axes) and is already taken out of u.
  Eigen::Vector3d commanded_mm = Eigen::Vector3d::Zero();
  /// Of (u, w) in mm and rad; infinite where a direction is free.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  /// Covariance if the noise were white and of its present size: the Cramer-Rao bound of these two scans.
  Eigen::Matrix<double, 6, 6> white_covariance = Eigen::Matrix<double, 6, 6>::Zero();
  /// Drift of u along the scan (mm): u + drift.col(0) t + drift.col(1) t^2, t = (y - c_y) / drift_length_mm.
  Eigen::Matrix<double, 3, 2> drift_mm = Eigen::Matrix<double, 3, 2>::Zero();
  double drift_length_mm = 1.0;
  RigidTransform target_from_source;  ///< profiler's frame; for push_broom only the rotation and shift at c
  double rms_mm = 0.0;                ///< of the points used about the target, along z
  double misfit_ratio = 0.0;          ///< residual of the cells over what the noise explains; 1 = only noise
  double noise_correlation = 1.0;     ///< long-run variance over the variance of single points
  double overlap = 0.0;               ///< part of the target's cells seen by the source
  double inliers = 0.0;               ///< part of the overlapping cells that agree
  std::size_t points_used = 0;
  int iterations = 0;
  double elapsed_ms = 0.0;                   ///< without reading files
  std::vector<std::string> free_directions;  ///< named, where the surface leaves some
  /// Change of the surface's shape beside the motion, where there is one; rms and misfit are of what is left.
  std::optional<FreeForm> free_form;

  [[nodiscard]] bool usable() const noexcept { return status == FitStatus::Converged; }
  [[nodiscard]] double standardUncertainty(int i) const { return std::sqrt(covariance(i, i)); }
};

/// The target, prepared once and used for any number of sources.
class RegistrationTarget {
 public:
  /// Throws InputError if the cloud is no height map.
  explicit RegistrationTarget(const PointCloud& cloud, const CellGridOptions& options = {});
  [[nodiscard]] const CellGrid& grid() const noexcept { return grid_; }
  [[nodiscard]] const HeightSpline& surface() const noexcept { return spline_; }
  /// Standard deviation of the heights about their plane (mm): how much relief there is.
  [[nodiscard]] double relief_mm() const noexcept { return relief_mm_; }

 private:
  CellGrid grid_;
  HeightSpline spline_;
  double relief_mm_ = 0.0;
};

/// Throws InputError for clouds that cannot be used at all; a registration that fails gives its status and reason.
/// The clouds are checked and compressed side by side.
[[nodiscard]] RegistrationResult registerClouds(const PointCloud& source, const PointCloud& target,
                                                const RegistrationOptions& options = {});
/// The same with a prepared target, method Surface.
[[nodiscard]] RegistrationResult registerToSurface(const PointCloud& source, const RegistrationTarget& target,
                                                   const RegistrationOptions& options = {});

/// Deviation of each source point from the target's surface after registration (um, along z); NaN outside. For
/// pictures.
[[nodiscard]] std::vector<float> deviations_um(const PointCloud& source, const RegistrationTarget& target,
                                               const RegistrationResult& registration,
                                               const RegistrationOptions& options = {});

}  // namespace spindrift
