// SPDX-License-Identifier: Apache-2.0
// From a session (or a campaign folder) into a plant store, when somebody says so. Where the store cannot be reached,
// what is published waits in the session and arrives once, with the next publishing.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/plant/plant_store.h"
#include "core/session/session.h"
#include "core/tasks/campaign_state.h"

namespace spindrift {

/// "user@host".
[[nodiscard]] std::string plantPublisher();

/// What the store keeps of a result as the session keeps it: parameters with their covariance, verdict, model. Kinds
/// that say nothing about the machine (checks, plans, reports) give nothing.
[[nodiscard]] std::optional<PlantResult> plantResult(const StoredResult& result);

/// A campaign folder without a session: its captures are evaluated, and the model of its last thermal state is fitted
/// where there are observations. Throws InputError, Cancelled. The folder is not written to.
[[nodiscard]] PlantCampaign plantCampaign(const std::filesystem::path& folder, JobContext& job);

/// What waits in a session for a store.
[[nodiscard]] std::vector<PlantCampaign> waitingFor(const Session& session, const std::string& store);

struct PublishOutcome {
  PublishCount count;
  std::size_t waiting = 0;            ///< campaigns that wait in the session, because the store cannot be reached
  std::string reason;                 ///< why they wait; empty: nothing waits
  std::vector<std::string> warnings;  ///< results that do not hold; of the store, such as a wrong clock
};

/// Publishing in parts, so that a window does not wait for files and servers: campaigns are read on any thread
/// (CampaignState::read), the publication begins and ends where the session is used, and is sent on any thread. Of
/// every kind the newest result that holds is published, as everything else uses it (TaskGraph::latest); of a kind of
/// which none holds, the newest, and a warning says so.
struct Publication {
  struct Pending {
    CampaignRecord record;
    std::shared_ptr<const Campaign> campaign;
    std::vector<PlantResult> results;
  };
  std::string store;
  std::vector<Pending> pending;
  std::vector<PlantCampaign> campaigns;  ///< what waits already; `sendPublication` adds the pending ones
  std::vector<std::string> warnings;     ///< results that do not hold, one sentence each
  bool waited = false;
};
/// `campaigns` as they were read from this session. Throws InputError: a result cannot be read.
[[nodiscard]] Publication beginPublication(const Session& session, const std::vector<CampaignState>& campaigns,
                                           const PlantAddress& address);
/// A store that cannot be reached is an outcome; a refusal is an InputError, and what waits goes on waiting.
[[nodiscard]] PublishOutcome sendPublication(Publication& publication, const PlantAddress& address,
                                             const PlantOpening& opening, JobContext& job);
/// Keeps what has to wait, and forgets what has arrived.
void endPublication(Session& session, const Publication& publication, const PublishOutcome& outcome);

/// All of it.
[[nodiscard]] PublishOutcome publishFromSession(Session& session, const std::vector<std::int64_t>& campaigns,
                                                const PlantAddress& address, const PlantOpening& opening = {});

}  // namespace spindrift
