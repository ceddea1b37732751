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
      "{} {} read at one point only: whether the state was shifted or the point moved cannot be told there.",
      shortenedList(lone, 5, 3), one ? "was" : "were"));
}

/// Simulation at a time of one series, linear between its observations.
double simulatedAt(const std::vector<std::pair<double, double>>& series, double time_s) {
  const auto after = std::lower_bound(series.begin(), series.end(), std::make_pair(time_s, -1e300));
  if (after == series.begin()) return series.front().second;
  if (after == series.end()) return series.back().second;
  const auto before = std::prev(after);
  const double part = (time_s - before->first) / std::max(1e-9, after->first - before->first);
  return before->second + part * (after->second - before->second);
}

/// Sum of the squares of deviations from the mean.
double scatter(const std::vector<double>& values) {
  double mean = 0.0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  double sum = 0.0;
  for (const double v : values) sum += (v - mean) * (v - mean);
  return sum;
}

/// The clock of the observations against that of the simulation, where the simulation at another time fits far better.
void warnAboutSimulationClock(const DiscrepancyInput& input, const std::vector<std::size_t>& rows,
                              std::vector<std::string>& warnings) {
  std::map<std::pair<std::string, Component>, std::vector<std::size_t>> series;
  for (const std::size_t row : rows) {
    const Observation& o = input.observations.rows[row];
    series[{o.point, o.component}].push_back(row);
  }
  constexpr double step_s = 600.0;
  constexpr int most_steps = 24;
  // Scatter with the simulation of another time, over that with the simulation of the same time, at the same readings.
  const auto left = [&](double offset_s) {
    double sum = 0.0;
    double sum_now = 0.0;
    double count = 0.0;
    for (auto& [key, members] : series) {
      std::vector<std::pair<double, double>> simulated;
      for (const std::size_t row : members)
        simulated.emplace_back(input.observations.rows[row].time_s, input.predicted[row]);
      std::sort(simulated.begin(), simulated.end());
      if (simulated.size() < 6) continue;
      // Only where the simulation is known at either time.
      std::vector<double> r;
      std::vector<double> r_now;
      for (const std::size_t row : members) {
        const double t = input.observations.rows[row].time_s + offset_s;
        if (t < simulated.front().first || t > simulated.back().first) continue;
        const Observation& o = input.observations.rows[row];
        r.push_back((o.value - simulatedAt(simulated, t)) / o.sigma);
        r_now.push_back((o.value - input.predicted[row]) / o.sigma);
      }
      if (r.size() < 4) continue;
      sum += scatter(r);
      sum_now += scatter(r_now);
      count += static_cast<double>(r.size()) - 1.0;
    }
    // On a good part of the readings, or it says nothing.
    return 2.0 * count > static_cast<double>(rows.size()) && sum_now > 0.0 ? sum / sum_now : 1.0;
  };
  double best = 1.0;
  int best_step = 0;
  for (int k = -most_steps; k <= most_steps; ++k) {
    const double value = left(k * step_s);
    if (value < best) {
      best = value;
      best_step = k;
    }
  }
  constexpr double far_better = 0.5;
  if (std::abs(best_step) < 2 || best > far_better) return;
  warnings.push_back(fmt::format(
      "The observations agree far better with the simulation of about {:.0f} min {} ({:.0f} % less scatter): compare "
      "the "
      "clocks of observations.csv, log.csv and the simulation.",
      std::abs(best_step) * step_s / 60.0, best_step > 0 ? "later" : "earlier", 100.0 * (1.0 - std::sqrt(best))));
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
  warnAboutSimulationClock(input, rows, warnings);
}

}  // namespace spindrift
