// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/commands/bound_options.h"

#include <utility>

#include "widgets/commands/commands.h"

namespace spindrift::gui {

OptionsBinding::OptionsBinding(SessionModel& session, CampaignUndo& undo, std::string key,
                               std::function<void()> changed)
    : session_(session), undo_(undo), key_(std::move(key)), changed_(std::move(changed)) {}

nlohmann::json OptionsBinding::kept() const {
  return session_.campaignSetting(key_, nlohmann::json());
}

void OptionsBinding::put(const QString& what, const nlohmann::json& before, const nlohmann::json& after) {
  if (after != before) undo_.push(new OptionsCommand(session_, what, session_.campaignKey(key_), after, changed_));
}

void OptionsBinding::fill(const std::function<void()>& controls) {
  const bool before = std::exchange(filling_, true);
  controls();
  filling_ = before;
}

}  // namespace spindrift::gui
