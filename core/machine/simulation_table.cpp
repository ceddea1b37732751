// SPDX-License-Identifier: Apache-2.0
#include "core/machine/simulation_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <set>
#include <tuple>

#include "core/base/csv.h"
#include "core/base/text.h"
#include "core/math/scattered_interpolation.h"

namespace spindrift {
namespace {

/// Times that were written with few digits.
constexpr double same_time_s = 1e-3;
/// Places that were written with few digits, mm.
constexpr double same_place_mm = 1e-6;
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

using PlaceKey = std::tuple<long long, long long, long long>;

PlaceKey keyOf(const Eigen::Vector3d& p) {
  return {std::llround(p.x() / same_place_mm), std::llround(p.y() / same_place_mm),
          std::llround(p.z() / same_place_mm)};
}

std::string placeText(const Eigen::Vector3d& p) {
  return fmt::format("place ({}, {}, {}) mm", p.x(), p.y(), p.z());
}

std::string listOf(const std::set<std::string>& names) {
  return shortenedList(std::vector<std::string>(names.begin(), names.end()));
}

}  // namespace

struct SimulationTable::Places {
  std::vector<Eigen::Vector3d> position_mm;
  std::vector<Series> series;
  bool all_alike = true;  ///< all series reach as far
  /// By the places that reach the time asked for; these change seldom. Guarded by the mutex.
  mutable std::mutex mutex;
  mutable std::vector<std::size_t> used;
  mutable std::unique_ptr<ScatteredInterpolation> interpolation;
  mutable std::map<PlaceKey, ScatteredInterpolation::Weights> weights;
};

bool SimulationTable::Series::reaches(double t) const {
  return t >= time_s.front() - same_time_s && t <= time_s.back() + same_time_s;
}

double SimulationTable::Series::at(double t) const {
  const auto after = std::upper_bound(time_s.begin(), time_s.end(), t);
  if (after == time_s.begin()) return value.front();
  if (after == time_s.end()) return value.back();
  const auto k = static_cast<std::size_t>(after - time_s.begin());
  const double part = (t - time_s[k - 1]) / (time_s[k] - time_s[k - 1]);
  return value[k - 1] + part * (value[k] - value[k - 1]);
}

SimulationTable SimulationTable::read(const std::filesystem::path& file) {
  const CsvTable table = CsvTable::read(file);
  const std::size_t time = table.column("time_s");
  const bool by_place = !table.hasColumn("point") && table.hasColumn("x_mm");
  const std::size_t point = by_place ? 0 : table.column("point");
  const std::size_t x = by_place ? table.column("x_mm") : 0;
  const std::size_t y = by_place ? table.column("y_mm") : 0;
  const std::size_t z = by_place ? table.column("z_mm") : 0;
  const std::size_t component = table.column("component");
  const std::size_t predicted = table.column("predicted");
  std::vector<SimulationRow> rows;
  rows.reserve(table.rowCount());
  std::map<std::tuple<std::string, PlaceKey, Component>, double> last;
  for (std::size_t i = 0; i < table.rowCount(); ++i) {
    SimulationRow row;
    const auto parsed = componentFromString(table.text(i, component));
    if (!parsed) {
      throw InputError(
          table.place(i, component),
          fmt::format("component \"{}\" is not known; allowed: EX, EY, EZ, EA, EB or EC.", table.text(i, component)));
    }
    row.component = *parsed;
    row.time_s = table.number(i, time);
    row.predicted = table.number(i, predicted);
    if (by_place) {
      row.position_mm = {table.number(i, x), table.number(i, y), table.number(i, z)};
    } else {
      row.point = table.requiredText(i, point);
    }
    const auto what = [&] { return by_place ? placeText(row.position_mm) : "point " + row.point; };
    const auto [before, fresh] =
        last.try_emplace({row.point, by_place ? keyOf(row.position_mm) : PlaceKey{}, row.component}, row.time_s);
    if (!fresh && std::abs(row.time_s - before->second) < 0.5 * same_time_s) {
      throw InputError(table.place(i), fmt::format("duplicate {} of {} at {} s; allowed: one prediction each.",
                                                   toString(row.component), what(), row.time_s));
    }
    if (!fresh && row.time_s < before->second) {
      throw InputError(
          table.place(i, time),
          fmt::format("time of {} runs backwards from {} s to {} s; allowed: rows of a point in order of time.", what(),
                      before->second, row.time_s));
    }
    before->second = row.time_s;
    rows.push_back(std::move(row));
  }
  if (rows.empty()) throw InputError({file, ""}, "holds no prediction; allowed: at least one row.");
  return SimulationTable(rows, by_place, file);
}

SimulationTable::SimulationTable(const std::vector<SimulationRow>& rows, bool by_place,
                                 const std::filesystem::path& file)
    : by_place_(by_place), size_(rows.size()) {
  if (rows.empty()) throw InputError({file, ""}, "holds no prediction; allowed: at least one row.");
  first_s_ = last_s_ = rows.front().time_s;
  std::map<std::pair<Component, PlaceKey>, std::size_t> index;
  for (const SimulationRow& row : rows) {
    first_s_ = std::min(first_s_, row.time_s);
    last_s_ = std::max(last_s_, row.time_s);
    Series* series = nullptr;
    if (by_place_) {
      auto& places = places_[row.component];
      if (!places) places = std::make_shared<Places>();
      const auto [at, fresh] = index.try_emplace({row.component, keyOf(row.position_mm)}, places->series.size());
      if (fresh) {
        places->position_mm.push_back(row.position_mm);
        places->series.emplace_back();
      }
      series = &places->series[at->second];
    } else {
      series = &series_[row.point][row.component];
    }
    series->time_s.push_back(row.time_s);
    series->value.push_back(row.predicted);
  }
  for (auto& [component, places] : places_) {
    const Series& first = places->series.front();
    for (const Series& s : places->series) {
      if (s.time_s.front() != first.time_s.front() || s.time_s.back() != first.time_s.back()) places->all_alike = false;
    }
  }
}

SimulationTable::Prediction SimulationTable::at(double time_s, const std::string& point,
                                                const Eigen::Vector3d& position_mm, Component component) const {
  if (by_place_) return between(time_s, position_mm, component);
  const auto series = series_.find(point);
  if (series == series_.end()) return {not_known, Answer::UnknownPoint};
  const auto found = series->second.find(component);
  if (found == series->second.end()) return {not_known, Answer::UnknownComponent};
  if (!found->second.reaches(time_s)) return {not_known, Answer::BeforeOrAfter};
  return {found->second.at(time_s), Answer::Known};
}

SimulationTable::Prediction SimulationTable::between(double time_s, const Eigen::Vector3d& position_mm,
                                                     Component component) const {
  const auto found = places_.find(component);
  if (found == places_.end()) return {not_known, Answer::UnknownComponent};
  const Places& places = *found->second;
  std::vector<std::size_t> used;
  if (places.all_alike) {
    if (!places.series.front().reaches(time_s)) return {not_known, Answer::BeforeOrAfter};
  } else {
    for (std::size_t i = 0; i < places.series.size(); ++i) {
      if (places.series[i].reaches(time_s)) used.push_back(i);
    }
    if (used.empty()) return {not_known, Answer::BeforeOrAfter};
  }
  const std::lock_guard lock(places.mutex);
  if (!places.interpolation || places.used != used) {
    std::vector<Eigen::Vector3d> positions;
    for (const std::size_t i : used) positions.push_back(places.position_mm[i]);
    places.interpolation =
        std::make_unique<ScatteredInterpolation>(places.all_alike ? places.position_mm : std::move(positions));
    places.used = used;
    places.weights.clear();
  }
  const auto [weights, fresh] = places.weights.try_emplace(keyOf(position_mm));
  if (fresh) weights->second = places.interpolation->at(position_mm);
  Prediction out;
  for (std::size_t k = 0; k < weights->second.place.size(); ++k) {
    const std::size_t i = weights->second.place[k];
    out.value += weights->second.weight[k] * places.series[places.all_alike ? i : used[i]].at(time_s);
  }
  out.outside_mm = weights->second.outside;
  if (out.outside_mm > 0.0) out.answer = Answer::OutsidePlaces;
  return out;
}

std::vector<std::string> SimulationTable::points() const {
  std::vector<std::string> out;
  for (const auto& [point, series] : series_) out.push_back(point);
  return out;
}

SimulationMatch matchSimulation(const SimulationTable& table, const ObservationSet& observations,
                                const std::vector<std::string>& known_points, std::string_view name) {
  using Answer = SimulationTable::Answer;
  SimulationMatch match;
  std::map<Answer, std::size_t> count;
  std::set<std::string> lacking;
  std::set<std::string> components;
  std::map<std::string, double> outside_mm;
  match.predicted.reserve(observations.rows.size());
  for (const Observation& o : observations.rows) {
    const SimulationTable::Prediction p = table.at(o.time_s, o.point, o.position_mm, o.component);
    match.predicted.push_back(p.value);
    if (o.use == ObservationUse::Exclude) continue;
    ++count[p.answer];
    if (p.answer == Answer::UnknownPoint) lacking.insert(o.point);
    if (p.answer == Answer::UnknownComponent) components.insert(std::string(toString(o.component)));
    if (p.answer == Answer::OutsidePlaces) outside_mm[o.point] = std::max(outside_mm[o.point], p.outside_mm);
  }
  std::vector<std::string> reasons;
  if (count[Answer::BeforeOrAfter] > 0) {
    reasons.push_back(fmt::format("{} lie before or after the rows of {} ({:.0f} s to {:.0f} s)",
                                  count[Answer::BeforeOrAfter], name, table.firstTime_s(), table.lastTime_s()));
  }
  if (count[Answer::UnknownPoint] > 0) {
    reasons.push_back(
        fmt::format("{} are at points that {} lacks ({})", count[Answer::UnknownPoint], name, listOf(lacking)));
  }
  if (count[Answer::UnknownComponent] > 0) {
    reasons.push_back(fmt::format("{} are of components that {} lacks ({})", count[Answer::UnknownComponent], name,
                                  listOf(components)));
  }
  match.why_unmatched = joinedList(reasons);
  if (!outside_mm.empty()) {
    std::set<std::string> names;
    double largest = 0.0;
    for (const auto& [point, distance] : outside_mm) {
      names.insert(point);
      largest = std::max(largest, distance);
    }
    match.notes.push_back(
        fmt::format("The simulation is extrapolated at {} {}, up to {:.3g} mm outside the places that {} predicts.",
                    names.size() == 1 ? "point" : "points", listOf(names), largest, name));
  }
  if (!table.byPlace()) {
    std::set<std::string> known(known_points.begin(), known_points.end());
    for (const Observation& o : observations.rows) known.insert(o.point);
    std::set<std::string> strange;
    for (const std::string& point : table.points()) {
      if (!known.contains(point)) strange.insert(point);
    }
    if (!strange.empty()) {
      match.notes.push_back(fmt::format("{} predicts {} {}, which neither machine.json nor the observations know.",
                                        name, strange.size() == 1 ? "point" : "points", listOf(strange)));
    }
  }
  return match;
}

}  // namespace spindrift
