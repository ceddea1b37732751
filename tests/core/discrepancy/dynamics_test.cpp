// SPDX-License-Identifier: GPL-3.0-or-later
// Names of two effects of which one could take up the other, and the dynamics that an accepted effect is predicted
// with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>

#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/residual_problem.h"
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
  const std::vector<double> part = result.model->effectPart(input.observations.rows);
  ASSERT_EQ(part.size(), result.effect_part.size());
  for (std::size_t i = 0; i < part.size(); i += 7) EXPECT_NEAR(part[i], result.effect_part[i], 1e-9);
  const auto query = DeviationQuery::of(input.observations.rows.back());
  const PredictedComponent predicted = result.model->predict(query, input.observations.rows.back().component);
  EXPECT_NEAR(predicted.value, part.back(), 1e-9);
  EXPECT_GT(predicted.sigma, 0.0);
}

TEST(ProjectedProducts, AreThoseOfTheProjectedColumns) {
  const DiscrepancyInput input = campaign(Hidden::SpindleDrift, 3);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < input.observations.rows.size(); ++i) rows.push_back(i);
  ResidualProblem problem(input, rows, 3000);
  problem.setNuisances(problem.simulationNuisances(0.01));
  Random random(9);
  Eigen::MatrixXd courses(problem.size(), 3);
  for (double& value : courses.reshaped()) value = random.normal();
  // A shape over EY alone, as most effects have, and a basis to be removed besides.
  Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(problem.size(), 2);
  std::vector<int> active;
  for (int s = 0; s < problem.seriesCount(); ++s) {
    const auto from = static_cast<std::size_t>(problem.series_begin[static_cast<std::size_t>(s)]);
    const auto to = static_cast<std::size_t>(problem.series_begin[static_cast<std::size_t>(s) + 1]);
    if (problem.component[from] != Component::EY) continue;
    active.push_back(s);
    for (std::size_t u = from; u < to; ++u) {
      shapes(static_cast<Eigen::Index>(u), 0) = 1.0;
      shapes(static_cast<Eigen::Index>(u), 1) = problem.place[u].position_mm.z() * 1e-3;
    }
  }
  for (const NoiseModel& noise : {NoiseModel{}, NoiseModel{1.2, 0.8, 2500.0}}) {
    problem.setNoise(noise);
    Eigen::MatrixXd further = problem.projected(Eigen::VectorXd(courses.col(2)));
    further /= further.norm();
    const ProjectedColumns products = problem.projectedProducts(courses.leftCols(2), shapes, active, further);
    Eigen::MatrixXd raw(problem.size(), 4);
    for (Eigen::Index o = 0; o < 2; ++o) raw.middleCols(2 * o, 2) = courses.col(o).asDiagonal() * shapes;
    Eigen::MatrixXd x = problem.projected(raw);
    x -= further * (further.transpose() * x);
    const Eigen::MatrixXd gram = x.transpose() * x;
    EXPECT_LT((products.gram() - gram).norm(), 1e-9 * gram.norm());
    EXPECT_LT((products.with_residual - x.transpose() * problem.projectedResidual()).norm(),
              1e-9 * x.norm() * problem.projectedResidual().norm());
    const Eigen::VectorXd whole = problem.whitened(raw).colwise().squaredNorm();
    EXPECT_LT((products.whole - whole).norm(), 1e-12 * whole.norm());
  }
}

TEST(ProjectedProducts, OfAShapeThatIsZeroEverywhereAreZero) {
  const DiscrepancyInput input = campaign(Hidden::Nothing, 3);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < input.observations.rows.size(); ++i) rows.push_back(i);
  ResidualProblem problem(input, rows, 3000);
  problem.setNuisances(problem.simulationNuisances(0.01));
  const ProjectedColumns products = problem.projectedProducts(
      Eigen::MatrixXd::Ones(problem.size(), 4), Eigen::MatrixXd::Zero(problem.size(), 2), {}, Eigen::MatrixXd());
  EXPECT_EQ(products.gram(), Eigen::MatrixXd::Zero(8, 8));
  EXPECT_EQ(products.with_residual, Eigen::VectorXd::Zero(8));
}

}  // namespace
}  // namespace spindrift
