// SPDX-License-Identifier: Apache-2.0
// A whole campaign of fiducial images as an operator would have taken them: folder with machine.json, campaign.json,
// captures/fiducials.csv and the images.
//
// Geometry (FORMATS.md): the camera hangs in the spindle, turned by phi + spindle_deg about +Z (counter-clockwise seen
// from above). The tool stands at commanded + deviation. A point of the table at v (mm, MCF) from the spindle's axis is
// seen at cor + (v . e, -v . f) / pixel length, e and f = the camera's x axis and its up. A fiducial's pattern is
// turned by its own small angle. Blur grows with |z commanded + EZ - z_focus|, so that the peak over the commanded
// height moves by -EZ.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/base/job_context.h"
#include "core/simulation/virtual_microscope.h"

namespace spindrift {

struct VirtualFiducial {
  std::string id;                                         ///< "F1"
  Eigen::Vector2d position_mm = Eigen::Vector2d::Zero();  ///< nominal, MCF
  double turn_rad = 0.0;                                  ///< direction of the pattern's X in MCF, about +Z
  Eigen::Vector2d centre_um{1400.0, 1400.0};  ///< point of the pattern that stands at the nominal position, FCF
};

struct VirtualState {
  std::string name;                           ///< "M0"
  double time_s = 0.0;                        ///< of its first image
  std::vector<Eigen::Vector3d> deviation_um;  ///< EX, EY, EZ at every fiducial
};

struct VirtualFiducialOptions {
  int width_px = 1920;
  int height_px = 1080;
  double pixel_length_um = 1.23;
  Eigen::Vector2d cor_px{959.8, 540.4};  ///< pixel that the spindle's axis meets (after distortion)
  double camera_turn_rad = -0.1;         ///< phi
  double k1_per_px2 = 1e-9;
  double blur_sigma_px = 1.0;  ///< in focus
  double defocus_px_per_um = 0.014;
  double z_focus_mm = 0.0;
  double noise_level = 2.0;
  double gradient_x = 0.2;
  double gradient_y = 0.1;
  double flicker = 0.01;                   ///< relative standard deviation of the light from image to image
  double spindle_repeatability_um = 0.25;  ///< scatter of the tool at every shot, X and Y
  double axis_repeatability_um = 0.1;      ///< scatter of Z at every shot
  double axis_squareness_rad = 0.0;        ///< machine Y axis turned by this about +Z beyond 90 deg
  int dust = 5;
  int jpeg_quality = 92;
  std::vector<double> rotations_deg = {-8.0, 0.0, 8.0};
  std::vector<double> steps_mm = {-0.1016, -0.0508, 0.0, 0.0508, 0.1016};  ///< of x_axis and y_axis
  std::vector<double> heights_mm = {-0.254, -0.127, 0.0, 0.127, 0.254};
  double image_interval_s = 8.0;
  std::vector<VirtualFiducial> fiducials;
  std::vector<VirtualState> states;
  /// If given, EX, EY, EZ (um) at a fiducial at the time of every shot, in place of those of the states.
  std::function<Eigen::Vector3d(const VirtualFiducial&, double time_s)> deviation_at;

  /// Throws InputError.
  void validate() const;
};

/// Writes `captures/fiducials.csv` and the images into an existing campaign folder. Same options and seed: same files.
void writeVirtualFiducialCaptures(const std::filesystem::path& folder, const FiducialPattern& pattern,
                                  const VirtualFiducialOptions& options, std::uint64_t seed, JobContext& job);

/// The same as a complete campaign with machine.json and campaign.json: writes into `folder` (made if missing). Same
/// options and seed: same files.
void writeVirtualFiducialCampaign(const std::filesystem::path& folder, const FiducialPattern& pattern,
                                  const VirtualFiducialOptions& options, std::uint64_t seed, JobContext& job);

/// The map of one shot: tool at `tool_mm` (actual, relative to the table), camera turned by `camera_rad` in all.
[[nodiscard]] PatternMap fiducialView(const VirtualFiducialOptions& options, const VirtualFiducial& fiducial,
                                      const Eigen::Vector2d& tool_mm, double camera_rad);

}  // namespace spindrift
