// SPDX-License-Identifier: Apache-2.0
// P4 (7)-(10) as printed beside the joint evaluation, on the tracks that were measured: how far the closed forms are
// off where the machine does not only turn its head.
//
// The closed forms (star_stylus.h) use the movement of one ball's centre through three styli between the first cycle
// and another. Three styli on one ball touch the same place, so that every translation of the spindle against the ball
// (drift, screws, column) counts as a rotation; the joint evaluation (ball_cycle.h) separates them. Units: urad, um.
#pragma once

#include <vector>

#include "core/probing/ball_cycle.h"

namespace spindrift {

/// One per cycle after the first and ball that three styli touched in both; empty with fewer than three styli.
[[nodiscard]] std::vector<HeadComparison> closedFormsBeside(const BallCycleResult& balls,
                                                            const MachineDescription& machine);

}  // namespace spindrift
