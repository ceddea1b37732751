// SPDX-License-Identifier: GPL-3.0-or-later
// Evidence where an onset is searched, and whether what is suggested to be measured next really separates rivals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/discrepancy/discrepancy_search.h"
#include "tests/core/discrepancy/small_plant.h"

namespace spindrift {
namespace {

using namespace small_plant;

/// The p-value of the best pulse of external_heat.z in a campaign.
double pulsePValue(const DiscrepancyInput& input) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < input.predicted.size(); ++i) {
    if (input.observations.rows[i].use == ObservationUse::Fit) rows.push_back(i);
  }
  ResidualProblem problem(input, rows, 3000);
  const DriverTable drivers(input.machine, &*input.log);
  CatalogueContext context;
  context.machine = &input.machine;
  context.drivers = &drivers;
  const std::vector<Effect> catalogue = effectCatalogue(context);
  const EffectSearch search(problem, drivers, catalogue);
  problem.setNuisances(problem.simulationNuisances(input.simulation_gain_uncertainty));
  problem.setNoise(estimateNoise(problem, problem.y, false));
  return onsetPValue(search, problem, search.best(*search.find("external_heat.z")));
}

TEST(OnsetSignificance, IsRareByChanceAlthoughManyOnsetsAreTried) {
  for (const double ar1 : {0.0, 0.9}) {
    int below_tenth = 0;
    int below_hundredth = 0;
    constexpr int trials = 30;
    for (std::uint64_t seed = 0; seed < trials; ++seed) {
      DiscrepancyInput input = campaign(Hidden::Nothing, 500 + seed);
      if (ar1 > 0.0) {
        // Replaces the noise by one that is correlated from state to state within each series of 18.
        Random random(900 + seed);
        std::vector<double> slow(18);
        for (std::size_t i = 0; i < input.predicted.size(); ++i) {
          double& s = slow[i % 18];
          s = i < 18 ? random.normal() : ar1 * s + std::sqrt(1.0 - ar1 * ar1) * random.normal();
          input.observations.rows[i].value = input.predicted[i] + 0.5 * s;
        }
      }
      const double p = pulsePValue(input);
      below_tenth += p < 0.1 ? 1 : 0;
      below_hundredth += p < 0.01 ? 1 : 0;
    }
    EXPECT_LE(below_tenth, 9) << "ar1 " << ar1;      // 3 expected
    EXPECT_LE(below_hundredth, 2) << "ar1 " << ar1;  // 0.3 expected
  }
}

TEST(OnsetSignificance, SeesAPulseOfTwiceTheNoise) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    DiscrepancyInput input = campaign(Hidden::Nothing, 600 + seed);
    for (Observation& o : input.observations.rows) {
      if (o.component == Component::EZ && o.time_s > 9000.0 && o.time_s < 22000.0) o.value += 1.0;
    }
    EXPECT_LT(pulsePValue(input), 1e-4);
  }
}

/// Adds steps of `um` to EZ of all points at the times given.
DiscrepancyInput withJumps(std::uint64_t seed, const std::vector<std::pair<double, double>>& jumps) {
  DiscrepancyInput input = campaign(Hidden::Nothing, seed);
  for (Observation& o : input.observations.rows) {
    if (o.component != Component::EZ) continue;
    for (const auto& [time_s, um] : jumps) o.value += o.time_s > time_s ? um : 0.0;
  }
  return input;
}

TEST(OnsetSignificance, NamesNothingThatLeavesTheLikeOfItself) {
  int heat_from_outside = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    JobContext job;
    DiscrepancyInput jumps = withJumps(700 + seed, {{8000.0, 4.0}, {17000.0, 2.0}, {25000.0, -4.4}});
    const DiscrepancyResult by_two = findDiscrepancy(jumps, {}, job);
    EXPECT_TRUE(by_two.effects.empty()) << "seed " << seed << ": " << by_two.effects.front().id;
    // With a log of the coolant a second pulse of the same shape is none of the effects any more.
    std::vector<double> coolant;
    for (std::size_t i = 0; i < jumps.log->time_s().size(); ++i) coolant.push_back(i % 200 < 60 ? 1.0 : 0.0);
    jumps.log->setSignal("coolant", coolant);
    const DiscrepancyResult by_one = findDiscrepancy(jumps, {}, job);
    EXPECT_TRUE(by_one.effects.empty()) << "seed " << seed << ": " << by_one.effects.front().id;
    EXPECT_EQ(by_one.verdict, DiscrepancyVerdict::Unknown);
    const DiscrepancyResult one = findDiscrepancy(withJumps(700 + seed, {{9000.0, 2.5}, {22000.0, -2.5}}), {}, job);
    heat_from_outside += one.effects.size() == 1 && one.effects[0].id == "external_heat.z" ? 1 : 0;
  }
  EXPECT_GE(heat_from_outside, 3);
}

TEST(NoiseEstimate, FindsTheCorrelationFromStateToState) {
  for (const double ar1 : {0.0, 0.3, 0.6, 0.9}) {
    for (const bool fitted : {false, true}) {
      double mean = 0.0;
      double square = 0.0;
      constexpr int trials = 24;
      for (std::uint64_t seed = 0; seed < trials; ++seed) {
        DiscrepancyInput input = campaign(Hidden::Nothing, 800 + seed);
        Random random(1200 + seed);
        std::vector<double> slow(18);
        std::vector<std::size_t> rows;
        for (std::size_t i = 0; i < input.predicted.size(); ++i) {
          double& s = slow[i % 18];
          s = i < 18 ? random.normal() : ar1 * s + std::sqrt(1.0 - ar1 * ar1) * random.normal();
          input.observations.rows[i].value = input.predicted[i] + 0.5 * s;
          if (input.observations.rows[i].use == ObservationUse::Fit) rows.push_back(i);
        }
        ResidualProblem problem(input, rows, 3000);
        const NoiseModel noise = estimateNoise(problem, problem.y, fitted);
        EXPECT_NEAR(noise.scale, 1.0, 0.35);
        const double found = noise.correlated_part > 0.0
                                 ? noise.correlated_part * std::exp(-44.0 * 30.0 / noise.correlation_time_s)
                                 : 0.0;
        mean += found / trials;
        square += (found - ar1) * (found - ar1) / trials;
      }
      EXPECT_NEAR(mean, ar1, 0.15) << "fitted " << fitted;
      EXPECT_LT(std::sqrt(square), 0.24) << "ar1 " << ar1 << " fitted " << fitted;
    }
  }
}

/// Spindle and coolant run together but for an hour and a half late in the programme, and only the first five hours are
/// measured: a drift along X may come from either.
struct TiedCampaign {
  DiscrepancyInput input;
  std::vector<double> drift;  // truth, um, every 30 s

  explicit TiedCampaign(std::uint64_t seed) : random_(seed) {
    input.machine = machine();
    std::vector<double> time, rpm, coolant, room;
    double heat = 0.0;
    double body = 0.0;
    double speed = 0.0;
    for (int i = 0; i < 1440; ++i) {
      const double t = 30.0 * i;
      if (i % 80 == 40) speed = random_.uniform() < 0.5 ? 0.0 : 3000.0;
      const bool apart = t > 29000.0 && t < 34500.0;
      time.push_back(t);
      rpm.push_back(apart ? 0.0 : speed);
      coolant.push_back(apart || speed > 0.0 ? 1.0 : 0.0);
      room.push_back(20.0 + std::sin(t / 8000.0) + random_.normal(0.0, 0.05));
      drift.push_back(body);
      heat += 30.0 * (4.0 * rpm.back() / 3000.0 - heat) / 700.0;
      body += 30.0 * (heat - body) / 1500.0;
    }
    OperatingLog log(time);
    log.setSignal("spindle_rpm", rpm);
    log.setSignal("coolant", coolant);
    log.setSignal("T_room_degC", room);
    input.log = log;
    for (int state = 0; state < 16; ++state) {
      for (int point = 1; point <= 4; ++point) {
        measure(1100.0 * state, "F" + std::to_string(point), {110.0 * point, 90.0 * point, 60.0 * point},
                "M" + std::to_string(state));
      }
    }
  }

  void measure(double t, const std::string& point, const Eigen::Vector3d& place, const std::string& state) {
    for (int c = 0; c < 3; ++c) {
      Observation o;
      o.time_s = t;
      o.state = state;
      o.point = point;
      o.position_mm = place;
      o.component = static_cast<Component>(c);
      o.sigma = 0.6;
      const auto at = std::min<std::size_t>(drift.size() - 1, static_cast<std::size_t>(t / 30.0));
      o.value = (c == 0 ? drift[at] : 0.0) + random_.normal(0.0, o.sigma);
      input.observations.rows.push_back(o);
      input.predicted.push_back(0.0);
    }
  }

 private:
  Random random_;
};

/// An outcome with terms that move the given readings.
SearchOutcome outcomeOf(const std::vector<Eigen::VectorXd>& contributions, double leftover_p_value) {
  SearchOutcome outcome;
  outcome.fit.terms.resize(contributions.size());
  outcome.fit.contribution = contributions;
  outcome.evidence.resize(contributions.size());
  for (TermEvidence& e : outcome.evidence) e.delta_bic = 200.0;
  outcome.leftover_p_value = leftover_p_value;
  outcome.unknown_course.advantage = -100.0;
  return outcome;
}

TEST(Confidence, IsThePosteriorOverWhatWasTriedInPlaceOfTheName) {
  const Eigen::VectorXd moves = Eigen::VectorXd::Ones(10);
  SearchOutcome outcome = outcomeOf({moves}, 0.5);
  TermEvidence& evidence = outcome.evidence[0];
  const auto confidence = [&] { return confidenceOf(outcome, evidence, outcome.fit, 0, SearchLimits{}); };
  EXPECT_GT(confidence(), 0.99);
  // One that fits as well takes half, two take two thirds; one that is far behind takes nothing.
  evidence.behind = {{0.0, false}};
  EXPECT_NEAR(confidence(), 0.5, 0.01);
  evidence.behind = {{0.0, false}, {0.0, false}};
  EXPECT_NEAR(confidence(), 1.0 / 3.0, 0.01);
  evidence.behind = {{30.0, false}};
  EXPECT_GT(confidence(), 0.99);
  // A wider effect that fits much better is the likelier cause though the simpler name is given.
  evidence.behind = {{0.0, true}};
  EXPECT_GT(confidence(), 0.9);
  evidence.behind = {{-16.0, true}};
  EXPECT_LT(confidence(), 0.05);
  // The same lead over an effect a hundred times as strong is within what its dynamics may be wrong by.
  evidence.delta_chi2 = 40000.0;
  EXPECT_GT(confidence(), 0.9);
  evidence.behind.clear();
  evidence.rivals.push_back({"ambient.drift.x", 0.0, false, {}, true});
  EXPECT_NEAR(confidence(), 0.5, 0.01);
}

TEST(Confidence, CountsWhatIsLeftAgainstEffectsThatMoveTheSameReadings) {
  Eigen::VectorXd first = Eigen::VectorXd::Zero(10);
  Eigen::VectorXd second = Eigen::VectorXd::Zero(10);
  first.head(5).setOnes();
  second.tail(5).setOnes();
  const auto confidence = [](const SearchOutcome& o) {
    return confidenceOf(o, o.evidence[0], o.fit, 0, SearchLimits{});
  };
  EXPECT_GT(confidence(outcomeOf({first, second}, 1e-5)), 0.98) << "apart";
  EXPECT_LT(confidence(outcomeOf({first, first}, 1e-5)), 0.2) << "stacked";
  EXPECT_GT(confidence(outcomeOf({first, first}, 0.3)), 0.98) << "stacked, nothing left";
}

TEST(Suggestion, SeparatesRivalsFurtherThanAsManyReadingsAtRandom) {
  int ambiguous = 0;
  int by_suggestion = 0;
  int at_random = 0;
  double margin_by_suggestion = 0.0;
  double margin_at_random = 0.0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const TiedCampaign base(seed);
    const DiscrepancyResult first = run(base.input);
    if (first.verdict != DiscrepancyVerdict::Ambiguous || !first.suggestion) continue;
    ++ambiguous;
    EXPECT_GT(first.suggestion->expected_delta_bic, 0.0);
    const auto separated = [&](const std::vector<double>& times) {
      TiedCampaign more = base;
      int state = 100;
      for (const double t : times) {
        for (int point = 1; point <= 3; ++point) {
          more.measure(t, "F" + std::to_string(point), {110.0 * point, 90.0 * point, 60.0 * point},
                       "M" + std::to_string(state));
        }
        ++state;
      }
      const DiscrepancyResult after = run(more.input);
      const bool right = after.effects.size() == 1 && after.effects[0].id == "spindle.drift.x";
      return std::pair{right && after.verdict == DiscrepancyVerdict::Named,
                       right ? std::min(after.effects[0].margin, 500.0) : 0.0};
    };
    const auto [told_apart, margin] = separated(first.suggestion->times_s);
    by_suggestion += told_apart ? 1 : 0;
    margin_by_suggestion += margin;
    Random random(seed * 77);
    std::vector<double> times;
    for (std::size_t i = 0; i < first.suggestion->times_s.size(); ++i) times.push_back(random.uniform(0.0, 43000.0));
    std::sort(times.begin(), times.end());
    const auto [by_chance, chance_margin] = separated(times);
    at_random += by_chance ? 1 : 0;
    margin_at_random += chance_margin;
  }
  EXPECT_GE(ambiguous, 5);
  EXPECT_GE(by_suggestion, ambiguous - 1);
  EXPECT_GE(by_suggestion, at_random);
  EXPECT_GT(margin_by_suggestion, margin_at_random);
  RecordProperty("separated_by_suggestion", by_suggestion);
  RecordProperty("separated_at_random", at_random);
}

}  // namespace
}  // namespace spindrift
