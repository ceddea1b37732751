// SPDX-License-Identifier: Apache-2.0
// The virtual machine as what a control drives: a process of its own beside the control, at any speed factor.
//
// It reads from HAL what the control does (spindle speed, drive positions, compensation), runs heat flow and structure
// of the virtual machine with it (core/simulation), and writes back what the machine then is: the deviation of the tool
// at the place where it stands (error-x ...), temperatures of its sensors, and its clock (machine-time). Touches of the
// control therefore carry the truth. Nobody but truth.csv is told the deviation itself; it is for judging afterwards.
#pragma once

#include <filesystem>
#include <functional>

#include "core/simulation/scenario.h"

namespace spindrift {

struct BesideControlOptions {
  Scenario scenario;    ///< machine, environment, physics, effects (sizes), sensors; its programme is not used
  double factor = 1.0;  ///< machine seconds per second, (0, 1000]
  Eigen::Vector3d reference_mm = Eigen::Vector3d::Zero();  ///< where truth.csv states the deviation
  std::filesystem::path truth;  ///< time_s,ex_um,ey_um,ez_um,cx_um,cy_um,cz_um,spindle_rpm, a row each 30 s
  double duration_s = 0.0;      ///< of the machine's time
  void validate() const;        ///< throws InputError
};

/// Runs until `duration_s` or until `ended`. A control that goes away and comes back is taken up again; the machine's
/// time and heat go on meanwhile. Throws InputError.
void runBesideControl(const BesideControlOptions& options, const std::function<bool()>& ended);

}  // namespace spindrift
