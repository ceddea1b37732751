// SPDX-License-Identifier: Apache-2.0
#include "core/tasks/campaign_facts.h"

#include <filesystem>

#include "core/workflows/instrument_checks.h"
#include "core/workflows/log_campaign.h"

namespace spindrift {

CampaignFacts CampaignFacts::of(const Campaign& campaign) {
  CampaignFacts facts;
  facts.images = campaign.captureList("fiducials.csv").has_value();
  facts.touches = campaign.captureList("touches.csv").has_value();
  facts.scans = campaign.captureList("scans.csv").has_value();
  facts.own_observations = campaign.observations.has_value();
  facts.simulation = !campaign.simulation.empty();
  facts.log = campaign.log.has_value();
  facts.warm_up = std::filesystem::exists(campaign.path(warm_up_file));
  facts.log_only = facts.log && !facts.own_observations && !facts.captures() && hasOutputSignals(*campaign.log);
  return facts;
}

}  // namespace spindrift
