// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/base/text.h"
#include "core/discrepancy/discrepancy_numbers.h"
#include "core/discrepancy/log_gaps.h"
#include "core/discrepancy/own_effects.h"

namespace spindrift {

void checkUnits(const DiscrepancyInput& input, const std::vector<std::size_t>& rows) {
  std::map<std::pair<std::string, int>, std::array<double, 3>> means;
  for (const std::size_t row : rows) {
    const Observation& o = input.observations.rows[row];
    auto& m = means[{o.point, static_cast<int>(o.component)}];
    m[0] += 1.0;
    m[1] += o.value;
    m[2] += input.predicted[row];
  }
  double oo = 0.0;
  double ss = 0.0;
  double os = 0.0;
  for (const std::size_t row : rows) {
    const Observation& o = input.observations.rows[row];
    const auto& m = means[{o.point, static_cast<int>(o.component)}];
    const double a = o.value - (input.absolute ? 0.0 : m[1] / m[0]);
    const double b = input.predicted[row] - (input.absolute ? 0.0 : m[2] / m[0]);
    oo += a * a;
    ss += b * b;
    os += a * b;
  }
  if (!(oo > 0.0) || !(ss > 0.0) || rows.size() < 20) return;
  const double correlation = os / std::sqrt(oo * ss);
  const double ratio = std::sqrt(oo / ss);
  const std::filesystem::path file = input.observations.file;
  if (correlation > 0.6 && ratio > 300.0) {
    throw InputError(
        {file, ""},
        fmt::format("the deviations are {:.0f} times as large as the simulation predicts, with the same time history: "
                    "one of them is not in µm (the simulation in mm, or the observations in nm); allowed: µm and µrad.",
                    ratio));
  }
  if (correlation > 0.6 && ratio < 1.0 / 300.0) {
    throw InputError(
        {file, ""},
        fmt::format("the deviations are {:.0f} times smaller than the simulation predicts, with the same time history: "
                    "one of them is not in µm (the observations in mm, or the simulation in nm); allowed: µm and µrad.",
                    1.0 / ratio));
  }
}

void warnAboutUndecidable(const DiscrepancyInput& input, const std::vector<Effect>& catalogue,
                          std::vector<std::string>& warnings) {
  // A machine has a column or a beam; one that states neither may have either.
  if (!input.machine.column_base_mm && !input.machine.crossbeam && (!input.own || input.own->builtIn()))
    warnings.emplace_back(
        "Not to be decided, because machine.json states neither a column nor a crossbeam: column.bending.a, "
        "column.bending.b, external_heat.a, external_heat.b and crossbeam.sag.z.");
  if (!input.log || input.log->empty()) return;
  std::vector<std::string> ids;
  for (const Effect& effect : catalogue) {
    if (effect.variants.empty()) ids.push_back(effect.id);
  }
  if (ids.empty()) return;
  warnings.push_back(fmt::format("Not to be decided, because the log lacks what drives {}: {}.",
                                 ids.size() > 1 ? "them" : "it", joinedList(ids)));
}

void warnAboutSensors(const std::vector<SensorReading>& sensors, std::vector<std::string>& warnings) {
  if (const std::string read = readFromNames(sensors); !read.empty()) {
    warnings.push_back(fmt::format(
        "Where sensors sit was read from their names, please confirm: {}. A \"role\" in machine.json decides.", read));
  }
  for (const SensorReading& s : sensors) {
    if (!s.note.empty()) warnings.push_back(s.note);
  }
}

void warnAboutLog(const DiscrepancyInput& input, const DriverTable& drivers, double log_clock_s,
                  std::vector<std::string>& warnings) {
  if (!input.log || input.log->empty()) {
    if (!input.own || input.own->builtIn()) {
      warnings.emplace_back(
          "There is no operating log: effects that follow speed, feed or temperature cannot be tried.");
    }
    return;
  }
  if (std::string doubt = input.log->doubtOfTemperatureUnit(); !doubt.empty()) warnings.push_back(std::move(doubt));
  for (const std::string& name : drivers.dead()) {
    if (OperatingLog::isTemperature(name)) {
      warnings.push_back(fmt::format("The sensor {} never moves; it is left out as dead.", name));
    }
  }
  if (!input.log->has("spindle_rpm") && (!input.own || input.own->builtIn()))
    warnings.emplace_back("The log has no spindle_rpm: spindle heat is known from temperatures at best.");
  if (input.own && !input.own->builtIn() && !input.own->anyLag()) return;
  for (const LogGap& gap : logGaps(input.log->time_s())) {
    const auto count =
        std::count_if(input.observations.rows.begin(), input.observations.rows.end(), [&](const Observation& o) {
          return inGap({&gap, 1}, o.time_s + log_clock_s);
        });
    warnings.push_back(fmt::format(
        "The log has a gap of {:.0f} s after {:.0f} s: what the machine did in it is not known, and {} observations "
        "between {:.0f} s and {:.0f} s, until its heat has gone, are not compared.",
        gap.to_s - gap.from_s, gap.from_s, count, gap.from_s, gap.known_from_s));
  }
}

namespace {

/// States in which a component was read at one point only, although the others saw several.
void warnAboutLoneStates(const DiscrepancyInput& input, const std::vector<std::size_t>& rows,
                         std::vector<std::string>& warnings) {
  std::map<std::string, std::set<std::string>> points;
  for (const std::size_t row : rows) {
    const Observation& o = input.observations.rows[row];
    points[o.state].insert(o.point);
  }
  std::vector<std::string> lone;
  for (const auto& [state, seen] : points) {
    if (seen.size() == 1) lone.push_back(state);
  }
  // Where every state is one reading, that is how it was measured.
  if (lone.empty() || 2 * lone.size() > points.size()) return;
  const bool one = lone.size() == 1;
  warnings.push_back(fmt::format(
      "{} {} read at one point only: whether the state was shifted or the point moved cannot be distinguished there.",
      shortenedList(lone, 5, 3), one ? "was" : "were"));
}

}  // namespace

void warnAboutData(const DiscrepancyInput& input, const std::vector<std::size_t>& rows,
                   std::vector<std::string>& warnings) {
  std::set<Component> components;
  for (const std::size_t row : rows) components.insert(input.observations.rows[row].component);
  if (components.size() == 1) {
    warnings.push_back(
        fmt::format("Only {} was observed: effects that differ in other components alone cannot be distinguished.",
                    toString(*components.begin())));
  }
  warnAboutLoneStates(input, rows, warnings);
}

}  // namespace spindrift
