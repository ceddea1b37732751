// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/sensitivity_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/text.h"

namespace spindrift {

SensitivityTable::SensitivityTable(const SimulatorFile& file, BasePrediction base)
    : simulator_file_(file), base_(std::move(base)) {
  SPINDRIFT_ASSERT(file.kind == SimulatorKind::Sensitivities, "a table of sensitivities");
  SPINDRIFT_ASSERT(base_ != nullptr, "the prediction that the sensitivities belong to");
  file_ = file.file;
  parameters_ = file.parameters;
  table_ = file.relativeFile(file.root.at("table"));
  for (const SimulatorParameter& p : parameters_) table_values_[p.name] = p.value;
  if (const auto given = file.root.find("table_values")) {
    for (const auto& [name, node] : given->members()) {
      if (!table_values_.contains(name)) node.reject("a value of a parameter of this simulator");
      table_values_[name] = node.number();
    }
  }
  const CsvTable table = CsvTable::read(file.folder() / table_);
  const std::size_t time = table.column("time_s");
  const std::size_t point = table.column("point");
  const std::size_t component = table.column("component");
  const std::size_t parameter = table.column("parameter");
  const std::size_t change = table.column("d_predicted");
  std::map<std::string, std::vector<SimulationRow>> rows;
  std::map<std::tuple<std::string, std::string, Component>, double> last;
  for (std::size_t i = 0; i < table.rowCount(); ++i) {
    const std::string name = table.requiredText(i, parameter);
    const auto parsed = componentFromString(table.text(i, component));
    if (!parsed) {
      throw InputError(
          table.place(i, component),
          fmt::format("component \"{}\" is not known; allowed: EX, EY, EZ, EA, EB or EC.", table.text(i, component)));
    }
    if (!table_values_.contains(name)) {
      std::vector<std::string> names;
      for (const SimulatorParameter& p : parameters_) names.push_back(p.name);
      throw InputError(table.place(i, parameter), fmt::format("\"{}\" is not a parameter of {}; allowed: {}.", name,
                                                              file_.filename().string(), joinedList(names, "or")));
    }
    SimulationRow row;
    row.time_s = table.number(i, time);
    row.point = table.requiredText(i, point);
    row.component = *parsed;
    row.predicted = table.number(i, change);
    const auto [before, fresh] = last.try_emplace({name, row.point, row.component}, row.time_s);
    if (!fresh && !(row.time_s > before->second)) {
      throw InputError(
          table.place(i, time),
          fmt::format("time {} s of {} of point {} follows {} s; allowed: rising times for each parameter, "
                      "point and component.",
                      row.time_s, name, row.point, before->second));
    }
    before->second = row.time_s;
    moved_[name].emplace(row.point, row.component);
    rows[name].push_back(std::move(row));
  }
  for (const SimulatorParameter& p : parameters_) {
    if (!rows.contains(p.name)) {
      throw InputError({table.file(), ""},
                       fmt::format("has no row of parameter {}; allowed: at least one of every parameter of {}.",
                                   p.name, file_.filename().string()));
    }
    sensitivity_.emplace(p.name, SimulationTable(rows[p.name], false, table.file()));
  }
}

std::shared_ptr<const SensitivityTable::Matched> SensitivityTable::matchedTo(const ObservationSet& at) const {
  std::string key = placesOf(at);
  const std::scoped_lock lock(mutex_);
  if (matched_ && matched_->key == key) return matched_;
  Matched out;
  out.key = std::move(key);
  out.base = base_(at);
  SPINDRIFT_ASSERT(out.base.size() == at.rows.size(), "a base prediction for every observation");
  for (const auto& [name, table] : sensitivity_) {
    std::vector<double>& sensitivity = out.sensitivity[name];
    sensitivity = matchSimulation(table, at, {}, file_.filename().string()).predicted;
    for (std::size_t i = 0; i < sensitivity.size(); ++i) {
      const Observation& o = at.rows[i];
      if (!std::isfinite(sensitivity[i]) && !moved_.at(name).contains({o.point, o.component})) sensitivity[i] = 0.0;
    }
  }
  matched_ = std::make_shared<const Matched>(std::move(out));
  return matched_;
}

SimulatorRun SensitivityTable::run(const ParameterValues& values, const ObservationSet& at,
                                   const JobContext& job) const {
  job.throwIfCancelled();
  const ParameterValues all = completeValues(*this, values);
  const std::shared_ptr<const Matched> matched = matchedTo(at);
  SimulatorRun out;
  out.predicted = matched->base;
  for (const auto& [name, value] : all) {
    const double change = value - table_values_.at(name);
    if (change == 0.0) continue;
    const std::vector<double>& sensitivity = matched->sensitivity.at(name);
    for (std::size_t i = 0; i < out.predicted.size(); ++i) out.predicted[i] += change * sensitivity[i];
  }
  return out;
}

void SensitivityTable::writeVersion(const ParameterValues& values, const std::filesystem::path& folder,
                                    const nlohmann::json& change) const {
  const ParameterValues all = completeValues(*this, values);
  std::vector<JsonEdit> edits = valueEdits(simulator_file_, all);
  for (const SimulatorParameter& p : parameters_) {
    // The table stays what it was, and says about which values.
    if (all.at(p.name) != p.value) edits.push_back({{"table_values", p.name}, table_values_.at(p.name)});
  }
  const std::string text = appendedJson(editedJson(simulator_file_.text, edits), "history", change);
  writeWholeFolder(folder, [&](const std::filesystem::path& into) {
    writeFileAtomically(into / "simulator.json", text);
    copyWithin(simulator_file_.folder(), into, table_);
  });
}

}  // namespace spindrift
