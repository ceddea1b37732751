// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/loop_twin.h"

#include <algorithm>

#include "core/base/error.h"

namespace spindrift {

LoopTwin::LoopTwin(const Scenario& scenario)
    : environment_(scenario.environment, scenario.duration_s, scenario.seed),
      plant_(scenario.machine, environment_, scenario.physics, scenario.seed) {
  for (const auto& [id, effect] : scenario.effects) {
    if (effect.setting.on && effect.setting.size != 0.0)
      effects_.emplace_back(effect.setting.size, plant_.effect(id, effect.setting));
  }
}

void LoopTwin::advance(double spindle_rpm, double now_s) {
  // What is found now has turned since the last look.
  if (speeds_.empty() || speeds_.back().second != spindle_rpm) speeds_.emplace_back(looked_s_, spindle_rpm);
  looked_s_ = std::max(looked_s_, now_s);
  ProgrammeSegment speeds;
  speeds.spindle_rpm = spindle_rpm;
  plant_.advance(speeds, now_s);
  // Between two steps of the heat flow everything runs linearly: one step behind.
  now_s_ = std::max(0.0, now_s - ThermalStepper::step_s);
}

Eigen::Vector3d LoopTwin::deviation_um(const Eigen::Vector3d& position_mm) const {
  PlantQuery query;
  query.time_s = now_s_;
  query.position_mm = position_mm;
  Eigen::Vector3d total = Eigen::Vector3d::Zero();
  for (const auto& [size, function] : effects_) total += size * function(query).translation_mm;
  return 1e3 * total;
}

void LoopTwin::replay(const Speeds& speeds, double now_s) {
  SPINDRIFT_ASSERT(speeds_.empty(), "a simulation that has not been driven yet");
  for (std::size_t i = 0; i < speeds.size(); ++i)
    advance(speeds[i].second, i + 1 < speeds.size() ? speeds[i + 1].first : now_s);
}

}  // namespace spindrift
