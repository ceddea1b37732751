// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/workflow/simulator_choice.h"

#include <utility>

#include "core/tasks/task_options.h"
#include "widgets/models/session_model.h"

namespace spindrift::gui {

std::string simulatorKey(std::int64_t campaign) {
  return campaignKey(option_keys::simulator, campaign);
}

std::filesystem::path simulatorFile(const SessionModel& session, const std::string& name) {
  return placeNamed(*session.session(), name);
}

std::string currentSimulator(const SessionModel& session) {
  if (session.campaign() == nullptr) return {};
  return SimulationOptions::of(*session.session(), session.campaignId(), *session.campaign()).simulator;
}

StoredResult simulationResult(const SessionModel& session, const std::string& simulator) {
  const Session* store = session.session();
  if (store == nullptr || simulator.empty()) return {};
  std::vector<StoredResult> all = store->resultHeads(session.campaignId(), "simulation");
  for (auto it = all.rbegin(); it != all.rend(); ++it) {
    const auto options = optionsFrom<SimulationOptions>(it->provenance.options);
    if (options.simulator == simulator || options.version == simulator) return std::move(*it);
  }
  return {};
}

}  // namespace spindrift::gui
