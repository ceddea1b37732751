// SPDX-License-Identifier: GPL-3.0-or-later
// A body never moves as the formula of an effect alone: a rotary table that drifts also tilts a little. That is no
// second cause.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/discrepancy/catalogue.h"
#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/effect_search.h"
#include "core/discrepancy/residual_problem.h"
#include "core/simulation/study_campaigns.h"
#include "tests/benchmarks/discrepancy/hidden_effect_scoring.h"
#include "tests/core/discrepancy/small_plant.h"

namespace spindrift {
namespace {

std::string namesIn(const DiscrepancyResult& result) {
  std::string names;
  for (const FoundEffect& e : result.effects) names += (names.empty() ? "" : " ") + e.id;
  return names;
}

TEST(BesideTheFormula, ARotaryTableThatDriftsAndTiltsALittleHasOneCause) {
  // Each was given two names, the second a tilt.
  struct Case {
    std::uint64_t number;
    std::size_t cell;
    double strength;
    double ar1;
    bool warm;
  };
  int one = 0;
  for (const Case& c : {Case{2, 2, 4.0, 0.0, false}, Case{10, 3, 8.0, 0.0, false}, Case{30, 7, 6.0, 0.0, true},
                        Case{10, 22, 4.0, 0.9, false}, Case{25, 22, 4.0, 0.9, false}}) {
    StudyOptions study;
    study.strength = c.strength;
    study.ar1 = c.ar1;
    study.conditions.warm_start = c.warm;
    study.turn = 81'001 * 7 + c.cell * 11 + c.number;
    const StudyCase made = studyCase(study, 81'001'000'000ULL + c.cell * 10'000 + c.number);
    ASSERT_TRUE(made.hidden.front().starts_with("rotary.")) << made.hidden.front();
    JobContext job;
    DiscrepancyOptions options;
    options.suggest = false;
    const DiscrepancyResult result = findDiscrepancy(study::inputOf(simulateStudy(made, job).campaign), options, job);
    one += namesIn(result) == made.hidden.front() ? 1 : 0;
  }
  EXPECT_GE(one, 4);
}

TEST(BesideTheFormula, WhatStandsInForADriverNeedsNoSecondEffect) {
  // The room drifts along X and its sensor is not in the log; another temperature stands in for it, which the spindle
  // warms as well. Beside it stood a second name that took that out again, or the same drift in a course of its own.
  struct Case {
    std::uint64_t base;
    std::uint64_t number;
  };
  for (const Case& c : {Case{98'201, 20}, Case{98'201, 50}, Case{98'201, 69}, Case{61'001, 25}, Case{61'001, 39}}) {
    StudyOptions study;
    study.kind = StudyKind::Confounded;
    study.strength = 5.0;
    study.turn = c.base * 7 + 24 * 11 + c.number;
    const StudyCase made = studyCase(study, c.base * 1'000'000 + 240'000 + c.number);
    ASSERT_EQ(made.hidden.front(), "ambient.drift.x");
    JobContext job;
    DiscrepancyOptions options;
    options.suggest = false;
    const DiscrepancyResult result = findDiscrepancy(study::inputOf(simulateStudy(made, job).campaign), options, job);
    if (c.number == 69) {  // what stands in leaves 0.41 of it: enough to doubt the name, and that is said
      EXPECT_TRUE(namesIn(result) == "ambient.drift.x" || result.leftover.find("ambient.drift.x") != std::string::npos);
      EXPECT_EQ(result.leftover.find("spindle.drift.x"), std::string::npos) << result.leftover;
      continue;
    }
    EXPECT_EQ(namesIn(result), "ambient.drift.x") << "at number " << c.number << " of " << c.base;
  }
}

TEST(BesideTheFormula, OfTwoThatTheDataDoNotTellApartTheSimplerIsNamed) {
  // Growth of the spindle, and heat that depends on a position, which holds it: three of these shared what the data
  // show, and nothing was named.
  StudyOptions study;
  study.kind = StudyKind::Two;
  study.strength = 4.0;
  study.turn = 660'202 * 7 + 23 * 11 + 25;
  const StudyCase made = studyCase(study, 660'202'230'025ULL);
  ASSERT_EQ(made.hidden, (std::vector<std::string>{"squareness.drift.c0y", "spindle.growth.z"}));
  JobContext job;
  DiscrepancyOptions options;
  options.suggest = false;
  const DiscrepancyResult result = findDiscrepancy(study::inputOf(simulateStudy(made, job).campaign), options, job);
  const auto growth = std::find_if(result.effects.begin(), result.effects.end(),
                                   [](const FoundEffect& e) { return e.id == "spindle.growth.z"; });
  ASSERT_NE(growth, result.effects.end()) << namesIn(result);
  EXPECT_THAT(growth->containers, testing::Contains("heat_source.position.y"));
  EXPECT_EQ(result.effects.size(), 2U);
}

TEST(BesideTheFormula, WhatADriftMovesAlongAnotherAxisIsToldAndGetsNoName) {
  int alone = 0;
  int told = 0;
  std::string names;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const DiscrepancyResult result =
        small_plant::run(small_plant::campaign(small_plant::Hidden::DriftThatLifts, 20 + seed, 100.0));
    ASSERT_FALSE(result.effects.empty()) << "at seed " << seed;
    EXPECT_EQ(result.effects.front().id, "spindle.drift.y");
    alone += result.effects.size() == 1 ? 1 : 0;
    told += result.leftover.find("EZ") != std::string::npos ? 1 : 0;
    names += namesIn(result) + "; ";
  }
  EXPECT_GE(alone, 5) << names;
  EXPECT_GE(told, alone);
}

TEST(BesideTheFormula, ALoadThatHadNotEndedKeepsItsName) {
  // It was predicted to last for ever, left more of what is held out than without it, and was taken back.
  int named = 0;
  double before_um = 0.0;
  double after_um = 0.0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const DiscrepancyResult result =
        small_plant::run(small_plant::campaign(small_plant::Hidden::LoadThatLasts, 70 + seed, 6.0));
    named += namesIn(result) == "external_heat.z" ? 1 : 0;
    before_um += result.gap.heldout_rms_before_um;
    after_um += result.gap.heldout_rms_after_um;
  }
  EXPECT_GE(named, 5);
  // How fast it cools nobody has seen: that costs little.
  EXPECT_LT(after_um, 1.05 * before_um);
}

TEST(BesideTheFormula, WhatTurnsTurnsAboutAnAxisOfTheMachine) {
  // A drift along Y was named a rotation of the frame about an axis at 20 m, although the rotation was measured.
  DiscrepancyInput input = small_plant::campaign(small_plant::Hidden::Nothing, 62);
  const std::size_t displacements = input.predicted.size();
  for (const bool turn_measured : {false, true}) {
    for (std::size_t i = 0; turn_measured && i < displacements; ++i) {
      Observation o = input.observations.rows[i];
      if (o.component != Component::EX) continue;
      o.component = Component::EA;
      input.observations.rows.push_back(o);
      input.predicted.push_back(0.0);
    }
    std::vector<std::size_t> rows(input.predicted.size());
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
    const ResidualProblem problem(input, rows, 3000);
    const DriverTable drivers(input.machine, &*input.log);
    const std::vector<Effect> effects = effectsOfMachine(input.machine, {});
    const EffectSearch search(problem, drivers, effects);
    const auto possible = [&](const char* id, const Eigen::VectorXd& gains) {
      const Effect* effect = search.find(id);
      if (effect == nullptr) return false;
      search.prepare(*effect);
      const EffectVariant& variant = effect->variants.front();
      return search.admissible({effect, variant, std::vector<double>(1, 600.0)}, gains);
    };
    const auto gains = [](double a, double b, double c, double d) { return Eigen::Vector4d(a, b, c, d); };
    // Of the frame: urad, um along Y, um along Z; it shows at points at several heights.
    EXPECT_TRUE(possible("frame.rotation.a", Eigen::Vector3d(5.0, 8.0, 8.0)));
    EXPECT_FALSE(possible("frame.rotation.a", Eigen::Vector3d(0.5, 8.0, 0.0)));
    EXPECT_FALSE(possible("frame.rotation.a", Eigen::Vector3d(0.5, 0.0, -8.0)));
    // Of a head that hangs on a ram: um along Y, um along Z, urad, urad that move with z; without the rotation nobody
    // knows the lever.
    EXPECT_TRUE(possible("head.tilt.a", gains(8.0, 5.0, 20.0, 0.0)));
    EXPECT_TRUE(possible("head.tilt.a", gains(8.0, 5.0, 0.0, 20.0)));
    EXPECT_EQ(possible("head.tilt.a", gains(8.0, 0.0, 1.0, 0.5)), !turn_measured);
    EXPECT_EQ(possible("head.tilt.a", gains(0.0, 8.0, 1.0, 0.5)), !turn_measured);
  }
}

TEST(BesideTheFormula, AScrewThatIsWarmerWhereItsNutTravelsIsNotTheUniformOne) {
  // The square had a slope beside it, and paid for two gains where the other paid for one: the uniform one was named
  // without a rival.
  int square = 0;
  int slope = 0;
  int wrong = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    for (const bool uniform : {false, true}) {
      const DiscrepancyResult result = small_plant::run(small_plant::campaign(
          uniform ? small_plant::Hidden::Screw : small_plant::Hidden::ScrewWhereItTravels, 40 + seed, 6.0));
      const std::string hidden = uniform ? "ball_screw.expansion.x" : "ball_screw.nonuniform.x";
      ASSERT_EQ(result.effects.size(), 1U) << namesIn(result);
      const FoundEffect& found = result.effects.front();
      if (found.id == hidden) (uniform ? slope : square) += 1;
      wrong += found.id != hidden && std::count(found.rivals.begin(), found.rivals.end(), hidden) == 0 ? 1 : 0;
    }
  }
  EXPECT_GE(square, 5);
  EXPECT_GE(slope, 5);
  EXPECT_EQ(wrong, 0);
}

TEST(BesideTheFormula, AScrewWhoseMeanIsInTheSimulationIsOneThatIsNotUniform) {
  // A rod that is heated where the nut travels, beside a simulation that has its mean temperature: what is left
  // vanishes at both ends. The square of the distance alone does not, and took the uniform screw along, of opposite
  // sign: two names for one cause.
  int campaigns = 0;
  int right = 0;
  std::string names;
  for (std::uint64_t number = 0; campaigns < 6 && number < 200; ++number) {
    const std::uint64_t seed = 97'001'160'000ULL + number;
    StudyOptions study;
    study.kind = StudyKind::One;
    study.strength = 6.0;
    study.conditions = StudyConditions::together();
    for (const std::string& id : hideable(seed)) {
      if (id.starts_with("ball_screw.nonuniform.")) study.hide = {id};
    }
    if (study.hide.empty()) continue;
    ++campaigns;
    JobContext job;
    DiscrepancyOptions options;
    options.suggest = false;
    const StudyCampaign made = simulateStudy(studyCase(study, seed), job);
    const DiscrepancyResult result = findDiscrepancy(study::inputOf(made.campaign), options, job);
    names += study.hide.front() + ": " + namesIn(result) + "; ";
    if (namesIn(result) != study.hide.front()) continue;
    ++right;
    // Both columns are in the model, so that a program reads it that knows the square and the slope.
    const ModelEffect& found = result.model->effects().front();
    ASSERT_EQ(found.effect.shape.size(), 2U);
    const auto axis = static_cast<std::size_t>(study.hide.front().back() - 'x');
    const auto& travel_mm = made.campaign.campaign.machine.axes[axis].travel_mm;
    EXPECT_NEAR(std::abs(found.gains[1] / found.gains[0]), 1e-3 * (travel_mm[1] - travel_mm[0]), 1e-9);
    const std::vector<double> part =
        EffectModel::contribution(result.model->drivers(), found, made.campaign.campaign.observations->rows);
    EXPECT_GT(study::explainedFraction(made.campaign, part), 0.8) << study.hide.front();
  }
  EXPECT_EQ(campaigns, 6);
  EXPECT_GE(right, 5) << names;
}

TEST(BesideTheFormula, ASlipIsSeenInThreeStatesBeforeAndAfter) {
  // Two readings may have gone wrong, at either end; of the point itself, not of the others.
  const DiscrepancyInput input = small_plant::campaign(small_plant::Hidden::Nothing, 61);
  std::vector<std::size_t> rows;
  std::vector<double> times_s;
  for (std::size_t i = 0; i < input.predicted.size(); ++i) {
    const Observation& o = input.observations.rows[i];
    // F3 was left out of the last state but one.
    if (o.point == "F3" && o.state == "M30") continue;
    rows.push_back(i);
    if (o.point == "F3" && o.component == Component::EX) times_s.push_back(o.time_s);
  }
  const ResidualProblem problem(input, rows, 3000);
  const DriverTable drivers(input.machine, &*input.log);
  const std::vector<Effect> effects = effectsOfMachine(input.machine, {"F1", "F3"});
  const EffectSearch search(problem, drivers, effects);
  const Effect* slip = search.find("fixture.slip.F3");
  ASSERT_NE(slip, nullptr);
  search.prepare(*slip);
  const auto possible = [&](double onset_s) {
    return search.admissible({slip, slip->variants.front(), {onset_s}}, Eigen::Vector3d(1.0, -2.0, 0.5));
  };
  const std::size_t states = times_s.size();
  for (std::size_t k = 0; k + 1 < states; ++k)
    EXPECT_EQ(possible(0.5 * (times_s[k] + times_s[k + 1])), k >= 2 && k + 4 <= states) << k << " of " << states;
}

}  // namespace
}  // namespace spindrift
