// SPDX-License-Identifier: GPL-3.0-or-later
// A room whose temperature nobody logged is a rival of every effect that changes as slowly as it and in its pattern.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "core/discrepancy/discrepancy.h"
#include "core/simulation/study_campaigns.h"
#include "tests/benchmarks/discrepancy/hidden_effect_scoring.h"

namespace spindrift {
namespace {

using ::testing::Contains;

constexpr auto room = "ambient.drift.x";

/// A campaign whose log lacks the room, which is what is hidden; nothing for a machine on which it would not be seen.
std::optional<StudyCase> roomHidden(std::uint64_t seed) {
  StudyOptions options;
  options.kind = StudyKind::Confounded;
  options.strength = 5.0;
  for (options.turn = 0; options.turn < 6; ++options.turn) {
    StudyCase made = studyCase(options, seed);
    if (made.hidden.front() == room) return made;
  }
  return std::nullopt;
}

TEST(RoomRivals, WhatIsNamedInItsPlaceHasItAsRivalAndIsNoSurerThanThat) {
  int named = 0;
  for (const std::uint64_t seed : {31002240056ULL, 31002240058ULL, 31002240108ULL, 31002240218ULL}) {
    SCOPED_TRACE(seed);
    const std::optional<StudyCase> made = roomHidden(seed);
    ASSERT_TRUE(made);
    JobContext job;
    DiscrepancyOptions options;
    options.suggest = false;
    const DiscrepancyResult result = findDiscrepancy(study::inputOf(simulateStudy(*made, job).campaign), options, job);
    for (const FoundEffect& effect : result.effects) {
      ++named;
      if (effect.id == room) continue;  // found by what stands in for its driver
      EXPECT_THAT(effect.rivals, Contains(room)) << effect.id;
      // One of two that the log cannot tell apart.
      EXPECT_LT(effect.confidence, 0.6) << effect.id;
    }
  }
  EXPECT_GE(named, 2) << "the test is about names";
}

}  // namespace
}  // namespace spindrift
