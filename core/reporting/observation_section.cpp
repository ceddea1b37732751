// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "core/base/natural_order.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/reporting/plot_picture.h"
#include "core/reporting/point_map.h"
#include "core/reporting/report_parts.h"
#include "core/reporting/report_wording.h"

namespace spindrift {
namespace {

/// Readings of a point from which on a curve says more than a map.
constexpr std::size_t least_for_curves = 4;
constexpr std::size_t most_panels = 18;
constexpr std::size_t most_maps = 4;

using Key = std::pair<std::string, Component>;

/// A reading approached from another side along its component, or with another tool, is another measurand: backlash is
/// no change.
using Measurand = std::tuple<Key, double, std::array<double, 3>>;
Measurand measurandOf(const Observation& o) {
  const Eigen::Vector3d& tool = o.tool_offset_mm;
  return {Key{o.point, o.component},
          isRotation(o.component) ? 0.0 : o.approach[axisIndex(o.component)],
          {tool.x(), tool.y(), tool.z()}};
}

/// An observation minus the first of its point and component, with the uncertainty of the difference.
struct Change {
  const Observation* row = nullptr;
  const Observation* first = nullptr;
  double value = 0.0;
  double sigma = 0.0;
};

/// What stands at another angle of the table is another place on it: readings of one point at several angles are told
/// apart by their names, and no change is from one angle to another.
ObservationSet placesOf(const ObservationSet& observations) {
  std::map<std::string, std::set<double>> angles;
  for (const Observation& o : observations.rows) angles[o.point].insert(o.c_deg);
  ObservationSet places = observations;
  for (Observation& o : places.rows)
    if (angles.at(o.point).size() > 1) o.point = fmt::format("{}, C {:g}°", o.point, o.c_deg);
  return places;
}

/// In order of time within each point and component; the first of each is zero by definition and not among them.
std::vector<Change> changesOf(const ObservationSet& observations) {
  const auto& rows = observations.rows;
  std::map<Measurand, std::vector<std::size_t>> series;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].use != ObservationUse::Exclude) series[measurandOf(rows[i])].push_back(i);
  std::vector<Change> changes;
  for (auto& [key, indices] : series) {
    std::stable_sort(indices.begin(), indices.end(),
                     [&](std::size_t a, std::size_t b) { return rows[a].time_s < rows[b].time_s; });
    const std::size_t f = indices.front();
    for (std::size_t k = 1; k < indices.size(); ++k) {
      const std::size_t i = indices[k];
      const double variance =
          rows[i].sigma * rows[i].sigma + rows[f].sigma * rows[f].sigma - 2.0 * observations.shared.covariance(f, i);
      changes.push_back({&rows[i], &rows[f], rows[i].value - rows[f].value, std::sqrt(std::max(0.0, variance))});
    }
  }
  return changes;
}

/// One change for every state of a point and component: the mean of its readings, each against the first of its own
/// measurand, weighted by their uncertainties.
std::vector<Change> changesOfStates(const ObservationSet& observations, const std::vector<Change>& changes) {
  std::map<std::tuple<std::string, std::string, Component>, std::vector<const Change*>> groups;
  std::vector<const std::vector<const Change*>*> order;
  for (const Change& c : changes) {
    auto& group = groups[{c.row->state, c.row->point, c.row->component}];
    if (group.empty()) order.push_back(&group);
    group.push_back(&c);
  }
  const auto covariance = [&](const Observation* a, const Observation* b) {
    if (a == b) return a->sigma * a->sigma;
    const Observation* from = observations.rows.data();
    return observations.shared.covariance(static_cast<std::size_t>(a - from), static_cast<std::size_t>(b - from));
  };
  std::vector<Change> out;
  for (const auto* group : order) {
    double total = 0.0;
    for (const Change* c : *group) total += 1.0 / (c->row->sigma * c->row->sigma);
    Change mean{group->front()->row, group->front()->first, 0.0, 0.0};
    double variance = 0.0;
    const auto weight = [&](const Change* c) { return 1.0 / (c->row->sigma * c->row->sigma) / total; };
    for (const Change* a : *group) {
      mean.value += weight(a) * a->value;
      for (const Change* b : *group)
        variance += weight(a) * weight(b) *
                    (covariance(a->row, b->row) - covariance(a->row, b->first) - covariance(a->first, b->row) +
                     covariance(a->first, b->first));
    }
    mean.sigma = std::sqrt(std::max(0.0, variance));
    out.push_back(mean);
  }
  return out;
}

std::size_t medianCount(const ObservationSet& observations) {
  std::map<Measurand, std::size_t> counts;
  for (const Observation& o : observations.rows)
    if (o.use != ObservationUse::Exclude) ++counts[measurandOf(o)];
  std::vector<std::size_t> sorted;
  for (const auto& [key, count] : counts) sorted.push_back(count);
  std::sort(sorted.begin(), sorted.end());
  return sorted.empty() ? 0 : sorted[sorted.size() / 2];
}

/// States of the changes in the order in which they were measured.
std::vector<std::string> statesOf(const ObservationSet& observations, const std::vector<Change>& changes) {
  std::vector<std::string> states;
  for (const std::string& state : observations.states())
    if (std::any_of(changes.begin(), changes.end(), [&](const Change& c) { return c.row->state == state; }))
      states.push_back(state);
  return states;
}

void addChangeTable(Report& document, const std::vector<std::string>& states, const std::vector<Change>& changes) {
  std::vector<Component> components;
  for (const Component c : all_components)
    if (std::any_of(changes.begin(), changes.end(), [c](const Change& x) { return x.row->component == c; }))
      components.push_back(c);
  ReportRow header{"Point", "State", "X / mm", "Y / mm"};
  for (const Component c : components) header.push_back(fmt::format("{} / {}", toString(c), printedUnitOf(c)));
  // In the order of the states, then of the points.
  std::vector<std::pair<std::string, std::string>> order;
  std::map<std::pair<std::string, std::string>, std::map<Component, const Change*>> cells;
  for (const Change& c : changes) {
    auto& row = cells[{c.row->state, c.row->point}];
    if (row.empty()) order.emplace_back(c.row->state, c.row->point);
    row[c.row->component] = &c;
  }
  const auto rank = [&](const std::string& state) { return std::find(states.begin(), states.end(), state); };
  std::stable_sort(order.begin(), order.end(),
                   [&](const auto& a, const auto& b) { return rank(a.first) < rank(b.first); });
  std::vector<ReportRow> rows;
  for (const auto& key : order) {
    const auto& row = cells[key];
    const Observation& o = *row.begin()->second->row;
    rows.push_back(
        {key.second, key.first, fmt::format("{:.1f}", o.position_mm.x()), fmt::format("{:.1f}", o.position_mm.y())});
    for (const Component c : components) {
      const auto found = row.find(c);
      rows.back().push_back(found == row.end() ? std::string("–")
                                               : withUncertainty(found->second->value, found->second->sigma, ""));
    }
  }
  document.table(header, rows,
                 "Change of each point from its first reading, the mean of the readings of a state ± one standard "
                 "uncertainty");
}

/// Displacements in one state with the table at one angle, ready for a map.
struct MapContent {
  std::map<std::string, PointDisplacement, NaturalOrder> points;
  std::set<std::string> references;
};

void addMaps(Report& document, const std::vector<std::string>& states, const std::vector<Change>& changes) {
  std::set<double> angles;
  for (const Change& c : changes) angles.insert(c.row->c_deg);
  std::size_t maps = 0;
  for (const std::string& state : states) {
    std::map<double, MapContent> of_angle;
    for (const Change& c : changes) {
      if (c.row->state != state || isRotation(c.row->component)) continue;
      MapContent& map = of_angle[c.row->c_deg];
      PointDisplacement& p = map.points[c.row->point];
      if (p.point.empty()) {
        p.point = c.row->point;
        p.change_um.setConstant(std::nan(""));
        p.position_mm = c.row->position_mm;
      }
      p.change_um[axisIndex(c.row->component)] = c.value;
      p.sigma_um[axisIndex(c.row->component)] = c.sigma;
      map.references.insert(c.first->state);
    }
    for (const auto& [c_deg, map] : of_angle) {
      if (maps == most_maps) return;
      std::vector<PointDisplacement> list;
      for (const auto& [name, point] : map.points) list.push_back(point);
      const std::string from =
          map.references.size() == 1 ? "state " + *map.references.begin() : std::string("its first reading");
      const std::string where = angles.size() > 1 ? fmt::format("{}, table at {:g}°", state, c_deg) : state;
      const auto drawing =
          pointMap(list, {.title = fmt::format("Displacement in state {}", where),
                          .subtitle = fmt::format("change of the tool relative to the table from {}", from)});
      if (!drawing) continue;
      document.figure(*drawing, fmt::format("Measured displacement of the points in state {}, from {}: arrows X and Y, "
                                            "colour and number Z in µm",
                                            where, from));
      ++maps;
    }
  }
}

/// Limits of all panels of a group, so that they can be compared.
struct Limits {
  double low = 0.0, high = 0.0;
  void add(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
};

/// The points whose readings change most against their uncertainty, in the order they came in.
std::vector<std::string> mostTelling(const ObservationSet& observations, const std::vector<Change>& changes,
                                     bool rotations) {
  std::map<std::string, double> largest;
  for (const Change& c : changes)
    if (isRotation(c.row->component) == rotations && c.sigma > 0.0) {
      double& most = largest[c.row->point];
      most = std::max(most, std::abs(c.value) / c.sigma);
    }
  std::vector<std::pair<double, std::string>> order;
  for (const auto& [point, size] : largest) order.emplace_back(-size, point);
  std::sort(order.begin(), order.end());
  if (order.size() > most_panels) order.resize(most_panels);
  std::vector<std::string> kept;
  for (const std::string& point : observations.points())
    if (std::any_of(order.begin(), order.end(), [&](const auto& o) { return o.second == point; }))
      kept.push_back(point);
  return kept;
}

void addPanels(Report& document, const ObservationSet& observations, const std::vector<Change>& changes,
               bool rotations) {
  const std::vector<std::string> points = mostTelling(observations, changes, rotations);
  if (points.empty()) return;
  std::map<Key, PlotSeries> series;
  Limits x, y;
  for (const Change& c : changes) {
    if (isRotation(c.row->component) != rotations) continue;
    PlotSeries& s = series[{c.row->point, c.row->component}];
    if (s.x.empty()) {
      s.name = toString(c.row->component);
      s.dress(componentLook(c.row->component));
      s.style = SeriesStyle::Both;
      // The reading that all others are relative to.
      s.x.push_back(c.first->time_s / seconds_per_hour);
      s.y.push_back(0.0);
      s.sigma.push_back(0.0);
    }
    // Two readings at one moment (both directions of approach) make no line.
    if (s.x.back() == c.row->time_s / seconds_per_hour) s.style = SeriesStyle::Points;
    s.x.push_back(c.row->time_s / seconds_per_hour);
    s.y.push_back(c.value);
    s.sigma.push_back(c.sigma);
    x.add(s.x.back());
    y.add(c.value - 2.0 * c.sigma);
    y.add(c.value + 2.0 * c.sigma);
  }
  const PanelGrid grid = PanelGrid::of(points.size());
  std::vector<Drawing> panels;
  for (const std::string& point : points) {
    std::vector<PlotSeries> lines;
    for (const Component c : all_components) {
      const auto found = series.find({point, c});
      if (found != series.end()) lines.push_back(std::move(found->second));
    }
    PlotOptions options{.title = point,
                        .x_label = "time / h",
                        .y_label = rotations ? "change / µrad" : "change / µm",
                        .width_px = grid.width_px,
                        .height_px = grid.height_px,
                        .y_from = y.low,
                        .y_to = y.high,
                        .x_from = x.low - 0.02 * (x.high - x.low),
                        .x_to = x.high + 0.02 * (x.high - x.low),
                        .compact = true};
    panels.push_back(plotPicture(lines, options));
  }
  std::set<std::string> changing;
  for (const Change& c : changes)
    if (isRotation(c.row->component) == rotations && c.sigma > 0.0) changing.insert(c.row->point);
  const std::size_t all = changing.size();
  document.figure(
      drawingGrid(panels, grid.columns, PanelGrid::gap_px),
      fmt::format("{} of {} from its first reading, all on one scale; bands: two standard uncertainties",
                  rotations ? "Rotation" : "Displacement",
                  points.size() < all ? fmt::format("the {} of {} points that change most", points.size(), all)
                                      : std::string("each point")));
}

}  // namespace

PanelGrid PanelGrid::of(std::size_t panels) {
  if (panels > 4) return {};
  return {2, 428, 200};
}

std::vector<LargestChange> largestChanges(const ObservationSet& measured) {
  const ObservationSet observations = placesOf(measured);
  std::map<Component, LargestChange> largest;
  for (const Change& c : changesOfStates(observations, changesOf(observations))) {
    LargestChange& most = largest[c.row->component];
    if (!most.point.empty() && std::abs(c.value) <= std::abs(most.value)) continue;
    most = {c.row->component, c.row->point, c.row->state, c.value, c.sigma};
  }
  std::vector<LargestChange> list;
  for (auto& [component, change] : largest) list.push_back(std::move(change));
  return list;
}

void addObservations(Report& document, const ObservationSet& observations) {
  if (observations.rows.empty()) return;
  document.section("Observations");
  std::size_t used = 0;
  std::set<std::string> points;
  std::set<std::string> states;
  for (const Observation& o : observations.rows) {
    if (o.use == ObservationUse::Exclude) continue;
    ++used;
    points.insert(o.point);
    states.insert(o.state);
  }
  document.paragraph(
      fmt::format("{} observations of {} points in {} states. Deviation = actual minus commanded position of the tool "
                  "relative to the table, up to a constant per point and component; shown is the change from the first "
                  "reading of each point.",
                  used, points.size(), states.size()));
  if (used < observations.rows.size())
    document.paragraph(fmt::format("Excluded, and shown nowhere: {} of {} observations.",
                                   observations.rows.size() - used, observations.rows.size()));
  const ObservationSet places = placesOf(observations);
  const std::vector<Change> changes = changesOf(places);
  if (changes.empty()) {
    document.callout(CalloutKind::Note, "Every point was read once only: there is no change to show.");
  } else if (medianCount(places) < least_for_curves) {
    const std::vector<std::string> in_order = statesOf(places, changes);
    const std::vector<Change> of_states = changesOfStates(places, changes);
    addMaps(document, in_order, of_states);
    addChangeTable(document, in_order, of_states);
  } else {
    addPanels(document, places, changes, false);
    addPanels(document, places, changes, true);
  }
}

}  // namespace spindrift
