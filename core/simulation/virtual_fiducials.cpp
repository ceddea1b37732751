// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/virtual_fiducials.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <atomic>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/text.h"
#include "core/base/units.h"

namespace spindrift {
namespace {

struct Shot {
  std::string name;
  MicroscopeScene scene;
  std::uint64_t seed = 0;
};

}  // namespace

void VirtualFiducialOptions::validate() const {
  if (fiducials.empty() || states.empty()) throw InputError("a virtual campaign needs a fiducial and a thermal state.");
  for (const VirtualState& state : states) {
    if (state.deviation_um.size() != fiducials.size()) {
      throw InputError(fmt::format("state {} has {} deviations for {} fiducials; one for each is needed.", state.name,
                                   state.deviation_um.size(), fiducials.size()));
    }
  }
  if (!(pixel_length_um > 0.0)) throw InputError("the pixel length must be greater than zero (µm).");
}

PatternMap fiducialView(const VirtualFiducialOptions& options, const VirtualFiducial& fiducial,
                        const Eigen::Vector2d& tool_mm, double camera_rad) {
  // The point of the pattern under the spindle's axis.
  const Eigen::Vector2d from_fiducial_um = (tool_mm - fiducial.position_mm) * um_per_mm;
  const Eigen::Vector2d under_axis = fiducial.centre_um + Eigen::Rotation2Dd(-fiducial.turn_rad) * from_fiducial_um;
  return poseAt(options.width_px, options.height_px, options.pixel_length_um, camera_rad - fiducial.turn_rad,
                under_axis, options.cor_px, options.k1_per_px2);
}

void writeVirtualFiducialCaptures(const std::filesystem::path& folder, const FiducialPattern& pattern,
                                  const VirtualFiducialOptions& options, std::uint64_t seed, JobContext& job) {
  options.validate();
  Random random(seed);
  std::string csv = "time_s,state,fiducial,role,index,x_mm,y_mm,z_mm,spindle_deg,image\n";
  std::vector<Shot> shots;
  const auto shoot = [&](const VirtualState& state, std::size_t f, const char* role, int index,
                         const Eigen::Vector3d& offset_mm, double spindle_deg, double& time_s) {
    const VirtualFiducial& fiducial = options.fiducials[f];
    const Eigen::Vector3d commanded(fiducial.position_mm.x() + offset_mm.x(), fiducial.position_mm.y() + offset_mm.y(),
                                    offset_mm.z());
    const Eigen::Vector3d deviation_um =
        options.deviation_at ? options.deviation_at(fiducial, time_s) : state.deviation_um[f];
    Eigen::Vector3d tool = commanded + deviation_um * mm_per_um;
    tool.x() +=
        -options.axis_squareness_rad * offset_mm.y() + random.normal(0.0, options.spindle_repeatability_um) * mm_per_um;
    tool.y() += random.normal(0.0, options.spindle_repeatability_um) * mm_per_um;
    tool.z() += random.normal(0.0, options.axis_repeatability_um) * mm_per_um;
    Shot shot;
    shot.name = fmt::format("captures/images/{}_{}_{}_{}.jpg", state.name, fiducial.id, role, index);
    MicroscopeScene& scene = shot.scene;
    scene.width_px = options.width_px;
    scene.height_px = options.height_px;
    scene.map = fiducialView(options, fiducial, tool.head<2>(), options.camera_turn_rad + spindle_deg * rad_per_deg);
    scene.blur_sigma_px = options.blur_sigma_px;
    scene.defocus_px_per_um = options.defocus_px_per_um;
    scene.defocus_um = (tool.z() - options.z_focus_mm) * um_per_mm;
    scene.noise_level = options.noise_level;
    scene.gradient_x = options.gradient_x;
    scene.gradient_y = options.gradient_y;
    scene.illumination_gain = 1.0 + random.normal(0.0, options.flicker);
    scene.dust = options.dust;
    scene.jpeg_quality = options.jpeg_quality;
    shot.seed = random.bits();
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", exactNumber(time_s), csvField(state.name),
                       csvField(fiducial.id), role, index, exactNumber(commanded.x()), exactNumber(commanded.y()),
                       exactNumber(commanded.z()), exactNumber(spindle_deg), csvField(shot.name));
    time_s += options.image_interval_s;
    shots.push_back(std::move(shot));
  };
  for (const VirtualState& state : options.states) {
    double time_s = state.time_s;
    for (std::size_t f = 0; f < options.fiducials.size(); ++f) {
      for (std::size_t k = 0; k < options.rotations_deg.size(); ++k) {
        shoot(state, f, "rotation", static_cast<int>(k), Eigen::Vector3d::Zero(), options.rotations_deg[k], time_s);
      }
      for (std::size_t k = 0; k < options.steps_mm.size(); ++k) {
        shoot(state, f, "x_axis", static_cast<int>(k), {options.steps_mm[k], 0, 0}, 0.0, time_s);
      }
      for (std::size_t k = 0; k < options.steps_mm.size(); ++k) {
        shoot(state, f, "y_axis", static_cast<int>(k), {0, options.steps_mm[k], 0}, 0.0, time_s);
      }
      for (std::size_t k = 0; k < options.heights_mm.size(); ++k) {
        shoot(state, f, "focus", static_cast<int>(k), {0, 0, options.heights_mm[k]}, 0.0, time_s);
      }
    }
  }
  std::filesystem::create_directories(folder / "captures" / "images");
  std::atomic<std::size_t> done = 0;
  parallelFor(shots.size(), job, [&](std::size_t k) {
    MicroscopeScene scene = shots[k].scene;
    const int quality = scene.jpeg_quality > 0 ? scene.jpeg_quality : 100;
    scene.jpeg_quality = 0;
    writeFileAtomically(folder / shots[k].name, encodeJpeg(renderFiducial(pattern, scene, shots[k].seed), quality));
    const std::size_t now = ++done;
    job.report(static_cast<double>(now) / static_cast<double>(shots.size()),
               fmt::format("image {} of {}", now, shots.size()));
  });
  writeFileAtomically(folder / "captures" / "fiducials.csv", csv);
}

void writeVirtualFiducialCampaign(const std::filesystem::path& folder, const FiducialPattern& pattern,
                                  const VirtualFiducialOptions& options, std::uint64_t seed, JobContext& job) {
  writeVirtualFiducialCaptures(folder, pattern, options, seed, job);
  nlohmann::json points = nlohmann::json::array();
  double far_x = 0.0;
  double far_y = 0.0;
  for (const VirtualFiducial& f : options.fiducials) {
    points.push_back(
        {{"id", f.id}, {"kind", "fiducial"}, {"x_mm", f.position_mm.x()}, {"y_mm", f.position_mm.y()}, {"z_mm", 0.0}});
    far_x = std::max(far_x, f.position_mm.x());
    far_y = std::max(far_y, f.position_mm.y());
  }
  const nlohmann::json machine = {{"format", "spindrift-machine"},
                                  {"version", 1},
                                  {"name", "virtual three-axis mill"},
                                  {"chain", "V [w-X'-Y'-b-Z-(C)-t]"},
                                  {"axes",
                                   {{{"name", "X"}, {"travel_mm", {0.0, far_x + 20.0}}, {"resolution_um", 1.0}},
                                    {{"name", "Y"}, {"travel_mm", {0.0, far_y + 20.0}}, {"resolution_um", 1.0}},
                                    {{"name", "Z"}, {"travel_mm", {0.0, 150.0}}, {"resolution_um", 1.0}}}},
                                  {"spindle", {{"axis", "Z"}, {"max_rpm", 10000}}},
                                  {"points", points}};
  writeFileAtomically(folder / "machine.json", machine.dump(1) + "\n");
  const nlohmann::json campaign = {{"format", "spindrift-campaign"},
                                   {"version", 1},
                                   {"name", "virtual fiducials"},
                                   {"start_utc", "2026-01-01T08:00:00Z"}};
  writeFileAtomically(folder / "campaign.json", campaign.dump(1) + "\n");
}

}  // namespace spindrift
