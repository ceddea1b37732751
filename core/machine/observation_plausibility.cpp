// SPDX-License-Identifier: Apache-2.0
#include "core/machine/observation_plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/base/units.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

/// A tenth of a metre or of a radian: no deviation is near it, whatever it counts from.
constexpr double largest_deviation = 1e5;
/// From here on a change is looked at: a feature has no neighbour that is nearer.
constexpr double telling_change_mm = 1.0;
/// No machine changes by it.
constexpr double largest_change_mm = 10.0;

int axisOf(Component component) {
  return component == Component::EX ? 0 : component == Component::EY ? 1 : component == Component::EZ ? 2 : -1;
}

/// The rows of one point at one time in one state.
struct Reading {
  std::string point;
  std::string state;
  std::vector<std::size_t> rows;
  Eigen::Vector3d change_mm = Eigen::Vector3d::Zero();
  bool measured[3] = {false, false, false};
  std::string other;  ///< point that lies where the change leads; empty: none
};

class PlausibilityCheck {
 public:
  explicit PlausibilityCheck(const ObservationSet& set) : set_(set) {}

  [[nodiscard]] std::vector<ImplausibleReading> run() {
    limitValues();
    findUsual();
    findReadings();
    for (auto& [key, reading] : readings_) findOther(reading);
    report();
    std::sort(found_.begin(), found_.end(),
              [](const ImplausibleReading& a, const ImplausibleReading& b) { return a.rows.front() < b.rows.front(); });
    return std::move(found_);
  }

 private:
  using Key = std::tuple<std::string, std::string, double, double>;  // point, state, time, table angle

  /// Rows that can only be of another unit, each on its own.
  void limitValues() {
    taken_.assign(set_.rows.size(), false);
    for (std::size_t i = 0; i < set_.rows.size(); ++i) {
      const Observation& o = set_.rows[i];
      if (std::abs(o.value) <= largest_deviation) continue;
      beyond_.push_back(i);
    }
  }

  /// What a component of a point usually reads, mm, and where the point lies.
  void findUsual() {
    std::unordered_map<std::string, std::array<std::vector<double>, 3>> values;
    for (const Observation& o : set_.rows) {
      const int axis = axisOf(o.component);
      if (axis < 0 || o.use == ObservationUse::Exclude) continue;
      place_.try_emplace(o.point, o.position_mm);
      values[o.point][static_cast<std::size_t>(axis)].push_back(o.value / um_per_mm);
    }
    for (auto& [point, of] : values) {
      for (std::size_t k = 0; k < 3; ++k)
        if (!of[k].empty())
          usual_.try_emplace(point, Eigen::Vector3d::Zero()).first->second(static_cast<Eigen::Index>(k)) =
              of[k].size() < 3 ? of[k].front() : median(of[k]);
    }
  }

  /// Readings in which any component changed tellingly.
  void findReadings() {
    const auto keyOf = [](const Observation& o) { return Key{o.point, o.state, o.time_s, o.c_deg}; };
    for (const Observation& o : set_.rows) {
      const int axis = axisOf(o.component);
      if (axis < 0 || o.use == ObservationUse::Exclude) continue;
      if (std::abs(o.value / um_per_mm - usual_.at(o.point)(axis)) >= telling_change_mm)
        readings_.try_emplace(keyOf(o), Reading{o.point, o.state, {}, {}, {}, {}});
    }
    if (readings_.empty()) return;
    for (std::size_t i = 0; i < set_.rows.size(); ++i) {
      const Observation& o = set_.rows[i];
      const auto found = readings_.find(keyOf(o));
      if (found == readings_.end() || o.use == ObservationUse::Exclude) continue;
      Reading& reading = found->second;
      reading.rows.push_back(i);
      if (const int axis = axisOf(o.component); axis >= 0) {
        reading.measured[axis] = true;
        reading.change_mm(axis) = o.value / um_per_mm - usual_.at(o.point)(axis);
      }
    }
  }

  /// The point whose place the change leads to.
  void findOther(Reading& reading) const {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [point, place] : place_) {
      if (point == reading.point) continue;
      const Eigen::Vector3d between = place - place_.at(reading.point);
      const double tolerance = std::min(std::max(2.0, 0.02 * between.norm()), 0.25 * between.norm());
      for (const double sign : {1.0, -1.0}) {
        double off = 0.0;
        for (int k = 0; k < 3; ++k)
          if (reading.measured[k]) off = std::max(off, std::abs(reading.change_mm(k) - sign * between(k)));
        if (off > tolerance || off >= best) continue;
        best = off;
        reading.other = point;
      }
    }
  }

  void add(std::vector<std::size_t> rows, std::vector<std::string> points, const std::string& state,
           std::string sentence) {
    std::erase_if(rows, [&](std::size_t i) { return taken_[i]; });
    if (rows.empty()) return;
    std::sort(rows.begin(), rows.end());
    for (const std::size_t i : rows) taken_[i] = true;
    found_.push_back({std::move(rows), std::move(points), state, std::move(sentence)});
  }

  /// Of a reading: its rows; all rows of the point where its first state is wrong, which all others count from.
  [[nodiscard]] std::vector<std::size_t> rowsOf(const Reading& reading) const {
    if (set_.absolute || reading.state != set_.rows.front().state) return reading.rows;
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < set_.rows.size(); ++i)
      if (set_.rows[i].point == reading.point) rows.push_back(i);
    return rows;
  }

  void report() {
    const std::string& first_state = set_.rows.empty() ? std::string() : set_.rows.front().state;
    for (const auto& entry : readings_) {
      const Reading& reading = entry.second;
      const double size = reading.change_mm.norm();
      if (reading.other.empty()) continue;
      std::vector<std::size_t> rows = rowsOf(reading);
      const auto back = std::find_if(readings_.begin(), readings_.end(), [&](const auto& r) {
        return r.second.point == reading.other && r.second.state == reading.state && r.second.other == reading.point;
      });
      if (back == readings_.end()) {
        add(std::move(rows), {reading.point}, reading.state,
            fmt::format("{} in state {} lies {:.1f} mm from its place in the other states, where {} lies: {} was "
                        "measured under the label {}.",
                        reading.point, reading.state, size, reading.other, reading.other, reading.point));
        continue;
      }
      const std::vector<std::size_t> others = rowsOf(back->second);
      rows.insert(rows.end(), others.begin(), others.end());
      std::vector<std::string> points{reading.point, reading.other};
      std::sort(points.begin(), points.end());
      const bool told_apart = states(points.front()) > 2 || reading.state == first_state;
      add(std::move(rows), points, reading.state,
          told_apart ? fmt::format(
                           "The labels of {} and {} are swapped in state {}: each lies {:.1f} mm away, at the place of "
                           "the other.",
                           points[0], points[1], reading.state, size)
                     : fmt::format(
                           "The labels of {} and {} are swapped in state {} or in {}: each lies {:.1f} mm away, at the "
                           "place of the other.",
                           points[0], points[1], reading.state, first_state, size));
    }
    // Of a state that nothing can be compared with, a value alone is too large.
    for (const std::size_t i : beyond_) {
      const Observation& o = set_.rows[i];
      add({i}, {o.point}, o.state,
          fmt::format("{:g} {} is not allowed; allowed: deviations up to {:g} {} in size.", o.value,
                      printedUnit(unitOf(o.component)), largest_deviation, printedUnit(unitOf(o.component))));
    }
    for (const auto& [key, reading] : readings_) {
      const double size = reading.change_mm.norm();
      if (!reading.other.empty() || size < largest_change_mm) continue;
      add(rowsOf(reading), {reading.point}, reading.state,
          fmt::format("{} in state {} lies {:.1f} mm from its place in the other states; allowed: changes below {:g} "
                      "mm (another feature, or another unit?).",
                      reading.point, reading.state, size, largest_change_mm));
    }
  }

  /// In how many states a point was measured.
  [[nodiscard]] std::size_t states(const std::string& point) const {
    std::set<std::string> names;
    for (const Observation& o : set_.rows)
      if (o.point == point) names.insert(o.state);
    return names.size();
  }

  const ObservationSet& set_;
  std::vector<bool> taken_;
  std::vector<std::size_t> beyond_;
  std::map<std::string, Eigen::Vector3d> place_;
  std::unordered_map<std::string, Eigen::Vector3d> usual_;
  std::map<Key, Reading> readings_;
  std::vector<ImplausibleReading> found_;
};

}  // namespace

std::vector<ImplausibleReading> implausibleReadings(const ObservationSet& observations) {
  return PlausibilityCheck(observations).run();
}

void rejectReading(const ImplausibleReading& reading, InstrumentEvaluation& evaluation) {
  evaluation.rejected.push_back(
      {fmt::format("{} in state {}", joinedList(reading.points), reading.state), reading.sentence});
  evaluation.warnings.push_back(reading.sentence);
  evaluation.good_enough = false;
}

ObservationSet withoutRows(const ObservationSet& observations, const std::vector<std::size_t>& rows) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < observations.rows.size(); ++i)
    if (!std::binary_search(rows.begin(), rows.end(), i)) kept.push_back(i);
  ObservationSet out;
  out.file = observations.file;
  out.absolute = observations.absolute;
  for (const std::size_t i : kept) out.rows.push_back(observations.rows[i]);
  out.shared = observations.shared.restrictedTo(kept);
  return out;
}

void refusePositionsInAnotherUnit(const ObservationSet& observations, const MachineDescription& machine) {
  constexpr double rounding_mm = 1e-9;
  double travel_mm = 0.0;
  for (const LinearAxis& axis : machine.axes)
    travel_mm = std::max({travel_mm, std::abs(axis.travel_mm[0]), std::abs(axis.travel_mm[1])});
  std::map<std::string, Eigen::Vector3d> places;
  double reach_mm = 0.0;
  for (const Observation& o : observations.rows) {
    places.try_emplace(o.point, o.position_mm);
    reach_mm = std::max(reach_mm, o.position_mm.cwiseAbs().maxCoeff());
  }
  const SourcePlace file{observations.file.empty() ? machine.file : observations.file, ""};
  constexpr double beyond_any = 50.0;
  std::vector<double> reaches;
  for (const auto& place : places) reaches.push_back(place.second.cwiseAbs().maxCoeff());
  if (travel_mm > 0.0 && !reaches.empty() && median(reaches) > beyond_any * travel_mm) {
    throw InputError(file, fmt::format("half of the {} points lie beyond {:.6g} mm although the axes travel {:g} mm: "
                                       "their positions look like micrometres; allowed: millimetres.",
                                       places.size(), median(reaches), travel_mm));
  }
  const bool apart = std::any_of(places.begin(), places.end(), [&](const auto& place) {
    return (place.second - places.begin()->second).cwiseAbs().maxCoeff() > rounding_mm;
  });
  constexpr double mm_per_metre = 1e3;
  constexpr double beyond_travel = 1.1;
  if (!apart || !(reach_mm * mm_per_metre <= beyond_travel * travel_mm)) return;
  throw InputError(
      file,
      fmt::format("all {} points lie within {:.3g} mm although the axes travel {:g} mm: their positions look like "
                  "metres; allowed: millimetres.",
                  places.size(), reach_mm, travel_mm));
}

std::string outsideTravel(const ObservationSet& observations, const MachineDescription& machine) {
  std::set<std::string> outside;
  std::string example;
  for (const Observation& o : observations.rows) {
    for (int i = 0; i < 3; ++i) {
      const LinearAxis* axis = machine.findAxis(std::string(1, "XYZ"[i]));
      if (axis == nullptr) continue;
      const double slack = 0.1 * (axis->travel_mm[1] - axis->travel_mm[0]);
      if (o.position_mm[i] >= axis->travel_mm[0] - slack && o.position_mm[i] <= axis->travel_mm[1] + slack) continue;
      if (outside.insert(o.point).second && example.empty())
        example = fmt::format("{} of point {} is {:g} mm, the travel {:g} to {:g} mm", "xyz"[i], o.point,
                              o.position_mm[i], axis->travel_mm[0], axis->travel_mm[1]);
    }
  }
  if (outside.empty()) return {};
  return fmt::format(
      "{} of {} points lie far outside the travel of this machine ({}): are these its observations, in mm?",
      outside.size(), observations.points().size(), example);
}

std::vector<std::string> pointsOutsideTravel(const MachineDescription& machine) {
  constexpr double rounding_mm = 1e-9;
  std::vector<std::string> sentences;
  for (const MachinePoint& point : machine.points) {
    for (int i = 0; i < 3; ++i) {
      const LinearAxis* axis = machine.findAxis(std::string(1, "XYZ"[i]));
      if (axis == nullptr) continue;
      const double p = point.position_mm[i];
      if (p >= axis->travel_mm[0] - rounding_mm && p <= axis->travel_mm[1] + rounding_mm) continue;
      sentences.push_back(fmt::format("Point {} lies outside the travel of axis {} ({:g} mm; travel {:g} to {:g} mm).",
                                      point.id, axis->name, p, axis->travel_mm[0], axis->travel_mm[1]));
    }
  }
  return sentences;
}

}  // namespace spindrift
