// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/simulation_story.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/reporting/simulation_update_report.h"
#include "core/workflows/fit_campaign.h"
#include "core/workflows/stored_effect.h"

namespace spindrift {
namespace {

double numberAt(const nlohmann::json& json) {
  return json.is_number() ? json.get<double>() : std::nan("");
}

/// Row after row of one point and component.
nlohmann::json rowsJson(const std::vector<DiscrepancyReportRow>& rows) {
  std::map<std::pair<std::string, Component>, nlohmann::json> series;
  for (const DiscrepancyReportRow& r : rows) {
    nlohmann::json& s = series[{r.point, r.component}];
    if (s.is_null()) s = {{"point", r.point}, {"component", toString(r.component)}};
    s["rows"].push_back({r.time_s, r.position_mm.x(), r.position_mm.y(), r.position_mm.z(), jsonNumber(r.sigma),
                         jsonNumber(r.measured), jsonNumber(r.before), jsonNumber(r.after), r.held_out, r.c_deg});
  }
  nlohmann::json out = nlohmann::json::array();
  for (auto& [key, s] : series) out.push_back(std::move(s));
  return out;
}

std::vector<DiscrepancyReportRow> rowsOf(const nlohmann::json& json) {
  std::vector<DiscrepancyReportRow> out;
  for (const nlohmann::json& s : json) {
    const auto component = componentFromString(s.at("component").get<std::string>());
    if (!component) throw InputError("the stored update of the simulation names a component that does not exist.");
    for (const nlohmann::json& r : s.at("rows")) {
      out.push_back({numberAt(r.at(0)),
                     s.at("point").get<std::string>(),
                     *component,
                     {numberAt(r.at(1)), numberAt(r.at(2)), numberAt(r.at(3))},
                     numberAt(r.at(4)),
                     numberAt(r.at(6)),
                     numberAt(r.at(7)),
                     r.at(8).get<bool>(),
                     numberAt(r.at(5))});
      // Those of earlier versions tell no angles apart.
      if (r.size() > 9) out.back().c_deg = numberAt(r.at(9));
    }
  }
  return out;
}

DiscrepancyVerdict storedVerdict(const nlohmann::json& json) {
  for (const DiscrepancyVerdict v : {DiscrepancyVerdict::Named, DiscrepancyVerdict::Ambiguous,
                                     DiscrepancyVerdict::Unknown, DiscrepancyVerdict::None}) {
    if (toString(v) == json.get<std::string>()) return v;
  }
  throw InputError("the stored search with the simulator has a verdict that does not exist; search again.");
}

}  // namespace

SimulationStory SimulationStory::of(const DiscrepancyRun& run) {
  SimulationStory story;
  story.verdict = run.result.verdict;
  story.message = run.result.message;
  story.effects = run.result.effects;
  story.gap = run.result.gap;
  story.warnings = run.result.warnings;
  story.mechanisms = run.mechanisms;
  story.twins = run.result.twins;
  story.result = run.result.json();
  if (run.update) {
    story.update = run.update;
    story.rows = simulationUpdateRows(run.input, *run.update);
  }
  return story;
}

nlohmann::json SimulationStory::json() const {
  nlohmann::json found = nlohmann::json::array();
  for (const FoundEffect& e : effects) found.push_back(storedEffect(e));
  return {{"format", "spindrift-simulation-story"},
          {"version", 1},
          {"verdict", toString(verdict)},
          {"message", message},
          {"effects", found},
          {"gap", storedGap(gap)},
          {"warnings", warnings},
          {"mechanisms", mechanisms},
          {"twins", twins},
          {"update", update ? update->json() : nlohmann::json()},
          {"rows", rowsJson(rows)},
          {"result", result}};
}

SimulationStory SimulationStory::parse(const nlohmann::json& json) {
  try {
    if (json.at("format") != "spindrift-simulation-story" || json.at("version") != 1) {
      throw InputError("the stored search with the simulator is of another version; search again.");
    }
    SimulationStory story;
    story.verdict = storedVerdict(json.at("verdict"));
    story.message = json.at("message").get<std::string>();
    for (const nlohmann::json& e : json.at("effects")) story.effects.push_back(effectOfStored(e));
    story.gap = gapOfStored(json.at("gap"));
    story.warnings = json.at("warnings").get<std::vector<std::string>>();
    // Searches stored by earlier versions tell neither.
    story.mechanisms = json.value("mechanisms", story.mechanisms);
    story.twins = json.value("twins", story.twins);
    if (json.at("update").is_object()) story.update = SimulationUpdate::parse(json.at("update"));
    story.rows = rowsOf(json.at("rows"));
    story.result = json.at("result");
    return story;
  } catch (const nlohmann::json::exception& e) {
    throw InputError(fmt::format("the stored search with the simulator cannot be read ({}); search again.", e.what()));
  }
}

void addStoredUpdate(Report& document, const nlohmann::json& story, const Campaign& campaign) {
  if (!story.is_object()) return;
  const SimulationStory told = SimulationStory::parse(story);
  if (told.update)
    addSimulationUpdate(document, *told.update, told.rows, mapTable(campaign.machine, 0.0, report_map_nodes));
}

}  // namespace spindrift
