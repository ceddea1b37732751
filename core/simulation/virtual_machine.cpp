// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/virtual_machine.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/text.h"
#include "core/simulation/plant_effects.h"

namespace spindrift {
namespace {

constexpr std::array<std::string_view, 3> axis_letters{"x", "y", "z"};

/// Ids that stand once per linear axis.
constexpr std::array<std::string_view, 9> per_axis{
    "ball_screw.expansion", "ball_screw.nonuniform", "scale.expansion", "ambient.drift",
    "instrument.warm_up",   "periodic.pitch",        "backlash",        "coolant.shock",
    "heat_source.position"};
constexpr std::array<std::string_view, 15> fixed_ids{
    "spindle.growth.z",     "spindle.centrifugal.z", "spindle.drift.x",  "spindle.drift.y",    "head.tilt.a",
    "head.tilt.b",          "column.bending.a",      "column.bending.b", "column.expansion.z", "table.expansion.xy",
    "squareness.drift.c0y", "crossbeam.sag.z",       "external_heat.a",  "external_heat.b",    "external_heat.z"};
constexpr std::array<std::string_view, 11> more_ids{"frame.rotation.a",     "frame.rotation.b",  "frame.rotation.c",
                                                    "rotary.drift.x0c",     "rotary.drift.y0c",  "rotary.drift.z0t",
                                                    "rotary.tilt.a0c",      "rotary.tilt.b0c",   "rotary.tilt.c0c",
                                                    "rotary.expansion.r0t", "artefact.expansion"};

bool known(std::string_view id) {
  if (id.starts_with("fixture.slip.")) return true;
  for (const std::string_view stem : per_axis) {
    for (const std::string_view axis : axis_letters) {
      if (id == fmt::format("{}.{}", stem, axis)) return true;
    }
  }
  const std::vector<std::string> outside = causesOutsideCatalogue();
  return std::find(fixed_ids.begin(), fixed_ids.end(), id) != fixed_ids.end() ||
         std::find(more_ids.begin(), more_ids.end(), id) != more_ids.end() ||
         std::find(outside.begin(), outside.end(), id) != outside.end();
}

}  // namespace

std::vector<std::string> causesOutsideCatalogue() {
  return {"unknown.foundation_creep", "unknown.hydraulics", "unknown.power_supply", "unknown.humidity",
          "unknown.chip_load"};
}

std::string whyNotPossible(std::string_view id, const MachineDescription& machine) {
  if (!known(id)) {
    return "is not an effect of the catalogue (spindrift-cli effects lists it) and none of " +
           joinedList(causesOutsideCatalogue());
  }
  const auto starts = [&](std::string_view stem) { return id.starts_with(stem); };
  if (starts("fixture.slip.")) {
    if (machine.findPoint(id.substr(13)) == nullptr) return "names a point that the machine does not have";
    return {};
  }
  const LinearAxis* axis = nullptr;
  for (const std::string_view stem : per_axis) {
    if (!starts(stem)) continue;
    axis = machine.findAxis(std::string(1, static_cast<char>(id.back() - 'x' + 'X')));
    if (axis == nullptr) return "needs an axis that the machine does not have";
    const bool linear_scale = axis->scale == "linear_scale";
    const bool screw = axis->drive_type == "ball_screw";
    if ((starts("ball_screw.") || starts("periodic.") || starts("backlash.")) && !screw) {
      return "needs a ball screw on that axis (drive.type)";
    }
    if (starts("ball_screw.") && linear_scale) return "cannot be seen on an axis with a linear scale";
    if (starts("scale.") && !linear_scale) return "needs a linear scale on that axis (scale)";
    if (starts("periodic.") && !axis->pitch_mm) return "needs the pitch of the screw (drive.pitch_mm)";
  }
  if ((starts("column.") || id == "external_heat.a" || id == "external_heat.b") && !machine.column_base_mm) {
    return "needs a column (column.base_mm)";
  }
  if (starts("crossbeam.") && !machine.crossbeam) return "needs a crossbeam (crossbeam)";
  if (starts("rotary.") && machine.rotary.empty()) return "needs a rotary axis (rotary)";
  if (starts("artefact.") && machine.artefacts.empty()) return "needs an artefact (artefacts)";
  return {};
}

std::vector<std::string> catalogueOf(const MachineDescription& machine) {
  std::vector<std::string> ids;
  const auto add = [&](const std::string& id) {
    if (whyNotPossible(id, machine).empty()) ids.push_back(id);
  };
  for (const std::string_view id : fixed_ids) add(std::string(id));
  for (const std::string_view stem : per_axis) {
    for (const std::string_view axis : axis_letters) add(fmt::format("{}.{}", stem, axis));
  }
  for (const std::string_view id : more_ids) add(std::string(id));
  for (const MachinePoint& point : machine.points) add("fixture.slip." + point.id);
  return ids;
}

std::vector<std::string> effectParameters(std::string_view id) {
  if (id.starts_with("fixture.slip.")) return {"time_s", "step_x_um", "step_y_um", "step_z_um"};
  if (id.starts_with("external_heat.")) return {"onset_s", "length_s", "flux_W", "overhang_x_mm", "overhang_y_mm"};
  if (id.starts_with("column.bending.")) return {"overhang_x_mm", "overhang_y_mm"};
  if (id.starts_with("head.tilt.")) return {"lever_x_mm", "lever_y_mm", "lever_z_mm", "ram"};
  if (id.starts_with("frame.rotation.") || id.starts_with("squareness.")) {
    return {"origin_x_mm", "origin_y_mm", "origin_z_mm"};
  }
  if (id.starts_with("periodic.")) return {"phase_rad", "steady_um"};
  if (id == "unknown.hydraulics") return {"period_s"};
  return {};
}

VirtualMachine::VirtualMachine(const MachineDescription& machine, const Programme& programme,
                               const Environment& environment, const PlantParameters& parameters, double duration_s,
                               std::uint64_t seed, const JobContext& job)
    : machine_(machine),
      programme_(programme),
      environment_(environment),
      parameters_(parameters),
      duration_s_(duration_s),
      seed_(seed),
      thermal_(runThermal(machine, programme, environment, parameters, duration_s, job)) {}

VirtualMachine::VirtualMachine(const MachineDescription& machine, const Environment& environment,
                               const PlantParameters& parameters, std::uint64_t seed)
    : machine_(machine),
      programme_(std::vector<ProgrammeSegment>(1)),
      environment_(environment),
      parameters_(parameters),
      duration_s_(0.0),
      seed_(seed),
      driven_(std::make_shared<ThermalStepper>(machine, environment, parameters)) {}

void VirtualMachine::advance(const ProgrammeSegment& now, double until_s) {
  SPINDRIFT_ASSERT(driven_ != nullptr, "a machine that is driven");
  while (driven_->time_s() + ThermalStepper::step_s <= until_s) {
    const double from_s = driven_->time_s();
    const ProgrammeSegment& last = programme_.segments().back();
    if (last.spindle_rpm != now.spindle_rpm || last.feed_mm_min != now.feed_mm_min || last.coolant != now.coolant ||
        last.c_rpm != now.c_rpm) {
      ProgrammeSegment next = now;
      next.from_s = from_s;
      programme_.append(next);
    }
    driven_->step(now);
    duration_s_ = driven_->time_s();
  }
}

PlantEffectFunction VirtualMachine::effect(const std::string& id, const PlantEffectSetting& setting) const {
  const std::string reason = whyNotPossible(id, machine_);
  if (!reason.empty()) throw InputError(fmt::format("effect \"{}\" {}.", id, reason));
  const bool looks_ahead = id.starts_with("instrument.") || id.starts_with("coolant.") || id.starts_with("unknown.") ||
                           id.starts_with("heat_source.") || id.starts_with("external_heat.");
  if (driven_ && looks_ahead) throw InputError(fmt::format("effect \"{}\" needs the whole program beforehand.", id));
  return makePlantEffect(*this, id, setting);
}

std::vector<SmallError> VirtualMachine::deviations(const PlantEffectSettings& settings,
                                                   const std::vector<PlantQuery>& queries) const {
  std::vector<SmallError> total(queries.size());
  for (const auto& [id, setting] : settings) {
    if (!setting.on || setting.size == 0.0) continue;
    const PlantEffectFunction function = effect(id, setting);
    for (std::size_t i = 0; i < queries.size(); ++i) total[i] += setting.size * function(queries[i]);
  }
  return total;
}

double VirtualMachine::temperature_degC(const std::vector<int>& volumes, double time_s) const {
  double sum = 0.0;
  for (const int volume : volumes) sum += thermal().heated.at(volume, time_s);
  return sum / static_cast<double>(volumes.size());
}

}  // namespace spindrift
