// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/workflow/simulator_choice.h"

#include "widgets/models/session_model.h"

namespace spindrift::gui {
namespace {

std::filesystem::path whole(const std::filesystem::path& path) {
  return std::filesystem::absolute(path).lexically_normal();
}

}  // namespace

std::string simulatorKey(std::int64_t campaign) {
  return "discrepancy/simulator/" + std::to_string(campaign);
}

std::string simulatorKey(const SessionModel& session) {
  return simulatorKey(session.campaignId());
}

std::string simulatorName(const SessionModel& session, const std::filesystem::path& file) {
  const std::filesystem::path relative = whole(file).lexically_relative(whole(session.folder()));
  const bool within = !relative.empty() && *relative.begin() != "..";
  return within ? relative.generic_string() : whole(file).generic_string();
}

std::filesystem::path simulatorFile(const SessionModel& session, const std::string& name) {
  return whole(session.folder()) / name;
}

std::string currentSimulator(const SessionModel& session) {
  if (session.campaign() == nullptr) return {};
  const nlohmann::json chosen = session.setting(simulatorKey(session), nlohmann::json());
  if (chosen.is_string()) return chosen.get<std::string>();
  const Campaign& campaign = *session.campaign();
  return campaign.simulator.empty() ? std::string()
                                    : simulatorName(session, campaign.path(campaign.simulator.string()));
}

StoredResult simulationResult(SessionModel& session, const std::string& simulator) {
  Session* store = session.session();
  if (store == nullptr || simulator.empty()) return {};
  std::vector<StoredResult> all = store->resultHeads(session.campaignId(), simulation_result);
  for (auto it = all.rbegin(); it != all.rend(); ++it) {
    const nlohmann::json& options = it->provenance.options;
    if (options.value("simulator", "") == simulator || options.value("version", "") == simulator) return std::move(*it);
  }
  return {};
}

nlohmann::json simulationUpdateOf(SessionModel& session) {
  Session* store = session.session();
  const std::string simulator = currentSimulator(session);
  if (store == nullptr || simulator.empty()) return {};
  const std::vector<StoredResult> all = store->resultHeads(session.campaignId(), simulation_result);
  for (auto it = all.rbegin(); it != all.rend(); ++it) {
    if (it->provenance.options.value("version", "") == simulator) return store->payload(it->id);
  }
  return {};
}

}  // namespace spindrift::gui
