// SPDX-License-Identifier: GPL-3.0-or-later
// A simulation whose parts are all off by some per cent: that is no missing effect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/random.h"
#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/residual_problem.h"
#include "core/discrepancy/simulation_clock.h"
#include "core/simulation/study_campaigns.h"
#include "tests/benchmarks/discrepancy/hidden_effect_scoring.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

struct Tally {
  int right = 0;  ///< the hidden effect is named, and nothing else
  int more = 0;   ///< something else is named as well
  int campaigns = 0;
};

Tally tallyOf(const StudyConditions& conditions, std::uint64_t first_seed, int campaigns) {
  Tally tally;
  for (int k = 0; k < campaigns; ++k) {
    StudyOptions study;
    study.strength = 6.0;
    study.conditions = conditions;
    study.turn = static_cast<std::size_t>(k);
    const StudyCase made = studyCase(study, first_seed + static_cast<std::uint64_t>(k));
    JobContext job;
    DiscrepancyOptions options;
    options.suggest = false;
    const DiscrepancyResult result = findDiscrepancy(study::inputOf(simulateStudy(made, job).campaign), options, job);
    const auto hidden = [&](const FoundEffect& e) { return e.id == made.hidden.front(); };
    const bool found = std::any_of(result.effects.begin(), result.effects.end(), hidden);
    const bool others = !std::all_of(result.effects.begin(), result.effects.end(), hidden);
    tally.right += found && !others ? 1 : 0;
    tally.more += others ? 1 : 0;
    ++tally.campaigns;
  }
  return tally;
}

TEST(RoughSimulation, ItsErrorsGetNoNameBesideWhatIsMissing) {
  StudyConditions all_parts;
  all_parts.base_error = 0.08;
  const Tally tally = tallyOf(all_parts, 91'001, 12);
  EXPECT_GE(tally.right, 11);
  EXPECT_LE(tally.more, 1);
}

TEST(RoughSimulation, OnePartThatIsFarOffIsToldAllTheSame) {
  StudyConditions one_part;
  one_part.one_base_error = 0.3;
  const Tally tally = tallyOf(one_part, 92'001, 8);
  EXPECT_GE(tally.right, 6);
}

TEST(RoughSimulation, OfAPartThatIsNamedItIsSaidByHowMuchItIsOff) {
  constexpr int campaigns = 10;
  int named = 0;
  int told = 0;
  int inside = 0;
  for (int k = 0; k < campaigns; ++k) {
    StudyOptions study;
    study.strength = 6.0;
    study.conditions.one_base_error = 0.3;
    study.turn = static_cast<std::size_t>(k);
    const StudyCase made = studyCase(study, 93'001 + static_cast<std::uint64_t>(k));
    JobContext job;
    DiscrepancyOptions options;
    options.suggest = false;
    const DiscrepancyResult result = findDiscrepancy(study::inputOf(simulateStudy(made, job).campaign), options, job);
    const std::string& off = made.hidden.front();
    if (result.effects.size() != 1 || result.effects.front().id != off) continue;
    ++named;
    const double error = made.scenario.simulation->size_errors.at(off);
    for (const std::string& warning : result.warnings) {
      const std::string begin = "The simulation has " + off + " already: ";
      if (!warning.starts_with(begin)) continue;
      ++told;
      EXPECT_EQ(result.message, "Of the wrong size in the simulation: " + off + ".");
      double percent = 0.0;
      double uncertainty = 0.0;
      ASSERT_EQ(std::sscanf(warning.c_str() + begin.size(), "%lf ± %lf", &percent, &uncertainty), 2) << warning;
      EXPECT_THAT(warning, HasSubstr(error > 0.0 ? "too much of it." : "too little of it."));
      inside += std::abs(percent - 30.0) <= 2.0 * uncertainty ? 1 : 0;
      EXPECT_NEAR(percent, 30.0, std::max(6.0, 4.0 * uncertainty)) << warning;
    }
  }
  EXPECT_GE(named, 7);
  EXPECT_GE(told, named - 1);
  EXPECT_GE(inside, told - 2);
}

TEST(RoughSimulation, OnePartThatIsFarOffIsNoRoughnessOfAllParts) {
  // Each was taken for a simulation all of whose parts are rough, which follows a fifth of a part as well.
  int right = 0;
  for (const std::uint64_t k : {48, 88, 98, 168}) {
    StudyOptions study;
    study.strength = 6.0;
    study.conditions.one_base_error = 0.3;
    study.turn = 41'502 * 7 + 99 + k;
    const StudyCase made = studyCase(study, 41'502'090'000ULL + k);
    JobContext job;
    DiscrepancyOptions options;
    options.suggest = false;
    const DiscrepancyResult result = findDiscrepancy(study::inputOf(simulateStudy(made, job).campaign), options, job);
    right += result.effects.size() == 1 && result.effects.front().id == made.hidden.front() ? 1 : 0;
  }
  EXPECT_EQ(right, 4);
}

TEST(RoughSimulation, APartThatIsSomewhatOffIsAnErrorOfItsSizeAndNotMissing) {
  constexpr int campaigns = 8;
  int nothing_named = 0;
  int told = 0;
  for (int k = 0; k < campaigns; ++k) {
    StudyOptions study;
    study.strength = 6.0;
    study.conditions.one_base_error = 0.18;
    study.turn = static_cast<std::size_t>(k);
    const StudyCase made = studyCase(study, 94'001 + static_cast<std::uint64_t>(k));
    JobContext job;
    DiscrepancyOptions options;
    options.suggest = false;
    const DiscrepancyResult result = findDiscrepancy(study::inputOf(simulateStudy(made, job).campaign), options, job);
    nothing_named += result.verdict == DiscrepancyVerdict::None ? 1 : 0;
    for (const std::string& warning : result.warnings) {
      if (warning.find("no more than a rough simulation") == std::string::npos) continue;
      ++told;
      const double error = made.scenario.simulation->size_errors.at(made.hidden.front());
      EXPECT_THAT(warning, HasSubstr((error > 0.0 ? " % too much of " : " % too little of ") + made.hidden.front()));
      double percent = 0.0;
      double uncertainty = 0.0;
      ASSERT_EQ(std::sscanf(warning.c_str(), "The simulation has %lf ± %lf", &percent, &uncertainty), 2) << warning;
      EXPECT_NEAR(percent, 18.0, 3.0 * uncertainty);
    }
  }
  EXPECT_GE(nothing_named, 6);
  EXPECT_GE(told, 2);
}

TEST(RoughSimulation, NothingIsMissingWhereAllPartsAreSomewhatOff) {
  constexpr int campaigns = 16;
  int nothing_named = 0;
  for (int k = 0; k < campaigns; ++k) {
    StudyOptions study;
    study.kind = StudyKind::Nothing;
    study.conditions.base_error = 0.08;
    study.turn = static_cast<std::size_t>(k);
    JobContext job;
    DiscrepancyOptions options;
    options.suggest = false;
    const DiscrepancyInput input =
        study::inputOf(simulateStudy(studyCase(study, 95'001 + static_cast<std::uint64_t>(k)), job).campaign);
    nothing_named += findDiscrepancy(input, options, job).verdict == DiscrepancyVerdict::None ? 1 : 0;
  }
  EXPECT_GE(nothing_named, campaigns - 1);
}

/// Readings of the held-out states that went wrong say nothing against an effect: one part in twenty, 30 sigma off.
TEST(HeldOut, DisturbedReadingsTakeNoNameBack) {
  int named = 0;
  int named_disturbed = 0;
  constexpr int campaigns = 10;
  for (int k = 0; k < campaigns; ++k) {
    StudyOptions study;
    study.strength = 4.0;
    study.turn = static_cast<std::size_t>(k);
    const StudyCase made = studyCase(study, 96'001 + static_cast<std::uint64_t>(k));
    JobContext job;
    DiscrepancyOptions options;
    options.suggest = false;
    DiscrepancyInput input = study::inputOf(simulateStudy(made, job).campaign);
    const auto found = [&] {
      const DiscrepancyResult result = findDiscrepancy(input, options, job);
      return std::any_of(result.effects.begin(), result.effects.end(),
                         [&](const FoundEffect& e) { return e.id == made.hidden.front(); });
    };
    named += found() ? 1 : 0;
    Random random(static_cast<std::uint64_t>(k));
    for (Observation& o : input.observations.rows)
      if (o.use == ObservationUse::Holdout && random.uniform() < 0.05)
        o.value += (random.uniform() < 0.5 ? -30.0 : 30.0) * o.sigma;
    named_disturbed += found() ? 1 : 0;
  }
  EXPECT_GE(named, 8);
  EXPECT_GE(named_disturbed, named - 1);
}

/// Nothing that is missing shows the clock, but the simulation does.
TEST(SimulationClock, OfMinutesIsToldThoughNothingIsMissing) {
  int told = 0;
  int inside = 0;
  int false_alarms = 0;
  constexpr int campaigns = 8;
  for (int k = 0; k < campaigns; ++k) {
    for (const double offset_s : {0.0, 300.0}) {
      StudyOptions study;
      study.kind = StudyKind::Nothing;
      study.turn = static_cast<std::size_t>(k);
      JobContext job;
      DiscrepancyOptions options;
      options.suggest = false;
      DiscrepancyInput input =
          study::inputOf(simulateStudy(studyCase(study, 97'001 + static_cast<std::uint64_t>(k)), job).campaign);
      const PredictedAt predicted = predictedBetween(input.observations.rows, input.predicted);
      for (std::size_t r = 0; r < input.predicted.size(); ++r) {
        Observation& o = input.observations.rows[r];
        o.time_s += offset_s;
        input.predicted[r] = predicted(o, o.time_s);
      }
      const DiscrepancyResult result = findDiscrepancy(input, options, job);
      if (offset_s == 0.0) {
        false_alarms += result.clock_offset_s != 0.0 ? 1 : 0;
      } else if (result.clock_offset_s != 0.0) {
        ++told;
        EXPECT_THAT(result.warnings,
                    ::testing::Contains(HasSubstr("that of the observations, as far as the data show it")));
        inside += std::abs(result.clock_offset_s + offset_s) < 2.5 * result.clock_offset_uncertainty_s ? 1 : 0;
      }
    }
  }
  EXPECT_LE(false_alarms, 1);
  EXPECT_GE(told, 4);
  EXPECT_GE(inside, told - 1);
}

/// A campaign of the study, and those of its rows that fits are made of.
struct RowsToFit {
  DiscrepancyInput input;
  std::vector<std::size_t> rows;
};

RowsToFit rowsToFit() {
  JobContext job;
  RowsToFit made{study::inputOf(simulateStudy(studyCase({}, 93'001), job).campaign), {}};
  for (std::size_t r = 0; r < made.input.observations.rows.size(); ++r) {
    if (made.input.observations.rows[r].use == ObservationUse::Fit) made.rows.push_back(r);
  }
  return made;
}

TEST(RoughSimulation, NuisancesOfOneComponentStayInItAndTheirOrderDoesNotMatter) {
  const RowsToFit made = rowsToFit();
  ResidualProblem problem(made.input, made.rows, 4000);
  std::vector<NuisanceColumn> nuisances = problem.simulationNuisances(0.08);
  const std::size_t of_one = nuisances.size();
  ASSERT_GE(of_one, 4U);
  // One that all components share, and a free one, before the others and after them.
  Eigen::VectorXd shared(problem.size());
  Eigen::VectorXd free(problem.size());
  for (Eigen::Index u = 0; u < problem.size(); ++u) {
    const double hours = problem.time_s[static_cast<std::size_t>(u)] / 3600.0;
    shared[u] = std::sin(hours);
    free[u] = hours * hours;
  }
  nuisances.insert(nuisances.begin(), {{shared, 0.5, false}, {free, 0.0, false}});
  problem.setNuisances(nuisances);
  const double determinant = problem.nuisanceLogDeterminant();
  const Eigen::VectorXd left = problem.projectedResidual();

  std::size_t parts = 0;
  Eigen::MatrixXd together = Eigen::MatrixXd::Zero(problem.size(), problem.nuisanceBasis().cols());
  for (std::size_t d = 0; d < problem.domains().size(); ++d) {
    const ResidualProblem::BasisPart& part = problem.nuisanceParts()[d];
    parts += part.columns.size();
    for (std::size_t q = 0; q < part.columns.size(); ++q)
      together.col(part.columns[q]).segment(problem.domains()[d].from, problem.domains()[d].count) =
          part.rows.col(static_cast<Eigen::Index>(q));
  }
  EXPECT_EQ((together - problem.nuisanceBasis().topRows(problem.size())).norm(), 0.0);
  // The free one comes first and is in all; what is of one component then holds a little of it.
  EXPECT_GT(parts, of_one);
  EXPECT_LT((problem.projected(free)).norm(), 1e-9 * problem.whitened(free).norm());

  std::reverse(nuisances.begin(), nuisances.end());
  problem.setNuisances(nuisances);
  EXPECT_NEAR(problem.nuisanceLogDeterminant(), determinant, 1e-9 * std::abs(determinant));
  EXPECT_NEAR(problem.projectedResidual().norm(), left.norm(), 1e-9 * left.norm());

  nuisances.erase(std::remove_if(nuisances.begin(), nuisances.end(),
                                 [](const NuisanceColumn& c) { return !(c.prior_sigma > 0.0); }),
                  nuisances.end());
  problem.setNuisances(nuisances);
  std::size_t without_free = 0;
  for (const ResidualProblem::BasisPart& part : problem.nuisanceParts()) without_free += part.columns.size();
  EXPECT_LE(without_free, of_one + problem.domains().size());
}

TEST(RoughSimulation, TheFreedomOfNuisancesCostsTheirDeterminant) {
  const RowsToFit made = rowsToFit();
  ResidualProblem problem(made.input, made.rows, 4000);
  const std::vector<NuisanceColumn> nuisances = problem.simulationNuisances(0.08);
  ASSERT_GE(nuisances.size(), 4U);
  problem.setNuisances(nuisances);
  const auto count = static_cast<Eigen::Index>(nuisances.size());
  Eigen::MatrixXd raw(problem.size(), count);
  for (Eigen::Index c = 0; c < count; ++c) {
    const NuisanceColumn& column = nuisances[static_cast<std::size_t>(c)];
    ASSERT_GT(column.prior_sigma, 0.0);
    raw.col(c) = column.prior_sigma * column.values;
  }
  Eigen::MatrixXd gram = Eigen::MatrixXd::Identity(count, count);
  for (std::size_t d = 0; d < problem.domains().size(); ++d) {
    const ResidualProblem::Domain& domain = problem.domains()[d];
    const Eigen::MatrixXd white = problem.withoutConstants(d, raw.middleRows(domain.from, domain.count));
    gram += white.transpose() * white;
  }
  const Eigen::LLT<Eigen::MatrixXd> llt(gram);
  const double expected = 2.0 * llt.matrixLLT().diagonal().array().log().sum();
  EXPECT_GT(expected, 1.0);
  EXPECT_NEAR(problem.nuisanceLogDeterminant(), expected, 1e-6 * expected);
}

}  // namespace
}  // namespace spindrift
