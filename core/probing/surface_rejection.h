// SPDX-License-Identifier: Apache-2.0
// Surface touches of a list of cycles that their own cycle contradicts (surface_heights.h) and that do not repeat in
// the other cycles: what repeats is the bar. Without it nothing tells a bad one in a single cycle, and with two cycles
// nothing tells which of both has it.
#pragma once

#include <vector>

#include "core/probing/cycle_evaluation.h"

namespace spindrift {

/// `centre_mm` and `axis`: of the rotary axis that turns the artefact. Touches of `rejected` take no part. The residual
/// is the height minus that of the others, um.
[[nodiscard]] std::vector<RejectedTouch> contradictedSurfaces(const TouchList& list, const std::string& artefact,
                                                              const Eigen::Vector3d& centre_mm,
                                                              const Eigen::Vector3d& axis,
                                                              const std::vector<RejectedTouch>& rejected);

}  // namespace spindrift
