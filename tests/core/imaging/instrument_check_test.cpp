// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/imaging/jog_validation.h"
#include "core/imaging/warm_up.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

/// One point every 5 min for `minutes`, approaching its end value with 25 min.
ObservationSet warmUp(Random& random, double minutes) {
  ObservationSet set;
  constexpr std::array<double, 3> amplitude{10.0, 25.0, 20.0};
  for (double t = 0.0; t <= minutes; t += 5.0) {
    for (std::size_t k = 0; k < 3; ++k) {
      Observation o;
      o.time_s = t * 60.0;
      o.state = "W" + std::to_string(static_cast<int>(t));
      o.point = "F1";
      o.component = all_components[k];
      o.value = amplitude[k] * (1.0 - std::exp(-t / 25.0)) + random.normal(0, 0.15);
      o.sigma = 0.2;
      set.rows.push_back(o);
    }
  }
  return set;
}

TEST(WarmUp, SaysNotSettledWhileItDrifts) {
  Random random(1);
  const WarmUpResult result = judgeWarmUp(warmUp(random, 45.0), "");
  EXPECT_EQ(result.point, "F1");
  EXPECT_FALSE(result.settled);
  EXPECT_THAT(result.reason, HasSubstr("Not settled"));
  EXPECT_THAT(result.reason, HasSubstr("EY"));
}

TEST(WarmUp, SaysSettledAfterwardsWithTheTimeConstant) {
  Random random(2);
  const WarmUpResult result = judgeWarmUp(warmUp(random, 240.0), "F1");
  EXPECT_TRUE(result.settled) << result.reason;
  for (const WarmUpAxis& axis : result.axes) {
    ASSERT_TRUE(axis.tau_s.has_value());
    EXPECT_NEAR(*axis.tau_s / 60.0, 25.0, 2.5);
    EXPECT_GT(*axis.settled_after_s, 70.0 * 60.0);
  }
  EXPECT_NEAR(result.axes[1].total_um, 25.0, 1.0);
}

TEST(WarmUp, DriftUncertaintyHolds) {
  Random random(3);
  int inside = 0;
  constexpr int runs = 500;
  for (int n = 0; n < runs; ++n) {
    ObservationSet set;
    for (int i = 0; i < 24; ++i) {
      Observation o;
      o.time_s = 300.0 * i;
      o.state = std::to_string(i);
      o.point = "F1";
      o.value = 2.0 * o.time_s / 3600.0 + random.normal(0, 0.2);
      o.sigma = 0.2 * (i == 0 ? 1.0 : std::sqrt(2.0));
      set.rows.push_back(o);
    }
    const WarmUpAxis axis = judgeWarmUp(set, "F1").axes[0];
    inside += std::abs(axis.drift_um_per_h - 2.0) < 1.96 * axis.drift_sigma_um_per_h ? 1 : 0;
  }
  EXPECT_GT(inside, 0.92 * runs);
}

TEST(WarmUp, DriftOfAnApproachHoldsAndIsKnownBetterThanThatOfALine) {
  Random random(5);
  int inside = 0, runs = 0;
  double sigma = 0.0;
  for (int n = 0; n < 300; ++n) {
    const WarmUpResult result = judgeWarmUp(warmUp(random, 120.0), "F1");
    const std::array<double, 3> amplitude{10.0, 25.0, 20.0};
    for (std::size_t k = 0; k < 3; ++k) {
      const double truth = amplitude[k] / 25.0 * std::exp(-120.0 / 25.0) * 60.0;  // um/h
      const WarmUpAxis& axis = result.axes[k];
      inside += std::abs(axis.drift_um_per_h - truth) < 1.96 * axis.drift_sigma_um_per_h ? 1 : 0;
      sigma += axis.drift_sigma_um_per_h;
      ++runs;
    }
  }
  EXPECT_GT(inside, 0.92 * runs);
  // A line through the last 40 min of nine readings with 0.14 um: 0.14 / (0.215 h sqrt(9)).
  EXPECT_LT(sigma / runs, 0.5 * 0.14 / (0.215 * 3.0));
}

TEST(WarmUp, ASeriesThatIsNoApproachIsJudgedByItsEnd) {
  Random random(6);
  ObservationSet set = warmUp(random, 120.0);
  for (Observation& o : set.rows) o.value += 4.0 * std::sin(o.time_s / 900.0);  // a machine at work
  const WarmUpAxis axis = judgeWarmUp(set, "F1").axes[0];
  EXPECT_GT(axis.drift_sigma_um_per_h, 0.5) << "nobody knows its drift to hundredths of a micrometre per hour";
}

/// EX of one point every 5 min; `value` of the minute in um, with noise of 0.15 um.
template <typename Value>
WarmUpAxis seen(Random& random, double minutes, Value value) {
  ObservationSet set;
  for (double t = 0.0; t <= minutes; t += 5.0) {
    Observation o;
    o.time_s = t * 60.0;
    o.state = "W" + std::to_string(static_cast<int>(t));
    o.point = "F1";
    o.value = value(t) + random.normal(0, 0.15);
    o.sigma = 0.2;
    set.rows.push_back(o);
  }
  return judgeWarmUp(set, "F1").axes[0];
}

TEST(WarmUp, ATimeConstantBeyondTheRecordIsNoResult) {
  Random random(11);
  for (const double tau_min : {600.0, 1.0e6}) {  // as good as a straight line: its fit ends at the bound of the search
    const WarmUpAxis axis =
        seen(random, 240.0, [&](double t) { return 3.0 / 60.0 * tau_min * -std::expm1(-t / tau_min); });
    EXPECT_EQ(axis.verdict, WarmUpVerdict::Drifts);
    EXPECT_EQ(axis.time_constant, TimeConstant::BeyondRecord);
    EXPECT_FALSE(axis.tau_s.has_value());
    EXPECT_FALSE(axis.settled_after_s.has_value()) << "nobody saw it settle";
  }
}

TEST(WarmUp, ATimeConstantAtTheLowerBoundIsNoResult) {
  Random random(12);
  const WarmUpAxis axis = seen(random, 600.0, [](double t) { return t > 0.0 ? 20.0 : 0.0; });
  EXPECT_EQ(axis.time_constant, TimeConstant::TooShort);
  EXPECT_FALSE(axis.tau_s.has_value());
}

TEST(WarmUp, AnAxisThatHasNotSettledHasNoTimeAtWhichItSettled) {
  Random random(13);
  const WarmUpAxis axis = seen(random, 60.0, [](double t) { return 20.0 * -std::expm1(-t / 25.0); });
  EXPECT_NE(axis.verdict, WarmUpVerdict::Settled);
  EXPECT_EQ(axis.time_constant, TimeConstant::Determined);
  EXPECT_FALSE(axis.settled_after_s.has_value());
}

TEST(WarmUp, NoDriftIsKnownBetterThanTheSlopeOfTheWholeSeries) {
  Random random(14);
  const WarmUpAxis axis = seen(random, 240.0, [](double t) { return 5.0 * -std::expm1(-t / 10.0); });
  EXPECT_EQ(axis.verdict, WarmUpVerdict::Settled);
  // 49 readings of 0.14 um over 4 h: 0.14 / (4 h sqrt(49 / 12)).
  EXPECT_GT(axis.drift_sigma_um_per_h, 0.9 * 0.14 / (4.0 * std::sqrt(49.0 / 12.0)));
}

TEST(WarmUp, AnAxisIsSettledDriftsOrCannotBeDecided) {
  EXPECT_EQ(warmUpVerdict(-0.3, 0.3, 1.0), WarmUpVerdict::Settled);
  EXPECT_EQ(warmUpVerdict(-0.3, 0.8, 1.0), WarmUpVerdict::NotDecidable);
  EXPECT_EQ(warmUpVerdict(2.8, 0.8, 1.0), WarmUpVerdict::Drifts);
  EXPECT_EQ(warmUpVerdict(std::nan(""), 0.8, 1.0), WarmUpVerdict::NotDecidable);
  // Both kinds are named.
  Random random(15);
  ObservationSet set = warmUp(random, 45.0);
  for (Observation& o : set.rows)
    if (o.component == Component::EX) o.value = random.normal(0, 3.0);
  const WarmUpResult result = judgeWarmUp(set, "");
  EXPECT_EQ(result.axes[0].verdict, WarmUpVerdict::NotDecidable);
  EXPECT_THAT(result.reason, ::testing::MatchesRegex("Not settled: .*EY.* and EZ.*[.] Not decidable yet: EX .*[.]"));
}

TEST(WarmUp, TooFewMeasurementsAndUnknownPoint) {
  Random random(4);
  EXPECT_EQ(judgeWarmUp(warmUp(random, 10.0), "F1").status, FitStatus::Degenerate);
  EXPECT_THROW((void)judgeWarmUp(warmUp(random, 60.0), "F9"), InputError);
}

ObservationSet states(double largest) {
  ObservationSet set;
  for (int s = 0; s < 6; ++s) {
    for (const Component c : {Component::EX, Component::EY, Component::EZ}) {
      Observation o;
      o.time_s = 100.0 * s;
      o.state = "J" + std::to_string(s);
      o.point = "F1";
      o.component = c;
      o.value = s == 3 && c == Component::EY ? largest : 0.1 * s;
      o.sigma = 0.3;
      set.rows.push_back(o);
    }
  }
  return set;
}

MachineDescription machineWithResolution() {
  MachineDescription machine;
  for (const char* name : {"X", "Y", "Z"}) {
    LinearAxis axis;
    axis.name = name;
    axis.resolution_um = 5.08;
    machine.axes.push_back(axis);
  }
  return machine;
}

TEST(ResolutionCheck, VerdictPerAxis) {
  const MachineDescription machine = machineWithResolution();
  EXPECT_TRUE(checkAgainstResolution(states(2.4), machine, 1.0).passed);
  EXPECT_TRUE(checkAgainstResolution(states(2.4), machine, 0.5).passed);
  const ResolutionCheck jogs = checkAgainstResolution(states(-6.0), machine, 1.0);
  EXPECT_FALSE(jogs.passed);
  EXPECT_THAT(jogs.reason, HasSubstr("EY is off by 6.0 µm at F1 in state J3"));
  EXPECT_TRUE(jogs.axes[0].passed);
  EXPECT_FALSE(jogs.axes[1].passed);
  EXPECT_FALSE(checkAgainstResolution(states(3.0), machine, 0.5).passed);
}

TEST(ResolutionCheck, NeedsStatesAndResolution) {
  ObservationSet one = states(0.0);
  std::erase_if(one.rows, [](const Observation& o) { return o.state != "J0"; });
  EXPECT_EQ(checkAgainstResolution(one, machineWithResolution(), 1.0).status, FitStatus::Degenerate);
  EXPECT_THROW((void)checkAgainstResolution(states(0.0), MachineDescription{}, 1.0), InputError);
}

OperatingLog logOf(double spindle_rpm, double warmer_K) {
  std::vector<double> time, speed, temperature;
  for (double t = -600.0; t <= 9000.0; t += 60.0) {
    time.push_back(t);
    speed.push_back(t > 600.0 ? spindle_rpm : 0.0);
    temperature.push_back(20.0 + warmer_K * std::max(0.0, t) / 9000.0);
  }
  OperatingLog log(time);
  log.setSignal("spindle_rpm", speed);
  log.setSignal("T_column_degC", temperature);
  return log;
}

TEST(WarmUp, TellsTheInstrumentFromTheMachineOrSaysThatItCannot) {
  Random random(8);
  const ObservationSet drifting = warmUp(random, 45.0);
  const OperatingLog rest = logOf(0.0, 0.2);
  const WarmUpResult instrument = judgeWarmUp(drifting, "", {}, &rest);
  EXPECT_FALSE(instrument.settled);
  EXPECT_EQ(instrument.cause, WarmUpCause::Instrument);
  EXPECT_THAT(instrument.cause_reason, HasSubstr("that of the instrument"));
  const OperatingLog work = logOf(3000.0, 8.0);
  const WarmUpResult unknown = judgeWarmUp(drifting, "", {}, &work);
  EXPECT_EQ(unknown.cause, WarmUpCause::Unknown);
  EXPECT_THAT(unknown.cause_reason, HasSubstr("at work (spindle speed)"));
  EXPECT_THAT(unknown.cause_reason, HasSubstr("cannot be separated"));
  const OperatingLog warm = logOf(0.0, 8.0);
  EXPECT_THAT(judgeWarmUp(drifting, "", {}, &warm).cause_reason,
              HasSubstr("temperatures changed (temperature of column by 2.4 K)"));
  EXPECT_THAT(judgeWarmUp(drifting, "", {}, nullptr).cause_reason, HasSubstr("Without a log"));
  // The largest changes are told, and the last row holds until the next one would have come.
  double end = 0.0;
  for (const WarmUpAxis& axis : unknown.axes) end = std::max(end, axis.time_s.empty() ? 0.0 : axis.time_s.back());
  OperatingLog several({0.0, end - 60.0, end - 30.0});
  several.setSignal("spindle_rpm", {0.0, 0.0, 0.0});
  for (const auto& [name, change] :
       {std::pair{"T_a_degC", 1.5}, {"T_b_degC", 2.5}, {"T_c_degC", 9.0}, {"T_d_degC", 3.5}})
    several.setSignal(name, {20.0, 20.0 + change, 20.0 + change});
  EXPECT_THAT(
      judgeWarmUp(drifting, "", {}, &several).cause_reason,
      HasSubstr("temperatures changed (temperature of C by 9.0 K, temperature of D by 3.5 K and temperature of B "
                "by 2.5 K)"));
  OperatingLog temperatures_only({-600.0, 9000.0});
  temperatures_only.setSignal("T_column_degC", {20.0, 20.1});
  EXPECT_EQ(judgeWarmUp(drifting, "", {}, &temperatures_only).cause, WarmUpCause::Unknown);
  // What has settled leaves nothing to tell apart.
  const WarmUpResult settled = judgeWarmUp(warmUp(random, 240.0), "", {}, &work);
  EXPECT_TRUE(settled.settled);
  EXPECT_EQ(settled.cause_reason, "");
}

}  // namespace
}  // namespace spindrift
