// SPDX-License-Identifier: Apache-2.0
// The parts of a scenario that say what the microscope and the laser profiler look at, and when.
//
//    "microscope":{"every_s","states" or "times_s","fiducials":["F1"],"width_px","height_px","pixel_length_um",
//                  "centre_px":[x,y],"camera_turn_deg","blur_sigma_px","defocus_px_per_um","noise_level","gradient_x",
//                  "gradient_y","flicker","spindle_repeatability_um","axis_repeatability_um","dust","jpeg_quality",
//                  "rotations_deg":[],"steps_mm":[],"heights_mm":[],"image_interval_s",
//                  "pattern":"pattern.json" (relative to the scenario) or {"rows","columns","first_row","first_column",
//                  "pitch_um"}; without it the standard pattern},
//    "profiler":{"every_s","cycles" or "times_s","seconds_per_artefact","alpha_rad","beta_rad","gamma_rad",
//                "offset_mm":[dx,dy,dz],"profile_spacing_mm","white_noise_um","speckle_noise_um",
//                "artefacts":[{"point","y_mm","turn_rad","bumps":[{"x_mm","y_mm","radius_mm","height_mm"}],
//                "bending":{"along_mm","across_mm","twist_mm","held_at","skew","time_constant_s"} (it changes its shape
//                as the machine warms up; see ArtefactBending)}]}
//
// The profiler's lever, lift, scan model, points a profile and calibration circle are those of machine.json.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/json_reader.h"
#include "core/imaging/pattern.h"
#include "core/machine/machine_description.h"
#include "core/simulation/virtual_fiducials.h"
#include "core/simulation/virtual_profiler.h"

namespace spindrift {

/// Images of coded fiducials in thermal states. `images.states` stays empty: it follows from the plant.
struct MicroscopeOptions {
  std::vector<double> times_s;  ///< start of each thermal state
  VirtualFiducialOptions images;
  /// Artwork of the user's own fiducials, written as pattern.json into the campaign; null: the standard pattern.
  std::shared_ptr<const FiducialPattern> pattern;
};

/// Scans of artefacts that stand along the axis.
struct ProfilerOptions {
  std::vector<double> times_s;  ///< start of each cycle
  double seconds_per_artefact = 40.0;
  VirtualProfilerMounting mounting;
  VirtualOptics optics;
  VirtualPocket pocket;
  std::vector<VirtualArtefact> artefacts;          ///< id = point of the machine
  std::vector<Eigen::Vector3d> artefact_at_mm;     ///< that point, MCF
  std::map<std::string, ArtefactBending> bending;  ///< of those that bend, by id
};

/// Throw InputError with file and JSON path for anything that is not as described above.
/// `folder`: of the scenario, where the file of a pattern is looked for.
[[nodiscard]] MicroscopeOptions parseMicroscope(const JsonNode& node, const MachineDescription& machine,
                                                std::vector<double> times_s, const std::filesystem::path& folder);
[[nodiscard]] ProfilerOptions parseProfiler(const JsonNode& node, const MachineDescription& machine,
                                            std::vector<double> times_s);

}  // namespace spindrift
