// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/discrepancy/discrepancy_choice.h"

#include <algorithm>

#include "core/base/atomic_file.h"

namespace spindrift::gui {

std::string DiscrepancyChoice::key(const SessionModel& session) {
  return "discrepancy/" + std::to_string(session.campaignId());
}

std::filesystem::path DiscrepancyChoice::file(const SessionModel& session) {
  return session.folder() / "effects" / (std::to_string(session.campaignId()) + ".json");
}

DiscrepancyChoice DiscrepancyChoice::of(const SessionModel& session) {
  DiscrepancyChoice choice;
  const nlohmann::json json = session.setting(key(session), nlohmann::json::object());
  if (json.is_object()) {
    choice.added = json.value("added", std::vector<std::string>());
    choice.rejected = json.value("rejected", std::vector<std::string>());
    choice.effects = json.value("effects", nlohmann::json());
  }
  return choice;
}

nlohmann::json DiscrepancyChoice::json() const {
  nlohmann::json out{{"added", added}, {"rejected", rejected}};
  if (effects.is_object()) out["effects"] = effects;
  return out;
}

bool DiscrepancyChoice::considers(const std::string& id) const {
  return std::find(rejected.begin(), rejected.end(), id) == rejected.end();
}

void DiscrepancyChoice::consider(const std::string& id, bool considered) {
  std::erase(rejected, id);
  if (considered) return;
  std::erase(added, id);
  rejected.push_back(id);
}

std::shared_ptr<const Campaign> DiscrepancyChoice::applied(std::shared_ptr<const Campaign> campaign,
                                                           const std::filesystem::path& file) const {
  if (!effects.is_object()) return campaign;
  std::filesystem::create_directories(file.parent_path());
  writeFileAtomically(file, effects.dump(2) + "\n");
  auto copy = std::make_shared<Campaign>(*campaign);
  copy->effects = std::filesystem::absolute(file);
  return copy;
}

}  // namespace spindrift::gui
