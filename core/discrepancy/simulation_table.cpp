// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/base/csv.h"
#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/own_effects.h"

namespace spindrift {

SimulationTable SimulationTable::read(const std::filesystem::path& file) {
  const CsvTable table = CsvTable::read(file);
  const std::size_t time = table.column("time_s");
  const std::size_t point = table.column("point");
  const std::size_t component = table.column("component");
  const std::size_t predicted = table.column("predicted");
  SimulationTable out;
  std::map<std::pair<std::string, int>, double> last;
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    const auto parsed = componentFromString(table.text(row, component));
    if (!parsed) {
      throw InputError(
          table.place(row, component),
          fmt::format("component \"{}\" is not known; allowed: EX, EY, EZ, EA, EB or EC.", table.text(row, component)));
    }
    const double t = table.number(row, time);
    const std::string id = table.requiredText(row, point);
    const auto [before, fresh] = last.try_emplace({id, static_cast<int>(*parsed)}, t);
    if (!fresh && t < before->second) {
      throw InputError(
          table.place(row, time),
          fmt::format("time of point {} runs backwards from {} s to {} s; allowed: rows of a point in order "
                      "of time.",
                      id, before->second, t));
    }
    before->second = t;
    const auto key = std::make_tuple(id, static_cast<int>(*parsed), std::llround(t * 1000.0));
    if (!out.values_.emplace(key, table.number(row, predicted)).second) {
      throw InputError(
          table.place(row),
          fmt::format("{} of point {} at {} s stands twice; allowed: one prediction each.", toString(*parsed), id, t));
    }
  }
  return out;
}

double SimulationTable::at(double time_s, const std::string& point, Component component) const {
  const long long ms = std::llround(time_s * 1000.0);
  for (const long long offset : {0LL, 1LL, -1LL}) {
    const auto found = values_.find(std::make_tuple(point, static_cast<int>(component), ms + offset));
    if (found != values_.end()) return found->second;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

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
    throw InputError(
        {campaign.path("campaign.json"), ""},
        "names no simulation to compare with; allowed: \"simulation\": \"simulation.csv\" or \"model.json\".");
  }
  const std::filesystem::path file = campaign.path(name);
  input.predicted.reserve(input.observations.rows.size());
  if (file.extension() == ".json") {
    const auto model = EffectModel::read(file, campaign.machine, campaign.log ? &*campaign.log : nullptr,
                                         input.observations.points(), input.own.get(), input.absolute);
    input.base = model;
    for (const Observation& o : input.observations.rows) {
      input.predicted.push_back(model->predict(DeviationQuery::of(o), o.component).value);
    }
  } else {
    const SimulationTable table = SimulationTable::read(file);
    input.base_table = name;
    for (const Observation& o : input.observations.rows) {
      input.predicted.push_back(table.at(o.time_s, o.point, o.component));
    }
  }
  return input;
}

}  // namespace spindrift
