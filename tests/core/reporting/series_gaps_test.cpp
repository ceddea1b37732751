// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reporting/series_gaps.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spindrift {
namespace {

/// Four points, three moments; EY grows along X and with time, a tenth of it is left; EX is zero.
std::vector<DiscrepancyReportRow> rows() {
  std::vector<DiscrepancyReportRow> all;
  for (int moment = 0; moment < 3; ++moment)
    for (int p = 0; p < 4; ++p)
      for (const Component c : {Component::EX, Component::EY}) {
        DiscrepancyReportRow row;
        row.time_s = 3600.0 * moment;
        row.point = "F" + std::to_string(p + 1);
        row.component = c;
        row.sigma = 0.2;
        row.before = c == Component::EY ? 5.0 * (p % 2) * moment : 0.0;
        row.after = 0.1 * row.before;
        all.push_back(row);
      }
  return all;
}

TEST(SeriesGaps, TheLargestIsFirst) {
  std::vector<DiscrepancyReportRow> all = rows();
  all.front().before = std::nan("");  // counts nowhere
  const std::vector<SeriesGap> gaps = seriesGaps(all);
  ASSERT_EQ(gaps.size(), 8U);
  // F2 and F4 move by 0, 5 and 10 um.
  EXPECT_EQ(gaps[0].point, "F2");
  EXPECT_EQ(gaps[1].point, "F4");
  EXPECT_EQ(gaps[0].component, Component::EY);
  EXPECT_NEAR(gaps[0].before, std::sqrt(125.0 / 3.0), 1e-12);
  EXPECT_NEAR(gaps[0].after, 0.1 * std::sqrt(125.0 / 3.0), 1e-12);
  EXPECT_EQ(gaps[7].before, 0.0);
}

}  // namespace
}  // namespace spindrift
