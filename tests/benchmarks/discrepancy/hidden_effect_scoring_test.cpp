// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/discrepancy/hidden_effect_scoring.h"

#include <gtest/gtest.h>

namespace spindrift::study {
namespace {

Answer named(std::vector<Answer::Listed> effects) {
  return {"named", std::move(effects)};
}

TEST(HiddenEffectScoring, ANameIsRightByItselfOrAsARival) {
  EXPECT_EQ(judge(named({{"spindle.growth.z", {}, 0.9}}), {"spindle.growth.z"}).outcome, Outcome::Named);
  EXPECT_EQ(judge(named({{"ambient.drift.z", {"spindle.growth.z"}, 0.6}}), {"spindle.growth.z"}).outcome,
            Outcome::Rival);
  EXPECT_EQ(judge(named({{"rotary.expansion.r0t", {}, 0.9}}), {"table.expansion.xy"}).outcome, Outcome::Named);
  EXPECT_EQ(judge(named({}), {"spindle.growth.z"}).outcome, Outcome::Abstained);
}

TEST(HiddenEffectScoring, AnythingBesideTheTruthIsWrong) {
  EXPECT_EQ(judge(named({{"ambient.drift.z", {}, 0.9}}), {"spindle.growth.z"}).outcome, Outcome::Wrong);
  EXPECT_EQ(judge(named({{"spindle.growth.z", {}, 0.9}, {"backlash.x", {}, 0.9}}), {"spindle.growth.z"}).outcome,
            Outcome::Wrong);
}

TEST(HiddenEffectScoring, OneOfSeveralIsAnAbstentionAboutTheOthers) {
  const Verdict verdict = judge(named({{"spindle.growth.z", {}, 0.9}, {"backlash.x", {}, 0.9}}),
                                {"spindle.growth.z", "backlash.x", "coolant.shock.y"});
  EXPECT_EQ(verdict.outcome, Outcome::Abstained);
  EXPECT_EQ(verdict.found, 2);
}

TEST(HiddenEffectScoring, EachHiddenEffectNeedsAListedOneOfItsOwn) {
  // Two names with one truth between them: nothing is wrong, and nothing is right.
  const Answer twice = named({{"spindle.drift.x", {}, 0.5}, {"ambient.drift.x", {"spindle.drift.x"}, 0.5}});
  EXPECT_EQ(judge(twice, {"spindle.drift.x"}).outcome, Outcome::Abstained);
  EXPECT_EQ(judge(twice, {"spindle.drift.x", "backlash.y"}).found, 1);
  // The first set could stand for either; the second only for one of them.
  const Answer shared = named({{"ambient.drift.x", {"spindle.drift.x"}, 0.5}, {"ambient.drift.x", {}, 0.5}});
  EXPECT_EQ(judge(shared, {"ambient.drift.x", "spindle.drift.x"}).found, 2);
}

TEST(HiddenEffectScoring, ASetOfMoreThanThreeIsNoAnswerUnlessItIsContainers) {
  const Answer four = named({{"ambient.drift.y", {"spindle.drift.y", "instrument.warm_up.y", "coolant.shock.y"}, 0.3}});
  EXPECT_EQ(judge(four, {"spindle.drift.y"}).outcome, Outcome::Abstained);
  EXPECT_EQ(judge(four, {"backlash.y"}).outcome, Outcome::Wrong);
  const Answer containers =
      named({{"ambient.drift.z", {"spindle.growth.z", "instrument.warm_up.z", "column.expansion.z"}, 0.3}});
  EXPECT_EQ(judge(containers, {"spindle.growth.z"}).outcome, Outcome::Rival);
}

}  // namespace
}  // namespace spindrift::study
