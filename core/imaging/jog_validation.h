// SPDX-License-Identifier: Apache-2.0
// Checks of the whole measurement against the resolution of the axes (P0 section 3.5).
//
// Jogs: every state is a jog to another commanded position of the same fiducial; the deviation that is measured is the
// difference between jog and microscope, and should stay within one resolution of the axis. Cold repeatability: the
// same positions measured again in the cold state should come back within half a resolution. Values in um, relative to
// the first state.
#pragma once

#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/machine/machine_description.h"
#include "core/machine/observation.h"

namespace spindrift {

struct AxisVerdict {
  Component component = Component::EX;
  std::size_t count = 0;  ///< differences judged
  double limit_um = 0.0;
  double largest_um = 0.0;  ///< magnitude
  double largest_sigma_um = 0.0;
  std::string largest_at;  ///< "F3 in state M2"
  double rms_um = 0.0;
  double standard_deviation_um = 0.0;  ///< of single measurements about their mean, pooled over points
  bool passed = false;
};

struct ResolutionCheck {
  FitStatus status = FitStatus::NotRun;
  std::vector<AxisVerdict> axes;
  bool passed = false;
  std::string reason;  ///< one sentence
};

/// `part`: limit as a part of the axis resolution, 1 for jogs, 0.5 for repeatability. Throws InputError if an axis has
/// no `resolution_um` in machine.json. Degenerate with fewer than two states.
[[nodiscard]] ResolutionCheck checkAgainstResolution(const ObservationSet& observations,
                                                     const MachineDescription& machine, double part);

}  // namespace spindrift
