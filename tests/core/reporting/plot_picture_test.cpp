// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reporting/plot_picture.h"

#include <gmock/gmock.h>

#include <cmath>

namespace spindrift {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(PlotPicture, TicksAreRoundAndInside) {
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

TEST(PlotPicture, DrawsEveryFinitePointAndBreaksTheLineAtAGap) {
  PlotSeries points{"measured", {0.0, 1.0, 2.0, 3.0}, {1.0, std::nan(""), 2.0, 3.0}, {}, SeriesStyle::Points};
  PlotSeries line = points;
  line.style = SeriesStyle::Line;
  line.name = "a & b";
  const std::string svg =
      svgOf(plotPicture({points, line}, {.title = "t", .x_label = "time / h", .y_label = "EZ / um"}));
  std::size_t circles = 0;
  for (std::size_t at = svg.find("r=\"2.2\""); at != std::string::npos; at = svg.find("r=\"2.2\"", at + 1)) ++circles;
  EXPECT_EQ(circles, 3U);
  const std::size_t end = svg.find("stroke-width=\"1.4\"");
  ASSERT_NE(end, std::string::npos);
  const std::size_t path = svg.rfind("<path d=\"", end);
  const std::string d = svg.substr(path, svg.find("fill", path) - path);
  EXPECT_EQ(std::count(d.begin(), d.end(), 'M'), 2);
  EXPECT_THAT(svg, HasSubstr("a &amp; b"));
  EXPECT_THAT(svg, HasSubstr("EZ / um"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(PlotPicture, SaysWhenThereIsNothingToShow) {
  EXPECT_THAT(svgOf(plotPicture({}, {})), HasSubstr("no data"));
  EXPECT_THAT(svgOf(plotPicture({{"one", {5.0}, {7.0}, {}, SeriesStyle::Points}}, {})), HasSubstr("<circle"));
}

TEST(PlotPicture, AxesHaveOneColourAndOneShapeEach) {
  PlotSeries x{"EX", {0.0, 1.0}, {0.0, 1.0}, {}, SeriesStyle::Points};
  PlotSeries y = x, z = x;
  x.dress(componentLook(Component::EX));
  y.dress(componentLook(Component::EB));
  z.dress(axisLook(2));
  const std::string svg = svgOf(plotPicture({x, y, z}, {}));
  EXPECT_THAT(svg, HasSubstr("r=\"2.2\" fill=\"#b83227\""));
  EXPECT_THAT(svg, HasSubstr("height=\"3.96\" fill=\"#2a7f46\""));
  EXPECT_THAT(svg, HasSubstr("fill=\"#2460b4\""));
}

TEST(PlotPicture, LongLegendsWrapInsteadOfBeingCut) {
  std::vector<PlotSeries> series;
  for (int i = 0; i < 12; ++i)
    series.push_back({"a rather long name " + std::to_string(i), {0.0, 1.0}, {0.0, 1.0}, {}, SeriesStyle::Line});
  const std::string svg = svgOf(plotPicture(series, {.width_px = 640}));
  int names = 0;
  for (std::size_t at = svg.find("<text x=\""); at != std::string::npos; at = svg.find("<text x=\"", at + 1)) {
    const std::string element = svg.substr(at, svg.find("</text>", at) - at);
    if (element.find("rather long") == std::string::npos) continue;
    ++names;
    EXPECT_LT(std::stod(element.substr(9)) + 6.8 * 20, 640.0) << element;
  }
  EXPECT_EQ(names, 12);
}

TEST(PlotPicture, EveryScaleHasThreeMarks) {
  for (double top = 1.0; top < 10.0; top += 0.1) {
    const PlotSeries s{"s", {0.0, 1.0}, {-top, top}, {}, SeriesStyle::Points};
    const std::string svg = svgOf(plotPicture({s}, {.width_px = 284, .height_px = 170, .compact = true}));
    int marks = 0;
    for (std::size_t at = svg.find("text-anchor=\"end\""); at != std::string::npos;
         at = svg.find("text-anchor=\"end\"", at + 1))
      ++marks;
    EXPECT_GE(marks, 3) << top;
    EXPECT_LE(marks, 9) << top;
  }
}

TEST(PlotPicture, EqualScalesAreEqual) {
  PlotSeries square{"s", {0.0, 10.0}, {0.0, 10.0}, {}, SeriesStyle::Points};
  const std::string svg = svgOf(plotPicture({square}, {.width_px = 640, .height_px = 300, .equal_scale = true}));
  std::vector<double> x, y;
  for (std::size_t at = svg.find("<circle cx=\""); at != std::string::npos; at = svg.find("<circle cx=\"", at + 1)) {
    x.push_back(std::stod(svg.substr(at + 12)));
    y.push_back(std::stod(svg.substr(svg.find("cy=\"", at) + 4)));
  }
  ASSERT_EQ(x.size(), 2U);
  EXPECT_NEAR(x[1] - x[0], y[0] - y[1], 0.2);
}

}  // namespace
}  // namespace spindrift
