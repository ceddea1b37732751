// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/session_source.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"

namespace spindrift::cli {

bool isSession(const std::filesystem::path& folder) {
  return std::filesystem::is_regular_file(folder / "spindrift-session.json");
}

namespace {

CampaignState stateOf(const Session& session, const std::string& campaign) {
  const std::vector<CampaignRecord> all = session.campaigns();
  const auto found = std::find_if(all.begin(), all.end(), [&](const CampaignRecord& r) { return r.name == campaign; });
  if (all.empty() || (!campaign.empty() && found == all.end())) {
    throw InputError({session.folder().string(), ""}, campaign.empty()
                                                          ? std::string("holds no campaign.")
                                                          : fmt::format("holds no campaign \"{}\".", campaign));
  }
  return CampaignState::read(session, campaign.empty() ? 0 : found->id);
}

}  // namespace

SessionSource::SessionSource(const std::filesystem::path& folder, const std::string& campaign, JobContext& job)
    : session_(Session::open(folder)), tasks_(session_, stateOf(session_, campaign)) {
  // Results may rest on other campaigns as well. One of these that cannot be read is told where it is used.
  for (const CampaignRecord& record : session_.campaigns()) {
    if (record.id == state().id) continue;
    try {
      session_.takeFiles(record.id, fingerprintsOfFiles(record.folder, job));
    } catch (const InputError&) {
    }
  }
  session_.takeFiles(state().id, fingerprintsOfFiles(state().campaign->folder, job));
}

}  // namespace spindrift::cli
