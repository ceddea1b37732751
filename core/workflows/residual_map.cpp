// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/residual_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/machine/interpolated_field.h"
#include "core/workflows/fit_campaign.h"

namespace spindrift {
namespace {

constexpr int nodes_along = 40;

/// Index of the reading of a series nearest in time; the size of the series if none is near.
std::size_t nearestReading(const DiscrepancySeries& series, double time_s, double within_s) {
  std::size_t found = series.time_s.size();
  double closest = within_s;
  for (std::size_t i = 0; i < series.time_s.size(); ++i) {
    const double distance = std::abs(series.time_s[i] - time_s);
    if (distance > closest) continue;
    closest = distance;
    found = i;
  }
  return found;
}

/// The same for moments in order: one walk along the series.
std::vector<std::size_t> nearestReadings(const DiscrepancySeries& series, const std::vector<double>& moments,
                                         double within_s) {
  const std::vector<double>& t = series.time_s;
  std::vector<std::size_t> order(t.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return t[a] < t[b]; });
  std::vector<std::size_t> found;
  found.reserve(moments.size());
  std::size_t at = 0;
  for (const double moment : moments) {
    const auto away = [&](std::size_t k) { return std::abs(t[order[k]] - moment); };
    while (at + 1 < order.size() && away(at + 1) <= away(at)) ++at;
    found.push_back(!order.empty() && away(at) <= within_s ? order[at] : t.size());
  }
  return found;
}

/// Half of the shortest time between two moments.
double halfStep(const std::vector<double>& moments) {
  double step = 1e300;
  for (std::size_t i = 1; i < moments.size(); ++i) step = std::min(step, moments[i] - moments[i - 1]);
  return moments.size() > 1 ? 0.6 * step : 1e300;
}

}  // namespace

std::vector<double> momentsOf(const DiscrepancyStory& story, Component component) {
  // The longest series has a reading in every state; the others lie within half a step of it.
  std::vector<double> moments;
  for (const DiscrepancySeries& s : story.series) {
    if (s.component == component && s.time_s.size() > moments.size()) moments = s.time_s;
  }
  std::sort(moments.begin(), moments.end());
  moments.erase(std::unique(moments.begin(), moments.end()), moments.end());
  return moments;
}

std::size_t worstMoment(const DiscrepancyStory& story, Component component) {
  const std::vector<double> moments = momentsOf(story, component);
  const double within = halfStep(moments);
  std::vector<double> sum(moments.size(), 0.0);
  std::vector<double> count(moments.size(), 0.0);
  for (const DiscrepancySeries& s : story.series) {
    if (s.component != component) continue;
    const std::vector<std::size_t> readings = nearestReadings(s, moments, within);
    for (std::size_t m = 0; m < moments.size(); ++m) {
      const std::size_t i = readings[m];
      if (i == s.time_s.size()) continue;
      const double left = s.value[i] - s.constant_before - s.simulated[i];
      sum[m] += left * left;
      count[m] += 1.0;
    }
  }
  std::size_t worst = 0;
  double largest = -1.0;
  for (std::size_t m = 0; m < moments.size(); ++m) {
    if (count[m] == 0.0 || sum[m] / count[m] <= largest) continue;
    largest = sum[m] / count[m];
    worst = m;
  }
  return worst;
}

std::vector<Field::Marker> residualsAt(const DiscrepancyStory& story, Component component, double time_s, bool after) {
  std::vector<Field::Marker> points;
  const double within = halfStep(momentsOf(story, component));
  for (const DiscrepancySeries& s : story.series) {
    if (s.component != component) continue;
    const std::vector<double>& model = after ? s.completed : s.simulated;
    const std::size_t i = nearestReading(s, time_s, within);
    if (model.empty() || i == s.time_s.size() || !std::isfinite(model[i])) continue;
    const double constant = after ? s.constant_after : s.constant_before;
    points.push_back({s.point, s.position_mm, s.value[i] - constant - model[i], s.noise, !s.held_out[i]});
  }
  return points;
}

ResidualMap residualMap(const DiscrepancyStory& story, const MachineDescription& machine, Component component,
                        double time_s, bool after) {
  ResidualMap map;
  map.points = residualsAt(story, component, time_s, after);
  std::vector<ScatteredValue> values;
  double z_mm = 0.0;
  for (const Field::Marker& p : map.points) {
    if (p.sigma > 0.0) values.push_back({p.position_mm, p.value, p.sigma});
    z_mm += p.position_mm.z();
  }
  if (!spreadsOverPlane(values)) return map;
  const auto grid = mapTable(machine, z_mm / static_cast<double>(map.points.size()), nodes_along);
  if (!grid) return map;
  auto field = std::make_shared<Field>(fieldBetween(component, values, *grid));
  field->markers = map.points;
  map.field = std::move(field);
  return map;
}

}  // namespace spindrift
