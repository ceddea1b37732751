// SPDX-License-Identifier: Apache-2.0
// Where a residual is larger than noise allows. Internal to core/discrepancy.
#pragma once

#include <vector>

#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/residual_problem.h"

namespace spindrift {

/// `residual` over the units, whitened. p-values hold for all places looked at together.
[[nodiscard]] std::vector<DisagreementPlace> findPlaces(const ResidualProblem& problem, const DriverTable& drivers,
                                                        const Eigen::VectorXd& residual);

}  // namespace spindrift
