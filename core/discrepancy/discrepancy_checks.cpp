// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

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
    throw InputError({file, ""},
                     fmt::format("the deviations move {:.0f} times as much as the simulation predicts, in the "
                                 "same way: one of them is not in um (the simulation in mm, or the observations in "
                                 "nm); allowed: um and urad.",
                                 ratio));
  }
  if (correlation > 0.6 && ratio < 1.0 / 300.0) {
    throw InputError({file, ""},
                     fmt::format("the deviations move {:.0f} times less than the simulation predicts, in the "
                                 "same way: one of them is not in um (the observations in mm, or the simulation in "
                                 "nm); allowed: um and urad.",
                                 1.0 / ratio));
  }
}

void warnAboutUndecidable(const DiscrepancyInput& input, const std::vector<Effect>& catalogue,
                          std::vector<std::string>& warnings) {
  if (!input.log || input.log->empty()) return;
  std::vector<std::string> ids;
  for (const Effect& effect : catalogue) {
    if (effect.variants.empty()) ids.push_back(effect.id);
  }
  if (ids.empty()) return;
  warnings.push_back(fmt::format("Not to be decided, because the log lacks what drives {}: {}.",
                                 ids.size() > 1 ? "them" : "it", joinedList(ids)));
}

void warnAboutLog(const DiscrepancyInput& input, const DriverTable& drivers, std::vector<std::string>& warnings) {
  if (!input.log || input.log->empty()) {
    if (!input.own || input.own->builtIn()) {
      warnings.emplace_back(
          "There is no operating log: effects that follow speed, feed or temperature cannot be tried.");
    }
    return;
  }
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
          return inGap({&gap, 1}, o.time_s);
        });
    warnings.push_back(fmt::format(
        "The log has a gap of {:.0f} s after {:.0f} s: what the machine did in it is not known, and {} observations "
        "between {:.0f} s and {:.0f} s, until its heat has gone, are not compared.",
        gap.to_s - gap.from_s, gap.from_s, count, gap.from_s, gap.known_from_s));
  }
}

}  // namespace spindrift
