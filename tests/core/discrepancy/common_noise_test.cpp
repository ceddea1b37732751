// SPDX-License-Identifier: GPL-3.0-or-later
// What moves all points of a state alike may be an effect or re-referencing: neither is taken for the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/discrepancy/discrepancy.h"
#include "core/simulation/study_campaigns.h"
#include "tests/benchmarks/discrepancy/hidden_effect_scoring.h"
#include "tests/core/discrepancy/small_plant.h"

namespace spindrift {
namespace {

DiscrepancyResult answerTo(const StudyCampaign& measured) {
  JobContext job;
  DiscrepancyOptions options;
  options.suggest = false;
  return findDiscrepancy(study::inputOf(measured.campaign), options, job);
}

DiscrepancyResult answerTo(const StudyCase& made) {
  JobContext job;
  return answerTo(simulateStudy(made, job));
}

TEST(CommonNoise, AWeakEffectIsNotTakenForShiftsOfStates) {
  // Effects of 0.8 times the noise, the same at all points. Estimated without them, the noise held them as shifts of
  // states, and beside such noise nothing was found.
  int named = 0;
  for (const std::uint64_t number : {9U, 16U, 17U, 25U, 65U}) {
    StudyOptions study;
    study.strength = 0.8;
    study.turn = 95'001 * 7 + number;
    const StudyCase made = studyCase(study, 95'001'000'000ULL + number);
    const DiscrepancyResult result = answerTo(made);
    const bool right = result.effects.size() == 1 && result.effects.front().id == made.hidden.front();
    named += right ? 1 : 0;
    if (right) {
      for (const NoiseEstimate& noise : result.noise) EXPECT_LT(noise.common_um, 0.1) << toString(noise.component);
    }
  }
  EXPECT_GE(named, 3);  // of the other two the odds are less than they have to be for a second look
}

TEST(CommonNoise, ShiftsOfStatesAreNotTakenForAnEffect) {
  // Re-referenced states and nothing hidden: begun without shifts, each of these finds an effect that follows them.
  for (const std::uint64_t number : {10U, 19U, 20U}) {
    StudyOptions study;
    study.kind = StudyKind::Nothing;
    study.conditions = StudyConditions::together();
    study.turn = 95'601 * 7 + 19 * 11 + number;
    const DiscrepancyResult result = answerTo(studyCase(study, 95'601'190'000ULL + number));
    EXPECT_EQ(result.verdict, DiscrepancyVerdict::None) << "at number " << number;
    bool shifts = false;
    for (const NoiseEstimate& noise : result.noise) shifts = shifts || noise.common_um > 0.1;
    EXPECT_TRUE(shifts) << "at number " << number;
  }
}

TEST(CommonNoise, NoEffectHidesInShiftsBesideOthers) {
  // Three effects under all that a workshop does. One of them, the same at all points, was held for shifts of states,
  // larger than an instrument makes them, as two others were found beside it.
  for (const std::uint64_t number : {8U, 19U}) {
    StudyOptions study;
    study.kind = StudyKind::Three;
    study.strength = 5.0;
    study.conditions = StudyConditions::together();
    study.turn = 61'001 * 7 + 17 * 11 + number;
    const StudyCase made = studyCase(study, 61'001'170'000ULL + number);
    const DiscrepancyResult result = answerTo(made);
    const auto named = [&](const std::string& id) {
      return std::any_of(result.effects.begin(), result.effects.end(),
                         [&](const FoundEffect& e) { return e.id == id; });
    };
    for (const std::string& id : made.hidden) EXPECT_TRUE(named(id)) << id << " at number " << number;
    EXPECT_EQ(result.effects.size(), made.hidden.size()) << "at number " << number;
    // Of rivals the more probable one is named.
    for (const FoundEffect& e : result.effects) EXPECT_GT(e.confidence, 0.5) << e.id;
  }
}

TEST(CommonNoise, ASwitchOfTheCoolantFollowsNoSlowCourse) {
  // With 443 s while it flows and 13,500 s afterwards it was named for an instrument that warms up; with 2,760 s and
  // 427 s where nothing is hidden.
  const auto names = [](StudyKind kind, std::uint64_t of_kind, std::uint64_t number) {
    StudyOptions study;
    study.kind = kind;
    study.strength = 5.0;
    study.conditions = StudyConditions::together();
    study.turn = 4242 * 7 + of_kind * 11 + number;
    const StudyCase made = studyCase(study, 4'242'000'000ULL + of_kind * 10'000ULL + number);
    const DiscrepancyResult result = answerTo(made);
    return std::count_if(result.effects.begin(), result.effects.end(), [&](const FoundEffect& e) {
      return e.id.starts_with("coolant.") &&
             std::find(made.hidden.begin(), made.hidden.end(), e.id) == made.hidden.end();
    });
  };
  EXPECT_EQ(names(StudyKind::Three, 18, 17), 0);
  EXPECT_EQ(names(StudyKind::Nothing, 20, 20), 0);
}

TEST(CommonNoise, ASecondLookBeginsWithTheClockThatWasStated) {
  // The room's drift was taken for shifts of states, and a clock that is right was moved by six minutes to fit what was
  // found in its place; beside that clock the drift was not found either.
  StudyOptions study;
  study.kind = StudyKind::Two;
  study.strength = 4.0;
  study.turn = 660'202 * 7 + 23 * 11 + 21;
  const StudyCase made = studyCase(study, 660'202'230'021ULL);
  ASSERT_EQ(made.hidden, (std::vector<std::string>{"ambient.drift.z", "spindle.growth.z"}));
  const DiscrepancyResult result = answerTo(made);
  EXPECT_EQ(result.clock_offset_s, 0.0);
  std::vector<std::string> named;
  for (const FoundEffect& e : result.effects) named.push_back(e.id);
  std::sort(named.begin(), named.end());
  EXPECT_EQ(named, made.hidden);
}

TEST(CommonNoise, OfHalfAReadingsScatterHidesNoEffect) {
  // The instrument warms up along Z beside two other effects: it was held for shifts that instruments make.
  StudyOptions study;
  study.kind = StudyKind::Three;
  study.strength = 5.0;
  study.turn = 660'301 * 7 + 16 * 11 + 6;
  const StudyCase made = studyCase(study, 660'301'160'006ULL);
  const DiscrepancyResult result = answerTo(made);
  for (const std::string& id : made.hidden) {
    EXPECT_TRUE(std::any_of(result.effects.begin(), result.effects.end(), [&](const FoundEffect& e) {
      return e.id == id;
    })) << id;
  }
  EXPECT_EQ(result.effects.size(), made.hidden.size());
}

TEST(CommonNoise, ThatDriftsIsToldAsTheInstrumentsAndNamesNothing) {
  // The instrument drifts by half to once the scatter of a reading: it was named as an effect in one campaign of ten.
  int none = 0;
  int told = 0;
  int drifting = 0;
  for (std::uint64_t number = 0; number < 5; ++number) {
    StudyOptions study;
    study.kind = StudyKind::Nothing;
    study.conditions.drift = true;
    JobContext job;
    const StudyCampaign made = simulateStudy(studyCase(study, 71'500 + number), job);
    const DiscrepancyResult result = answerTo(made);
    EXPECT_TRUE(result.effects.empty()) << number;
    for (const NoiseEstimate& n : result.noise) {
      EXPECT_EQ(n.drift_um > 0.0, n.drift_correlation_time_s > 0.0) << number;
      if (!(n.drift_um > 0.0)) continue;
      // Drawn: the scatter of a walk about its mean over a few correlation times varies by a factor of its own.
      double squares = 0.0, sum = 0.0, states = 0.0;
      for (const auto& [where, shift] : made.applied.shifts) {
        if (where.second != n.component) continue;
        squares += shift * shift;
        sum += shift;
        ++states;
      }
      const double scatter = std::sqrt(squares / states - (sum / states) * (sum / states));
      EXPECT_NEAR(std::log(n.drift_um / scatter), 0.0, std::log(1.6)) << number;
      ++drifting;
    }
    none += result.verdict == DiscrepancyVerdict::None ? 1 : 0;
    told += std::any_of(result.warnings.begin(), result.warnings.end(),
                        [](const std::string& warning) {
                          return warning.find("taken for a drift of the instrument") != std::string::npos;
                        })
                ? 1
                : 0;
  }
  EXPECT_GE(none, 2);  // what is larger than instruments make it is told as something that remains
  EXPECT_GE(drifting, 2);
  EXPECT_GE(told, 2);  // and where shifts do not clearly follow each other they are re-referencing
}

TEST(CommonNoise, IsNoCauseThatRemainsHoweverManyPointsShowIt) {
  // Re-referenced states seen by 320 points: units are means of readings, and scatter less than states are shifted. The
  // shifts were told as a cause that remains; and that an effect is the same at all points spoke against it.
  for (const std::uint64_t seed : {3U, 4U}) {
    const DiscrepancyInput input = small_plant::atManyPoints(seed, 320, 0.3);
    const DiscrepancyResult result = small_plant::run(input);
    ASSERT_EQ(result.effects.size(), 1U) << seed;
    EXPECT_EQ(result.effects.front().id, "spindle.drift.y") << seed;
    EXPECT_EQ(result.leftover, "") << seed;
    for (const NoiseEstimate& noise : result.noise) EXPECT_NEAR(noise.common_um, 0.3, 0.15) << seed;
  }
}

}  // namespace
}  // namespace spindrift
