// SPDX-License-Identifier: GPL-3.0-or-later
// What is typed in an editor and not applied yet. It is on the disk with every change, belongs to the campaign and to
// what was being edited, and every change of it is a step that can be undone. What is set in a window of its own (a
// note, sliders, a design) is kept the same way and is no step.
#pragma once

#include <QString>
#include <cstdint>
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

/// What is set in a window beside the pages and leaves no result, for the campaign that is at hand when the window is
/// opened: there again after another campaign, another session and a crash. Without a session it is kept with the
/// settings of the program.
class WindowDraft {
 public:
  /// Keeps nothing.
  WindowDraft() = default;
  /// `name` tells it from other windows'. The session has to live as long.
  WindowDraft(SessionModel& session, const std::string& name);

  /// What was set last; null: nothing.
  [[nodiscard]] nlohmann::json typed() const;
  /// Null: there is nothing to keep. Nothing happens when the session it belongs to is not open any more.
  void keep(const nlohmann::json& typed);
  /// Of a campaign, and not only of the program.
  [[nodiscard]] bool ofCampaign() const { return of_campaign_; }
  /// Whether a window that is opened now would keep the same.
  [[nodiscard]] bool atHand() const;

 private:
  SessionModel* session_ = nullptr;
  std::string name_;
  std::int64_t session_number_ = 0;  ///< SessionModel::sessionNumber
  std::string key_;                  ///< SessionModel::draftKey
  bool of_campaign_ = false;
};

}  // namespace spindrift::gui
