// SPDX-License-Identifier: GPL-3.0-or-later
// A simulation that was computed from a log whose clock is off.
#include "core/discrepancy/simulation_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/discrepancy/discrepancy.h"
#include "core/simulation/study_campaigns.h"
#include "tests/benchmarks/discrepancy/hidden_effect_scoring.h"

namespace spindrift {
namespace {

struct Followed {
  double offset_s = 0.0;
  double found_s = 0.0;
  double left = 0.0;         ///< part of what the offset does that the column leaves
  double left_by_row = 0.0;  ///< the same of the rate from row to row
};

/// What the wrong clock does to a simulation that is right in everything else, without noise.
Followed followedAt(std::uint64_t seed) {
  StudyOptions study;
  study.kind = StudyKind::Nothing;
  study.conditions.clock = true;
  JobContext job;
  const StudyCampaign made = simulateStudy(studyCase(study, seed), job);
  DiscrepancyInput input = study::inputOf(made.campaign);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < input.observations.rows.size(); ++i) {
    input.observations.rows[i].value = made.campaign.truth.total[i];
    if (input.observations.rows[i].use == ObservationUse::Fit) rows.push_back(i);
  }
  const DriverTable drivers(input.machine, &*input.log);
  const ResidualProblem problem(input, rows, 4000);
  CatalogueContext context;
  context.machine = &input.machine;
  context.drivers = &drivers;
  context.point_count = 10;
  context.position_varies = true;
  context.c_varies = true;
  const std::vector<Effect> catalogue = effectCatalogue(context);
  const std::vector<SimulationPart> parts = partsOfSimulation(problem, drivers, catalogue, DiscrepancyPriors{}, job);
  const Eigen::VectorXd y = problem.projected(problem.y);
  const auto left = [&](const Eigen::VectorXd& column) {
    const Eigen::VectorXd x = problem.projected(column);
    return 1.0 - std::pow(x.dot(y), 2) / (x.squaredNorm() * y.squaredNorm());
  };
  const Eigen::VectorXd rate = clockRate(problem, parts);
  const Eigen::VectorXd x = problem.projected(rate);
  return {-made.applied.clock_offset_s, x.dot(y) / x.squaredNorm(), left(rate),
          left(problem.ratePerSecond(problem.simulated))};
}

TEST(SimulationParts, MoveWithTheClockOfTheLogAsTheirDriversSay) {
  std::vector<double> left;
  std::vector<double> left_by_row;
  for (std::uint64_t seed = 51'001; left.size() < 5; ++seed) {
    const Followed one = followedAt(seed);
    if (std::abs(one.offset_s) < 60.0) continue;
    std::printf("offset %6.0f s, found %6.0f s, left %.3f, from row to row %.3f\n", one.offset_s, one.found_s, one.left,
                one.left_by_row);
    left.push_back(one.left);
    left_by_row.push_back(one.left_by_row);
    EXPECT_NEAR(one.found_s, one.offset_s, 0.25 * std::abs(one.offset_s));
  }
  std::sort(left.begin(), left.end());
  std::sort(left_by_row.begin(), left_by_row.end());
  EXPECT_LT(left[2], 0.15);
  EXPECT_GT(left_by_row[2], 0.3);
}

}  // namespace
}  // namespace spindrift
