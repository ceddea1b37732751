// SPDX-License-Identifier: GPL-3.0-or-later
// What is typed in an editor and not applied yet. It is on the disk with every change, belongs to the campaign and to
// what was being edited, and every change of it is a step that can be undone.
#pragma once

#include <QString>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

namespace spindrift::gui {

class CampaignUndo;
class SessionModel;

class Draft {
 public:
  /// `name` tells it from other editors' (SessionModel::draft). `show` fills the editor again: it is called when a
  /// change is taken back or done again, while its campaign is at hand.
  Draft(SessionModel& session, CampaignUndo& undo, std::string name, std::function<void()> show);

  [[nodiscard]] const std::string& name() const { return name_; }
  /// What was typed for `base`; null: nothing.
  [[nodiscard]] nlohmann::json typed(const nlohmann::json& base) const;
  /// Something was typed for what has become another meanwhile.
  [[nodiscard]] bool ofAnother(const nlohmann::json& base) const;
  /// What stands in the editor now that it is filled; the next change is told from it.
  void shown(nlohmann::json typed) { shown_ = std::move(typed); }
  /// The user typed; `what` names the step. Nothing happens if nothing has changed.
  void keep(const QString& what, const nlohmann::json& base, const nlohmann::json& typed);
  /// Gives up what was typed. The editor shows it when it is filled again.
  void discard();
  /// What was typed for another is typed for `base` from now on.
  void takeOver(const nlohmann::json& base);

 private:
  void push(const QString& what, nlohmann::json after, std::string place);

  SessionModel& session_;
  CampaignUndo& undo_;
  std::string name_;
  std::function<void()> show_;
  nlohmann::json shown_;
};

}  // namespace spindrift::gui
