// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spindrift {
namespace {

TEST(Random, SameSeedSameNumbersOtherSeedOthers) {
  Random a(7);
  Random b(7);
  Random c(8);
  bool differs = false;
  for (int i = 0; i < 100; ++i) {
    const auto word = a.bits();
    EXPECT_EQ(word, b.bits());
    differs = differs || word != c.bits();
  }
  EXPECT_TRUE(differs);
}

TEST(Random, NormalHasTheMomentsOfANormal) {
  Random random(1);
  constexpr int n = 200000;
  double m1 = 0.0;
  double m2 = 0.0;
  double m4 = 0.0;
  for (int i = 0; i < n; ++i) {
    const double z = random.normal();
    m1 += z;
    m2 += z * z;
    m4 += z * z * z * z;
  }
  EXPECT_NEAR(m1 / n, 0.0, 5.0 / std::sqrt(n));
  EXPECT_NEAR(m2 / n, 1.0, 5.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(m4 / n, 3.0, 5.0 * std::sqrt(96.0 / n));
}

TEST(Random, UniformAndIndexStayInside) {
  Random random(2);
  int seen[5] = {};
  for (int i = 0; i < 10000; ++i) {
    const double u = random.uniform(-2.0, 3.0);
    EXPECT_GE(u, -2.0);
    EXPECT_LT(u, 3.0);
    ++seen[random.index(5)];
  }
  for (const int count : seen) EXPECT_NEAR(count, 2000, 250);
}

}  // namespace
}  // namespace spindrift
