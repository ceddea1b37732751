// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/known_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace spindrift {
namespace {

TEST(KnownValues, WhatIsNotKnownDoesNotCount) {
  const double nan = std::nan("");
  EXPECT_DOUBLE_EQ(meanOfKnown(std::vector<double>{3.0, nan, -1.0}), 1.0);
  EXPECT_DOUBLE_EQ(rootMeanSquareOfKnown(std::vector<double>{nan, 3.0, -4.0}), std::sqrt(12.5));
  EXPECT_TRUE(std::isnan(meanOfKnown(std::vector<double>{nan})));
  EXPECT_TRUE(std::isnan(rootMeanSquareOfKnown({})));
}

TEST(KnownValues, AWeightedMeanTrustsWhatIsSurer) {
  const WeightedMean both = weightedMean(std::vector<double>{10.0, 20.0}, std::vector<double>{1.0, 3.0});
  EXPECT_DOUBLE_EQ(both.value, (10.0 + 20.0 / 9.0) / (1.0 + 1.0 / 9.0));
  EXPECT_DOUBLE_EQ(both.sigma, 1.0 / std::sqrt(1.0 + 1.0 / 9.0));
  EXPECT_TRUE(std::isnan(weightedMean({}, {}).value));
}

}  // namespace
}  // namespace spindrift
