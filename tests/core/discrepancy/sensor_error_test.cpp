// SPDX-License-Identifier: GPL-3.0-or-later
// Sensors are read with noise and in steps. What that leaves in the course of a driver is known, and no reason to
// believe in heat that nobody logged.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/discrepancy/catalogue.h"
#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/drivers.h"
#include "core/discrepancy/effect_search.h"
#include "tests/core/discrepancy/small_plant.h"

namespace spindrift {
namespace {

using small_plant::machine;
using small_plant::run;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr double step_s = 15.0;
constexpr int rows = 640;
constexpr double sigma_um = 0.4;
constexpr double lag_s = 1500.0;

/// The walls of a column: the front warms by a kelvin through the spindle's heat, both follow the room.
struct Walls {
  std::vector<double> time_s, rpm, front, rear;
};

Walls walls(Random& random) {
  Walls out;
  double front = 0.0;
  double rear = 0.0;
  double rpm = 0.0;
  const double phase = random.uniform(0.0, 3.0);
  for (int i = 0; i < rows; ++i) {
    const double t = step_s * i;
    if (i % 90 == 20) rpm = 1000.0 * static_cast<double>(random.index(7));
    const double room = 0.4 * std::sin(t / 5000.0 + phase) - 0.4 * std::sin(phase);
    out.time_s.push_back(t);
    out.rpm.push_back(rpm);
    out.front.push_back(front);
    out.rear.push_back(rear);
    front += step_s * (0.35 * rpm * 1e-3 + room - front) / 2400.0;
    rear += step_s * (room - rear) / 4500.0;
  }
  return out;
}

std::vector<double> read(const std::vector<double>& rise, double noise, double resolution, Random& random) {
  std::vector<double> out;
  for (const double value : rise)
    out.push_back(resolution * std::round((21.3 + value + random.normal(0.0, noise)) / resolution));
  return out;
}

/// Both walls bend the column towards X at once; read in steps of 0.05 and 0.1 K.
DiscrepancyInput coarselyRead(std::uint64_t seed, double bending_um) {
  Random random(seed);
  const Walls w = walls(random);
  DiscrepancyInput input;
  input.machine = machine();
  OperatingLog log(w.time_s);
  log.setSignal("spindle_rpm", w.rpm);
  log.setSignal("T_column_front_degC", read(w.front, 0.01, 0.05, random));
  log.setSignal("T_column_rear_degC", read(w.rear, 0.01, 0.1, random));
  input.log = log;
  for (int state = 0; state < 36; ++state) {
    for (int p = 0; p < 12; ++p) {
      for (const Component c : {Component::EX, Component::EY}) {
        Observation o;
        o.time_s = 260.0 * state + 10.0 * p;
        const auto at = static_cast<std::size_t>(o.time_s / step_s);
        o.state = "M" + std::to_string(state);
        o.point = "P" + std::to_string(p);
        o.position_mm = {40.0 * (p % 5), 70.0 * (p % 4), 36.0 * p};
        o.component = c;
        o.sigma = sigma_um;
        const double height = (o.position_mm.z() + 180.0) / 600.0;
        o.value = random.normal(0.0, sigma_um);
        if (c == Component::EX) o.value += bending_um * (w.front[at] - w.rear[at]) * height * height;
        input.observations.rows.push_back(o);
        input.predicted.push_back(0.0);
      }
    }
  }
  return input;
}

std::vector<std::string> named(const DiscrepancyResult& result) {
  std::vector<std::string> out;
  for (const FoundEffect& effect : result.effects) out.push_back(effect.id);
  return out;
}

TEST(SensorError, OfADifferenceIsThatOfBothAndALagAveragesIt) {
  constexpr double noise = 0.05;
  double errors = 0.0;
  double lagged_errors = 0.0;
  double stated = 0.0;
  double lagged_stated = 0.0;
  constexpr int trials = 30;
  const EffectVariant at_once{{{"column_difference", Dynamics::None}}, false};
  const EffectVariant lagged{{{"column_difference", Dynamics::Lag}}, false};
  for (std::uint64_t seed = 1; seed <= trials; ++seed) {
    Random random(seed);
    const Walls w = walls(random);
    const auto tableOf = [&](double sigma, double resolution) {
      OperatingLog log(w.time_s);
      log.setSignal("T_column_front_degC", read(w.front, sigma, resolution, random));
      log.setSignal("T_column_rear_degC", read(w.rear, sigma, resolution, random));
      return DriverTable(machine(), &log);
    };
    const DriverTable clean = tableOf(0.0, 1e-6);
    const DriverTable noisy = tableOf(noise, 1e-6);
    const auto add = [&](const EffectVariant& variant, const std::vector<double>& parameters, double& sum,
                         double& sum_stated) {
      const Eigen::VectorXd difference = inputResponses(noisy, variant, parameters, w.time_s).col(0) -
                                         inputResponses(clean, variant, parameters, w.time_s).col(0);
      const ResponseError error = responseError(noisy, variant, parameters, 0);
      // A constant is seen by nobody; the error of the start is told on its own.
      Eigen::VectorXd start = Eigen::VectorXd::Zero(rows);
      for (int i = 0; i < rows && error.tau_s > 0.0; ++i) start[i] = std::exp(-step_s * i / error.tau_s);
      start.array() -= start.mean();
      const double from_start = std::pow(error.start, 2) * start.squaredNorm() / rows;
      sum += (difference.array() - difference.mean()).matrix().squaredNorm() / rows;
      sum_stated += std::pow(error.standard_deviation, 2) + from_start;
    };
    add(at_once, {}, errors, stated);
    add(lagged, {lag_s}, lagged_errors, lagged_stated);
    const ResponseError slow = responseError(noisy, lagged, std::vector<double>{lag_s}, 0);
    EXPECT_GT(slow.time_s, lag_s);
  }
  // Where a wall begins to warm the smoother rounds it off, which its noise does not tell.
  EXPECT_NEAR(std::sqrt(errors / stated), 1.25, 0.25);
  EXPECT_NEAR(std::sqrt(lagged_errors / lagged_stated), 1.0, 0.3);
}

TEST(SensorError, NoLoadFromOutsideIsNamedForStepsOfASensor) {
  int right = 0;
  constexpr int campaigns = 8;
  for (std::uint64_t seed = 1; seed <= campaigns; ++seed) {
    SCOPED_TRACE(seed);
    DiscrepancyOptions options;
    options.suggest = false;
    const std::vector<std::string> names = named(run(coarselyRead(seed, 10.0), options));
    EXPECT_THAT(names, Not(Contains(StartsWith("external_heat."))));
    right += names == std::vector<std::string>{"column.bending.b"} ? 1 : 0;
  }
  EXPECT_GE(right, 7);
}

TEST(SensorError, CastingsTakeMinutesToTakeUpHeat) {
  const DiscrepancyInput input = coarselyRead(3, 0.0);
  std::vector<std::size_t> every(input.observations.rows.size());
  std::iota(every.begin(), every.end(), std::size_t{0});
  const ResidualProblem problem(input, every, 3000);
  const DriverTable drivers(input.machine, &*input.log);
  const std::vector<Effect> all = effectsOfMachine(input.machine, {});
  const EffectSearch search(problem, drivers, all);
  int loads = 0;
  for (const Effect& effect : all) {
    if (!effect.id.starts_with("external_heat.")) continue;
    ++loads;
    for (const double tau_s : search.pulseLagsOf(effect)) EXPECT_GE(tau_s, 180.0) << effect.id;
    const ModelTerm term{&effect, effect.variants.front(), {1000.0, 2000.0, 600.0}};
    EXPECT_EQ(search.parameterBounds(term, 2).first, 180.0) << effect.id;
    EXPECT_EQ(search.parameterBounds(term, 0).first, problem.node_time_s.front()) << effect.id;
  }
  EXPECT_EQ(loads, 3);
}

TEST(SensorError, WhatOneStateAloneShowsIsNoLoad) {
  // A kick of five minutes between two states, which nothing in the log explains.
  DiscrepancyInput input = coarselyRead(3, 0.0);
  for (Observation& o : input.observations.rows) {
    if (o.state == "M17" && o.component == Component::EX)
      o.value += 6.0 * sigma_um * std::pow((o.position_mm.z() + 180.0) / 600.0, 2);
  }
  const DiscrepancyResult result = run(input);
  EXPECT_THAT(named(result), IsEmpty());
}

}  // namespace
}  // namespace spindrift
