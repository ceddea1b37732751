// SPDX-License-Identifier: Apache-2.0
// What became of the simulation when a missing effect was put into it, for people: fitted physical parameters,
// measured against simulation before and after, on fitted and held-out states. um or urad, times h.
#pragma once

#include <optional>
#include <vector>

#include "core/discrepancy/into_simulation.h"
#include "core/reporting/discrepancy_report.h"

namespace spindrift {

/// Every observation minus the simulation before and after, each series free of its constant over the rows fitted.
[[nodiscard]] std::vector<DiscrepancyReportRow> simulationUpdateRows(const DiscrepancyInput& input,
                                                                     const SimulationUpdate& update);

/// Adds a subsection; with maps over `table` if there is one.
void addSimulationUpdate(Report& document, const SimulationUpdate& update,
                         const std::vector<DiscrepancyReportRow>& rows, const std::optional<FieldGrid>& table);

}  // namespace spindrift
