// SPDX-License-Identifier: Apache-2.0
// Figures of a discrepancy before and after: time histories, and maps over the table. um or urad, times h.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "core/reporting/discrepancy_report.h"

namespace spindrift {

/// What is left before (0) and after (1) at the moment and in the component where it is largest before, over `table`
/// (its z is set to that of the points); empty if the points of no moment span a plane.
[[nodiscard]] std::optional<std::array<Field, 2>> discrepancyMaps(const std::vector<DiscrepancyReportRow>& rows,
                                                                  FieldGrid table, double& time_s);

/// All points over time, one figure for each component. `completed`: what the model after is called.
void addTimeHistories(Report& document, const std::vector<DiscrepancyReportRow>& rows, std::string_view completed);
/// The maps, if there are any.
void addDiscrepancyMaps(Report& document, const std::vector<DiscrepancyReportRow>& rows, const FieldGrid& table,
                        std::string_view completed);

}  // namespace spindrift
