// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/workflows/compensation_sizes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spindrift {
namespace {

TEST(CompensationSizes, AreOfWhatWasMeasured) {
  CompensationPoint point;
  EXPECT_TRUE(std::isnan(measuredLength_um(point)));
  point.measured_um = {3.0, std::nullopt, -4.0};
  point.remains_um = {0.0, std::nullopt, 1.5};
  point.measured_sigma_um = {0.3, 0.0, 0.0};
  point.sigma_um = {0.4, 0.1, 0.1};
  EXPECT_DOUBLE_EQ(measuredLength_um(point), 5.0);
  EXPECT_DOUBLE_EQ(remainingLength_um(point), 1.5);
  EXPECT_DOUBLE_EQ(remainingSigma_um(point, 0), 0.5);
}

}  // namespace
}  // namespace spindrift
