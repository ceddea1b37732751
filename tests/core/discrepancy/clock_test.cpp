// SPDX-License-Identifier: GPL-3.0-or-later
// Clocks that are hours apart: that of the observations from that of simulation and log, and that of the log alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/discrepancy/simulation_clock.h"
#include "tests/core/discrepancy/small_plant.h"

namespace spindrift {
namespace {

using namespace small_plant;

bool says(const DiscrepancyResult& result, const std::string& words) {
  return std::any_of(result.warnings.begin(), result.warnings.end(),
                     [&](const std::string& w) { return w.find(words) != std::string::npos; });
}

/// What a simulation says in excess of that of the small plant, um: heat of a programme that does not repeat.
double course(double time_s) {
  return 6.0 * std::sin(time_s / 4100.0) + 4.0 * std::sin(time_s / 1900.0) +
         4.0 * std::tanh((time_s - 21000.0) / 3000.0);
}

/// A campaign whose simulation moves, as if the clock that stamped the observations were `ahead_s` ahead.
DiscrepancyInput stampedLate(Hidden hidden, std::uint64_t seed, double ahead_s, PredictedAt& predicted) {
  DiscrepancyInput input = campaign(hidden, seed);
  for (std::size_t i = 0; i < input.predicted.size(); ++i) {
    Observation& o = input.observations.rows[i];
    o.value += course(o.time_s);
    input.predicted[i] += course(o.time_s);
  }
  predicted = predictedBetween(input.observations.rows, input.predicted);
  for (Observation& o : input.observations.rows) o.time_s += ahead_s;
  return input;
}

/// As core/discrepancy/discrepancy_input.cpp does with what it reads.
void follow(DiscrepancyInput& input, const PredictedAt& predicted) {
  const auto clock = farSimulationClock(input.observations.rows, predicted);
  if (clock) {
    input.log_clock_s = clock->offset_s;
    input.log_clock_uncertainty_s = clock->standard_uncertainty_s;
  }
  for (std::size_t i = 0; i < input.predicted.size(); ++i) {
    const Observation& o = input.observations.rows[i];
    input.predicted[i] = predicted(o, o.time_s + input.log_clock_s);
  }
}

TEST(SimulationClock, IsFoundWhereItIsFarAwayAndOnlyThere) {
  int inside = 0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    for (const Hidden hidden : {Hidden::Nothing, Hidden::SpindleDrift, Hidden::Screw}) {
      PredictedAt predicted;
      for (const double ahead_s : {7200.0, -7200.0, 3600.0}) {
        const DiscrepancyInput input = stampedLate(hidden, seed, ahead_s, predicted);
        const auto clock = farSimulationClock(input.observations.rows, predicted);
        ASSERT_TRUE(clock.has_value()) << seed << " " << ahead_s;
        ++count;
        inside += std::abs(clock->offset_s + ahead_s) <= 2.0 * clock->standard_uncertainty_s ? 1 : 0;
        EXPECT_NEAR(clock->offset_s, -ahead_s, 400.0) << seed;
      }
      const DiscrepancyInput right = stampedLate(hidden, seed, 0.0, predicted);
      EXPECT_FALSE(farSimulationClock(right.observations.rows, predicted).has_value()) << seed;
      // What may be estimated with the effects is left to that.
      const DiscrepancyInput nearly = stampedLate(hidden, seed, 300.0, predicted);
      EXPECT_FALSE(farSimulationClock(nearly.observations.rows, predicted).has_value()) << seed;
    }
  }
  EXPECT_GE(inside, count * 9 / 10);
}

TEST(SimulationClock, FromPredictionsAtTheTimesOfTheObservations) {
  std::vector<Observation> rows(3);
  for (std::size_t i = 0; i < 3; ++i) {
    rows[i].time_s = 100.0 * static_cast<double>(i);
    rows[i].point = "F1";
  }
  const PredictedAt between = predictedBetween(rows, {1.0, 3.0, 7.0});
  EXPECT_DOUBLE_EQ(between(rows[0], 0.0), 1.0);
  EXPECT_DOUBLE_EQ(between(rows[0], 50.0), 2.0);
  EXPECT_DOUBLE_EQ(between(rows[0], 175.0), 6.0);
  EXPECT_DOUBLE_EQ(between(rows[0], 200.0), 7.0);
  EXPECT_TRUE(std::isnan(between(rows[0], 201.0)));
  Observation other = rows[0];
  other.point = "F2";
  EXPECT_TRUE(std::isnan(between(other, 50.0)));
}

TEST(SimulationClock, WhatIsMissingIsNamedAllTheSame) {
  int right = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    for (const double ahead_s : {7200.0, -7200.0}) {
      PredictedAt predicted;
      DiscrepancyInput input = stampedLate(Hidden::SpindleDrift, seed, ahead_s, predicted);
      follow(input, predicted);
      const DiscrepancyResult result = run(input);
      right += result.effects.size() == 1 && result.effects[0].id == "spindle.drift.y" ? 1 : 0;
      EXPECT_NEAR(result.clock_offset_s, -ahead_s, 400.0) << seed;
      EXPECT_GT(result.clock_offset_uncertainty_s, 0.0);
      for (const FoundEffect& e : result.effects) EXPECT_EQ(e.id, "spindle.drift.y") << seed << " " << ahead_s;
    }
  }
  EXPECT_GE(right, 7);
}

TEST(LogClock, FarOffIsFoundWithWhatIsMissing) {
  int right = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    DiscrepancyInput input = campaign(Hidden::SpindleDrift, seed);
    std::vector<double> later = input.log->time_s();
    for (double& t : later) t += 7200.0;
    OperatingLog moved(later);
    for (const std::string& name : input.log->names()) moved.setSignal(name, *input.log->signal(name));
    input.log = moved;
    const DiscrepancyResult result = run(input);
    for (const FoundEffect& e : result.effects) EXPECT_EQ(e.id, "spindle.drift.y") << seed;
    if (result.effects.empty()) continue;
    ++right;
    EXPECT_NEAR(result.clock_offset_s, 7200.0, 3.0 * result.clock_offset_uncertainty_s) << seed;
    EXPECT_TRUE(says(result, "ahead of that of the observations")) << seed;
  }
  EXPECT_GE(right, 3);
}

TEST(LogClock, IsNotMovedForWhatNothingInTheLogDrives) {
  for (const Hidden hidden : {Hidden::Wave, Hidden::Slip, Hidden::Nothing}) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const DiscrepancyResult result = run(campaign(hidden, seed));
      EXPECT_LT(std::abs(result.clock_offset_s), 600.0) << seed;
      EXPECT_FALSE(says(result, "fits the log as if")) << seed;
    }
  }
}

}  // namespace
}  // namespace spindrift
