// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/session_source.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"

namespace spindrift::cli {

bool isSession(const std::filesystem::path& folder) {
  return std::filesystem::is_regular_file(folder / "spindrift-session.json");
}

SessionSource::SessionSource(const std::filesystem::path& folder, const std::string& campaign, JobContext& job)
    : session_(Session::open(folder)) {
  const std::vector<CampaignRecord> all = session_.campaigns();
  const auto found = std::find_if(all.begin(), all.end(), [&](const CampaignRecord& r) { return r.name == campaign; });
  if (all.empty() || (!campaign.empty() && found == all.end())) {
    throw InputError({folder.string(), ""}, campaign.empty() ? std::string("holds no campaign.")
                                                             : fmt::format("holds no campaign \"{}\".", campaign));
  }
  state_ = CampaignState::read(session_, campaign.empty() ? 0 : found->id);
  session_.takeFiles(state_.id, fingerprintsOfFiles(state_.campaign->folder, job));
}

void SessionSource::keep(const ResultOrigin& origin, const nlohmann::json& payload) {
  state_.latest[origin.kind] = session_.keepResult(origin, payload);
  if (origin.kind == "evaluate")
    state_.evaluation = std::make_shared<StoredEvaluation>(evaluationFrom(*state_.latest[origin.kind]));
}

bool SessionSource::evaluate(JobContext& job) {
  if (tasks().needed("evaluate").empty()) return false;
  const ResultOrigin origin = tasks().origin("evaluate");
  keep(origin, payloadOf(evaluateCampaign(*withoutExcluded(*state_.campaign, state_.excluded), {}, job)));
  return true;
}

}  // namespace spindrift::cli
