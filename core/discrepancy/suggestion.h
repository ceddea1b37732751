// SPDX-License-Identifier: Apache-2.0
// What to measure next. Internal to core/discrepancy.
#pragma once

#include <optional>
#include <string>

#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/effect_search.h"

namespace spindrift {

[[nodiscard]] std::optional<MeasurementSuggestion> suggestMeasurement(const DiscrepancyInput& input,
                                                                      const DriverTable& drivers,
                                                                      const EffectSearch& search,
                                                                      const ResidualProblem& problem,
                                                                      const JointFit& first, const JointFit& second,
                                                                      const std::string& separates, double log_n);

}  // namespace spindrift
