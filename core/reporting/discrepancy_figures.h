// SPDX-License-Identifier: Apache-2.0
// Figures of a discrepancy before and after: time histories, and maps over the table. um or urad, times h.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "core/reporting/discrepancy_report.h"

namespace spindrift {

/// What is left before and after over the table at one moment with the table at one angle.
struct DiscrepancyMaps {
  std::array<Field, 2> fields;  ///< before, after
  double time_s = 0.0;          ///< of the first reading
  std::optional<double> c_deg;  ///< angle of the table; empty where all was measured at one
};

/// At the moment and in the component where most is left before, over `table` (its z is set to that of the points);
/// empty if the points of no moment span a plane.
[[nodiscard]] std::optional<DiscrepancyMaps> discrepancyMaps(const std::vector<DiscrepancyReportRow>& rows,
                                                             FieldGrid table);

/// All points over time, one figure for each component. `completed`: what the model after is called.
void addTimeHistories(Report& document, const std::vector<DiscrepancyReportRow>& rows, std::string_view completed);
/// The maps, if there are any.
void addDiscrepancyMaps(Report& document, const std::vector<DiscrepancyReportRow>& rows, const FieldGrid& table,
                        std::string_view completed);

}  // namespace spindrift
