// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/study_campaigns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "core/simulation/virtual_campaign.h"

namespace spindrift {
namespace {

TEST(StudyCampaigns, WalkThroughTheWholeCatalogueAtTheStatedStrength) {
  std::set<std::string> seen;
  for (std::size_t turn = 0; turn < studyEffects().size(); ++turn) {
    StudyOptions options;
    options.turn = turn;
    const StudyCase made = studyCase(options, 100 + turn);
    ASSERT_EQ(made.hidden.size(), 1u);
    const VirtualCampaign campaign = simulateCampaign(made.scenario, {}, {});
    ASSERT_EQ(campaign.truth.hidden, made.hidden);
    EXPECT_GE(campaign.truth.base.size(), 2u);
    std::map<Component, std::pair<double, int>> sums;
    for (std::size_t i = 0; i < campaign.truth.hidden_signal.size(); ++i) {
      const Observation& row = campaign.campaign.observations->rows[i];
      if (row.use != ObservationUse::Fit) continue;
      sums[row.component].first += std::pow(campaign.truth.hidden_signal[i] / row.sigma, 2);
      ++sums[row.component].second;
    }
    double strength = 0.0;
    for (const auto& [component, sum] : sums) strength = std::max(strength, std::sqrt(sum.first / sum.second));
    EXPECT_NEAR(strength, 4.0, 1e-6) << made.hidden.front();
    seen.insert(made.hidden.front().substr(0, made.hidden.front().find('.')));
  }
  EXPECT_GE(seen.size(), 15u);
}

TEST(StudyCampaigns, KindsHideWhatTheySay) {
  for (const StudyKind kind : {StudyKind::Two, StudyKind::Nothing, StudyKind::Outside, StudyKind::Confounded}) {
    for (std::size_t turn = 0; turn < 4; ++turn) {
      StudyOptions options;
      options.kind = kind;
      options.turn = turn;
      const StudyCase made = studyCase(options, 7 + turn);
      const VirtualCampaign campaign = simulateCampaign(made.scenario, {}, {});
      EXPECT_EQ(campaign.truth.hidden.size(), kind == StudyKind::Nothing ? 0u : kind == StudyKind::Two ? 2u : 1u);
      EXPECT_GE(campaign.campaign.observations->rows.size(), 1080u);
      if (kind == StudyKind::Outside) {
        EXPECT_TRUE(campaign.truth.hidden.front().starts_with("unknown."));
      }
    }
  }
}

}  // namespace
}  // namespace spindrift
