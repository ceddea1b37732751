// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/thermal/compensator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/base/json_reader.h"
#include "core/thermal/compensator_c.h"
#include "core/thermal/thermal_model.h"
#include "tests/support/refusal.h"
#include "tests/support/temp_folder.h"

extern "C" int compensate_one_minute(const char* model_file, double temperature_degC, double* compensation);

namespace spindrift {
namespace {

using ::testing::HasSubstr;

ThermalModel model() {
  ThermalModel m;
  m.inputs = {{"spindle_rpm", SignalKind::Speed, 1.5, 4000.0, 0.2, 0.0, 4000.0},
              {"T_1_degC", SignalKind::Temperature, 1.0, 1.0, 22.0, 20.0, 30.0}};
  ThermalOutput o;
  o.name = "ez_um";
  o.unit = "um";
  o.offset = 1.0;
  o.terms = {{0, 600.0, 10.0}, {1, 2000.0, -4.0}, {1, 0.0, 0.5}};
  m.outputs = {o};
  return m;
}

/// Heat has no direction: a spindle that turns the other way warms all the same.
TEST(Compensator, ASpindleThatTurnsBackwardsWarmsAsWell) {
  for (const double rpm : {-3000.0, -500.0}) {
    Compensator forwards;
    Compensator backwards;
    ASSERT_EQ(forwards.load(model(), 1.0), "");
    ASSERT_EQ(backwards.load(model(), 1.0), "");
    for (int k = 0; k < 900; ++k) {
      double there = 0.0;
      double back = 0.0;
      const double u[2] = {k < 5 ? 0.0 : -rpm, 22.0};
      const double v[2] = {k < 5 ? 0.0 : rpm, 22.0};
      forwards.step(u, nullptr, &there);
      EXPECT_EQ(backwards.step(v, nullptr, &back), CompensatorState::Running);
      EXPECT_EQ(there, back);
    }
  }
  TimeSeries series;
  for (int k = 0; k < 50; ++k) series.time_s.push_back(60.0 * k);
  series.signals = {{"spindle_rpm", SignalKind::Speed, std::vector<double>(50, 2000.0)},
                    {"T_1_degC", SignalKind::Temperature, std::vector<double>(50, 22.0)}};
  const std::vector<double> forwards = model().predict(series, 0).value;
  for (double& v : series.signals[0].values) v = -v;
  const ThermalPrediction backwards = model().predict(series, 0);
  EXPECT_EQ(backwards.value, forwards);
  EXPECT_TRUE(std::none_of(backwards.outside.begin(), backwards.outside.end(), [](char o) { return o != 0; }));
}

/// A plug that was out for two hours: what the temperature did meanwhile is behind its lags when it is back.
TEST(Compensator, AnInputThatComesBackHasMovedInTheMeantime) {
  const auto temperature = [](double t_s) { return 22.0 + 5.0 * (1.0 - std::exp(-t_s / 7000.0)); };
  Compensator whole;
  Compensator gap;
  ASSERT_EQ(whole.load(model(), 10.0), "");
  ASSERT_EQ(gap.load(model(), 10.0), "");
  double worst = 0.0;
  double without = 0.0;
  for (int k = 0; k < 1440; ++k) {
    const double t_s = 10.0 * k;
    const bool out = t_s > 3000.0 && t_s < 10000.0;
    const double u[2] = {1500.0, temperature(t_s)};
    const double v[2] = {1500.0, out ? std::nan("") : temperature(t_s)};
    double right = 0.0;
    double held = 0.0;
    whole.step(u, nullptr, &right);
    gap.step(v, nullptr, &held);
    if (t_s < 10100.0) continue;
    worst = std::max(worst, std::abs(right - held));
    without = std::max(
        without, 4.0 * std::abs(temperature(10000.0) - temperature(3000.0)) * std::exp(-(t_s - 10000.0) / 2000.0));
  }
  EXPECT_LT(worst, 0.1 * without) << "um of " << without;
}

/// A loose plug: one good value in 55 cycles, each held for up to 60 s.
TEST(Compensator, StaysInFallbackUntilNothingIsRefusedAnyMore) {
  Compensator c;
  CompensatorLimits limits;
  limits.stale_after_s = 60.0;
  limits.recover_after_s = 10.0;
  ASSERT_EQ(c.load(model(), 1.0, limits), "");
  const double good[2] = {4000.0, 25.0};
  const double bad[2] = {4000.0, std::numeric_limits<double>::quiet_NaN()};
  double out = 0.0;
  for (int k = 0; k < 100; ++k) (void)c.step(good, nullptr, &out);
  ASSERT_GT(std::abs(out), 1.0);
  for (int k = 0; k < 200; ++k) (void)c.step(bad, nullptr, &out);
  ASSERT_EQ(c.state(), CompensatorState::Fallback);
  for (int k = 0; k < 2000; ++k) {
    (void)c.step(k % 55 == 0 ? good : bad, nullptr, &out);
    ASSERT_EQ(c.state(), CompensatorState::Fallback) << k;
    ASSERT_EQ(out, 0.0) << k;
  }
  // A single refused value while it recovers begins the time anew.
  for (int k = 0; k < 8; ++k) EXPECT_EQ(c.step(good, nullptr, &out), CompensatorState::Fallback) << k;
  EXPECT_EQ(c.step(bad, nullptr, &out), CompensatorState::Fallback);
  for (int k = 0; k < 9; ++k) EXPECT_EQ(c.step(good, nullptr, &out), CompensatorState::Fallback) << k;
  EXPECT_EQ(c.step(good, nullptr, &out), CompensatorState::Running);
  // Outside fall-back the same values are held, as ever.
  for (int k = 0; k < 500; ++k) {
    (void)c.step(k % 55 == 0 ? good : bad, nullptr, &out);
    ASSERT_NE(c.state(), CompensatorState::Fallback) << k;
  }
}

/// Back at once is not "never gone".
TEST(Compensator, FadesAlsoWithoutATimeToRecover) {
  Compensator c;
  CompensatorLimits limits;
  limits.recover_after_s = 0.0;
  ASSERT_EQ(c.load(model(), 1.0, limits), "");
  const double good[2] = {4000.0, 25.0};
  double out = 0.0;
  for (int k = 0; k < 100; ++k) (void)c.step(good, nullptr, &out);
  ASSERT_GT(std::abs(out), 1.0);
  for (int k = 0; k < 300; ++k) (void)c.step(nullptr, nullptr, &out);
  EXPECT_EQ(c.state(), CompensatorState::Fallback);
  EXPECT_EQ(out, 0.0);
  EXPECT_EQ(c.step(good, nullptr, &out), CompensatorState::Running);
}

TEST(Compensator, AResetNeitherJumpsNorForgetsWhatWasMeasured) {
  Compensator c;
  CompensatorLimits limits;
  limits.slew_per_s = 0.5;
  ASSERT_EQ(c.load(model(), 1.0, limits), "");
  const double input[2] = {4000.0, 25.0};
  double out = 0.0;
  for (int k = 0; k < 3000; ++k) (void)c.step(input, nullptr, &out);
  ASSERT_TRUE(c.update(0, 1.0, 3.0));
  for (int k = 0; k < 3000; ++k) (void)c.step(input, nullptr, &out);
  const double settled = out;
  c.reset();
  (void)c.step(input, nullptr, &out);
  EXPECT_NEAR(out, settled, 1e-6);  // at rest at the same inputs, and the correction is still there
  c.reset();
  double before = out;
  for (int k = 0; k < 100; ++k, before = out) {
    (void)c.step(nullptr, nullptr, &out);
    EXPECT_LE(std::abs(out - before), 0.5 + 1e-12);
  }
  EXPECT_EQ(out, 0.0);
  EXPECT_EQ(c.state(), CompensatorState::Fallback);
}

TEST(Compensator, EqualsMinusTheModelsPrediction) {
  TimeSeries s;
  std::vector<double> rpm;
  std::vector<double> t;
  for (int k = 0; k < 4000; ++k) {
    s.time_s.push_back(k);
    rpm.push_back(k < 1000 ? 0.0 : 3000.0);
    t.push_back(22.0 + 2.0 * std::sin(k / 700.0));
  }
  s.signals = {{"spindle_rpm", SignalKind::Speed, rpm}, {"T_1_degC", SignalKind::Temperature, t}};
  const ThermalPrediction expected = model().predict(s, 0);
  Compensator c;
  CompensatorLimits limits;
  limits.slew_per_s = 1e6;
  ASSERT_EQ(c.load(model(), 1.0, limits), "");
  ASSERT_STREQ(c.inputName(0), "spindle_rpm");
  for (int k = 0; k < 4000; ++k) {
    const double u[2] = {rpm[k], t[k]};
    double out = 0.0;
    EXPECT_EQ(c.step(u, nullptr, &out), CompensatorState::Running);
    EXPECT_NEAR(out, -expected.value[k], 1e-9);
  }
}

TEST(Compensator, BoundsOutputAndSlew) {
  Compensator c;
  CompensatorLimits limits;
  limits.limit = 3.0;
  limits.slew_per_s = 0.5;
  ASSERT_EQ(c.load(model(), 0.1, limits), "");
  double last = 0.0;
  double out = 0.0;
  for (int k = 0; k < 100000; ++k) {
    const double u[2] = {4000.0, 22.0};
    c.step(u, nullptr, &out);
    EXPECT_LE(std::abs(out - last), 0.05 + 1e-12);
    EXPECT_LE(std::abs(out), 3.0);
    last = out;
  }
  EXPECT_DOUBLE_EQ(out, -3.0);
}

TEST(Compensator, FallsBackSafelyAndComesBack) {
  Compensator c;
  CompensatorLimits limits;
  limits.slew_per_s = 0.5;
  limits.stale_after_s = 30.0;
  limits.recover_after_s = 20.0;
  ASSERT_EQ(c.load(model(), 1.0, limits), "");
  double out = 0.0;
  const double good[2] = {3000.0, 24.0};
  for (int k = 0; k < 3000; ++k) c.step(good, nullptr, &out);
  const double level = out;
  // -(1 + 10 (0.75^1.5 - 0.2) - 4 * 2 + 0.5 * 2)
  EXPECT_NEAR(level, 1.505, 0.05);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {nan, std::numeric_limits<double>::infinity(), 295.0, -300.0}) {
    const double u[2] = {3000.0, bad};
    EXPECT_EQ(c.step(u, nullptr, &out), CompensatorState::Holding);
    EXPECT_EQ(c.refusedInput(), 1);
    EXPECT_NEAR(out, level, 0.2);
  }
  const double u[2] = {3000.0, nan};
  for (int k = 0; k < 200; ++k) c.step(u, nullptr, &out);
  EXPECT_EQ(c.state(), CompensatorState::Fallback);
  EXPECT_DOUBLE_EQ(out, 0.0);
  for (int k = 0; k < 200; ++k) c.step(good, nullptr, &out);
  EXPECT_EQ(c.state(), CompensatorState::Running);
  EXPECT_NEAR(out, level, 1.5);
  // Stale: the value is plausible but old.
  const double age[2] = {0.0, 31.0};
  c.step(good, age, &out);
  EXPECT_EQ(c.state(), CompensatorState::Fallback);
}

TEST(Compensator, IsZeroUntilAllInputsWereGoodOnce) {
  Compensator c;
  double out = 7.0;
  const double bad[2] = {0.0, std::numeric_limits<double>::quiet_NaN()};
  c.step(bad, nullptr, &out);
  EXPECT_EQ(c.state(), CompensatorState::Empty);
  ASSERT_EQ(c.load(model(), 1.0), "");
  EXPECT_EQ(c.step(bad, nullptr, &out), CompensatorState::Fallback);
  EXPECT_EQ(out, 0.0);
  EXPECT_THAT(c.load(model(), 0.0), HasSubstr("cycle"));
  ThermalModel large = model();
  large.outputs.front().terms.assign(2000, {0, 1.0, 1.0});
  EXPECT_THAT(c.load(large, 1.0), HasSubstr("1024"));
}

TEST(Compensator, RefusesWhatMustNotRunOnAMachine) {
  Compensator c;
  ThermalModel rejected = model();
  rejected.outputs.front().verdict = ThermalVerdict{false, 0.0, 1.0, 2.0, "no better than a straight line"};
  EXPECT_THAT(c.load(rejected, 1.0), HasSubstr("not good enough (no better than a straight line)"));
  EXPECT_EQ(c.state(), CompensatorState::Empty);
  CompensatorLimits forced;
  forced.forced = true;
  ASSERT_EQ(c.load(rejected, 1.0, forced), "");
  EXPECT_TRUE(c.status().forced);
  ASSERT_EQ(c.load(model(), 1.0, forced), "");
  EXPECT_FALSE(c.status().forced);
  const auto complaint = [&](const std::function<void(ThermalModel&)>& spoil) {
    ThermalModel m = model();
    spoil(m);
    return c.load(m, 1.0, forced);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(complaint([](ThermalModel& m) { m.outputs[0].terms.clear(); }), HasSubstr("has no terms"));
  EXPECT_THAT(complaint([](ThermalModel& m) { m.outputs[0].unit = "mm"; }), HasSubstr("allowed: \"um\" or \"urad\""));
  EXPECT_THAT(complaint([](ThermalModel& m) { m.outputs[0].terms[0].tau_s = -5.0; }), HasSubstr("unstable"));
  EXPECT_THAT(complaint([&](ThermalModel& m) { m.outputs[0].terms[0].gain = nan; }), HasSubstr("finite"));
  EXPECT_THAT(complaint([](ThermalModel& m) { m.outputs[0].terms[0].input = 7; }), HasSubstr("input 7"));
  EXPECT_THAT(complaint([](ThermalModel& m) {
                m.inputs[1].train_min = -1e308;
                m.inputs[1].train_max = 1e308;
              }),
              HasSubstr("range of training"));
}

TEST(Compensator, RecoversFromAnythingThatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  CompensatorLimits limits;
  limits.slew_per_s = 0.5;
  limits.stale_after_s = 30.0;
  limits.recover_after_s = 20.0;
  // At the first step, in mid-run, for a moment and for long: the same end.
  for (const double bad : {nan, inf, -inf, 1e308})
    for (const int from : {0, 1, 1000})
      for (const int length : {1, 10, 200}) {
        Compensator c;
        Compensator sound;
        ASSERT_EQ(c.load(model(), 1.0, limits), "");
        ASSERT_EQ(sound.load(model(), 1.0, limits), "");
        double out = 0.0, expected = 0.0, last = 0.0;
        const double good[2] = {3000.0, 24.0};
        for (int k = 0; k < 40000; ++k) {
          const double u[2] = {3000.0, k >= from && k < from + length ? bad : 24.0};
          const CompensatorState state = c.step(u, nullptr, &out);
          sound.step(good, nullptr, &expected);
          ASSERT_TRUE(std::isfinite(out));
          ASSERT_LE(std::abs(out - last), 0.5 + 1e-12);
          if (from == 1000 && length == 10 && k >= from) {
            EXPECT_NEAR(out, expected, 0.05);
          }
          if (length == 200 && k == from + length - 1) {
            EXPECT_EQ(out, 0.0);
            EXPECT_EQ(state, CompensatorState::Fallback);
          }
          last = out;
        }
        EXPECT_EQ(c.state(), CompensatorState::Running);
        EXPECT_NEAR(out, expected, 1e-6) << bad << " from " << from << " for " << length;
      }
}

TEST(Compensator, AValueThatIsNoNumberIsHeldFadedAndLeftBehind) {
  // Finite inputs whose power is not: the range of training allows them.
  ThermalModel wild = model();
  wild.inputs[0].train_max = 1e300;
  wild.inputs[0].power = 2.0;
  CompensatorLimits limits;
  limits.slew_per_s = 1.0;
  limits.stale_after_s = 5.0;
  Compensator c;
  ASSERT_EQ(c.load(wild, 1.0, limits), "");
  const double good[2] = {3000.0, 24.0};
  const double bad[2] = {1e200, 24.0};
  double out = 0.0;
  for (int k = 0; k < 5000; ++k) c.step(good, nullptr, &out);
  const double level = out;
  EXPECT_GT(std::abs(level), 1.0);
  EXPECT_EQ(c.step(bad, nullptr, &out), CompensatorState::Holding);
  EXPECT_TRUE(c.status().value_not_finite);
  EXPECT_EQ(out, level);
  for (int k = 0; k < 50; ++k) c.step(bad, nullptr, &out);
  EXPECT_EQ(c.state(), CompensatorState::Fallback);
  EXPECT_EQ(out, 0.0);
  for (int k = 0; k < 50000; ++k) c.step(good, nullptr, &out);
  EXPECT_EQ(c.state(), CompensatorState::Running);
  EXPECT_FALSE(c.status().value_not_finite);
  EXPECT_NEAR(out, level, 1e-2);
}

TEST(Compensator, AStandingSpindleMakesNoStepSlower) {
  // Numbers below 1e-308 take some processors a hundred times longer; a lag without input decays into them and stays.
  ThermalModel m = model();
  for (int k = 0; k < 40; ++k) m.outputs[0].terms.push_back({0, 1.0 + 0.05 * k, 2.0});
  Compensator c;
  ASSERT_EQ(c.load(m, 0.5), "");
  double out = 0.0;
  const auto steps = [&](int count, double rpm) {
    const double u[2] = {rpm, 24.0};
    for (int k = 0; k < count; ++k) (void)c.step(u, nullptr, &out);
  };
  steps(100, 3000.0);
  steps(20'000, 0.0);
  const double before = out;
  std::feclearexcept(FE_ALL_EXCEPT);
  steps(2000, 0.0);
  EXPECT_EQ(std::fetestexcept(FE_UNDERFLOW), 0);
  EXPECT_NEAR(out, before, 0.5);
}

TEST(Compensator, RefusesAnImpossibleMeasurementAndSaysSo) {
  Compensator c;
  CompensatorLimits limits;
  limits.slew_per_s = 1e6;
  limits.update_limit = 50.0;
  ASSERT_EQ(c.load(model(), 1.0, limits), "");
  const double u[2] = {3000.0, 24.0};
  double before = 0.0, out = 0.0;
  c.step(u, nullptr, &before);
  for (const double wild : {1e9, -1e9, 51.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(c.update(0, 1.0, wild));
    EXPECT_EQ(c.status().refused_update, 0);
  }
  for (const double gain : {0.0, -1.0, 100.0, std::numeric_limits<double>::infinity()})
    EXPECT_FALSE(c.update(0, gain, 0.0));
  EXPECT_FALSE(c.update(3, 1.0, 0.0));
  c.step(u, nullptr, &out);
  EXPECT_NEAR(out, before, 1e-9);
  EXPECT_TRUE(c.update(0, 1.0, 30.0));
  EXPECT_EQ(c.status().refused_update, -1);
  EXPECT_FALSE(c.update(0, 1.0, 30.0)) << "the sum counts";
  c.step(u, nullptr, &out);
  EXPECT_NEAR(out, before - 30.0, 1e-9);
}

TEST(Compensator, NoMeasuredOffsetHoldsAnOutputAtItsLimit) {
  Compensator c;
  CompensatorLimits limits;
  limits.limit = 20.0;
  ASSERT_EQ(c.load(model(), 1.0, limits), "");
  EXPECT_FALSE(c.update(0, 1.0, 90.0)) << "below update_limit, far beyond what can be compensated";
  EXPECT_EQ(c.status().refused_update, 0);
  EXPECT_TRUE(c.update(0, 1.0, 19.0));
}

TEST(Compensator, SaysWhatIsExtrapolatedAndWhatStandsAtItsLimit) {
  CompensatorLimits limits;
  limits.limit = 1.0;
  Compensator c;
  ASSERT_EQ(c.load(model(), 1.0, limits), "");
  EXPECT_EQ(c.status().outside_training, -1) << "nothing came yet";
  const ThermalInput second = model().inputs[1];
  double inputs[2] = {model().inputs[0].train_min, second.train_max};
  double out = 0.0;
  c.step(inputs, nullptr, &out);
  EXPECT_EQ(c.status().outside_training, -1);
  inputs[1] = second.train_max + 1.0;
  EXPECT_EQ(c.step(inputs, nullptr, &out), CompensatorState::Running) << "within the margin";
  EXPECT_EQ(c.status().outside_training, 1);
  inputs[0] = model().inputs[0].train_max;
  for (int k = 0; k < 5000; ++k) c.step(inputs, nullptr, &out);
  EXPECT_EQ(std::abs(out), 1.0);
  EXPECT_EQ(c.status().limited_output, 0);
  limits.limit = 200.0;
  ASSERT_EQ(c.load(model(), 1.0, limits), "");
  for (int k = 0; k < 5000; ++k) c.step(inputs, nullptr, &out);
  EXPECT_EQ(c.status().limited_output, -1);
}

/// A controller that is switched on beside a machine that warms up already: until it has settled it is off by what the
/// machine still had to go, then by about a twentieth of it.
TEST(Compensator, SaysHowLongWhatWasBeforeItsStartCounts) {
  CompensatorLimits limits;
  limits.slew_per_s = 1e6;
  Compensator from_the_beginning;
  Compensator late;
  ASSERT_EQ(from_the_beginning.load(model(), 1.0, limits), "");
  ASSERT_EQ(late.load(model(), 1.0, limits), "");
  double longest_s = 0.0;
  const ThermalModel of = model();
  for (const LagTerm& term : of.outputs[0].terms) longest_s = std::max(longest_s, term.tau_s);
  EXPECT_DOUBLE_EQ(late.status().settling_s, 3.0 * longest_s) << "nothing came yet";
  const double cold[2] = {model().inputs[0].train_min, model().inputs[1].train_min};
  const double warm[2] = {model().inputs[0].train_max, model().inputs[1].train_max};
  double right = 0.0;
  double out = 0.0;
  from_the_beginning.step(cold, nullptr, &right);
  for (int k = 0; k < 60; ++k) from_the_beginning.step(warm, nullptr, &right);
  late.step(warm, nullptr, &out);
  EXPECT_DOUBLE_EQ(late.status().settling_s, 3.0 * longest_s);
  const double off = std::abs(out - right);
  ASSERT_GT(off, 0.1);
  double before_s = late.status().settling_s;
  while (before_s > 0.0) {
    from_the_beginning.step(warm, nullptr, &right);
    late.step(warm, nullptr, &out);
    ASSERT_LT(late.status().settling_s, before_s);
    before_s = late.status().settling_s;
  }
  EXPECT_LT(std::abs(out - right), 0.08 * off);
  late.reset();
  EXPECT_DOUBLE_EQ(late.status().settling_s, 3.0 * longest_s) << "after a reset nothing is known of before";
}

TEST(Compensator, TheInterfaceForCChecksLengthsSizesAndNames) {
  const testing::TempFolder folder;
  ThermalModel m = model();
  // Two names that agree for longer than any fixed buffer.
  m.inputs[0].name.assign(200, 'a').append("_rpm");
  m.inputs[1].name.assign(200, 'a').append("_degC");
  m.outputs[0].verdict = ThermalVerdict{false, 0.0, 1.0, 2.0, "worse than nothing"};
  m.write(folder / "model.json");
  char message[300];
  spindrift_compensator_options options{};
  EXPECT_EQ(spindrift_compensator_load_with((folder / "model.json").c_str(), &options, message, sizeof message),
            nullptr);
  EXPECT_THAT(message, HasSubstr("struct_size"));
  options.struct_size = sizeof options;
  options.cycle_s = 1.0;
  EXPECT_EQ(spindrift_compensator_load_with((folder / "model.json").c_str(), &options, message, sizeof message),
            nullptr);
  EXPECT_THAT(message, HasSubstr("worse than nothing"));
  char little[4];
  EXPECT_EQ(spindrift_compensator_load_with((folder / "model.json").c_str(), &options, little, sizeof little), nullptr);
  EXPECT_EQ(std::string(little).size(), 3U);
  // A caller of an older version knows nothing of `force`: it cannot be set by what stands behind its struct.
  options.force = 1;
  options.struct_size = offsetof(spindrift_compensator_options, force);
  EXPECT_EQ(spindrift_compensator_load_with((folder / "model.json").c_str(), &options, message, sizeof message),
            nullptr);
  options.struct_size = sizeof options;
  options.slew_per_s = -1.0;
  EXPECT_EQ(spindrift_compensator_load_with((folder / "model.json").c_str(), &options, message, sizeof message),
            nullptr);
  options.slew_per_s = 0.0;
  spindrift_compensator* c =
      spindrift_compensator_load_with((folder / "model.json").c_str(), &options, message, sizeof message);
  ASSERT_NE(c, nullptr) << message;
  ASSERT_EQ(spindrift_compensator_inputs(c), 2);
  EXPECT_EQ(spindrift_compensator_copy_input_name(c, 1, nullptr, 0), 206U);
  std::string name(206, 'x');
  EXPECT_EQ(spindrift_compensator_copy_input_name(c, 1, name.data(), name.size()), 206U);
  EXPECT_STREQ(name.c_str(), m.inputs[1].name.c_str());
  EXPECT_EQ(spindrift_compensator_copy_input_name(c, 2, name.data(), name.size()), 0U);
  EXPECT_EQ(spindrift_compensator_copy_output_name(c, 0, name.data(), name.size()), 6U);
  const double u[2] = {3000.0, 24.0};
  const double age[2] = {0.0, 0.0};
  double out[2] = {7.0, 7.0};
  EXPECT_EQ(spindrift_compensator_step_sized(c, u, 1, nullptr, 0, out, 1), -1);
  EXPECT_EQ(spindrift_compensator_step_sized(c, u, 2, nullptr, 0, out, 2), -1);
  EXPECT_EQ(spindrift_compensator_step_sized(c, u, 2, age, 1, out, 1), -1);
  EXPECT_EQ(out[0], 7.0);
  EXPECT_EQ(spindrift_compensator_step_sized(c, u, 2, age, 2, out, 1), SPINDRIFT_COMPENSATOR_RUNNING);
  EXPECT_EQ(out[1], 7.0);
  EXPECT_EQ(spindrift_compensator_update(c, 0, 1.0, 1e9), 0);
  spindrift_compensator_status status{};
  EXPECT_EQ(spindrift_compensator_get_status(c, &status), -1);
  status.struct_size = sizeof status;
  EXPECT_EQ(spindrift_compensator_get_status(c, &status), 0);
  EXPECT_EQ(status.state, SPINDRIFT_COMPENSATOR_RUNNING);
  EXPECT_EQ(status.refused_input, -1);
  EXPECT_EQ(status.refused_update, 0);
  EXPECT_EQ(status.forced, 1);
  EXPECT_GT(status.settling_s, 0.0);
  status.forced = 9;
  status.struct_size = offsetof(spindrift_compensator_status, forced);
  EXPECT_EQ(spindrift_compensator_get_status(c, &status), 0);
  EXPECT_EQ(status.forced, 9) << "written behind the caller's struct";
  spindrift_compensator_free(c);
}

/// Of a model that can be loaded.
class CompensatorInC : public ::testing::Test {
 protected:
  CompensatorInC() {
    model().write(folder_ / "model.json");
    options_.struct_size = sizeof options_;
    options_.cycle_s = 1.0;
    options_.slew_per_s = 1e6;
  }
  ~CompensatorInC() override { spindrift_compensator_free(loaded_); }
  /// The sentence why not, else empty.
  std::string load() {
    spindrift_compensator_free(loaded_);
    char message[300] = "";
    loaded_ = spindrift_compensator_load_with((folder_ / "model.json").c_str(), &options_, message, sizeof message);
    return message;
  }
  int step(const double* inputs, const double* age_s = nullptr) {
    return spindrift_compensator_step(loaded_, inputs, age_s, &out_);
  }

  static constexpr double good[2] = {3000.0, 24.0};
  testing::TempFolder folder_;
  spindrift_compensator_options options_{};
  spindrift_compensator* loaded_ = nullptr;
  double out_ = 7.0;
};

TEST_F(CompensatorInC, BoundsTheGainsThatAreTaken) {
  options_.least_gain = 0.9;
  options_.most_gain = 1.5;
  ASSERT_EQ(load(), "");
  EXPECT_EQ(spindrift_compensator_update(loaded_, 0, 0.5, 0.0), 0);
  EXPECT_EQ(spindrift_compensator_update(loaded_, 0, 2.0, 0.0), 0);
  EXPECT_EQ(spindrift_compensator_update(loaded_, 0, 1.4, 0.0), 1);
  // A caller of the version without them: what stands behind its struct is not read.
  options_.struct_size = offsetof(spindrift_compensator_options, least_gain);
  ASSERT_EQ(load(), "");
  EXPECT_EQ(spindrift_compensator_update(loaded_, 0, 0.5, 0.0), 1);
  EXPECT_EQ(spindrift_compensator_update(loaded_, 0, 4.0, 0.0), 1);
  options_.struct_size = sizeof options_;
  options_.least_gain = SPINDRIFT_COMPENSATOR_ZERO;
  options_.most_gain = SPINDRIFT_COMPENSATOR_ZERO;
  EXPECT_NE(load(), "");
}

TEST_F(CompensatorInC, WhatALaterVersionAsksForIsNotLeftOutSilently) {
  struct Later {
    spindrift_compensator_options known;
    double newer;
  } later{options_, 0.0};
  later.known.struct_size = sizeof later;
  const auto loads = [&] {
    char message[300] = "";
    spindrift_compensator* c =
        spindrift_compensator_load_with((folder_ / "model.json").c_str(), &later.known, message, sizeof message);
    spindrift_compensator_free(c);
    return c != nullptr ? std::string("loaded") : std::string(message);
  };
  EXPECT_EQ(loads(), "loaded");
  later.newer = 3.0;
  EXPECT_NE(loads().find("does not know"), std::string::npos) << loads();
  later.known.struct_size = static_cast<std::size_t>(-1);
  EXPECT_NE(loads().find("struct_size"), std::string::npos) << loads();
}

TEST_F(CompensatorInC, ZeroCanBeAskedFor) {
  const double late[2] = {0.0, 0.5};
  ASSERT_EQ(load(), "");
  for (int i = 0; i < 20; ++i) (void)step(good);
  EXPECT_EQ(step(good, late), SPINDRIFT_COMPENSATOR_RUNNING);
  options_.stale_after_s = SPINDRIFT_COMPENSATOR_ZERO;
  options_.recover_after_s = SPINDRIFT_COMPENSATOR_ZERO;
  ASSERT_EQ(load(), "");
  EXPECT_EQ(step(good), SPINDRIFT_COMPENSATOR_RUNNING);
  EXPECT_EQ(step(good, late), SPINDRIFT_COMPENSATOR_FALLBACK);  // nothing is held for 0 s
  EXPECT_EQ(step(good), SPINDRIFT_COMPENSATOR_RUNNING);         // and it is back at once
  options_.stale_after_s = -2.0;
  EXPECT_NE(load(), "");
}

TEST_F(CompensatorInC, WithoutInputsTheOutputsAreHeldAndFaded) {
  options_.stale_after_s = 5.0;
  ASSERT_EQ(load(), "");
  for (int i = 0; i < 20; ++i) (void)step(good);
  const double held = out_;
  ASSERT_NE(held, 0.0);
  for (int i = 0; i < 5; ++i) {
    out_ = 7.0;
    EXPECT_EQ(step(nullptr), SPINDRIFT_COMPENSATOR_HOLDING);
    EXPECT_NEAR(out_, held, 0.05 * std::abs(held)) << i;
  }
  EXPECT_EQ(spindrift_compensator_step_sized(loaded_, nullptr, 0, nullptr, 0, &out_, 1),
            SPINDRIFT_COMPENSATOR_FALLBACK);
  EXPECT_EQ(out_, 0.0);
  EXPECT_EQ(spindrift_compensator_step_sized(loaded_, nullptr, 2, nullptr, 0, &out_, 1), -1);
}

TEST(Compensator, WorksFromC) {
  const testing::TempFolder folder;
  model().write(folder / "model.json");
  double value = 0.0;
  EXPECT_EQ(compensate_one_minute((folder / "model.json").c_str(), 24.0, &value), SPINDRIFT_COMPENSATOR_RUNNING);
  EXPECT_LT(value, 20.0);
  EXPECT_NE(value, 0.0);
  char message[200];
  EXPECT_EQ(spindrift_compensator_load((folder / "none.json").c_str(), 1.0, 0.0, 0.0, message, sizeof message),
            nullptr);
  EXPECT_THAT(message, HasSubstr("none.json"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(spindrift_compensator_load((folder / "model.json").c_str(), 1.0, nan, 0.0, message, sizeof message),
            nullptr)
      << "a limit that is no number is none that was left out";
  EXPECT_THAT(message, HasSubstr("limit"));
}

TEST(Compensator, AModelWhoseFileSaysNonsenseIsRefused) {
  const testing::TempFolder folder;
  const auto refusal = [&](const std::function<void(nlohmann::json&)>& spoil) {
    nlohmann::json json = model().json();
    spoil(json);
    return testing::refusal([&] { (void)ThermalModel::parse(JsonNode::parse(json.dump(), "model.json")); });
  };
  EXPECT_EQ(refusal([](nlohmann::json&) {}), "");
  EXPECT_THAT(refusal([](nlohmann::json& json) { json["outputs"][0].erase("unit"); }), HasSubstr("unit"));
  EXPECT_THAT(refusal([](nlohmann::json& json) { json["outputs"].push_back(json["outputs"][0]); }),
              HasSubstr("every output once"));
  EXPECT_THAT(refusal([](nlohmann::json& json) {
                auto& lower = json["outputs"][0]["covariance_lower"];
                const std::size_t n = 1 + json["outputs"][0]["terms"].size();
                lower = std::vector<double>(n * (n + 1) / 2, 0.0);
                lower[0] = -1.0;
              }),
              HasSubstr("none negative"));
}

}  // namespace
}  // namespace spindrift
