// SPDX-License-Identifier: GPL-3.0-or-later
// The options of a task of the campaign at hand, bound to the session: every change is one step that can be undone, and
// makes the task's result outdated wherever it is asked for.
#pragma once

#include <QString>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "widgets/commands/campaign_undo.h"
#include "widgets/models/session_model.h"

namespace spindrift::gui {

class BoundOptions {
 public:
  /// `key`: of option_keys (core/tasks). `changed` is called after every change, done or undone, while its campaign is
  /// at hand.
  BoundOptions(SessionModel& session, CampaignUndo& undo, std::string key, std::function<void()> changed);

  /// As kept; an empty object where nothing was chosen yet. A single value is kept as it is.
  [[nodiscard]] nlohmann::json json() const;
  /// Puts `change` over what is kept; `what` names the step. Nothing happens if it changes nothing, or while the
  /// controls are filled.
  void change(const QString& what, const nlohmann::json& change);
  /// Controls are being filled with what is kept: what they tell is no wish of the user.
  void fill(const std::function<void()>& controls);
  [[nodiscard]] bool filling() const { return filling_; }

 private:
  SessionModel& session_;
  CampaignUndo& undo_;
  std::string key_;
  std::function<void()> changed_;
  bool filling_ = false;
};

}  // namespace spindrift::gui
