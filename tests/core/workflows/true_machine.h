// SPDX-License-Identifier: GPL-3.0-or-later
// The machine that a loop measures, without a control: deviations and temperatures of a scenario, driven by a speed.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/simulation/virtual_machine.h"
#include "core/workflows/loop_twin.h"

namespace spindrift::testing {

class TrueMachine {
 public:
  explicit TrueMachine(const Scenario& scenario)
      : twin_(scenario),
        environment_(scenario.environment, scenario.duration_s, scenario.seed),
        plant_(scenario.machine, environment_, scenario.physics, scenario.seed) {
    for (const SensorOptions& sensor : standardSensors(scenario.machine))
      sensors_.emplace_back(sensor.name, volumesAt(plant_.thermal().bodies, sensor.place, {}));
  }
  void advance(double spindle_rpm, double now_s) {
    twin_.advance(spindle_rpm, now_s);
    ProgrammeSegment speeds;
    speeds.spindle_rpm = spindle_rpm;
    plant_.advance(speeds, now_s);
    at_s_ = std::max(0.0, now_s - ThermalStepper::step_s);
  }
  [[nodiscard]] Eigen::Vector3d deviation_um(const Eigen::Vector3d& place_mm) const {
    return twin_.deviation_um(place_mm);
  }
  /// 20 where there is no such sensor.
  [[nodiscard]] double temperature_degC(const std::string& column) const {
    for (const auto& [name, volumes] : sensors_) {
      if (name == column) return plant_.temperature_degC(volumes, at_s_);
    }
    return 20.0;
  }

 private:
  LoopTwin twin_;
  Environment environment_;
  VirtualMachine plant_;
  std::vector<std::pair<std::string, std::vector<int>>> sensors_;
  double at_s_ = 0.0;
};

}  // namespace spindrift::testing
