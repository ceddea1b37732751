// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/bound_options.h"

#include <utility>

#include "widgets/commands/commands.h"

namespace spindrift::gui {

BoundOptions::BoundOptions(PageContext& context, std::string key, std::function<void()> changed)
    : context_(context), key_(std::move(key)), changed_(std::move(changed)) {}

nlohmann::json BoundOptions::json() const {
  nlohmann::json kept = context_.session.campaignSetting(key_, nlohmann::json::object());
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
  context_.undo.push(new OptionsCommand(context_.session, what, context_.session.campaignKey(key_), after, changed_));
}

void BoundOptions::fill(const std::function<void()>& controls) {
  const bool before = std::exchange(filling_, true);
  controls();
  filling_ = before;
}

}  // namespace spindrift::gui
