// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/discrepancy_sizes.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/no_number.h"
#include "core/math/statistics.h"

namespace spindrift {

DiscrepancySizes sizesOf(const std::vector<DiscrepancySeries>& series, Component component) {
  std::vector<double> residual, effects, noise;
  for (const DiscrepancySeries& s : series) {
    if (s.component != component) continue;
    for (std::size_t i = 0; i < s.value.size(); ++i) {
      if (s.held_out[i]) continue;
      residual.push_back(s.value[i] - s.simulated[i] - s.constant_before);
      effects.push_back(s.explained.empty() ? 0.0 : s.explained[i]);
      noise.push_back(s.noise);
    }
  }
  const bool explained = std::any_of(series.begin(), series.end(), [component](const DiscrepancySeries& s) {
    return s.component == component && !s.explained.empty();
  });
  return {residual.size(), rootMeanSquare(residual), explained ? rootMeanSquare(effects) : std::nan(""),
          rootMeanSquare(noise)};
}

double beyondNoise(double rms, double noise) noexcept {
  return std::isfinite(rms) ? std::sqrt(std::max(0.0, rms * rms - noise * noise)) : no_number;
}

SeriesSizes sizesAt(const DiscrepancySeries& series, double c_deg) {
  SeriesSizes sizes;
  for (const TablePlace& place : series.places)
    if (place.c_deg == c_deg) sizes.position_mm = place.position_mm;
  if (series.places.empty()) sizes.position_mm = series.position_mm;
  std::vector<double> before, after;
  for (std::size_t i = 0; i < series.value.size(); ++i) {
    if (series.held_out[i] || series.placeOf(i).c_deg != c_deg) continue;
    before.push_back(series.value[i] - series.simulated[i] - series.constant_before);
    if (!series.completed.empty()) after.push_back(series.value[i] - series.completed[i] - series.constant_after);
  }
  sizes.before = before.empty() ? no_number : rootMeanSquare(before);
  sizes.after = after.empty() ? no_number : rootMeanSquare(after);
  sizes.excess = beyondNoise(sizes.before, series.noise);
  return sizes;
}

bool measuredAt(const DiscrepancySeries& series, double c_deg) {
  if (series.places.empty()) return c_deg == 0.0;
  return std::any_of(series.places.begin(), series.places.end(),
                     [c_deg](const TablePlace& p) { return p.c_deg == c_deg; });
}

std::vector<double> anglesOf(const DiscrepancyStory& story, Component component) {
  std::set<double> angles;
  for (const DiscrepancySeries& s : story.series) {
    if (s.component != component) continue;
    if (s.places.empty()) angles.insert(0.0);
    for (const TablePlace& p : s.places) angles.insert(p.c_deg);
  }
  return {angles.begin(), angles.end()};
}

}  // namespace spindrift
