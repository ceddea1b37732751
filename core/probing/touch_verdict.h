// SPDX-License-Identifier: Apache-2.0
// What became of every touch of an artefact, for the person at the machine: used, left out and why, excluded by the
// user, or missing although the other cycles have it.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/probing/evaluate_touches.h"

namespace spindrift {

enum class TouchState { Used, LeftOut, Excluded, Missing };

struct TouchVerdict {
  /// Of a missing touch: as in the first cycle that has it, with the name of the cycle that lacks it and no line.
  Touch touch;
  TouchState state = TouchState::Used;
  std::string reason;                                             ///< of everything that is not used
  double residual_um = std::numeric_limits<double>::quiet_NaN();  ///< along the normal, of the fit of all cycles
  double studentised = std::numeric_limits<double>::quiet_NaN();  ///< residual over its standard deviation
};

/// One verdict per touch of the artefact of `cycles`, by cycle in order of appearance, within it in order of time,
/// missing ones at the end of their cycle. A touch is expected in every cycle if more than half of the cycles have it,
/// or the one with the most touches has it and it is one that most features have (the others are short then).
[[nodiscard]] std::vector<TouchVerdict> touchVerdicts(const TouchEvaluation& evaluation, const CycleEvaluation& cycles);

}  // namespace spindrift
