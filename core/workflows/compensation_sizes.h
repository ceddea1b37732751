// SPDX-License-Identifier: Apache-2.0
// How far a point is off before and after a compensation, as one length.
#pragma once

#include "core/workflows/compensation_workflow.h"

namespace spindrift {

/// Length of the deviation in the components that were measured, um; NaN if none was.
[[nodiscard]] double measuredLength_um(const CompensationPoint& point);
[[nodiscard]] double remainingLength_um(const CompensationPoint& point);
/// Standard uncertainty of what remains along an axis (0, 1, 2): of the measurement and of the correction, um.
[[nodiscard]] double remainingSigma_um(const CompensationPoint& point, int axis);

}  // namespace spindrift
