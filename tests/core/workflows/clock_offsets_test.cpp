// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/workflows/clock_offsets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/error.h"
#include "core/base/random.h"

namespace spindrift {
namespace {

struct Record {
  std::vector<double> time_s;
  std::vector<double> value;
};

/// A table that is driven to three places, seen at `period_s` by a clock that is `late_s` behind.
Record motion(double period_s, double late_s, double noise, std::uint64_t seed) {
  Random random(seed);
  Record r;
  for (double t = 0.0; t < 300.0; t += period_s) {
    const double x = t < 60.0 ? 0.0 : t < 70.0 ? 12.0 * (t - 60.0) : t < 170.0 ? 120.0 : t < 230.0 ? 40.0 : 0.0;
    r.time_s.push_back(t - late_s);
    r.value.push_back(x + random.normal(0.0, noise));
  }
  return r;
}

TEST(CampaignClockOffset, IsFoundFromACommonMotionWithinItsUncertainty) {
  const Record reference = motion(1.0, 0.0, 0.0, 1);
  int inside = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const double late = -20.0 + static_cast<double>(seed) * 1.03;
    const Record source = motion(0.7, late, 2.0, seed);
    const OffsetEstimate e = estimateClockOffset(reference.time_s, reference.value, source.time_s, source.value, 60.0);
    EXPECT_NEAR(e.offset_s, late, 0.8);
    EXPECT_GT(e.correlation, 0.95);
    inside += std::abs(e.offset_s - late) <= 2.0 * e.sigma_s;
  }
  EXPECT_GE(inside, 34);
}

TEST(CampaignClockOffset, RefusesWhatShowsNoEvent) {
  const Record reference = motion(1.0, 0.0, 0.0, 1);
  const Record still{{0.0, 1.0, 2.0, 3.0, 4.0}, {5.0, 5.0, 5.0, 5.0, 5.0}};
  EXPECT_THROW(
      static_cast<void>(estimateClockOffset(reference.time_s, reference.value, still.time_s, still.value, 60.0)),
      InputError);
  Record noise = motion(1.0, 0.0, 0.0, 1);
  Random random(3);
  for (double& v : noise.value) v = random.normal(0.0, 1.0);
  EXPECT_THROW(
      static_cast<void>(estimateClockOffset(reference.time_s, reference.value, noise.time_s, noise.value, 60.0)),
      InputError);
}

TEST(CampaignClockOffset, MovesLogAndObservationsAndSurvivesTheSession) {
  Campaign c;
  c.log = OperatingLog({0.0, 100.0});
  c.log.edit().setSignal("spindle_rpm", {0.0, 3000.0});
  c.observations.emplace();
  Observation o;
  o.time_s = 50.0;
  o.instrument = "probe";
  c.observations.edit().rows = {o};
  const ClockOffsets offsets = clockOffsetsFrom(toJson(
      {{"log", {7.5, 0.2, "entered"}}, {"probe", {-3.0, 0.1, "motion of X"}}, {"camera", {1.0, 0.0, "entered"}}}));
  EXPECT_EQ(offsets.at("probe").how, "motion of X");
  applyClockOffsets(c, offsets);
  EXPECT_EQ(c.log->time_s()[1], 107.5);
  EXPECT_EQ(c.log->at("spindle_rpm", 106.0), 0.0);
  EXPECT_EQ(c.observations->rows[0].time_s, 47.0);
  EXPECT_THROW(static_cast<void>(clockOffsetsFrom({{"log", {{"offset_s", "late"}}}})), InputError);
}

}  // namespace
}  // namespace spindrift
