// SPDX-License-Identifier: Apache-2.0
// The virtual laser profiler: scans a free-form artefact or the calibration pocket from a machine with errors, as a
// real instrument would deliver it.
//
// Geometry (mm, rad). A reading (x, y, z) in the profiler's frame stands for the point, in the tool frame at the start
// of the scan lowered by the lift,
//   rigid:       P = Rc (x, y, z) + d                     push_broom:  P = Rc (x, 0, z) + (0, y, 0) + d
// with Rc = Rx(alpha) Ry(beta) Rz(gamma), d = (dx, dy, dz) without the lift (P3 (6)). The carriage's error E = (e, w)
// at the slide's origin moves it to P + e + w x q, q = lever - (0, 0, lift) + Rc (x, y, z) + d (push_broom: y = 0, with
// E of the carriage position of that profile). The reading is the z for which the moved point lies on the surface.
//
// Optics: white noise of every reading, speckle-like noise correlated over `speckle_points` neighbours of a profile,
// lost points, points lost where the surface is too steep, gross outliers anywhere and more of them near edges,
// profiles at irregular positions (known to the control) with a small error of the recorded position (not known to it).
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/base/random.h"
#include "core/geometry/small_error.h"
#include "core/scanning/artefact_surface.h"
#include "core/scanning/cloud.h"

namespace spindrift {

struct VirtualOptics {
  int profile_points = 3200;
  double profile_interval_mm = 0.0125;
  double profile_spacing_mm = 0.15;
  double white_noise_um = 0.5;
  double speckle_noise_um = 0.5;    ///< standard deviation of the correlated part
  int speckle_points = 3;           ///< length of the moving average that correlates it
  double position_jitter_um = 0.5;  ///< of the profile's carriage position, recorded in y
  double position_error_um = 0.1;   ///< of the recorded position, unknown to the evaluation
  double outlier_rate = 5e-4;
  double outlier_size_mm = 1.0;  ///< standard deviation
  double edge_outlier_rate = 0.05;
  double edge_width_mm = 0.2;
  double lost_rate = 2e-3;
  double steepest_slope = 1.2;  ///< |dz/dx| or |dz/dy| beyond which nothing returns

  void validate() const;
};

/// How the profiler sits in the machine.
struct VirtualProfilerMounting {
  std::string scan_model = "rigid";  ///< "rigid" or "push_broom"
  double alpha_rad = 0.0;
  double beta_rad = 0.0;
  double gamma_rad = 0.0;
  Eigen::Vector3d offset_mm = Eigen::Vector3d::Zero();  ///< dx, dy, dz without the lift
  double lift_mm = 178.152;
  Eigen::Vector3d lever_mm{-900.0, 0.0, -2051.0};  ///< slide origin to tool frame
};

/// How an artefact bends while its machine warms up: curved along y and across, twisted, held at one place.
struct ArtefactBending {
  double along_mm = 0.0;            ///< over half its length
  double across_mm = 0.0;           ///< over half its width
  double twist_mm = 0.0;            ///< at its corners
  double held_at = 0.0;             ///< place along y where it is held, -1 to 1: there it neither moves nor turns
  double skew = 0.0;                ///< part of the curvature that grows along y
  double time_constant_s = 7200.0;  ///< first-order, from the start of the campaign on; > 0

  /// At a place of the surface and a time.
  [[nodiscard]] double height_mm(const ArtefactSurface& surface, double x_mm, double y_mm, double time_s) const;
};

/// Where an artefact stands: its centre in the frame of P above, turned by `yaw_rad` about Z.
struct VirtualArtefact {
  std::string id = "A1";
  double y_mm = 350.0;  ///< carriage position where the scan starts
  ArtefactSurface surface;
  Eigen::Vector3d centre_mm{0.0, 20.5, 0.0};
  double yaw_rad = 0.0;
  /// What bends it: smooth and small height (mm) by place in the artefact's frame (mm). Where the height tilts the
  /// surface, its relief shifts sideways (about z = 0): normals of the body stay normal.
  std::function<double(double x_mm, double y_mm)> bending;
};

/// Error of the axis at the slide's origin as a function of the carriage position (mm).
using CarriageError = std::function<SmallError(double y_mm)>;

/// One scan of an artefact. `carriage` may be empty (no error).
[[nodiscard]] PointCloud virtualScan(const VirtualArtefact& artefact, const VirtualProfilerMounting& mounting,
                                     const VirtualOptics& optics, const CarriageError& carriage, Random& random);

/// A circular pocket in a plane plate, `circle_mm` = (x, y, z, r) in the tool frame lowered by the lift.
struct VirtualPocket {
  std::array<double, 4> circle_mm{0.0, 0.0, 0.0, 12.496};
  double depth_mm = 3.0;
  double scan_from_mm = -16.0;  ///< carriage positions scanned
  double scan_to_mm = 16.0;
  double profile_spacing_mm = 0.1;
};
[[nodiscard]] PointCloud virtualPocketScan(const VirtualPocket& pocket, const VirtualProfilerMounting& mounting,
                                           const VirtualOptics& optics, Random& random);

/// A whole campaign of scans.
struct VirtualScanCycle {
  std::string name = "C0";
  double time_s = 0.0;
  double seconds_per_artefact = 40.0;
};
struct VirtualScanCampaign {
  std::string name = "virtual crossbeam";
  std::string start_utc = "2026-01-31T08:00:00Z";
  VirtualProfilerMounting mounting;
  VirtualOptics optics;
  VirtualPocket pocket;
  std::vector<VirtualArtefact> artefacts;
  std::vector<VirtualScanCycle> cycles;
  /// Error of the axis at the slide's origin, by time (s) and carriage position (mm).
  std::function<SmallError(double time_s, double y_mm)> error;
  std::map<std::string, ArtefactBending> bending;  ///< of the artefacts that bend, by their id
};

/// Writes `captures/scans.csv` and the clouds (binary PCD), the calibration scan included, into an existing campaign
/// folder. Returns the text of the "profiler" entry for machine.json; nothing else is written.
[[nodiscard]] std::string writeVirtualScans(const VirtualScanCampaign& campaign, const std::filesystem::path& folder,
                                            std::uint64_t seed, JobContext& job);

/// The same into a new folder with its campaign.json and machine.json: a complete campaign.
void writeVirtualScanCampaign(const VirtualScanCampaign& campaign, const std::filesystem::path& folder,
                              std::uint64_t seed, JobContext& job);

}  // namespace spindrift
