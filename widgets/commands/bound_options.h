// SPDX-License-Identifier: GPL-3.0-or-later
// The options of a task of the campaign at hand, bound to the session: every change is one step that can be undone, and
// makes the task's result outdated wherever it is asked for.
#pragma once

#include <QString>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "core/tasks/task_options.h"
#include "widgets/commands/campaign_undo.h"
#include "widgets/models/session_model.h"

namespace spindrift::gui {

/// What is the same for all types of options.
class OptionsBinding {
 public:
  /// Controls are being filled with what is kept: what they tell is no wish of the user.
  void fill(const std::function<void()>& controls);
  [[nodiscard]] bool filling() const { return filling_; }

 protected:
  OptionsBinding(SessionModel& session, CampaignUndo& undo, std::string key, std::function<void()> changed);
  [[nodiscard]] nlohmann::json kept() const;
  void put(const QString& what, const nlohmann::json& before, const nlohmann::json& after);

 private:
  SessionModel& session_;
  CampaignUndo& undo_;
  std::string key_;
  std::function<void()> changed_;
  bool filling_ = false;
};

/// `Choice`: of core/tasks/task_options.h.
template <class Choice>
class BoundOptions : public OptionsBinding {
 public:
  /// `changed` is called after every change, done or undone, while its campaign is at hand.
  BoundOptions(SessionModel& session, CampaignUndo& undo, std::function<void()> changed)
      : OptionsBinding(session, undo, Choice::key, std::move(changed)) {}

  [[nodiscard]] Choice now() const { return optionsFrom<Choice>(kept()); }
  /// `edit(Choice&)` alters what is kept; `what` names the step. Nothing happens if that changes nothing, or while the
  /// controls are filled.
  template <class Edit>
  void change(const QString& what, const Edit& edit) {
    if (filling()) return;
    const Choice before = now();
    Choice after = before;
    edit(after);
    put(what, optionsJson(before), optionsJson(after));
  }
};

}  // namespace spindrift::gui
