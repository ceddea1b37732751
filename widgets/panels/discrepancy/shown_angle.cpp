// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/discrepancy/shown_angle.h"

#include <algorithm>

#include "core/workflows/discrepancy_sizes.h"
#include "widgets/common/table_angle.h"

namespace spindrift::gui {

double clearestAngle(const DiscrepancySeries& series) {
  if (series.places.empty()) return 0.0;
  // Places without fitted readings have no size.
  const auto size = [&](const TablePlace& place) {
    const SeriesSizes sizes = sizesAt(series, place.c_deg);
    return sizes.before >= 0.0 ? sizes.before : -1.0;
  };
  return std::max_element(series.places.begin(), series.places.end(),
                          [&](const TablePlace& a, const TablePlace& b) { return size(a) < size(b); })
      ->c_deg;
}

QString withShownAngle(const QString& what, const DiscrepancySeries& series, double c_deg) {
  return series.places.size() > 1 ? withTableAngle(what, c_deg) : what;
}

}  // namespace spindrift::gui
