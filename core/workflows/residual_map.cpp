// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/residual_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/machine/interpolated_field.h"
#include "core/workflows/discrepancy_sizes.h"
#include "core/workflows/fit_campaign.h"

namespace spindrift {
namespace {

constexpr int nodes_along = 40;

/// The readings of a series with the table at one angle, in order of time.
std::vector<std::size_t> readingsAtAngle(const DiscrepancySeries& series, double c_deg) {
  std::vector<std::size_t> readings;
  for (std::size_t i = 0; i < series.time_s.size(); ++i)
    if (series.placeOf(i).c_deg == c_deg) readings.push_back(i);
  std::stable_sort(readings.begin(), readings.end(),
                   [&](std::size_t a, std::size_t b) { return series.time_s[a] < series.time_s[b]; });
  return readings;
}

/// Of `readings`, in order of time, the one nearest to each moment, also in order; the size of the series if none is
/// near. One walk along the series.
std::vector<std::size_t> nearestReadings(const DiscrepancySeries& series, const std::vector<std::size_t>& readings,
                                         const std::vector<double>& moments_s, double within_s) {
  const std::vector<double>& t = series.time_s;
  std::vector<std::size_t> found;
  found.reserve(moments_s.size());
  std::size_t at = 0;
  for (const double moment_s : moments_s) {
    const auto away = [&](std::size_t k) { return std::abs(t[readings[k]] - moment_s); };
    while (at + 1 < readings.size() && away(at + 1) <= away(at)) ++at;
    found.push_back(!readings.empty() && away(at) <= within_s ? readings[at] : t.size());
  }
  return found;
}

/// The moments with the table at one angle, s. The longest series has a reading in every state; the others lie within
/// half a step of it.
std::vector<double> timesAtAngle(const DiscrepancyStory& story, Component component, double c_deg) {
  std::vector<double> times_s;
  for (const DiscrepancySeries& s : story.series) {
    if (s.component != component) continue;
    const std::vector<std::size_t> readings = readingsAtAngle(s, c_deg);
    if (readings.size() <= times_s.size()) continue;
    times_s.clear();
    for (const std::size_t i : readings) times_s.push_back(s.time_s[i]);
  }
  times_s.erase(std::unique(times_s.begin(), times_s.end()), times_s.end());
  return times_s;
}

/// Half of the shortest time between two moments.
double halfStep(const std::vector<double>& moments_s) {
  double step = 1e300;
  for (std::size_t i = 1; i < moments_s.size(); ++i) step = std::min(step, moments_s[i] - moments_s[i - 1]);
  return moments_s.size() > 1 ? 0.6 * step : 1e300;
}

bool earlier(const ResidualMoment& a, const ResidualMoment& b) {
  return std::pair(a.time_s, a.c_deg) < std::pair(b.time_s, b.c_deg);
}

}  // namespace

std::vector<ResidualMoment> momentsOf(const DiscrepancyStory& story, Component component) {
  std::vector<ResidualMoment> moments;
  for (const double c_deg : anglesOf(story, component))
    for (const double time_s : timesAtAngle(story, component, c_deg)) moments.push_back({time_s, c_deg});
  std::sort(moments.begin(), moments.end(), earlier);
  return moments;
}

std::size_t worstMoment(const DiscrepancyStory& story, Component component) {
  ResidualMoment worst;
  double largest = -1.0;
  for (const double c_deg : anglesOf(story, component)) {
    const std::vector<double> times_s = timesAtAngle(story, component, c_deg);
    const double within_s = halfStep(times_s);
    std::vector<double> sum(times_s.size(), 0.0);
    std::vector<double> count(times_s.size(), 0.0);
    for (const DiscrepancySeries& s : story.series) {
      if (s.component != component) continue;
      const auto nearest = nearestReadings(s, readingsAtAngle(s, c_deg), times_s, within_s);
      for (std::size_t m = 0; m < times_s.size(); ++m) {
        const std::size_t i = nearest[m];
        if (i == s.time_s.size()) continue;
        const double left = s.value[i] - s.constant_before - s.simulated[i];
        sum[m] += left * left;
        count[m] += 1.0;
      }
    }
    for (std::size_t m = 0; m < times_s.size(); ++m) {
      if (count[m] == 0.0 || sum[m] / count[m] <= largest) continue;
      largest = sum[m] / count[m];
      worst = {times_s[m], c_deg};
    }
  }
  const std::vector<ResidualMoment> moments = momentsOf(story, component);
  const auto at = std::lower_bound(moments.begin(), moments.end(), worst, earlier);
  return largest < 0.0 ? 0 : static_cast<std::size_t>(at - moments.begin());
}

std::vector<Field::Marker> residualsAt(const DiscrepancyStory& story, Component component, const ResidualMoment& moment,
                                       bool after) {
  std::vector<Field::Marker> points;
  const double within_s = halfStep(timesAtAngle(story, component, moment.c_deg));
  for (const DiscrepancySeries& s : story.series) {
    if (s.component != component) continue;
    const std::vector<double>& model = after ? s.completed : s.simulated;
    const std::size_t i = nearestReadings(s, readingsAtAngle(s, moment.c_deg), {moment.time_s}, within_s).front();
    if (model.empty() || i == s.time_s.size() || !std::isfinite(model[i])) continue;
    const double constant = after ? s.constant_after : s.constant_before;
    points.push_back({s.point, s.placeOf(i).position_mm, s.value[i] - constant - model[i], s.noise, !s.held_out[i]});
  }
  return points;
}

ResidualMap residualMap(const DiscrepancyStory& story, const MachineDescription& machine, Component component,
                        const ResidualMoment& moment, bool after) {
  ResidualMap map;
  map.points = residualsAt(story, component, moment, after);
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
