// SPDX-License-Identifier: Apache-2.0
// One HTML file without any outside reference: verdict, effects with evidence, time courses before and after, points,
// places and steps. Deviations um or urad, times h.
#pragma once

#include <string>

#include "core/discrepancy/discrepancy.h"

namespace spindrift {

[[nodiscard]] std::string discrepancyReport(const std::string& campaign, const DiscrepancyInput& input,
                                            const DiscrepancyResult& result);

}  // namespace spindrift
