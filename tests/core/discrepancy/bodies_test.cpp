// SPDX-License-Identifier: GPL-3.0-or-later
// What is missing in a machine of bodies: heat that flows between them gives each effect another shape and another
// course than the catalogue's. Names must bear that, and what is added must not enlarge the gap on held-out states.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/discrepancy/discrepancy.h"
#include "tests/core/discrepancy/heated_column.h"

namespace spindrift {
namespace {

struct Story {
  std::string what;
  ParameterValues truth;
  std::vector<std::string> names;  ///< any of these is right
};

struct Tally {
  int right = 0;
  int named = 0;
  int larger = 0;  ///< the gap on held-out states is larger than without any addition
  std::string told;
};

Tally tallyOf(const Story& story, std::uint64_t first_seed, int campaigns) {
  Tally tally;
  for (int k = 0; k < campaigns; ++k) {
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(k);
    ParameterValues truth = story.truth;
    if (truth.contains("sun_front")) {
      Random random(seed);
      truth["sun_on_s"] = random.uniform(3000.0, 9000.0);
      truth["sun_off_s"] = truth["sun_on_s"] + random.uniform(6000.0, 11'000.0);
    }
    const heated_column::Column column = heated_column::columnCampaign(truth, seed);
    DiscrepancyOptions options;
    options.suggest = false;
    JobContext job;
    const DiscrepancyResult result = findDiscrepancy(column.input, options, job);
    bool right = false;
    std::string ids;
    for (const FoundEffect& e : result.effects) {
      right = right || std::find(story.names.begin(), story.names.end(), e.id) != story.names.end();
      ids += e.id + " ";
    }
    tally.right += right ? 1 : 0;
    tally.named += result.effects.empty() ? 0 : 1;
    tally.larger += result.gap.heldout_rms_after_um > result.gap.heldout_rms_before_um ? 1 : 0;
    tally.told += fmt::format("{} seed {}: {}, held out {:.2f} -> {:.2f} um\n", story.what, seed,
                              ids.empty() ? toString(result.verdict) : ids, result.gap.heldout_rms_before_um,
                              result.gap.heldout_rms_after_um);
  }
  return tally;
}

constexpr int campaigns_each = 6;

TEST(Bodies, TheSunOnOneWallIsNamedFromTheWindowThatBendAndLiftShare) {
  const Story sun{
      "sun", {{"sun_front", 60.0}}, {"external_heat.a", "external_heat.z", "column.bending.a", "column.expansion.z"}};
  const Tally tally = tallyOf(sun, 31'001, campaigns_each);
  EXPECT_GE(tally.right, 5) << tally.told;
  EXPECT_EQ(tally.larger, 0) << tally.told;
}

TEST(Bodies, HeatOfTheSpindleIsNamed) {
  const Story friction{"friction", {{"friction", 16.0}}, {"spindle.growth.z", "spindle.drift.y", "head.tilt.a"}};
  const Tally tally = tallyOf(friction, 32'001, campaigns_each);
  EXPECT_GE(tally.right, 5) << tally.told;
  EXPECT_EQ(tally.larger, 0) << tally.told;
}

TEST(Bodies, AFilmThatNoEffectFollowsEnlargesNoGap) {
  // A wet table follows the coolant within minutes and the room no more: in no catalogue.
  const Tally tally = tallyOf({"coolant", {{"h_coolant", 900.0}}, {}}, 33'001, campaigns_each);
  EXPECT_EQ(tally.larger, 0) << tally.told;
}

TEST(Bodies, NothingIsNamedWhereNothingIsMissing) {
  const Tally tally = tallyOf({"nothing", {}, {}}, 34'001, campaigns_each);
  EXPECT_EQ(tally.named, 0) << tally.told;
}

}  // namespace
}  // namespace spindrift
