// SPDX-License-Identifier: GPL-3.0-or-later
// Names of two effects of which one could take up the other, and the dynamics that an accepted effect is predicted
// with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/discrepancy/candidate_library.h"
#include "core/discrepancy/catalogue.h"
#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/distributed_dynamics.h"
#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/residual_problem.h"
#include "tests/core/discrepancy/effect_part.h"
#include "tests/core/discrepancy/small_plant.h"

namespace spindrift {
namespace {

using namespace small_plant;
using ::testing::UnorderedElementsAre;

/// Part of the power of the hidden signal over the held-out rows that the effects found explain; both about their mean
/// over the fitted rows of the series.
double heldOutPart(const DiscrepancyInput& input, const std::vector<double>& hidden,
                   const std::vector<double>& estimate) {
  const auto& rows = input.observations.rows;
  std::map<std::pair<std::string, Component>, std::array<double, 3>> means;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].use != ObservationUse::Fit) continue;
    auto& mean = means[{rows[i].point, rows[i].component}];
    mean[0] += 1.0;
    mean[1] += hidden[i];
    mean[2] += estimate[i];
  }
  double left = 0.0;
  double whole = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].use != ObservationUse::Holdout) continue;
    const auto& mean = means.at({rows[i].point, rows[i].component});
    const double h = hidden[i] - mean[1] / mean[0];
    const double e = estimate[i] - mean[2] / mean[0];
    left += (h - e) * (h - e);
    whole += h * h;
  }
  return 1.0 - left / whole;
}

TEST(TwoEffects, AreBothNamedWhereAFurtherDriverOfTheOneCouldTakeUpTheOther) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const DiscrepancyResult result = run(campaign(Hidden::TurnAndDrift, seed));
    std::vector<std::string> names;
    for (const FoundEffect& effect : result.effects) names.push_back(effect.id);
    EXPECT_THAT(names, UnorderedElementsAre("frame.rotation.a", "spindle.drift.y")) << "seed " << seed;
  }
}

/// A spindle that grows with its speed through one lag (exact for what is constant from row to row), by the clock of
/// the log.
DiscrepancyInput growthThroughOneLag(std::uint64_t seed, double tau_s, double um_per_krpm) {
  DiscrepancyInput input = campaign(Hidden::Nothing, seed);
  const std::vector<double>& time = input.log->time_s();
  const std::vector<double>& rpm = *input.log->signal("spindle_rpm");
  std::vector<double> state(time.size(), 0.0);
  for (std::size_t i = 0; i + 1 < time.size(); ++i) {
    state[i + 1] = state[i] + (rpm[i] * 1e-3 - state[i]) * (1.0 - std::exp(-(time[i + 1] - time[i]) / tau_s));
  }
  for (Observation& o : input.observations.rows) {
    if (o.component != Component::EZ) continue;
    const auto at = static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), o.time_s) - time.begin());
    o.value += um_per_krpm * state[at];
  }
  return input;
}

TEST(Dynamics, OfOneLagAreToldAsOneLagByTheRightClock) {
  // Lags between those of the grid, strong enough for the difference to matter.
  for (const double tau_s : {700.0, 1310.0, 1500.0, 2600.0}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      SCOPED_TRACE(std::to_string(tau_s) + " s, seed " + std::to_string(seed));
      const DiscrepancyResult result = run(growthThroughOneLag(seed, tau_s, 8.0));
      ASSERT_EQ(result.effects.size(), 1U);
      EXPECT_EQ(result.effects[0].id, "spindle.growth.z");
      EXPECT_EQ(result.effects[0].drivers.find('+'), std::string::npos) << result.effects[0].drivers;
      int lags = 0;
      for (const FittedParameter& p : result.effects[0].parameters) {
        if (p.name.find("tau") == std::string::npos) continue;
        ++lags;
        EXPECT_NEAR(p.value, tau_s, 4.0 * p.standard_uncertainty + 0.01 * tau_s) << p.name;
      }
      EXPECT_EQ(lags, 1);
      EXPECT_EQ(result.clock_offset_s, 0.0);
    }
  }
}

TEST(Dynamics, OfASpindleThatRanOnceAreNotTakenForALoadOfUnknownOnset) {
  // Forty times the noise, through a lag between those of the grid; the sensor sees it five minutes later.
  constexpr double lag_s = 2400.0;
  for (std::uint64_t seed = 61; seed <= 64; ++seed) {
    SCOPED_TRACE(seed);
    DiscrepancyInput input = campaign(Hidden::Nothing, seed);
    Random random(seed);
    std::vector<double> rpm;
    std::vector<double> grown;
    std::vector<double> seen;
    double state = 0.0;
    for (const double t : input.log->time_s()) {
      const std::size_t row = grown.size();
      if (row > 0) state += (rpm.back() * 1e-3 - state) * (1.0 - std::exp(-30.0 / lag_s));
      rpm.push_back(t < 1800.0 || t >= 14400.0 ? 0.0 : 6000.0);
      grown.push_back(state);
      seen.push_back(22.0 + 1.4 * (row < 10 ? 0.0 : grown[row - 10]) + random.normal(0.0, 0.02));
    }
    input.log->setSignal("spindle_rpm", rpm);
    input.log->setSignal("T_spindle_degC", seen);
    const std::vector<double>& time = input.log->time_s();
    for (Observation& o : input.observations.rows) {
      const auto at = static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), o.time_s) - time.begin());
      if (o.component == Component::EZ) o.value += 3.5 * grown[at];
    }
    const DiscrepancyResult result = run(std::move(input));
    ASSERT_EQ(result.effects.size(), 1U);
    EXPECT_EQ(result.effects[0].id, "spindle.growth.z");
    EXPECT_GT(result.effects[0].confidence, 0.8);
    EXPECT_EQ(result.effects[0].drivers.find('+'), std::string::npos) << result.effects[0].drivers;
    EXPECT_EQ(result.clock_offset_s, 0.0);
  }
}

TEST(Dynamics, OfAHeatedScrewPredictHeldOutStates) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    std::vector<double> hidden;
    const DiscrepancyInput input = campaign(Hidden::Screw, seed, 8.0, &hidden);
    const DiscrepancyResult result = run(input);
    EXPECT_GT(heldOutPart(input, hidden, result.effect_part), 0.9) << "seed " << seed;
  }
}

TEST(Dynamics, OfTheModelAreThoseOfThePrediction) {
  const DiscrepancyInput input = campaign(Hidden::TurnAndDrift, 2);
  const DiscrepancyResult result = run(input);
  ASSERT_NE(result.model, nullptr);
  const std::vector<double> part = effectPart(*result.model, input.observations.rows);
  ASSERT_EQ(part.size(), result.effect_part.size());
  for (std::size_t i = 0; i < part.size(); i += 7) EXPECT_NEAR(part[i], result.effect_part[i], 1e-9);
  const auto query = DeviationQuery::of(input.observations.rows.back());
  const PredictedComponent predicted = result.model->predict(query, input.observations.rows.back().component);
  EXPECT_NEAR(predicted.value, part.back(), 1e-9);
  EXPECT_GT(predicted.sigma, 0.0);
}

/// The drift of the spindle, driven by one signal with a lag, with a covariance of gain and lag.
ModelEffect drivenBy(const DiscrepancyInput& input, const DriverTable& drivers, const char* driver, double tau_s,
                     double gain) {
  CatalogueContext context;
  context.machine = &input.machine;
  context.drivers = &drivers;
  ModelEffect effect;
  for (const Effect& e : effectCatalogue(context)) {
    if (e.id == "spindle.drift.y") effect.effect = e;
  }
  effect.variant = {{{driver, Dynamics::Lag}}, false};
  effect.parameters = {tau_s};
  effect.gains = Eigen::VectorXd::Constant(1, gain);
  effect.covariance = (Eigen::Matrix2d() << 0.01, 0.2, 0.2, 900.0).finished();
  return effect;
}

TEST(Dynamics, OfSeveralPossibleDriversAreAveragedWithTheScatterAmongThem) {
  const DiscrepancyInput input = campaign(Hidden::SpindleDrift, 1);
  const auto drivers = std::make_shared<const DriverTable>(input.machine, &*input.log);
  const ModelEffect heat = drivenBy(input, *drivers, "spindle_rpm^1", 1800.0, 0.8);
  const ModelEffect bearing = drivenBy(input, *drivers, "T_spindle_degC", 600.0, 0.2);
  const auto& rows = input.observations.rows;
  const std::vector<double> by_heat = effectPart(EffectModel(drivers, {heat}), rows);
  const std::vector<double> by_bearing = effectPart(EffectModel(drivers, {bearing}), rows);
  const std::vector<double> sigma_heat = EffectModel(drivers, {heat}).effectSigma(rows);
  const std::vector<double> sigma_bearing = EffectModel(drivers, {bearing}).effectSigma(rows);
  const EffectModel mean(drivers, averagedEffects({{heat}, {bearing}}, {0.7, 0.3}));
  const std::vector<double> part = effectPart(mean, rows);
  const std::vector<double> sigma = mean.effectSigma(rows);
  for (std::size_t i = 0; i < rows.size(); i += 5) {
    EXPECT_NEAR(part[i], 0.7 * by_heat[i] + 0.3 * by_bearing[i], 1e-9);
    const double apart = by_heat[i] - by_bearing[i];
    const double variance =
        0.7 * sigma_heat[i] * sigma_heat[i] + 0.3 * sigma_bearing[i] * sigma_bearing[i] + 0.7 * 0.3 * apart * apart;
    EXPECT_NEAR(sigma[i], std::sqrt(variance), 1e-3 + 0.02 * std::sqrt(variance));
  }
}

TEST(Dynamics, OfEqualVersionsAreOneVersion) {
  const DiscrepancyInput input = campaign(Hidden::SpindleDrift, 1);
  const auto drivers = std::make_shared<const DriverTable>(input.machine, &*input.log);
  const ModelEffect heat = drivenBy(input, *drivers, "spindle_rpm^1", 1800.0, 0.8);
  const std::vector<ModelEffect> mean = averagedEffects({{heat}, {heat}}, {0.5, 0.5});
  ASSERT_EQ(mean.size(), 1u);
  EXPECT_EQ(mean[0].variant.inputs.size(), 1u);
  EXPECT_DOUBLE_EQ(mean[0].gains[0], 0.8);
  EXPECT_LT((mean[0].covariance - heat.covariance).norm(), 1e-9 * heat.covariance.norm());
}

TEST(Dynamics, TryEveryDriverThatTheDataAllow) {
  const DiscrepancyInput input = campaign(Hidden::SpindleDrift, 2, 1.5);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < input.observations.rows.size(); ++i) {
    if (input.observations.rows[i].use == ObservationUse::Fit) rows.push_back(i);
  }
  const DriverTable drivers(input.machine, &*input.log);
  ResidualProblem problem(input, rows, 3000);
  problem.setNuisances(problem.simulationNuisances(0.01));
  CatalogueContext context;
  context.machine = &input.machine;
  context.drivers = &drivers;
  const std::vector<Effect> catalogue = effectCatalogue(context);
  const EffectSearch search(problem, drivers, catalogue);
  JobContext job;
  const CandidateLibrary library(search, problem, job);
  std::vector<std::string> others;
  for (const Effect& effect : catalogue) {
    if (effect.id != "spindle.drift.y") others.push_back(effect.id);
  }
  CandidateLibrary::Given nothing{Eigen::MatrixXd(problem.projectedResidual().size(), 0), problem.projectedResidual()};
  const std::vector<CandidateFit> candidates = library.sweep(nothing, others, job);
  ASSERT_EQ(candidates.size(), 1u);
  const auto versions = alternativeDynamics(search, problem, drivers, search.refine({candidates[0].term}, 2));
  ASSERT_GT(versions.size(), 1u) << "bearing temperature and powers of the speed fit alike at this strength";
  double sum = 0.0;
  for (std::size_t v = 0; v < versions.size(); ++v) {
    sum += versions[v].weight;
    EXPECT_LE(versions[v].weight, versions[v == 0 ? 0 : v - 1].weight);
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

}  // namespace
}  // namespace spindrift
