// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reporting/heatmap_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/reporting/plot_picture.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

Field someField() {
  Field field;
  field.grid = {0, 300, 0, 130, 0, 7, 5};
  field.component = Component::EX;
  for (int iy = 0; iy < 5; ++iy) {
    for (int ix = 0; ix < 7; ++ix) {
      field.value.push_back(4.0 * ix - 10.0);
      field.sigma.push_back(1.0);
      field.extrapolated.push_back(ix == 0 || ix == 6);
    }
  }
  field.markers.push_back({"F1", {20, 15, 0}, -9.5, 0.3, true});
  field.markers.push_back({"F2 & co", {280, 115, 0}, 12.0, 0.3, false});
  return field;
}

TEST(HeatmapPicture, ZeroIsNeutralAndTheEndsAreThoseOfTheMap) {
  const auto zero = coolWarm(0.0);
  EXPECT_EQ(zero[0], zero[1]);
  EXPECT_EQ(zero[1], zero[2]);
  EXPECT_EQ(coolWarm(-1.0), (std::array<std::uint8_t, 3>{59, 76, 192}));
  EXPECT_EQ(coolWarm(7.0), (std::array<std::uint8_t, 3>{180, 4, 38}));
}

TEST(HeatmapPicture, LimitsAreRoundAndCoverTheData) {
  EXPECT_DOUBLE_EQ(roundLimit(35.0), 40.0);
  EXPECT_DOUBLE_EQ(roundLimit(0.4), 0.4);
  EXPECT_DOUBLE_EQ(roundLimit(9.1), 10.0);
  EXPECT_DOUBLE_EQ(roundLimit(0.0), 1.0);
}

TEST(HeatmapPicture, SvgHoldsAxesUnitsPointsAndEscapesNames) {
  HeatmapPictureOptions options;
  options.title = "EX of state <M1>";
  const std::string svg = svgOf(heatmapPicture(someField(), options));
  EXPECT_THAT(svg, ::testing::StartsWith("<svg"));
  for (const char* text : {"x / mm", "y / mm", "EX / µm", "F1: ", "F2 &amp; co", "EX of state &lt;M1&gt;", "</svg>"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

/// The texts of an SVG that name `point`: alone or with its value.
std::vector<std::string> labelsOf(const std::string& svg, const std::string& point) {
  std::vector<std::string> labels;
  for (std::size_t at = svg.find('>' + point); at != std::string::npos; at = svg.find('>' + point, at + 1))
    labels.push_back(svg.substr(at + 1, svg.find('<', at + 1) - at - 1));
  return labels;
}

// Twelve points where three labels have room: values where they can be read, else names, never one over another.
TEST(HeatmapPicture, PointsThatAreCloseHaveTheirNameAlone) {
  Field field = someField();
  field.markers.clear();
  const FieldGrid& g = field.grid;
  for (int i = 0; i < 12; ++i)
    field.markers.push_back(
        {"P" + std::string(1, static_cast<char>('A' + i)),
         {g.x_from_mm + (0.4 + 0.02 * i) * (g.x_to_mm - g.x_from_mm), 0.5 * (g.y_from_mm + g.y_to_mm), 0.0},
         1.0,
         0.1,
         true});
  HeatmapPictureOptions options;
  options.width_px = 480;
  const std::string svg = svgOf(heatmapPicture(field, options));
  std::size_t with_value = 0, named = 0;
  for (const Field::Marker& m : field.markers) {
    const std::vector<std::string> labels = labelsOf(svg, m.point);
    if (labels.empty()) continue;
    ++(labels.front().find(':') != std::string::npos ? with_value : named);
  }
  EXPECT_GE(with_value, 1U);
  EXPECT_LT(with_value, 12U);
  EXPECT_GE(named, 1U) << "names alone where the values have no room";
  // A scale has three marks at least.
  std::size_t x_marks = 0;
  for (const double x : roundTicks(g.x_from_mm, g.x_to_mm, 6))
    if (!labelsOf(svg, tickText(x, 50.0)).empty()) ++x_marks;
  EXPECT_GE(x_marks, 3U);
}

TEST(HeatmapPicture, PngIsAPngOfTheLayoutsSize) {
  HeatmapPictureOptions options;
  options.width_px = 600;
  const std::string png = pngOf(heatmapPicture(someField(), options), 1.0);
  ASSERT_GT(png.size(), 1000u);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(png[i]); };
  EXPECT_EQ(byte(18) * 256 + byte(19), 600);
}

TEST(HeatmapPicture, RefusesSizesThatCannotBeDrawn) {
  HeatmapPictureOptions options;
  options.width_px = 100;
  EXPECT_THROW((void)heatmapPicture(someField(), options), InputError);
  options.width_px = 800;
  options.limit = -1.0;
  EXPECT_THROW((void)heatmapPicture(someField(), options), InputError);
}

}  // namespace
}  // namespace spindrift
