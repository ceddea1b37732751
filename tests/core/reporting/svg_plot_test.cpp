// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reporting/svg_plot.h"

#include <gmock/gmock.h>

#include <cmath>

namespace spindrift {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(SvgPlot, TicksAreRoundAndInside) {
  EXPECT_THAT(roundTicks(0.0, 10.0, 5), ElementsAre(0.0, 2.0, 4.0, 6.0, 8.0, 10.0));
  const auto ticks = roundTicks(-0.013, 0.021, 6);
  EXPECT_GE(ticks.front(), -0.013);
  EXPECT_LE(ticks.back(), 0.021);
  EXPECT_GE(ticks.size(), 3U);
  EXPECT_EQ(tickText(-0.01, 0.01), "\u22120.01");
  EXPECT_EQ(tickText(-1e-18, 0.5), "0.0");
  EXPECT_EQ(tickText(2000.0, 500.0), "2000");
  EXPECT_THAT(roundTicks(3.0, 3.0, 5), ElementsAre(3.0));
}

TEST(SvgPlot, DrawsEveryFinitePointAndBreaksTheLineAtAGap) {
  PlotSeries points{"measured", {0.0, 1.0, 2.0, 3.0}, {1.0, std::nan(""), 2.0, 3.0}, {}, SeriesStyle::Points};
  PlotSeries line = points;
  line.style = SeriesStyle::Line;
  line.name = "a & b";
  const std::string svg = svgPlot({points, line}, {.title = "t", .x_label = "time / h", .y_label = "EZ / um"});
  std::size_t circles = 0;
  for (std::size_t at = svg.find("r=\"2.2\""); at != std::string::npos; at = svg.find("r=\"2.2\"", at + 1)) ++circles;
  EXPECT_EQ(circles, 3U);
  const std::size_t path = svg.find("<path d=\"");
  const std::string d = svg.substr(path, svg.find("fill", path) - path);
  EXPECT_EQ(std::count(d.begin(), d.end(), 'M'), 2);
  EXPECT_THAT(svg, HasSubstr("a &amp; b"));
  EXPECT_THAT(svg, HasSubstr("EZ / um"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(SvgPlot, SaysWhenThereIsNothingToShow) {
  EXPECT_THAT(svgPlot({}, {}), HasSubstr("no data"));
  EXPECT_THAT(svgPlot({{"one", {5.0}, {7.0}, {}, SeriesStyle::Points}}, {}), HasSubstr("<circle"));
}

}  // namespace
}  // namespace spindrift
