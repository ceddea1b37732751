// SPDX-License-Identifier: Apache-2.0
// What was taken as noise, told reading by reading: scales, shifts of states, outliers, what remains. Internal to
// core/discrepancy.
#pragma once

#include <vector>

#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/effect_posterior.h"

namespace spindrift {

/// Fills noise, shifts, outliers, remaining and remainder of the result, with the warnings that belong to them.
void tellNoise(const ResidualProblem& problem, const JointFit& fit, const Remainder& remainder,
               const std::vector<Observation>& rows, DiscrepancyResult& result);

}  // namespace spindrift
