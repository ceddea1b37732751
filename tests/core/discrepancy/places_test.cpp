// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/discrepancy/drivers.h"
#include "core/discrepancy/places.h"
#include "tests/core/discrepancy/small_plant.h"

namespace spindrift {
namespace {

using namespace small_plant;
using ::testing::Contains;
using ::testing::UnorderedElementsAre;

/// The same noise in every component.
NoiseModel noiseOf(double scale, double correlated_part, double correlation_time_s) {
  NoiseModel out;
  out.component.fill({scale, 0.0, 0.0, correlated_part, correlation_time_s});
  return out;
}

/// Noise alone (part of it correlated in time) in place of the observations, with `added` on top.
std::vector<DisagreementPlace> placesOf(std::uint64_t seed, const NoiseModel& noise, auto&& added) {
  DiscrepancyInput input = campaign(Hidden::Nothing, 3);
  Random random(seed);
  std::map<std::pair<std::string, Component>, std::pair<double, double>> last;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < input.observations.rows.size(); ++i) {
    Observation& o = input.observations.rows[i];
    const auto [at, fresh] = last.try_emplace({o.point, o.component}, o.time_s, random.normal());
    auto& [time, slow] = at->second;
    if (!fresh && noise.component[0].correlated_part > 0.0) {
      const double phi = std::exp(-(o.time_s - time) / noise.component[0].correlation_time_s);
      slow = phi * slow + std::sqrt(1.0 - phi * phi) * random.normal();
    }
    time = o.time_s;
    const double unit = std::sqrt(noise.component[0].correlated_part) * slow +
                        std::sqrt(1.0 - noise.component[0].correlated_part) * random.normal();
    o.value = input.predicted[i] + o.sigma * unit + added(o);
    rows.push_back(i);
  }
  ResidualProblem problem(input, rows, 3000);
  problem.setNoise(noise);
  const DriverTable drivers(input.machine, &*input.log);
  return findPlaces(problem, drivers, problem.projectedResidual().head(problem.size()));
}

TEST(Places, AreNoneInNoiseAlsoWhereItIsCorrelatedInTime) {
  int found = 0;
  constexpr int draws = 60;
  for (int seed = 0; seed < draws; ++seed) {
    const NoiseModel noise = seed % 2 == 0 ? NoiseModel{} : noiseOf(1.0, 0.9, 4000.0);
    const auto places = placesOf(100 + static_cast<std::uint64_t>(seed), noise, [](const Observation&) { return 0.0; });
    found += places.empty() ? 0 : 1;
  }
  EXPECT_LE(found, 3);  // 0.6 are expected at a level of 1 %
}

TEST(Places, AreTheSpanOfTimeAndThePointsThatDeviate) {
  // F2 and F5 leave their place in Y for three and a half hours.
  const auto places = placesOf(7, {}, [](const Observation& o) {
    const bool there = o.point == "F2" || o.point == "F5";
    return there && o.component == Component::EY && o.time_s > 15000.0 && o.time_s < 28000.0 ? 3.0 : 0.0;
  });
  ASSERT_FALSE(places.empty());
  EXPECT_EQ(places[0].component, Component::EY);
  EXPECT_THAT(places[0].points, UnorderedElementsAre("F2", "F5"));
  EXPECT_NEAR(places[0].from_s, 15000.0, 2.0 * 44.0 * 30.0);
  EXPECT_NEAR(places[0].to_s, 28000.0, 2.0 * 44.0 * 30.0);
  EXPECT_LT(places[0].p_value, 1e-6);
  for (const DisagreementPlace& place : places) EXPECT_EQ(place.component, Component::EY);
}

TEST(Places, AreTwoSpansWhereTheDeviationComesTwice) {
  const auto places = placesOf(9, {}, [](const Observation& o) {
    const bool first = o.time_s > 5000.0 && o.time_s < 10000.0;
    const bool second = o.time_s > 30000.0 && o.time_s < 36000.0;
    return o.component == Component::EX && (first || second) ? (first ? 2.5 : -2.5) : 0.0;
  });
  std::vector<std::pair<double, double>> spans;
  for (const DisagreementPlace& place : places) {
    if (place.condition.empty()) spans.emplace_back(place.from_s, place.to_s);
  }
  std::sort(spans.begin(), spans.end());
  ASSERT_EQ(spans.size(), 2u);
  EXPECT_NEAR(spans[0].first, 5000.0, 2700.0);
  EXPECT_NEAR(spans[0].second, 10000.0, 2700.0);
  EXPECT_NEAR(spans[1].first, 30000.0, 2700.0);
  EXPECT_NEAR(spans[1].second, 36000.0, 2700.0);
}

TEST(Places, NameTheRegionBesideTheCondition) {
  const DiscrepancyInput input = campaign(Hidden::Nothing, 3);
  const auto places = placesOf(11, {}, [&](const Observation& o) {
    const bool turning = input.log->at("spindle_rpm", o.time_s) > 0.0;
    return o.component == Component::EZ && turning && o.position_mm.z() > 150.0 ? 3.0 : 0.0;
  });
  std::vector<std::string> conditions;
  for (const DisagreementPlace& place : places) {
    EXPECT_EQ(place.component, Component::EZ);
    if (!place.condition.empty()) conditions.push_back(place.condition.substr(0, 7));
  }
  EXPECT_THAT(conditions, Contains("z above"));
}

}  // namespace
}  // namespace spindrift
