// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scanning/painted_mask.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace spindrift {
namespace {

PointCloud plate() {
  PointCloud cloud;
  for (int k = 0; k <= 20; ++k) {
    cloud.profile_start.push_back(cloud.size());
    for (int i = 0; i <= 20; ++i) cloud.points_mm.emplace_back(0.5 * i, 0.5 * k, 0.0);
  }
  cloud.profile_start.push_back(cloud.size());
  return cloud;
}

std::size_t left(const std::string& strokes) {
  const PointCloud cloud = plate();
  return masked(cloud, paintedMask(cloud, maskStrokesFromText(strokes))).size();
}

TEST(PaintedMask, BrushRectangleAndLassoCoverWhatTheyShow) {
  EXPECT_EQ(left("erase rectangle 1,1 2,3"), 441U - 3 * 5);
  EXPECT_EQ(left("erase rectangle 2,3 1,1"), 441U - 3 * 5) << "corners in any order";
  EXPECT_EQ(left("erase brush 0.6 5,5"), 441U - 5) << "a point and its four neighbours";
  EXPECT_EQ(left("erase brush 0.2 1,1 4,1"), 441U - 7) << "along a path";
  EXPECT_EQ(left("erase lasso -0.1,-0.1 10.3,-0.1 -0.1,10.3"), 441U - 231) << "half the plate with its diagonal";
}

TEST(PaintedMask, TheLastStrokeDecides) {
  EXPECT_EQ(left("erase rectangle 0,0 10,10; restore rectangle 2,2 3,3"), 9U);
  EXPECT_EQ(left("erase rectangle 0,0 10,10; restore rectangle 2,2 3,3; erase brush 0.1 2,2"), 8U);
}

TEST(PaintedMask, TextGivesBackTheStrokes) {
  const std::string text = "erase lasso 1.2,3.4 5,6 7,-3; restore brush 0.5 2,3 2.125,3.4; erase rectangle 0,0 1,1";
  EXPECT_EQ(toText(maskStrokesFromText(text)), text);
  const auto masks = masksOf({maskItem("captures/a: b.pcd", maskStrokesFromText(text)), "captures/c.pcd", "M0/F1/EX"});
  ASSERT_EQ(masks.size(), 1U);
  EXPECT_EQ(masks.begin()->first, "captures/a: b.pcd");
  EXPECT_EQ(toText(masks.begin()->second), text);
}

TEST(PaintedMask, SaysWhatIsWrong) {
  for (const char* bad : {"paint lasso 1,2 3,4 5,6", "erase circle 1,2 3,4", "erase lasso 1,2 3,4", "erase brush 0 1,2",
                          "erase rectangle 1,2", "erase rectangle 1,2 3,4 5,6", "erase lasso 1,2 3 5,6",
                          "erase lasso 1,2 x,4 5,6", "erase"}) {
    EXPECT_THROW((void)maskStrokesFromText(bad), InputError) << bad;
  }
}

}  // namespace
}  // namespace spindrift
