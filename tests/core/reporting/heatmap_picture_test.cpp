// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reporting/heatmap_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"

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
