// SPDX-License-Identifier: Apache-2.0
// Bodies that carry the machine, each with volumes that have temperatures of their own: a bed plate on four feet, the
// two rails that turn a bridge, a guideway on a saddle, the hub of a rotary table. What they do to the tool is close to
// the simple turn or growth that carries its name, and a few percent to a tenth off it, as real castings are. For
// plant_effects.cpp only.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/simulation/small_bodies.h"
#include "core/simulation/virtual_machine.h"

namespace spindrift {

/// A temperature in K above the start.
using Rise = std::function<double(double time_s)>;

/// A volume that is tied to a driving body and to one that stays: C dT/dt = G (part * drive - T), C / G = lag_s > 0.
struct Follower {
  double part = 1.0;
  double lag_s = 300.0;
};
[[nodiscard]] std::vector<SampledSignal> followers(const Rise& drive, const std::vector<Follower>& volumes,
                                                   double duration_s);

/// frame.rotation.a and .b: two feet of the bed grow, the plate on them turns and twists a little; .c: one of two rails
/// grows. `origin_mm` stays where it is.
[[nodiscard]] PlantEffectFunction turningFrame(const VirtualMachine& plant, int axis, const Eigen::Vector3d& origin_mm,
                                               const Rise& drive);

/// squareness.drift.c0y: a saddle turns the guideway of Y and warms one flank of it, so that it also bends.
[[nodiscard]] PlantEffectFunction turningGuideway(const VirtualMachine& plant, double origin_y_mm, const Rise& drive);

/// rotary.drift, rotary.tilt, rotary.expansion: four walls of the hub, three rings of the table.
[[nodiscard]] PlantEffectFunction rotaryHub(const VirtualMachine& plant, const std::string& id, const Rise& drive,
                                            const Rise& hub);

/// Spindle minus column in the plane (mm) of a column that carries an overhanging head: the parameters overhang_x_mm
/// and overhang_y_mm, else "column":{"overhang_mm":[x,y]} of machine.json, else 0.
[[nodiscard]] Eigen::Vector2d columnOverhang_mm(const MachineDescription& machine, const PlantEffectSetting& setting);
/// A column that turns also lifts the head that overhangs.
void liftOverhang(SmallError& e, const Eigen::Vector2d& overhang_mm);

}  // namespace spindrift
