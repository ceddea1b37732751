// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/virtual_captures.h"

#include <fmt/format.h>

#include "core/base/atomic_file.h"
#include "core/base/units.h"
#include "core/imaging/pattern.h"
#include "core/machine/component.h"

namespace spindrift {
namespace {

void addTruth(nlohmann::json& list, const std::string& state, const std::string& point, const SmallError& error,
              bool rotations) {
  for (const Component component : all_components) {
    if (isRotation(component) && !rotations) continue;
    list.push_back(
        {{"state", state}, {"point", point}, {"component", toString(component)}, {"value", valueOf(error, component)}});
  }
}

}  // namespace

VirtualCaptures::VirtualCaptures(std::shared_ptr<const VirtualMachine> plant, const PlantEffectSettings& settings,
                                 std::optional<MicroscopeOptions> microscope, std::optional<ProfilerOptions> profiler,
                                 std::uint64_t image_seed, std::uint64_t scan_seed)
    : plant_(std::move(plant)),
      microscope_(std::move(microscope)),
      profiler_(std::move(profiler)),
      image_seed_(image_seed),
      scan_seed_(scan_seed) {
  for (const auto& [id, setting] : settings) effects_.emplace_back(setting.size, plant_->effect(id, setting));
}

SmallError VirtualCaptures::deviation(double time_s, const Eigen::Vector3d& position_mm,
                                      const std::string& point) const {
  PlantQuery query;
  query.time_s = std::min(time_s, plant_->duration_s());
  query.position_mm = position_mm;
  query.point = point;
  SmallError sum;
  for (const auto& [size, function] : effects_) sum += size * function(query);
  return sum;
}

double VirtualCaptures::seconds_per_fiducial() const {
  const VirtualFiducialOptions& o = microscope_->images;
  return o.image_interval_s * static_cast<double>(o.rotations_deg.size() + 2 * o.steps_mm.size() + o.heights_mm.size());
}

std::size_t VirtualCaptures::images() const {
  if (!microscope_) return 0;
  const VirtualFiducialOptions& o = microscope_->images;
  return microscope_->times_s.size() * o.fiducials.size() *
         (o.rotations_deg.size() + 2 * o.steps_mm.size() + o.heights_mm.size());
}

std::size_t VirtualCaptures::scans() const {
  return profiler_ ? profiler_->times_s.size() * profiler_->artefacts.size() : 0;
}

void VirtualCaptures::write(const std::filesystem::path& folder, nlohmann::json& machine, JobContext& job) const {
  JobContext first = job.part(0.0, profiler_ ? 0.5 : 1.0);
  if (microscope_) writeImages(folder, first);
  JobContext second = job.part(microscope_ ? 0.5 : 0.0, 1.0);
  if (profiler_) writeScans(folder, machine, second);
}

void VirtualCaptures::writeImages(const std::filesystem::path& folder, JobContext& job) const {
  VirtualFiducialOptions options = microscope_->images;
  for (std::size_t k = 0; k < microscope_->times_s.size(); ++k) {
    VirtualState state;
    state.name = fmt::format("M{}", k);
    state.time_s = microscope_->times_s[k];
    state.deviation_um.assign(options.fiducials.size(), Eigen::Vector3d::Zero());
    options.states.push_back(state);
  }
  options.deviation_at = [this](const VirtualFiducial& fiducial, double time_s) -> Eigen::Vector3d {
    const Eigen::Vector3d at(fiducial.position_mm.x(), fiducial.position_mm.y(), 0.0);
    return deviation(time_s, at, fiducial.id).translation_mm * um_per_mm;
  };
  const FiducialPattern& pattern = microscope_->pattern ? *microscope_->pattern : standardPattern();
  if (microscope_->pattern) writeFileAtomically(folder / "pattern.json", patternJson(pattern));
  writeVirtualFiducialCaptures(folder, pattern, options, image_seed_, job);
}

void VirtualCaptures::writeScans(const std::filesystem::path& folder, nlohmann::json& machine, JobContext& job) const {
  VirtualScanCampaign plan;
  plan.mounting = profiler_->mounting;
  plan.optics = profiler_->optics;
  plan.pocket = profiler_->pocket;
  plan.artefacts = profiler_->artefacts;
  plan.bending = profiler_->bending;
  for (std::size_t k = 0; k < profiler_->times_s.size(); ++k) {
    plan.cycles.push_back({fmt::format("C{}", k), profiler_->times_s[k], profiler_->seconds_per_artefact});
  }
  // The plant gives the error where the profiler looks; the carriage carries it at the slide's origin.
  const Eigen::Vector3d slide_to_tool =
      profiler_->mounting.lever_mm - Eigen::Vector3d(0, 0, profiler_->mounting.lift_mm);
  const Eigen::Vector3d place = profiler_->artefact_at_mm.front();
  plan.error = [&](double time_s, double y_mm) {
    return deviation(time_s, {place.x(), y_mm, place.z()}, {}).at(-slide_to_tool);
  };
  const nlohmann::json entry = nlohmann::json::parse(writeVirtualScans(plan, folder, scan_seed_, job));
  machine["profiler"].update(entry);
}

nlohmann::json VirtualCaptures::truth() const {
  nlohmann::json list = nlohmann::json::array();
  if (microscope_) {
    const auto& fiducials = microscope_->images.fiducials;
    for (std::size_t f = 0; f < fiducials.size(); ++f) {
      const Eigen::Vector3d at(fiducials[f].position_mm.x(), fiducials[f].position_mm.y(), 0.0);
      SmallError cold;
      for (std::size_t k = 0; k < microscope_->times_s.size(); ++k) {
        // The plane is measured first, the height last.
        const VirtualFiducialOptions& o = microscope_->images;
        const double start_s = microscope_->times_s[k] + static_cast<double>(f) * seconds_per_fiducial();
        const double plane_s = start_s + 0.5 * o.image_interval_s * static_cast<double>(o.rotations_deg.size());
        const double height_s =
            start_s + seconds_per_fiducial() - 0.5 * o.image_interval_s * static_cast<double>(o.heights_mm.size());
        SmallError now = deviation(plane_s, at, fiducials[f].id);
        now.translation_mm.z() = deviation(height_s, at, fiducials[f].id).translation_mm.z();
        if (k == 0) cold = now;
        addTruth(list, fmt::format("M{}", k), fiducials[f].id, now - cold, false);
      }
    }
  }
  if (profiler_) {
    for (std::size_t a = 0; a < profiler_->artefacts.size(); ++a) {
      const VirtualArtefact& artefact = profiler_->artefacts[a];
      Eigen::Vector3d at = profiler_->artefact_at_mm[a];
      // A rigid scan is carried as a whole by the error where it starts; the values are those of the centroid.
      Eigen::Vector3d to_centroid = Eigen::Vector3d::Zero();
      if (profiler_->mounting.scan_model == "rigid") {
        to_centroid.y() = at.y() - artefact.y_mm;
        at.y() = artefact.y_mm;
      }
      SmallError cold;
      for (std::size_t k = 0; k < profiler_->times_s.size(); ++k) {
        const double time_s = profiler_->times_s[k] + static_cast<double>(a) * profiler_->seconds_per_artefact;
        const SmallError now = deviation(time_s, at, {}).at(to_centroid);
        if (k == 0) cold = now;
        addTruth(list, fmt::format("C{}", k), artefact.id, now - cold, true);
      }
    }
  }
  return list;
}

}  // namespace spindrift
