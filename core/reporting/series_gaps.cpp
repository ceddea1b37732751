// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/series_gaps.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/math/statistics.h"

namespace spindrift {

std::vector<SeriesGap> seriesGaps(const std::vector<DiscrepancyReportRow>& rows) {
  struct Sums {
    std::vector<double> before, after, weighted;
  };
  std::map<std::pair<std::string, Component>, Sums> sums;
  for (const DiscrepancyReportRow& r : rows) {
    if (!std::isfinite(r.before) || !std::isfinite(r.after)) continue;
    Sums& s = sums[{r.point, r.component}];
    s.before.push_back(r.before);
    s.after.push_back(r.after);
    s.weighted.push_back(r.before / r.sigma);
  }
  std::vector<std::pair<double, SeriesGap>> sorted;
  for (const auto& [key, s] : sums)
    sorted.push_back(
        {rootMeanSquare(s.weighted), {key.first, key.second, rootMeanSquare(s.before), rootMeanSquare(s.after)}});
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<SeriesGap> gaps;
  for (auto& [size, gap] : sorted) gaps.push_back(std::move(gap));
  return gaps;
}

}  // namespace spindrift
