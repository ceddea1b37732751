// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/commands/bound_options.h"

#include <utility>

#include "widgets/commands/commands.h"

namespace spindrift::gui {

BoundOptions::BoundOptions(SessionModel& session, CampaignUndo& undo, std::string key, std::function<void()> changed)
    : session_(session), undo_(undo), key_(std::move(key)), changed_(std::move(changed)) {}

nlohmann::json BoundOptions::json() const {
  nlohmann::json kept = session_.campaignSetting(key_, nlohmann::json::object());
  return kept.is_null() ? nlohmann::json::object() : kept;
}

void BoundOptions::change(const QString& what, const nlohmann::json& change) {
  if (filling_) return;
  nlohmann::json after = json();
  if (change.is_object() && after.is_object()) {
    after.update(change);
  } else {
    after = change;
  }
  if (after == json()) return;
  undo_.push(new OptionsCommand(session_, what, session_.campaignKey(key_), after, changed_));
}

void BoundOptions::fill(const std::function<void()>& controls) {
  const bool before = std::exchange(filling_, true);
  controls();
  filling_ = before;
}

}  // namespace spindrift::gui
