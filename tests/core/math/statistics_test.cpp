// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spindrift {
namespace {

TEST(Statistics, HandCheckedValues) {
  const std::vector<double> v{1.0, 2.0, 4.0, 9.0};
  EXPECT_DOUBLE_EQ(mean(v), 4.0);
  EXPECT_NEAR(standardDeviation(v), std::sqrt(38.0 / 3.0), 1e-12);
  EXPECT_DOUBLE_EQ(median(v), 3.0);
  EXPECT_DOUBLE_EQ(quantile(v, 1.0), 9.0);
  EXPECT_NEAR(robustSigma(v), 1.4826022185056018 * 1.5, 1e-12);  // deviations 2, 1, 1, 6: median 1.5
  const std::vector<double> d{-3.0, 1.0, 2.5};
  EXPECT_DOUBLE_EQ(peakToPeak(d), 5.5);
}

TEST(Statistics, FitPercentIsThatOfP2) {
  const std::vector<double> m{0.0, 1.0, 2.0, 3.0};
  EXPECT_DOUBLE_EQ(fitPercent(m, m), 100.0);
  EXPECT_NEAR(fitPercent(m, std::vector<double>(4, 1.5)), 0.0, 1e-12);  // the mean explains nothing
  EXPECT_TRUE(std::isinf(fitPercent(std::vector<double>(3, 1.0), std::vector<double>(3, 2.0))));
}

TEST(Statistics, WilsonIntervalKnownCase) {
  const RateInterval interval = wilsonInterval(8, 10);
  EXPECT_NEAR(interval.low, 0.4901625, 1e-6);
  EXPECT_NEAR(interval.high, 0.9433178, 1e-6);
  EXPECT_EQ(wilsonInterval(0, 0).high, 1.0);
}

}  // namespace
}  // namespace spindrift
