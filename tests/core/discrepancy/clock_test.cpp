// SPDX-License-Identifier: GPL-3.0-or-later
// Clocks that are hours apart: that of the observations from that of simulation and log, and that of the log alone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/discrepancy/comparable_rows.h"
#include "core/discrepancy/simulation_clock.h"
#include "tests/core/discrepancy/small_plant.h"
#include "tests/support/temp_folder.h"

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
  auto clock = farSimulationClock(input.observations.rows, predicted);
  if (!clock) clock = nearSimulationClock(input.observations.rows, predicted);
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

TEST(SimulationClock, IsFoundToSecondsWhereItIsNearAndMovesEverything) {
  int found = 0;
  int inside = 0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    for (const Hidden hidden : {Hidden::Nothing, Hidden::SpindleDrift, Hidden::Screw}) {
      PredictedAt predicted;
      for (const double ahead_s : {90.0, -150.0, 300.0}) {
        const DiscrepancyInput input = stampedLate(hidden, seed, ahead_s, predicted);
        const auto clock = nearSimulationClock(input.observations.rows, predicted);
        ++count;
        if (!clock) continue;
        ++found;
        inside += std::abs(clock->offset_s + ahead_s) <= 2.0 * clock->standard_uncertainty_s ? 1 : 0;
      }
      // What is missing moves some components some of the time.
      const DiscrepancyInput right = stampedLate(hidden, seed, 0.0, predicted);
      EXPECT_FALSE(nearSimulationClock(right.observations.rows, predicted).has_value()) << seed;
    }
  }
  // Below six standard uncertainties (here some 15 s and more) it is left to the search, with the effects.
  EXPECT_GE(found, count / 4);
  EXPECT_GE(inside, found * 5 / 6);
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

/// Three minutes: the simulation knows them to seconds, the effect alone does not.
TEST(SimulationClock, MinutesAreToldWithTheirUncertainty) {
  int told = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    PredictedAt predicted;
    DiscrepancyInput input = stampedLate(Hidden::Nothing, seed, 180.0, predicted);
    follow(input, predicted);
    const DiscrepancyResult result = run(input);
    EXPECT_TRUE(result.effects.empty()) << seed;
    told += std::abs(result.clock_offset_s + 180.0) < 3.0 * result.clock_offset_uncertainty_s &&
                    result.clock_offset_uncertainty_s < 25.0
                ? 1
                : 0;
  }
  EXPECT_GE(told, 3);
}

/// The coolant of a log switched by a programme that does not repeat.
std::vector<double> switchedCoolant(std::size_t size, std::uint64_t seed) {
  std::vector<double> coolant;
  Random random(seed);
  for (double on = 0.0; coolant.size() < size; on = 1.0 - on)
    coolant.insert(coolant.end(), static_cast<std::size_t>(random.uniform(20.0, 110.0)), on);
  coolant.resize(size);
  return coolant;
}

/// What a signal of a log comes to through a lag, at the time of its clock.
double lagged(const std::vector<double>& signal, double step_s, double time_constant_s, double time_s) {
  double q = 0.0;
  for (std::size_t i = 0; i < signal.size() && step_s * static_cast<double>(i) < time_s; ++i)
    q += step_s * (signal[i] - q) / time_constant_s;
  return q;
}

/// What the simulation has follows the coolant within minutes, and the clock is minutes off: a straight line in the
/// offset explains part of it, and states lie too far apart for one between them. What is missing goes with the log.
TEST(SimulationClock, MinutesBesideWhatFollowsWithinMinutes) {
  int right = 0;
  int told = 0;
  int followed = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    for (const double log_ahead_s : {330.0, -330.0}) {
      DiscrepancyInput input = campaign(Hidden::Nothing, seed);
      const std::vector<double> coolant = switchedCoolant(input.log->time_s().size(), 40 + seed);
      input.log->setSignal("coolant", coolant);
      const std::vector<double> rpm = *input.log->signal("spindle_rpm");
      const double step_s = input.log->time_s()[1] - input.log->time_s()[0];
      for (std::size_t i = 0; i < input.predicted.size(); ++i) {
        Observation& o = input.observations.rows[i];
        if (o.component == Component::EX) {
          input.predicted[i] += 30.0 * lagged(coolant, step_s, 200.0, o.time_s);
          o.value += 30.0 * lagged(coolant, step_s, 200.0, o.time_s + log_ahead_s);
        } else if (o.component == Component::EY) {
          o.value += 5.0 * lagged(coolant, step_s, 900.0, o.time_s + log_ahead_s);
        } else {
          // The spindle's growth goes with the log as well.
          o.value -= input.predicted[i] / 1.006;
          o.value += 2e-3 * lagged(rpm, step_s, 1500.0, o.time_s + log_ahead_s);
          input.predicted[i] = 1.006 * 2e-3 * lagged(rpm, step_s, 1500.0, o.time_s);
        }
      }
      const DiscrepancyResult result = run(input);
      right += result.effects.size() == 1 && result.effects[0].id == "coolant.shock.y" ? 1 : 0;
      told += std::abs(result.clock_offset_s - log_ahead_s) < 2.0 * result.clock_offset_uncertainty_s ? 1 : 0;
      EXPECT_LT(result.clock_offset_uncertainty_s, 100.0);
      followed += says(result, "clock of log and simulation") ? 1 : 0;
    }
  }
  std::printf("right %d of 8, clock told %d of 8\n", right, told);
  EXPECT_GE(followed, 7);
  EXPECT_GE(right, 7);
  EXPECT_GE(told, 7);
}

/// A model that says what time it is, s.
class TimeTeller final : public ErrorModel {
 public:
  [[nodiscard]] std::string description() const override { return "time"; }
  [[nodiscard]] PredictedComponent predict(const DeviationQuery& query, Component) const override {
    return {query.time_s, 0.5};
  }
};

TEST(SimulationClock, AModelIsAskedByTheClockOfTheObservations) {
  const SimulationOfOtherClock model(std::make_shared<TimeTeller>(), -7200.0);
  DeviationQuery query;
  query.time_s = 9000.0;
  EXPECT_DOUBLE_EQ(model.predict(query, Component::EX).value, 1800.0);
  EXPECT_DOUBLE_EQ(model.predict(query, Component::EX).sigma, 0.5);
}

TEST(SimulationClock, OfTheFilesOfACampaign) {
  // The computer at the microscope is two hours ahead of the control, whose log the simulation was computed from.
  const testing::TempFolder folder;
  folder.write("machine.json", machine_json);
  folder.write("campaign.json", R"({"format":"spindrift-campaign","version":1,"name":"c",
    "start_utc":"2026-01-31T08:00:00Z","simulation":"simulation.csv"})");
  PredictedAt predicted;
  const DiscrepancyInput made = stampedLate(Hidden::SpindleDrift, 3, 7200.0, predicted);
  made.observations.write(folder / "observations.csv");
  std::string simulation = "time_s,point,component,predicted\n";
  for (std::size_t i = 0; i < made.predicted.size(); ++i) {
    const Observation& o = made.observations.rows[i];
    simulation += fmt::format("{},{},{},{}\n", o.time_s - 7200.0, o.point, toString(o.component), made.predicted[i]);
  }
  folder.write("simulation.csv", simulation);
  std::string log = "time_s";
  for (const std::string& name : made.log->names()) log += "," + name;
  for (std::size_t k = 0; k < made.log->time_s().size(); ++k) {
    log += fmt::format("\n{}", made.log->time_s()[k]);
    for (const std::string& name : made.log->names()) log += fmt::format(",{}", (*made.log->signal(name))[k]);
  }
  folder.write("log.csv", log + "\n");

  const Campaign read = Campaign::read(folder.path());
  const DiscrepancyInput input = discrepancyInput(read, ObservationSet::read(folder / "observations.csv"));
  EXPECT_NEAR(input.log_clock_s, -7200.0, 3.0 * input.log_clock_uncertainty_s);
  // Told by the clock of the observations: nothing is moved but what they are compared with.
  EXPECT_EQ(input.observations.rows.front().time_s, 7200.0);
  const DiscrepancyResult result = run(input);
  ASSERT_EQ(result.effects.size(), 1u);
  EXPECT_EQ(result.effects[0].id, "spindle.drift.y");
  EXPECT_TRUE(says(result, "so they are compared with simulation and log at that time"));
}

TEST(LogClock, OfACoolantThatActsWithinMinutes) {
  // By a programme that does not repeat; the readings are stamped two hours late.
  DiscrepancyInput input = campaign(Hidden::Nothing, 9);
  const std::vector<double>& time_s = input.log->time_s();
  const std::vector<double> coolant = switchedCoolant(time_s.size(), 3);
  input.log->setSignal("coolant", coolant);
  const double step_s = time_s[1] - time_s[0];
  for (Observation& o : input.observations.rows) {
    if (o.component != Component::EX) continue;
    o.value += 6.0 * lagged(coolant, step_s, 500.0, o.time_s - 7200.0);
  }
  const DiscrepancyResult result = run(input);
  ASSERT_EQ(result.effects.size(), 1u);
  EXPECT_EQ(result.effects[0].id, "coolant.shock.x");
  EXPECT_NEAR(result.clock_offset_s, -7200.0, 3.0 * result.clock_offset_uncertainty_s);
  EXPECT_TRUE(says(result, "behind that of the observations"));
}

/// A campaign of three hours: two hours later the log says something of a third of it, four hours later of nothing.
TEST(LogClock, IsNotTriedBeyondTheEndsOfTheLog) {
  DiscrepancyInput input;
  input.log = OperatingLog({0.0, 5400.0, 10800.0});
  for (int k = 0; k < 10; ++k) {
    Observation o;
    o.time_s = 1000.0 * k;
    input.observations.rows.push_back(o);
  }
  for (const double offset_s : {0.0, 4000.0, -4000.0}) EXPECT_TRUE(logCovers(input, offset_s)) << offset_s;
  for (const double offset_s : {7200.0, -7200.0, 14400.0, -14400.0})
    EXPECT_FALSE(logCovers(input, offset_s)) << offset_s;
  input.log.reset();
  EXPECT_TRUE(logCovers(input, 14400.0));
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

TEST(LogClock, IsNotMovedForALoadThatBeginsAtAFullHour) {
  // An instrument that is on from the first row of the log explains as much, if the log begins an hour later.
  constexpr double lag_s = 3860.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const double onset_s = 3600.0 + 20.0 * (static_cast<double>(seed % 4) - 1.0);
    DiscrepancyInput input = campaign(Hidden::Nothing, seed);
    if (seed > 4) input.log->setSignal("instrument_on", std::vector<double>(input.log->time_s().size(), 1.0));
    for (Observation& o : input.observations.rows) {
      if (o.component == Component::EZ && o.time_s > onset_s)
        o.value += 20.0 * (1.0 - std::exp(-(o.time_s - onset_s) / lag_s));
    }
    const DiscrepancyResult result = run(input);
    EXPECT_LT(std::abs(result.clock_offset_s), 600.0) << seed << result.summary();
    ASSERT_EQ(result.effects.size(), 1U) << seed << result.summary();
    EXPECT_EQ(result.effects[0].id, "external_heat.z") << seed << result.summary();
  }
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
