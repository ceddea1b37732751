// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/connect/source_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"

namespace spindrift::testing {
namespace {

TEST(SourceClock, OffsetIsFoundBelowRandomDelays) {
  Random random(7);
  SourceClock clock;
  for (int i = 0; i < 600; ++i) {
    const double held = 1000.0 + i;
    const double received = held + 0.01 + random.uniform(0.0, 2.0);
    const double local = clock.toLocal(held + 37.0, received);
    if (i > 100) {
      EXPECT_NEAR(local, held, 0.12);
      EXPECT_LE(local, received);
    }
  }
  EXPECT_NEAR(clock.offset_s(), 37.0, 0.12);
  EXPECT_EQ(clock.steps(), 0);
}

TEST(SourceClock, AClockThatIsSetIsFollowedAtOnce) {
  for (const double step : {3600.0, -3600.0}) {
    SourceClock clock;
    for (int i = 0; i < 300; ++i) {
      const double held = 1e9 + i;
      const double set = i < 150 ? 0.0 : step;
      EXPECT_NEAR(clock.toLocal(held + set, held + 0.05), held, 0.06) << i;
    }
    EXPECT_EQ(clock.steps(), 1);
    EXPECT_NEAR(clock.offset_s(), step, 0.06);
  }
}

TEST(SourceClock, APausedNetworkIsNoStep) {
  SourceClock clock;
  for (int i = 0; i < 200; ++i) {
    const double held = 5000.0 + i;
    // From 100 to 160 everything waits and comes at once.
    const double received = i >= 100 && i < 160 ? 5160.0 : held + 0.02;
    EXPECT_NEAR(clock.toLocal(held, received), held, 0.03) << i;
  }
  EXPECT_EQ(clock.steps(), 0);
}

TEST(SourceClock, ADriftIsFollowed) {
  SourceClock clock;
  double worst = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double held = 1e6 + i;
    worst = std::max(worst, std::abs(clock.toLocal(held - 1e-4 * i, held + 0.01) - held));
  }
  EXPECT_LT(worst, 0.03);
  EXPECT_EQ(clock.steps(), 0);
}

TEST(SourceClock, WithoutStampsTheTimeIsThatOfReception) {
  SourceClock clock;
  EXPECT_EQ(clock.toLocal(std::nan(""), 12.0), 12.0);
  EXPECT_TRUE(std::isnan(clock.offset_s()));
}

}  // namespace
}  // namespace spindrift::testing
