// SPDX-License-Identifier: Apache-2.0
// The virtual machine: from the temperatures of its bodies to the deviation of the tool relative to the table.
//
// Every cause of deviation has an id (those of EFFECTS.md, and `unknown.*` for causes that no catalogue knows), a
// switch and a size that multiplies what the physics gives (1 = the standard machine). A cause moves one or two axes or
// bodies: strains are integrated along the cells of a body, slopes and deflections from the difference of two walls,
// errors of an axis go through the kinematic chain to the tool. Nothing here is fitted and nothing is shared with the
// error model that searches for these causes.
//
// Frames and units: MCF, mm, rad, s, degC; deviation = actual minus commanded position of the tool relative to the
// table. Axis coordinates are those of the spindle reference (tool point minus tool offset).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/small_error.h"
#include "core/simulation/machine_bodies.h"

namespace spindrift {

/// One cause, switched on or off. `driver` chooses the body that drives a cause with a choice ("room", "column",
/// "spindle"); `parameters` are named in effectParameters().
struct PlantEffectSetting {
  bool on = true;
  double size = 1.0;
  std::string driver;
  std::map<std::string, double> parameters;

  [[nodiscard]] double parameter(const std::string& name, double otherwise) const {
    const auto found = parameters.find(name);
    return found == parameters.end() ? otherwise : found->second;
  }
};

/// By id.
using PlantEffectSettings = std::map<std::string, PlantEffectSetting>;

/// Where and when the deviation is asked for.
struct PlantQuery {
  double time_s = 0.0;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();  ///< tool point, commanded
  double c_rad = 0.0;                                     ///< rotation of the table about +Z
  Eigen::Vector3d approach = Eigen::Vector3d::Zero();
  Eigen::Vector3d tool_offset_mm = Eigen::Vector3d::Zero();
  std::string_view point;
  /// Where the table carries what is touched, if it is one body that is held there and grows by itself, as an artefact
  /// does; nothing: a point of the table itself.
  std::optional<Eigen::Vector3d> held_mm;

  /// The place of the table whose movement by growth the touched point takes part in.
  [[nodiscard]] const Eigen::Vector3d& placeOnTable_mm() const { return held_mm ? *held_mm : position_mm; }
};

/// Deviation that one cause adds.
using PlantEffectFunction = std::function<SmallError(const PlantQuery&)>;

/// Ids of EFFECTS.md that this machine can have (a scale needs a linear scale, bending a column, ...). `fixture.slip`
/// is given once per point.
[[nodiscard]] std::vector<std::string> catalogueOf(const MachineDescription& machine);
/// Ids of the causes outside the catalogue.
[[nodiscard]] std::vector<std::string> causesOutsideCatalogue();
/// Empty if the machine can have this cause, else the reason in a sentence without a full stop.
[[nodiscard]] std::string whyNotPossible(std::string_view id, const MachineDescription& machine);
/// Names that `PlantEffectSetting::parameters` may have for this cause.
[[nodiscard]] std::vector<std::string> effectParameters(std::string_view id);

class VirtualMachine {
 public:
  /// Runs the heat flow. `seed` decides the times of causes that have their own (a power supply that steps).
  VirtualMachine(const MachineDescription& machine, const Programme& programme, const Environment& environment,
                 const PlantParameters& parameters, double duration_s, std::uint64_t seed, const JobContext& job = {});

  /// A machine that a control drives: it stands at the beginning, and `advance` moves it on. Causes that look ahead in
  /// their programme (instrument.warm_up, coolant splash, heat that follows the position) cannot be had of it.
  VirtualMachine(const MachineDescription& machine, const Environment& environment, const PlantParameters& parameters,
                 std::uint64_t seed);
  /// Runs with these speeds until `until_s` (in whole steps of the heat flow). Of a driven machine only.
  void advance(const ProgrammeSegment& now, double until_s);

  /// The function of one cause; throws InputError if the machine cannot have it. Valid as long as this object.
  [[nodiscard]] PlantEffectFunction effect(const std::string& id, const PlantEffectSetting& setting) const;
  /// Sum of all causes that are on, at each query.
  [[nodiscard]] std::vector<SmallError> deviations(const PlantEffectSettings& settings,
                                                   const std::vector<PlantQuery>& queries) const;
  /// Mean temperature of volumes (volumesAt).
  [[nodiscard]] double temperature_degC(const std::vector<int>& volumes, double time_s) const;

  [[nodiscard]] const MachineDescription& machine() const noexcept { return machine_; }
  [[nodiscard]] const Programme& programme() const noexcept { return programme_; }
  [[nodiscard]] const Environment& environment() const noexcept { return environment_; }
  [[nodiscard]] const PlantParameters& parameters() const noexcept { return parameters_; }
  [[nodiscard]] const ThermalRun& thermal() const noexcept { return driven_ ? driven_->run() : thermal_; }
  [[nodiscard]] double duration_s() const noexcept { return duration_s_; }
  [[nodiscard]] std::uint64_t seed() const noexcept { return seed_; }

 private:
  MachineDescription machine_;
  Programme programme_;
  Environment environment_;
  PlantParameters parameters_;
  double duration_s_;
  std::uint64_t seed_;
  ThermalRun thermal_;
  std::shared_ptr<ThermalStepper> driven_;
};

}  // namespace spindrift
