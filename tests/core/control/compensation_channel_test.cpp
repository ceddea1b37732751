// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/control/compensation_channel.h"

#include <gmock/gmock.h>

#include <limits>

#include "core/base/error.h"

namespace spindrift::testing {
namespace {

using ::testing::HasSubstr;

ControlState ready() {
  ControlState state;
  state.condition = ControlState::Condition::Ready;
  return state;
}

CompensationChannel::Wish wish(double z_um, double age_s = 1.0) {
  CompensationChannel::Wish w;
  w.offset_um.z() = z_um;
  w.age_s = age_s;
  return w;
}

TEST(Channel, NeitherRateNorStepNorLimitAreExceeded) {
  ChannelLimits limits;
  limits.limit_um = 30.0;
  limits.rate_um_s = 0.2;
  limits.step_um = 4.0;
  CompensationChannel channel(limits);
  channel.begin(Eigen::Vector3d::Zero(), 0.0);
  EXPECT_NEAR(channel.next(wish(100.0), ready(), 10.0).z(), 2.0, 1e-12);
  EXPECT_NEAR(channel.next(wish(100.0), ready(), 1010.0).z(), 6.0, 1e-12);  // the time was long, the step is not
  EXPECT_NEAR(channel.next(wish(100.0), ready(), 1000.0).z(), 6.0, 1e-12);  // a clock that runs backwards
  double t = 1010.0;
  for (int i = 0; i < 100; ++i) (void)channel.next(wish(100.0), ready(), t += 5.0);
  EXPECT_NEAR(channel.written_um().z(), 30.0, 1e-9);
  EXPECT_LE(channel.largestStep_um(), 4.0);
  EXPECT_LE(channel.largestRate_um_s(), 0.2 + 1e-12);
}

TEST(Channel, FadesWhileTheControlIsNotThereAndReturns) {
  CompensationChannel channel({});
  channel.begin({0.0, 0.0, 10.0}, 0.0);
  ControlState off;
  off.condition = ControlState::Condition::Off;
  off.sentence = "The machine is off: switch it on.";
  EXPECT_NEAR(channel.next(wish(10.0), off, 10.0).z(), 8.0, 1e-12);
  EXPECT_THAT(channel.sentence(), HasSubstr("machine is off"));
  EXPECT_FALSE(channel.active());
  EXPECT_NEAR(channel.next(wish(10.0), ready(), 15.0).z(), 9.0, 1e-12);
  EXPECT_THAT(channel.sentence(), HasSubstr("active: X +0.0, Y +0.0, Z +9.0 µm; inputs 1 s old"));
}

TEST(Channel, OldInputsAndNoNumbersAreNotApplied) {
  CompensationChannel channel({});
  channel.begin({0.0, 0.0, 1.0}, 0.0);
  EXPECT_NEAR(channel.next(wish(50.0, 61.0), ready(), 10.0).z(), 0.0, 1e-12);
  EXPECT_THAT(channel.reason(), HasSubstr("61 s old; allowed: 60 s"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(channel.next(wish(nan), ready(), 20.0).z(), 0.0);
  EXPECT_THAT(channel.reason(), HasSubstr("not a number"));
  EXPECT_EQ(channel.next(wish(50.0, nan), ready(), 30.0).z(), 0.0);
  EXPECT_FALSE(channel.active());
}

TEST(Channel, SaysHowSureWhereSomebodyKnowsAndWhyItIsRefused) {
  CompensationChannel channel({});
  channel.begin({0.0, 0.0, 9.0}, 0.0);
  CompensationChannel::Wish w = wish(9.0);
  w.sigma_um.z() = 0.84;
  (void)channel.next(w, ready(), 10.0);
  EXPECT_THAT(channel.sentence(), HasSubstr("X +0.0, Y +0.0, Z +9.0 ± 0.8 µm"));
  w.refused = "the machine was homed anew";
  EXPECT_NEAR(channel.next(w, ready(), 15.0).z(), 8.0, 1e-12);
  EXPECT_FALSE(channel.active());
  EXPECT_THAT(channel.sentence(), HasSubstr("off, fading from X +0.0, Y +0.0, Z +8.0 µm: the machine was homed anew"));
}

TEST(Channel, LimitsHaveToBeAboveZero) {
  ChannelLimits limits;
  limits.rate_um_s = 0.0;
  EXPECT_THROW(CompensationChannel{limits}, InputError);
}

}  // namespace
}  // namespace spindrift::testing
