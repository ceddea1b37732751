// SPDX-License-Identifier: Apache-2.0
// What a search with a simulator named and what became of it in the simulation: kept in a session, told again without a
// run. Units as in FORMATS.md: um and urad, mm in MCF, s.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/machine/campaign.h"
#include "core/reporting/discrepancy_report.h"
#include "core/workflows/discrepancy_workflow.h"

namespace spindrift {

struct SimulationStory {
  DiscrepancyVerdict verdict = DiscrepancyVerdict::None;
  std::string message;
  std::vector<FoundEffect> effects;  ///< id, title, physics, drivers, rivals, confidence, parameters
  DiscrepancyGap gap;                ///< of the simulator's own prediction; after: with the effects as fitted terms
  std::vector<std::string> warnings;
  std::vector<std::string> mechanisms;                     ///< parameters of the simulator behind the effects
  std::vector<std::pair<std::string, std::string>> twins;  ///< parameters that do the same to the readings
  std::optional<SimulationUpdate> update;                  ///< without its predictions, which `rows` tells
  std::vector<DiscrepancyReportRow> rows;                  ///< before and after the update; empty without one
  nlohmann::json result;                                   ///< of the search, as FORMATS.md has it

  /// Of a search, with the update of `run` if there is one.
  [[nodiscard]] static SimulationStory of(const DiscrepancyRun& run);
  [[nodiscard]] nlohmann::json json() const;
  /// Reads what `json` wrote. Throws InputError if it is something else.
  [[nodiscard]] static SimulationStory parse(const nlohmann::json& json);
};

/// Adds the update of a stored story (SimulationStory::json) to a report; nothing where there is none.
void addStoredUpdate(Report& document, const nlohmann::json& story, const Campaign& campaign);

}  // namespace spindrift
