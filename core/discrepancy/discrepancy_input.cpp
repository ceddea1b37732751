// SPDX-License-Identifier: Apache-2.0
// What the search looks at: a campaign with the predictions of its simulation.
#include <filesystem>

#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/own_effects.h"
#include "core/finite_elements/fe_simulation.h"

namespace spindrift {
namespace {

void match(const SimulationTable& table, const Campaign& campaign, const std::string& name, DiscrepancyInput& input) {
  std::vector<std::string> known;
  for (const MachinePoint& point : campaign.machine.points) known.push_back(point.id);
  SimulationMatch found = matchSimulation(table, input.observations, known, name);
  input.base_table = name;
  input.predicted = std::move(found.predicted);
  input.notes.insert(input.notes.end(), found.notes.begin(), found.notes.end());
  input.why_unmatched = std::move(found.why_unmatched);
}

}  // namespace

DiscrepancyInput discrepancyInput(const Campaign& campaign, ObservationSet observations) {
  DiscrepancyInput input;
  input.machine = campaign.machine;
  input.log = campaign.log;
  input.observations = std::move(observations);
  input.absolute = input.observations.absolute = campaign.absolute;
  if (!campaign.effects.empty()) input.own = OwnEffects::read(campaign.path(campaign.effects.string()));
  input.simulation_gain_uncertainty = campaign.simulation_gain_uncertainty;
  std::string name = campaign.simulation;
  if (name.empty()) {
    for (const char* candidate : {"simulation.csv", "model.json"}) {
      if (name.empty() && std::filesystem::exists(campaign.path(candidate))) name = candidate;
    }
  }
  if (name.empty()) {
    throw InputError({campaign.path("campaign.json"), ""},
                     "names no simulation to compare with; allowed: \"simulation\": \"simulation.csv\", \"model.json\" "
                     "or \"fe.json\".");
  }
  const std::filesystem::path file = campaign.path(name);
  if (file.extension() == ".json") {
    if (isFeMap(file)) {
      match(readSimulation(file, input.notes), campaign, name, input);
      return input;
    }
    const auto model = EffectModel::read(file, campaign.machine, campaign.log ? &*campaign.log : nullptr,
                                         input.observations.points(), input.own.get(), input.absolute);
    input.base = model;
    input.predicted.reserve(input.observations.rows.size());
    for (const Observation& o : input.observations.rows) {
      input.predicted.push_back(model->predict(DeviationQuery::of(o), o.component).value);
    }
    return input;
  }
  if (file.extension() != ".csv") {
    throw InputError({campaign.path("campaign.json"), "$.simulation"},
                     "\"" + name +
                         "\" is no simulation by its ending; allowed: .csv, a model (.json), or a map of "
                         "finite-element results (.json).");
  }
  match(SimulationTable::read(file), campaign, name, input);
  return input;
}

}  // namespace spindrift
