// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/thermal/iso230_3.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>

#include "core/base/error.h"
#include "core/base/random.h"

namespace spindrift {
namespace {

// Worked example, checked by hand: readings every 30 min.
TEST(Iso2303, EtveByHand) {
  std::vector<double> time;
  std::vector<double> ambient;
  ComponentSeries ez{"EZ", "um", {}, 0.1};
  for (int k = 0; k <= 16; ++k) {
    time.push_back(1800.0 * k);
    ambient.push_back(20.0 + 0.25 * k);               // 20 ... 24 degC
    ez.values.push_back(1.0 - 0.5 * 0.25 * k * 3.0);  // -1.5 um per K
  }
  const EtveResult r = evaluateEtve(time, {ez}, ambient);
  EXPECT_DOUBLE_EQ(r.duration_s, 28800.0);
  EXPECT_DOUBLE_EQ(r.temperature_range_K, 4.0);
  // 4 K x 1.5 um/K; what readings of 0.1 um add to the range of such a record is taken off.
  EXPECT_NEAR(r.components[0].range, 6.0, 0.03);
  EXPECT_NEAR(r.components[0].range_per_K, 0.25 * r.components[0].range, 1e-12);
  EXPECT_NEAR(r.components[0].slope_per_K, -1.5, 1e-12);
  EXPECT_NEAR(r.components[0].range_sigma, std::sqrt(2.0) * 0.1, 0.03);
}

// Without that the mean lies 2.8 of the stated uncertainties too high, and every one of these records above the truth.
TEST(Iso2303, TheRangeOfNoisyReadingsIsThatOfWhatTheyShow) {
  constexpr int records = 40;
  double error_um = 0.0;
  double squares = 0.0;
  double still_um = 0.0;
  for (int seed = 1; seed <= records; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    std::vector<double> time;
    std::vector<double> ambient;
    ComponentSeries day{"Z_um", "um", {}, 0.0};
    ComponentSeries still{"Y_um", "um", {}, 0.0};
    for (int k = 0; k < 2880; ++k) {
      time.push_back(30.0 * k);
      ambient.push_back(20.0 + std::sin(k / 458.4));
      day.values.push_back(5.0 * std::sin(k / 458.4) + random.normal(0.0, 0.1));
      still.values.push_back(random.normal(0.0, 0.5));
    }
    const EtveResult r = evaluateEtve(time, {day, still}, ambient);
    error_um += (r.components[0].range - 10.0) / records;
    squares += std::pow((r.components[0].range - 10.0) / r.components[0].range_sigma, 2) / records;
    still_um += r.components[1].range / records;
    EXPECT_LT(r.components[1].range, 3.0 * r.components[1].range_sigma) << "seed " << seed;
  }
  EXPECT_NEAR(error_um, 0.0, 0.03);
  EXPECT_NEAR(std::sqrt(squares), 1.0, 0.35);
  EXPECT_LT(still_um, 0.3) << "1.5 um as it stands in the record";
}

/// An encoder that creeps while the spindle stands neither begins the test nor ends it.
TEST(Iso2303, ACreepingEncoderIsAStandingSpindle) {
  std::vector<double> time;
  std::vector<double> creeping;
  std::vector<double> still;
  ComponentSeries z{"Z_um", "um", {}, 0.1};
  for (int k = 0; k <= 300; ++k) {
    const double t = 60.0 * k;
    const bool runs = t >= 3600.0 && t < 10800.0;
    time.push_back(t);
    still.push_back(runs ? 3000.0 : 0.0);
    creeping.push_back(runs ? 3000.0 : 0.3);
    z.values.push_back(t < 3600.0 ? 0.0 : runs ? 30.0 * -std::expm1(-(t - 3600.0) / 1800.0) : 10.0);
  }
  const SpindleResult expected = evaluateRotatingSpindle(time, still, {z});
  const SpindleResult r = evaluateRotatingSpindle(time, creeping, {z});
  EXPECT_EQ(r.start_s, 3600.0);
  EXPECT_EQ(r.stop_s, 10800.0);
  EXPECT_EQ(r.components[0].at_end, expected.components[0].at_end);
  for (double& rpm : creeping) rpm = 0.3;
  EXPECT_THROW((void)evaluateRotatingSpindle(time, creeping, {z}), InputError);
}

/// Each change has the uncertainty of the readings it was taken from: the level after an hour lies in the middle of its
/// window and is surer than those at an edge.
TEST(Iso2303, EveryChangeHasItsOwnUncertainty) {
  std::vector<double> time;
  std::vector<double> speed;
  ComponentSeries z{"Z_um", "um", {}, 0.3};
  for (int k = 0; k <= 2000; ++k) {
    const double t = 10.0 * k;
    time.push_back(t);
    speed.push_back(t >= 3600.0 && t < 10800.0 ? 3000.0 : 0.0);
    z.values.push_back(0.001 * t);
  }
  const SpindleComponent c = evaluateRotatingSpindle(time, speed, {z}).components[0];
  z.reading_sigma = 1e-9;
  const double true_range = evaluateRotatingSpindle(time, speed, {z}).components[0].range;
  z.reading_sigma = 0.3;
  EXPECT_LT(c.first_hour_sigma, 0.8 * c.change_sigma);
  EXPECT_NEAR(c.after_cooling_sigma, c.change_sigma, 0.1 * c.change_sigma);
  // Against noise: what is stated is how the values scatter.
  double first = 0.0;
  double cooled = 0.0;
  double range = 0.0;
  constexpr int runs = 400;
  for (int seed = 1; seed <= runs; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    ComponentSeries noisy = z;
    for (double& v : noisy.values) v += random.normal(0.0, 0.3);
    const SpindleComponent n = evaluateRotatingSpindle(time, speed, {noisy}).components[0];
    first += std::pow((n.first_hour - c.first_hour) / c.first_hour_sigma, 2) / runs;
    cooled += std::pow((n.after_cooling - c.after_cooling) / c.after_cooling_sigma, 2) / runs;
    range += std::pow((n.range - true_range) / n.range_sigma, 2) / runs;
  }
  EXPECT_NEAR(first, 1.0, 0.25);
  EXPECT_NEAR(cooled, 1.0, 0.25);
  EXPECT_NEAR(range, 1.0, 0.5) << "of levels of windows, the extreme ones chosen";
}

/// Single readings: the time grows with their number, not with its square.
TEST(Iso2303, SingleReadingsOfALongRecordAreQuick) {
  const auto seconds = [](int rows) {
    std::vector<double> time;
    std::vector<double> speed;
    ComponentSeries z{"Z_um", "um", {}, 0.1};
    for (int k = 0; k < rows; ++k) {
      time.push_back(k);
      speed.push_back(k > rows / 4 && k < rows / 2 ? 1000.0 : 0.0);
      z.values.push_back(k % 3 == 0 ? std::nan("") : std::sin(k * 1e-3));
    }
    double quickest = 1e300;  // a machine that does something else meanwhile only makes it longer
    for (int run = 0; run < 3; ++run) {
      const auto from = std::chrono::steady_clock::now();
      (void)evaluateRotatingSpindle(time, speed, {z}, 0.9, 0.0);
      quickest = std::min(quickest, std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count());
    }
    return quickest;
  };
  // Ten times the rows: some ten times as long in one run, a hundred times where each row asks every other.
  EXPECT_LT(seconds(400000), 35.0 * std::max(seconds(40000), 0.005));
}

TEST(Iso2303, RotatingSpindleByHand) {
  // Runs from 600 s to 600 + 14400 s; displacement 20 (1 - exp(-t / 3600)), then cools.
  std::vector<double> time;
  std::vector<double> speed;
  ComponentSeries ez{"EZ", "um", {}, 0.05};
  double at_stop = 0.0;
  for (int k = 0; k <= 400; ++k) {
    const double t = 60.0 * k;
    time.push_back(t);
    const bool runs = t >= 600.0 && t < 15000.0;
    speed.push_back(runs ? 3000.0 : 0.0);
    const double value = t < 600.0      ? 0.0
                         : t <= 15000.0 ? 20.0 * -std::expm1(-(t - 600.0) / 3600.0)
                                        : at_stop * std::exp(-(t - 15000.0) / 3600.0);
    if (t <= 15000.0) at_stop = value;
    ez.values.push_back(value);
  }
  const SpindleResult r = evaluateRotatingSpindle(time, speed, {ez}, 0.9);
  EXPECT_DOUBLE_EQ(r.start_s, 600.0);
  EXPECT_DOUBLE_EQ(r.stop_s, 15000.0);
  // The course bends within the window of a level: by 20 um (60 s)^2 / (2 (3600 s)^2) at most, 0.003 um.
  EXPECT_NEAR(r.components[0].first_hour, 20.0 * (1.0 - std::exp(-1.0)), 3e-3);  // 12.64
  EXPECT_NEAR(r.components[0].at_end, 20.0 * (1.0 - std::exp(-4.0)), 3e-3);      // 19.63
  // 1 - exp(-t/3600) = 0.9 * 0.98168 -> t = 7749 s, first reading at or after: 7800 s.
  EXPECT_DOUBLE_EQ(r.components[0].time_to_fraction_s, 7800.0);
  EXPECT_NEAR(r.components[0].after_cooling, 19.6337 * std::exp(-2.5), 1e-3);
  EXPECT_NEAR(r.components[0].first_hour_range, r.components[0].first_hour, 0.1) << "it only grows";
}

TEST(Iso2303, AfterTheStopNothingIsStatedOfARecordThatEndsWithIt) {
  std::vector<double> time;
  std::vector<double> speed;
  ComponentSeries ez{"EZ", "um", {}, 0.05};
  for (int k = 0; k <= 200; ++k) {
    time.push_back(60.0 * k);
    speed.push_back(k >= 10 ? 3000.0 : 0.0);
    // Grows, and after half an hour shrinks again below where it was: the change of an hour is not its range.
    ez.values.push_back(k < 10 ? 0.0 : k < 40 ? 0.4 * (k - 10) : 12.0 - 0.3 * std::min(k - 40, 40));
  }
  const SpindleComponent c = evaluateRotatingSpindle(time, speed, {ez}, 0.9).components[0];
  EXPECT_TRUE(std::isnan(c.after_cooling));
  EXPECT_TRUE(std::isnan(c.after_cooling_sigma));
  EXPECT_NEAR(c.first_hour, 3.0, 0.1);
  EXPECT_NEAR(c.first_hour_range, 12.0, 0.3);
  EXPECT_GT(c.first_hour_range_sigma, 0.0);
}

// A thermometer of 0.1 K in a room that changes by 1 K: neither its range nor its squares are those of the room.
TEST(Iso2303, NoiseOfTheThermometerChangesNothingPerKelvin) {
  constexpr int records = 30;
  double per_K = 0.0;
  double slope = 0.0;
  double squares = 0.0;
  for (int seed = 1; seed <= records; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    std::vector<double> time;
    std::vector<double> ambient;
    ComponentSeries z{"Z_um", "um", {}, 0.0};
    for (int k = 0; k < 960; ++k) {
      time.push_back(30.0 * k);
      const double room = 0.5 * std::sin(k / 153.0);
      ambient.push_back(20.0 + room + random.normal(0.0, 0.1));
      z.values.push_back(5.0 * room + random.normal(0.0, 0.05));
    }
    const EtveComponent c = evaluateEtve(time, {z}, ambient).components[0];
    per_K += c.range_per_K / records;
    slope += c.slope_per_K / records;
    squares += std::pow((c.range_per_K - 5.0) / c.range_per_K_sigma, 2) / records;
  }
  // The range of levels keeps a third of the noise of a reading (3.1 um/K with all of it).
  EXPECT_NEAR(per_K, 5.0, 0.2);
  EXPECT_NEAR(slope, 5.0, 0.05);
  EXPECT_LT(std::sqrt(squares), 2.0);
  // Nothing but noise: nothing is said per kelvin.
  Random random(3);
  std::vector<double> time;
  std::vector<double> ambient;
  ComponentSeries z{"Z_um", "um", {}, 0.0};
  for (int k = 0; k < 960; ++k) {
    time.push_back(30.0 * k);
    ambient.push_back(20.0 + random.normal(0.0, 0.1));
    z.values.push_back(random.normal(0.0, 0.05));
  }
  EXPECT_TRUE(std::isnan(evaluateEtve(time, {z}, ambient).components[0].slope_per_K));
}

// A reading every second with noise of 0.5 um: what is reported must not be that of single readings.
TEST(Iso2303, LevelsAreReadOverAWindow) {
  Random random(7);
  std::vector<double> time;
  std::vector<double> speed;
  std::vector<double> ambient;
  ComponentSeries course{"EZ", "um", {}, 0.5};
  ComponentSeries still{"EY", "um", {}, 0.5};
  for (int k = 0; k <= 18000; ++k) {
    const double t = 1.0 * k;
    time.push_back(t);
    speed.push_back(t >= 600.0 && t < 15000.0 ? 3000.0 : 0.0);
    ambient.push_back(20.0 + 1e-4 * t);
    const double value = t < 600.0 ? 0.0 : 20.0 * -std::expm1(-(std::min(t, 15000.0) - 600.0) / 3600.0);
    course.values.push_back(value + random.normal(0.0, 0.5));
    still.values.push_back(random.normal(0.0, 0.5));
  }
  const SpindleComponent with = evaluateRotatingSpindle(time, speed, {course}, 0.9).components[0];
  EXPECT_NEAR(with.at_end, 20.0 * (1.0 - std::exp(-4.0)), 4.0 * with.change_sigma);
  EXPECT_NEAR(with.first_hour, 20.0 * (1.0 - std::exp(-1.0)), 4.0 * with.change_sigma);
  EXPECT_NEAR(with.change_sigma, 0.5 * std::sqrt(2.0 * 4.0 / 121.0), 2e-3);  // the end of a line: 4 / n
  EXPECT_NEAR(with.time_to_fraction_s, 7749.0, 450.0);
  const SpindleComponent without = evaluateRotatingSpindle(time, speed, {course}, 0.9, 0.0).components[0];
  EXPECT_NEAR(without.change_sigma, 0.5 * std::sqrt(2.0), 1e-9);
  EXPECT_GT(without.time_to_fraction_s, 8200.0) << "one low reading among many undoes it";
  // Nothing happens: the range is that of noise, 7 sigma of single readings.
  EXPECT_LT(evaluateEtve(time, {still}, ambient).components[0].range, 1.0);
  EXPECT_LT(evaluateEtve(time, {still}, ambient, 0.0).components[0].range, 1.0);
}

TEST(Iso2303, MovingAxisByHand) {
  // Five cycles every 20 min; low end grows 1 um, high end 9 um over 400 mm; reversal 0.4 um at both.
  std::vector<AxisReading> readings;
  for (int k = 0; k < 9; ++k) {
    const double part = k / 8.0;
    for (const int direction : {1, -1}) {
      readings.push_back({1200.0 * k + (direction > 0 ? 0.0 : 4.0), 50.0, 1.0 * part + 0.2 * direction, direction});
      readings.push_back({1200.0 * k + (direction > 0 ? 2.0 : 6.0), 450.0, 9.0 * part + 0.2 * direction, direction});
    }
  }
  const AxisResult r = evaluateMovingAxis(readings);
  EXPECT_NEAR(r.low.change_um, 1.0, 1e-9);
  EXPECT_NEAR(r.high.change_um, 9.0, 1e-9);
  EXPECT_NEAR(r.expansion_um, 8.0, 1e-9);
  EXPECT_NEAR(r.expansion_um_per_m, 20.0, 1e-9);
  // At one moment: what was read 4 s later should have moved on by 1 um in 9600 s.
  EXPECT_NEAR(r.low.reversal_um, 0.4 + 4.0 / 9600.0, 1e-9);
  EXPECT_NEAR(r.high.range_um, 9.4, 1e-9);
  EXPECT_LT(r.high.repeatability_um, 0.05);
  EXPECT_NEAR(r.expansion_over_time_um.back(), 8.0, 0.05);
  // Positions as a probe finds them are never twice the same.
  Random random(4);
  for (AxisReading& reading : readings) reading.position_mm += random.uniform(-0.01, 0.01);
  const AxisResult found = evaluateMovingAxis(readings);
  EXPECT_NEAR(found.expansion_um, 8.0, 1e-9);
  EXPECT_EQ(found.low.readings, 18U);
  EXPECT_NEAR(found.low.position_mm, 50.0, 0.01);
}

// ISO 230-2 asks for repeatability and reversal, ISO/TR 230-9 for their uncertainty: over many tests the scatter of
// what is found is what is stated.
TEST(Iso2303, RepeatabilityAndReversalCarryTheirUncertainty) {
  constexpr double sigma_um = 0.5;
  constexpr int tests = 400;
  double repeatability = 0.0, repeatability2 = 0.0, stated = 0.0, reversal_z2 = 0.0;
  for (int seed = 0; seed < tests; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    std::vector<AxisReading> readings;
    for (int k = 0; k < 9; ++k) {
      for (const int direction : {1, -1}) {
        for (const double position : {50.0, 450.0}) {
          readings.push_back({1200.0 * k + (direction > 0 ? 0.0 : 4.0), position,
                              position / 50.0 * k / 8.0 + 0.2 * direction + random.normal(0.0, sigma_um), direction});
        }
      }
    }
    const AxisPositionResult p = evaluateMovingAxis(readings).high;
    repeatability += p.repeatability_um / tests;
    repeatability2 += p.repeatability_um * p.repeatability_um / tests;
    stated += p.repeatability_sigma_um / tests;
    reversal_z2 += std::pow((p.reversal_um - 0.4 - 9.0 * 4.0 / 9600.0) / p.reversal_sigma_um, 2) / tests;
  }
  EXPECT_NEAR(repeatability, 2.0 * sigma_um, 0.04);
  const double scatter = std::sqrt(repeatability2 - repeatability * repeatability);
  EXPECT_NEAR(stated / scatter, 1.0, 0.12);
  EXPECT_NEAR(std::sqrt(reversal_z2), 1.0, 0.12);
  // One direction only says nothing of the reversal, four readings nothing of the repeatability beyond one degree.
  std::vector<AxisReading> few;
  for (int k = 0; k < 4; ++k) {
    for (const double position : {50.0, 450.0}) few.push_back({1200.0 * k, position, 0.1 * k * k, 1});
  }
  const AxisPositionResult p = evaluateMovingAxis(few).low;
  EXPECT_TRUE(std::isnan(p.reversal_sigma_um));
  EXPECT_TRUE(std::isfinite(p.repeatability_sigma_um));
}

// Constants of points and directions are unknown: none of them may look like an expansion.
TEST(Iso2303, MovingAxisOfSeveralPointsAndInAnyOrderOfDirections) {
  std::vector<AxisReading> readings;
  const auto add = [&](double t, double position, const char* point, double offset, int direction) {
    readings.push_back(
        {t, position, (position > 100.0 ? 9.0 : 1.0) * t / 9600.0 + offset + 0.2 * direction, direction, point});
  };
  for (int k = 0; k < 9; ++k) {
    const double t = 1200.0 * k;
    // Both of one direction first, then both of the other: the first two readings are not one of each.
    for (const int direction : {1, 1, -1, -1}) {
      add(t, 50.0, "F1", 0.0, direction);
      add(t, 50.0, "F2", 35.0, direction);
      if (k > 0) add(t, 450.0, "F3", -120.0, direction);
      add(t, 450.0, "F4", 7.0, direction);
    }
  }
  const AxisResult r = evaluateMovingAxis(readings);
  EXPECT_NEAR(r.low.change_um, 1.0, 1e-9);
  EXPECT_NEAR(r.high.change_um, 9.0, 1e-9) << "F3 begins too late to say it";
  EXPECT_NEAR(r.low.reversal_um, 0.4, 1e-9);
  EXPECT_NEAR(r.high.reversal_um, 0.4, 1e-9);
  EXPECT_NEAR(r.high.range_um, 9.4, 1e-9);
  EXPECT_LT(r.low.repeatability_um, 1e-6);
  for (std::size_t i = 0; i < r.time_s.size(); ++i)
    EXPECT_NEAR(r.expansion_over_time_um[i], 8.0 * r.time_s[i] / 9600.0, 1e-9) << r.time_s[i];
  // One direction at the beginning, the other at the end.
  std::vector<AxisReading> halves;
  for (const double position : {50.0, 450.0})
    for (int k = 0; k < 8; ++k) halves.push_back({600.0 * k, position, 1.0 * k, k < 4 ? 1 : -1, "F1"});
  try {
    (void)evaluateMovingAxis(halves);
    ADD_FAILURE() << "the reversal was taken for an expansion";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("no point was approached from one direction both"), std::string::npos);
  }
}

TEST(Iso2303, TheChangeOfAnAxisIsAsUncertainAsStated) {
  constexpr int runs = 300;
  double normalised = 0.0;
  for (int seed = 1; seed <= runs; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    std::vector<AxisReading> readings;
    for (int k = 0; k < 12; ++k)
      for (const int direction : {1, -1})
        for (const double position : {50.0, 450.0})
          readings.push_back({600.0 * k, position, random.normal(0.0, 0.4) + 0.1 * k, direction, "F1"});
    const AxisResult r = evaluateMovingAxis(readings);
    normalised += std::pow(r.expansion_um / r.expansion_sigma_um, 2) / runs;
  }
  EXPECT_NEAR(normalised, 1.0, 0.25);
}

// Four readings of each point, and a time history that goes through all of them: what is stated is what is known.
TEST(Iso2303, FewReadingsOfAnAxisAreNoBetterThanTheyState) {
  std::vector<AxisReading> readings;
  for (int k = 0; k < 4; ++k)
    for (const double position : {50.0, 250.0})
      readings.push_back({600.0 * k, position, 0.01 * position * k, 1, "F1", 0.1});
  const AxisResult r = evaluateMovingAxis(readings);
  EXPECT_NEAR(r.expansion_um, 6.0, 1e-9);
  EXPECT_NEAR(r.low.change_sigma_um, 0.1 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(r.expansion_sigma_um, 0.2, 1e-9);
}

// Most neighbours of a quiet record are equal where it is read in steps: that is no reason to be certain.
TEST(Iso2303, ReadingsInStepsAreNoBetterThanTheirSteps) {
  std::vector<double> time;
  ComponentSeries z{"Z_um", "um", {}, 0.0};
  for (int k = 0; k <= 28800; k += 4) {
    time.push_back(k);
    z.values.push_back(std::round(10.0 * 6.2 * std::sin(k / 5000.0)) / 10.0);
  }
  const EtveComponent c = evaluateEtve(time, {z}, {}, 0.0).components[0];
  EXPECT_NEAR(c.range_sigma, 0.1 / std::sqrt(12.0) * std::sqrt(2.0), 1e-3);
}

TEST(Iso2303, ALevelOverTheWholeRecordIsRefused) {
  std::vector<double> time;
  for (int i = 0; i <= 100; ++i) time.push_back(60.0 * i);
  const ComponentSeries ez{"EZ", "um", time, 0.1};
  const std::vector<double> rpm(time.size(), 3000.0);
  for (const double window_s : {3001.0, 1e9, std::nan(""), -1.0}) {
    EXPECT_THROW(static_cast<void>(evaluateEtve(time, {ez}, rpm, window_s)), InputError) << window_s;
    EXPECT_THROW(static_cast<void>(evaluateRotatingSpindle(time, rpm, {ez}, 0.9, window_s)), InputError) << window_s;
  }
  EXPECT_GT(evaluateEtve(time, {ez}, rpm, 3000.0).components[0].range, 0.0);
  EXPECT_EQ(evaluateRotatingSpindle(time, rpm, {ez}, 0.9, 3000.0).window_s, 3000.0);
  // The usual window is taken of a record of any length, and no longer one is said to be allowed.
  const std::vector<double> eleven{0, 15, 30, 45, 60, 75, 90, 105, 120, 135, 150};
  const ComponentSeries few{"EZ", "um", eleven, 0.1};
  EXPECT_EQ(evaluateEtve(eleven, {few}, {}).window_s, level_window_s);
  try {
    static_cast<void>(evaluateEtve(eleven, {few}, {}, 121.0));
    ADD_FAILURE() << "a longer one was taken";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("allowed: 0 s to 120 s"), std::string::npos) << e.what();
  }
}

TEST(Iso2303, RefusesTestsThatHoldNothing) {
  const std::vector<double> time = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  const std::vector<double> still(11, 0.0);
  ComponentSeries ez{"EZ", "um", still, 0.1};
  EXPECT_THROW(static_cast<void>(evaluateRotatingSpindle(time, still, {ez})), InputError);
  EXPECT_THROW(static_cast<void>(evaluateEtve(time, {}, {})), InputError);
  EXPECT_THROW(static_cast<void>(evaluateMovingAxis({{0, 1, 2, 1}})), InputError);
}

TEST(Etve, IsRefusedWhenTheSpindleRan) {
  TimeSeries series;
  series.file = "log.csv";
  series.time_s = {0.0, 60.0, 120.0};
  series.signals = {{"x_um", SignalKind::Displacement, {0.0, 1.0, 2.0}},
                    {"spindle_rpm", SignalKind::Speed, {0.0, std::nan(""), 0.5}}};
  EXPECT_TRUE(requireMachineAtRest(series).empty());
  series.signals[1].values[2] = -3000.0;
  try {
    (void)requireMachineAtRest(series);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "log.csv, column spindle_rpm: the spindle turns (-3000 rpm at 120 s), but an ETVE test is of a machine at "
        "rest; allowed: a log without a running spindle, or the test \"spindle\".");
  }
}

TEST(Etve, SaysWhatSpeaksAgainstAMachineAtRest) {
  TimeSeries series;
  series.file = "log.csv";
  series.time_s = {0.0, 60.0, 120.0};
  series.signals = {{"x_um", SignalKind::Displacement, {0.0, 1.0, 2.0}},
                    {"feed_x_mm_min", SignalKind::Feed, {0.0, 3000.0, 0.0}}};
  const std::vector<std::string> notes = requireMachineAtRest(series);
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_NE(notes[0].find("feed_x_mm_min is 3000 at 60 s"), std::string::npos) << notes[0];
  EXPECT_NE(notes[1].find("could not be checked"), std::string::npos) << notes[1];
}

TEST(RotatingSpindle, IsOneStepOfSpeed) {
  TimeSeries series;
  series.file = "log.csv";
  std::vector<double> speed;
  const auto fill = [&](const std::function<double(double)>& rpm) {
    series.time_s.clear();
    speed.clear();
    for (double t = 0.0; t <= 20000.0; t += 60.0) {
      series.time_s.push_back(t);
      speed.push_back(rpm(t));
    }
  };
  const auto complaint = [&]() -> std::string {
    try {
      return "accepted" + requireOneSpeedStep(series, "spindle_rpm", speed);
    } catch (const InputError& error) {
      return error.what();
    }
  };
  // Comes up to speed within a minute, wobbles by 2 %, one row is off.
  fill([](double t) {
    if (t < 600.0 || t >= 15000.0) return 0.2;
    return t < 660.0 ? 1200.0 : t == 9000.0 ? 500.0 : 3000.0 + 60.0 * std::sin(t);
  });
  EXPECT_EQ(complaint(), "accepted");
  fill([](double t) { return t < 15000.0 ? 3000.0 : 0.0; });
  EXPECT_NE(complaint().find("begins with a running spindle"), std::string::npos) << complaint();
  fill([](double t) { return t < 600.0 || t >= 15000.0 ? 0.0 : t < 7800.0 ? 3000.0 : 6000.0; });
  EXPECT_EQ(
      complaint(),
      "log.csv, column spindle_rpm: the spindle turns at 6000 rpm at 7800 s, but at 3000 rpm for most of its run: "
      "these are several steps of speed, not one test; allowed: a record of one step, or --range FROM:TO around "
      "it.");
  fill([](double t) { return t < 600.0 || (t >= 9000.0 && t < 9600.0) || t >= 15000.0 ? 0.0 : 3000.0; });
  EXPECT_NE(complaint().find("the spindle stands at 9000 s"), std::string::npos) << complaint();
  fill([](double) { return 0.0; });
  EXPECT_EQ(complaint(), "accepted") << "the evaluation itself refuses it";
}

}  // namespace
}  // namespace spindrift
