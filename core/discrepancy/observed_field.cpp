// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/observed_field.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace spindrift {

ObservedField::Key ObservedField::keyOf(const DeviationQuery& q, Component component) {
  const auto direction = [](double v) { return static_cast<int>(std::lround(10.0 * v)); };
  const auto thousandths = [](double v) { return std::llround(1000.0 * v); };
  return {q.point,
          static_cast<int>(component),
          thousandths(q.c_deg),
          direction(q.approach.x()),
          direction(q.approach.y()),
          direction(q.approach.z()),
          thousandths(q.tool_offset_mm.x()),
          thousandths(q.tool_offset_mm.y()),
          thousandths(q.tool_offset_mm.z())};
}

ObservedField::ObservedField(std::span<const Observation> rows, std::span<const double> values) {
  SPINDRIFT_ASSERT(rows.size() == values.size(), "one value for every row");
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (!std::isfinite(values[r])) continue;
    series_[keyOf(DeviationQuery::of(rows[r]), rows[r].component)].emplace_back(rows[r].time_s, values[r]);
  }
  for (auto& [key, series] : series_) std::sort(series.begin(), series.end());
}

double ObservedField::at(const DeviationQuery& query, Component component) const {
  const auto found = series_.find(keyOf(query, component));
  if (found == series_.end()) return 0.0;
  const auto& series = found->second;
  const auto after = std::lower_bound(series.begin(), series.end(), std::make_pair(query.time_s, -1e300));
  if (after == series.begin()) return series.front().second;
  if (after == series.end()) return series.back().second;
  const auto before = std::prev(after);
  const double span = after->first - before->first;
  const double part = span > 0.0 ? (query.time_s - before->first) / span : 1.0;
  return before->second + part * (after->second - before->second);
}

}  // namespace spindrift
