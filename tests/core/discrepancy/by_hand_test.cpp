// SPDX-License-Identifier: GPL-3.0-or-later
// Effects put in or left out by hand: what has no support is said to have none and changes nothing else; what is
// rejected is weighed against what stands in its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/core/discrepancy/small_plant.h"

namespace spindrift {
namespace {

using small_plant::campaign;
using small_plant::Hidden;
using small_plant::run;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(AcceptedByHand, WithoutSupportChangesNothingElse) {
  for (std::uint64_t seed = 2; seed < 5; ++seed) {
    const DiscrepancyInput input = campaign(Hidden::SpindleDrift, seed);
    const DiscrepancyResult plain = run(input);
    ASSERT_EQ(plain.effects.size(), 1u) << "seed " << seed;
    for (const char* id : {"ball_screw.expansion.x", "ambient.drift.x", "column.bending.b", "fixture.slip.F2"}) {
      DiscrepancyOptions options;
      options.accept = {id};
      const DiscrepancyResult result = run(input, options);
      SCOPED_TRACE(std::string(id) + ", seed " + std::to_string(seed));
      EXPECT_THAT(result.warnings, Contains(HasSubstr("do not support it")));
      ASSERT_EQ(result.effects.size(), 2u);
      EXPECT_TRUE(result.effects[0].forced);
      EXPECT_TRUE(result.effects[0].rivals.empty());
      EXPECT_LT(result.effects[0].confidence, 0.5);
      EXPECT_EQ(result.effects[1].id, plain.effects[0].id);
      EXPECT_EQ(result.effects[1].rivals, plain.effects[0].rivals);
      EXPECT_NEAR(result.effects[1].confidence, plain.effects[0].confidence, 0.1);
      EXPECT_EQ(result.verdict, plain.verdict);
      // Nor does it spoil the prediction.
      EXPECT_LT(result.gap.heldout_rms_after_um, 1.03 * plain.gap.heldout_rms_after_um);
    }
  }
}

TEST(AcceptedByHand, WhereNothingIsMissing) {
  const DiscrepancyInput input = campaign(Hidden::Nothing, 6);
  DiscrepancyOptions options;
  options.accept = {"spindle.drift.x"};
  const DiscrepancyResult result = run(input, options);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("do not support it")));
  ASSERT_EQ(result.effects.size(), 1u);
  EXPECT_TRUE(result.effects[0].forced);
  EXPECT_LT(result.gap.heldout_rms_after_um, 1.03 * result.gap.heldout_rms_before_um);
}

TEST(AcceptedByHand, InReadingsWithoutAnyNoise) {
  DiscrepancyInput input = campaign(Hidden::SpindleDrift, 6);
  for (std::size_t i = 0; i < input.observations.rows.size(); ++i)
    input.observations.rows[i].value = input.predicted[i];
  for (const char* id : {"spindle.drift.y", "ball_screw.expansion.x", "column.bending.b"}) {
    DiscrepancyOptions options;
    options.accept = {id};
    const DiscrepancyResult result = run(input, options);
    ASSERT_EQ(result.effects.size(), 1u) << id;
    EXPECT_EQ(result.effects[0].id, id);
    for (const FittedParameter& p : result.effects[0].parameters) EXPECT_TRUE(std::isfinite(p.value)) << id;
    EXPECT_LT(result.gap.rms_after_um, 0.01) << id;
    EXPECT_THAT(result.warnings, Contains(HasSubstr("do not support it")));
  }
}

TEST(AcceptedByHand, InThePlaceOfAMoreProbableOneIsSaidToBe) {
  // A turn of the frame about any axis holds a drift along Y as a special case and takes its part.
  DiscrepancyOptions options;
  options.accept = {"frame.rotation.c"};
  const DiscrepancyResult result = run(campaign(Hidden::SpindleDrift, 2), options);
  ASSERT_FALSE(result.effects.empty());
  EXPECT_TRUE(result.effects[0].forced);
  EXPECT_LT(result.effects[0].confidence, 0.5);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("spindle.drift.y in its place is more probable")));
}

TEST(RejectedByHand, IsWeighedAgainstItsRivals) {
  for (std::uint64_t seed = 2; seed < 5; ++seed) {
    const DiscrepancyInput input = campaign(Hidden::SpindleDrift, seed);
    DiscrepancyOptions options;
    options.reject = {"spindle.drift.y"};
    const DiscrepancyResult result = run(input, options);
    SCOPED_TRACE(seed);
    for (const FoundEffect& e : result.effects) {
      EXPECT_NE(e.id, "spindle.drift.y");
      EXPECT_LT(e.confidence, 0.5) << e.id;
      EXPECT_THAT(e.rivals, Not(Contains("spindle.drift.y")));
    }
    // The probabilities are stated against the rejected one: it leads, and says that it is rejected.
    const auto found = std::find_if(result.candidates.begin(), result.candidates.end(),
                                    [](const EffectCandidate& c) { return c.id == "spindle.drift.y"; });
    ASSERT_NE(found, result.candidates.end());
    EXPECT_TRUE(found->rejected);
    EXPECT_GT(found->probability, 0.8);
    for (const EffectCandidate& c : result.candidates) EXPECT_EQ(c.rejected, c.id == "spindle.drift.y");
    EXPECT_THAT(result.warnings, Contains(HasSubstr("spindle.drift.y was rejected by hand; with it considered")));
    EXPECT_TRUE(result.json()["candidates"].at(0).contains("rejected"));
  }
}

TEST(RejectedByHand, WhatNobodyAsksForIsNotMissed) {
  const DiscrepancyInput input = campaign(Hidden::SpindleDrift, 3);
  const DiscrepancyResult plain = run(input);
  DiscrepancyOptions options;
  options.reject = {"fixture.slip.F1"};
  const DiscrepancyResult result = run(input, options);
  ASSERT_EQ(result.effects.size(), plain.effects.size());
  EXPECT_EQ(result.effects[0].id, plain.effects[0].id);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("fixture.slip.F1 was rejected by hand; the data do not ask")));
}

// A list of switched-off effects is kept from one search to the next, while machine and data change.
TEST(RejectedByHand, AnEffectThatCannotBeTriedAnyway) {
  DiscrepancyInput input = campaign(Hidden::SpindleDrift, 3);
  DiscrepancyOptions options;
  options.reject = {"rotary.expansion.r0t"};
  EXPECT_FALSE(run(input, options).effects.empty());
  options.reject = {"rotary.no_such"};
  EXPECT_THROW((void)run(input, options), InputError);
}

}  // namespace
}  // namespace spindrift
