// SPDX-License-Identifier: Apache-2.0
// The user's simulation of the machine, driven by what the control says while it runs.
//
// What drove it is kept (spindle speed over the machine's time, piecewise constant), so that it can be brought to where
// it was after the program has been ended: heat remembers. Deviations um, places mm, times s of the machine.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "core/simulation/scenario.h"
#include "core/simulation/virtual_machine.h"

namespace spindrift {

class LoopTwin {
 public:
  /// Time of a change and the speed in rpm from then on.
  using Speeds = std::vector<std::pair<double, double>>;

  /// Machine, environment, physics and effects (sizes) of the scenario; its programme is not used. Throws InputError.
  explicit LoopTwin(const Scenario& scenario);

  /// The spindle turned like this since the last call. Time does not run backwards.
  void advance(double spindle_rpm, double now_s);
  [[nodiscard]] Eigen::Vector3d deviation_um(const Eigen::Vector3d& position_mm) const;

  [[nodiscard]] const Speeds& speeds() const noexcept { return speeds_; }
  /// A fresh one, driven as another was, up to `now_s`.
  void replay(const Speeds& speeds, double now_s);

 private:
  Environment environment_;
  VirtualMachine plant_;
  std::vector<std::pair<double, PlantEffectFunction>> effects_;
  Speeds speeds_;
  double looked_s_ = 0.0;
  double now_s_ = 0.0;
};

}  // namespace spindrift
