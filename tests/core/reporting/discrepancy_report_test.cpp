// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reporting/discrepancy_report.h"

#include <gmock/gmock.h>

#include <cmath>

namespace spindrift {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Four points, three moments in which each is read at its own time; EY grows along X and with time, a tenth of it is
/// left by the model; EX is zero.
DiscrepancyReportData data() {
  DiscrepancyReportData d;
  d.verdict = DiscrepancyVerdict::Named;
  d.message = "Missing in the simulation: ball_screw.expansion.y.";
  for (int moment = 0; moment < 3; ++moment)
    for (int p = 0; p < 4; ++p)
      for (const Component c : {Component::EX, Component::EY}) {
        const double x = 100.0 * (p % 2), y = 80.0 * (p / 2);
        const double before = c == Component::EY ? 0.05 * x * moment : 0.0;
        d.rows.push_back({3600.0 * moment + 60.0 * p,
                          "F" + std::to_string(p + 1),
                          c,
                          {x, y, 10.0},
                          0.2,
                          before,
                          0.1 * before,
                          moment == 2});
      }
  FoundEffect effect;
  effect.id = "ball_screw.expansion.y";
  effect.forced = true;
  d.effects = {effect};
  d.gap.rms_after_um = std::nan("");
  return d;
}

TEST(DiscrepancyReport, MapsAreOfTheWorstMomentBeforeAndAfter) {
  double time_s = 0.0;
  const auto maps = discrepancyMaps(data(), {0, 100, 0, 80, 0, 11, 9}, time_s);
  ASSERT_TRUE(maps.has_value());
  EXPECT_EQ(time_s, 7200.0);
  EXPECT_EQ((*maps)[0].component, Component::EY);
  EXPECT_EQ((*maps)[0].grid.z_mm, 10.0);
  ASSERT_EQ((*maps)[0].markers.size(), 4U);
  EXPECT_FALSE((*maps)[0].markers[0].used) << "held out";
  for (int ix = 0; ix < 11; ++ix) {
    const std::size_t n = (*maps)[0].grid.index(ix, 4);
    EXPECT_NEAR((*maps)[0].value[n], 10.0 * ix / 10.0, 2.0 * (*maps)[0].sigma[n] + 1e-9);
    EXPECT_NEAR((*maps)[1].value[n], 1.0 * ix / 10.0, 2.0 * (*maps)[1].sigma[n] + 1e-9);
  }
  // Along a line there is no map, and that is no failure.
  DiscrepancyReportData line = data();
  for (DiscrepancyReportRow& row : line.rows) row.position_mm.y() = 0.0;
  EXPECT_FALSE(discrepancyMaps(line, {0, 100, 0, 80, 0, 11, 9}, time_s).has_value());
}

TEST(DiscrepancyReport, SaysWhatWasAddedAndWhatIsProposed) {
  DiscrepancyReportData d = data();
  EXPECT_THAT(discrepancyReport("c", d, std::nullopt), Not(HasSubstr("(added to the model)")));
  d.user_adds = true;
  const std::string html = discrepancyReport("c", d, FieldGrid{0, 100, 0, 80, 0, 11, 9});
  EXPECT_THAT(
      html,
      HasSubstr("Thermal expansion of the Y ball screw <small>ball_screw.expansion.y</small> (added to the model)"));
  // F2 moves by 0, 5 and 10; the last is held out and is no part of the figures, as in the window.
  EXPECT_THAT(html, HasSubstr("3.54 \u2192 0.35"));
  EXPECT_THAT(html, HasSubstr("EY before"));
  EXPECT_THAT(html, HasSubstr("EY after"));
  EXPECT_THAT(html, HasSubstr("Missing in the simulation: thermal expansion of the Y ball screw <small>"));
  EXPECT_THAT(html, Not(HasSubstr(" um")));
  EXPECT_THAT(html, Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace spindrift
