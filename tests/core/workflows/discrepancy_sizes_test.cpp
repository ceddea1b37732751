// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/workflows/discrepancy_sizes.h"

#include <gmock/gmock.h>

#include <cmath>

namespace spindrift {
namespace {

DiscrepancySeries series(const std::string& point, double moved) {
  DiscrepancySeries s;
  s.point = point;
  s.component = Component::EY;
  s.value = {moved, -moved, 50.0};
  s.simulated = {0.0, 0.0, 0.0};
  s.held_out = {false, false, true};
  s.noise = 0.5;
  return s;
}

TEST(DiscrepancySizes, AreOfTheRowsThatWereFitted) {
  std::vector<DiscrepancySeries> all{series("F1", 1.0), series("F2", 7.0)};
  const DiscrepancySizes before = sizesOf(all, Component::EY);
  EXPECT_EQ(before.rows, 4U);
  EXPECT_DOUBLE_EQ(before.residual, 5.0);
  EXPECT_DOUBLE_EQ(before.noise, 0.5);
  EXPECT_TRUE(std::isnan(before.effects)) << "nothing was found";
  all[1].explained = {6.0, -6.0, 6.0};
  EXPECT_DOUBLE_EQ(sizesOf(all, Component::EY).effects, std::sqrt(18.0));
  EXPECT_EQ(sizesOf(all, Component::EX).rows, 0U);
}

TEST(DiscrepancySizes, OfASeriesAreOfOneAngleOfTheTable) {
  DiscrepancySeries s = series("F1", 3.0);
  EXPECT_TRUE(measuredAt(s, 0.0)) << "what names no angle is at 0";
  EXPECT_DOUBLE_EQ(sizesAt(s, 0.0).before, 3.0);
  s.places = {{0.0, {100.0, 0.0, 50.0}}, {90.0, {0.0, 100.0, 50.0}}};
  s.place = {0, 1, 1};
  s.value = {0.3, -4.0, 50.0};
  s.completed = {0.0, -4.0, 50.0};
  const SeriesSizes still = sizesAt(s, 0.0);
  EXPECT_DOUBLE_EQ(still.before, 0.3);
  EXPECT_DOUBLE_EQ(still.after, 0.3);
  EXPECT_DOUBLE_EQ(still.excess, 0.0) << "the noise of 0.5 explains it";
  EXPECT_EQ(still.position_mm, Eigen::Vector3d(100.0, 0.0, 50.0));
  const SeriesSizes turned = sizesAt(s, 90.0);
  EXPECT_DOUBLE_EQ(turned.before, 4.0) << "the row held out takes no part";
  EXPECT_DOUBLE_EQ(turned.after, 0.0);
  EXPECT_DOUBLE_EQ(turned.excess, std::sqrt(16.0 - 0.25));
  EXPECT_EQ(turned.position_mm, Eigen::Vector3d(0.0, 100.0, 50.0));
  EXPECT_FALSE(measuredAt(s, 45.0));
  DiscrepancyStory story;
  story.series = {s};
  EXPECT_EQ(anglesOf(story, Component::EY), (std::vector<double>{0.0, 90.0}));
}

}  // namespace
}  // namespace spindrift
