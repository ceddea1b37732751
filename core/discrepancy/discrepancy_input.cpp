// SPDX-License-Identifier: Apache-2.0
// What the search looks at: a campaign with the predictions of its simulation.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "core/base/unit_text.h"
#include "core/discrepancy/comparable_rows.h"
#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/own_effects.h"
#include "core/discrepancy/simulation_clock.h"
#include "core/discrepancy/simulator_tangents.h"
#include "core/finite_elements/fe_simulation.h"

namespace spindrift {
namespace {

/// `between`: the simulation can be asked between the times of the observations.
void followClock(DiscrepancyInput& input, const PredictedAt& predicted, bool between) {
  auto clock = farSimulationClock(input.observations.rows, predicted);
  if (!clock && between) clock = nearSimulationClock(input.observations.rows, predicted);
  if (!clock || !logCovers(input, clock->offset_s)) return;
  input.log_clock_s = clock->offset_s;
  input.log_clock_uncertainty_s = clock->standard_uncertainty_s;
  input.notes.push_back(clock->sentence(true));
}

void match(const SimulationTable& table, const Campaign& campaign, const std::string& name, bool follow_clock,
           DiscrepancyInput& input) {
  std::vector<std::string> known;
  for (const MachinePoint& point : campaign.machine.points) known.push_back(point.id);
  if (follow_clock) {
    // With no more rows than there are observations it has one for each; minutes from it, the log says more.
    const bool between = !input.log || table.byPlace() || table.size() > 2 * input.observations.rows.size();
    followClock(
        input,
        [&](const Observation& o, double time_s) {
          return table.at(time_s, o.point, o.position_mm, o.component).value;
        },
        between);
  }
  ObservationSet moved;
  if (input.log_clock_s != 0.0) {
    moved = input.observations;
    for (Observation& o : moved.rows) o.time_s += input.log_clock_s;
  }
  SimulationMatch found = matchSimulation(table, input.log_clock_s != 0.0 ? moved : input.observations, known, name);
  input.base_table = name;
  input.predicted = std::move(found.predicted);
  input.notes.insert(input.notes.end(), found.notes.begin(), found.notes.end());
  input.why_unmatched = std::move(found.why_unmatched);
}

/// All but the simulation.
DiscrepancyInput withoutSimulation(const Campaign& campaign, ObservationSet observations) {
  DiscrepancyInput input;
  input.machine = campaign.machine;
  input.log = campaign.log;
  input.observations = std::move(observations);
  input.absolute = input.observations.absolute = campaign.absolute;
  if (!campaign.effects.empty()) input.own = OwnEffects::read(campaign.path(campaign.effects.string()));
  input.simulation_gain_uncertainty = campaign.simulation_gain_uncertainty;
  return input;
}

/// Empty: there is none.
std::string simulationName(const Campaign& campaign) {
  std::string name = campaign.simulation;
  for (const char* candidate : {"simulation.csv", "model.json"}) {
    if (name.empty() && std::filesystem::exists(campaign.path(candidate))) name = candidate;
  }
  return name;
}

/// A sentence if the simulator's own run is not what the campaign says it is; each series about its mean.
void compareRuns(const std::vector<Observation>& rows, const std::vector<double>& given, const std::vector<double>& run,
                 const std::string& name, std::vector<std::string>& notes) {
  std::map<std::pair<std::string, Component>, std::pair<double, double>> mean;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!std::isfinite(given[i]) || !std::isfinite(run[i])) continue;
    auto& [sum, count] = mean[{rows[i].point, rows[i].component}];
    sum += given[i] - run[i];
    count += 1.0;
  }
  double largest = 0.0;
  std::string where;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!std::isfinite(given[i]) || !std::isfinite(run[i])) continue;
    const auto& [sum, count] = mean.at({rows[i].point, rows[i].component});
    const double apart = given[i] - run[i] - sum / count;
    if (!(std::abs(apart) / rows[i].sigma > largest)) continue;
    largest = std::abs(apart) / rows[i].sigma;
    where = fmt::format("{:.2f} {} in {} at {}, {:.0f} s", apart, printedUnit(unitOf(rows[i].component)),
                        toString(rows[i].component), rows[i].point, rows[i].time_s);
  }
  constexpr double told_from = 0.5;  // of the stated sigma
  if (largest < told_from) return;
  notes.push_back(
      fmt::format("{} is not what the simulator predicts with its own values (up to {}); the simulator's run is used.",
                  name, where));
}

/// `follow_clock`: compared at the time at which they agree, where that is not their own.
DiscrepancyInput withSimulation(const Campaign& campaign, ObservationSet observations, const std::string& name,
                                bool follow_clock) {
  DiscrepancyInput input = withoutSimulation(campaign, std::move(observations));
  const std::filesystem::path file = campaign.path(name);
  if (file.extension() == ".json") {
    if (isFeMap(file)) {
      match(readSimulation(file, input.notes), campaign, name, follow_clock, input);
      return input;
    }
    const auto model = EffectModel::read(file, campaign.machine, campaign.log ? &*campaign.log : nullptr,
                                         input.observations.points(), input.own.get(), input.absolute);
    input.base = model;
    if (follow_clock) {
      followClock(
          input,
          [&](const Observation& o, double time_s) {
            return SimulationOfOtherClock(model, time_s - o.time_s).predict(DeviationQuery::of(o), o.component).value;
          },
          true);
      if (input.log_clock_s != 0.0) input.base = std::make_shared<SimulationOfOtherClock>(model, input.log_clock_s);
    }
    input.predicted.reserve(input.observations.rows.size());
    for (const Observation& o : input.observations.rows)
      input.predicted.push_back(input.base->predict(DeviationQuery::of(o), o.component).value);
    return input;
  }
  if (file.extension() != ".csv") {
    throw InputError({campaign.path("campaign.json"), "$.simulation"},
                     "\"" + name +
                         "\" is not a simulation by its ending; allowed: .csv, a model (.json), or a map of "
                         "finite-element results (.json).");
  }
  match(SimulationTable::read(file), campaign, name, follow_clock, input);
  return input;
}

}  // namespace

DiscrepancyInput discrepancyInput(const Campaign& campaign, ObservationSet observations,
                                  std::shared_ptr<const SimulatorTangents> tangents) {
  SPINDRIFT_ASSERT(tangents != nullptr && tangents->base.size() == observations.rows.size(),
                   "a simulator that was run for these observations");
  const std::string name = simulationName(campaign);
  DiscrepancyInput input = name.empty() ? withoutSimulation(campaign, std::move(observations))
                                        : withSimulation(campaign, std::move(observations), name, false);
  if (!name.empty()) compareRuns(input.observations.rows, input.predicted, tangents->base, name, input.notes);
  input.predicted = tangents->base;
  // A simulator was run for the times of the observations, and they cannot be moved.
  const auto clock =
      farSimulationClock(input.observations.rows, predictedBetween(input.observations.rows, input.predicted));
  if (clock) input.notes.push_back(clock->sentence(false));
  input.base.reset();
  input.base_table.clear();
  input.notes.insert(input.notes.end(), tangents->notes.begin(), tangents->notes.end());
  input.tangents = std::move(tangents);
  return input;
}

DiscrepancyInput discrepancyInput(const Campaign& campaign, ObservationSet observations) {
  const std::string name = simulationName(campaign);
  if (name.empty()) {
    throw InputError({campaign.path("campaign.json"), ""},
                     "names no simulation to compare with; allowed: \"simulation\": \"simulation.csv\", \"model.json\" "
                     "or \"fe.json\".");
  }
  return withSimulation(campaign, std::move(observations), name, true);
}

}  // namespace spindrift
