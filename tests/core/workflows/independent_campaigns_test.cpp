// SPDX-License-Identifier: GPL-3.0-or-later
// Campaigns that another program made from the description of the files and the effects alone (tests/data/independent):
// what is hidden in them is named, each effect by itself, and nothing else is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/workflows/discrepancy_workflow.h"
#include "tests/support/source_folder.h"

namespace spindrift {
namespace {

class IndependentCampaign : public ::testing::TestWithParam<const char*> {};

TEST_P(IndependentCampaign, IsExplainedByWhatIsHiddenInIt) {
  const std::filesystem::path folder = testing::testData() / "independent" / GetParam();
  const auto truth = nlohmann::json::parse(readFile(folder / "truth.json"));
  std::vector<std::string> hidden = truth.at("hidden");
  DiscrepancyRequest request;
  request.campaign = folder;
  JobContext job;
  const DiscrepancyResult result = runDiscrepancy(request, job).result;
  std::vector<std::string> named;
  for (const FoundEffect& effect : result.effects) {
    named.push_back(effect.id);
    EXPECT_THAT(effect.rivals, ::testing::IsEmpty()) << effect.id;
  }
  if (hidden == std::vector<std::string>{"outside"}) {
    EXPECT_EQ(result.verdict, DiscrepancyVerdict::Unknown) << result.message;
    EXPECT_THAT(named, ::testing::IsEmpty());
    return;
  }
  EXPECT_EQ(result.verdict, hidden.empty() ? DiscrepancyVerdict::None : DiscrepancyVerdict::Named) << result.message;
  EXPECT_THAT(named, ::testing::UnorderedElementsAreArray(hidden));
}

INSTANTIATE_TEST_SUITE_P(Made, IndependentCampaign,
                         ::testing::Values("two_effects", "three_effects", "outside_the_catalogue",
                                           "together_ball_screw", "together_slip", "heavy_tails", "warm_at_the_start",
                                           "nothing", "nothing_together", "together_coolant", "together_rotation",
                                           "three_with_the_sun", "load_that_ended_unseen", "part_far_off"),
                         [](const auto& test) { return std::string(test.param); });

TEST(IndependentCampaigns, ALoadAndADriftAlongOneAxisAreToldApartBesideAHeadThatTilts) {
  // The head moves three components, load and drift only Z: lags that were moved one at a time stood between the two.
  DiscrepancyRequest request;
  request.campaign = testing::testData() / "independent" / "tilt_and_more";
  JobContext job;
  const DiscrepancyResult result = runDiscrepancy(request, job).result;
  std::vector<std::string> named;
  for (const FoundEffect& effect : result.effects) named.push_back(effect.id);
  EXPECT_THAT(named, ::testing::UnorderedElementsAre("head.tilt.a", "external_heat.z", "ambient.drift.z"))
      << result.message;
  EXPECT_EQ(result.verdict, DiscrepancyVerdict::Named);
}

}  // namespace
}  // namespace spindrift
