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

}  // namespace
}  // namespace spindrift
