// SPDX-License-Identifier: GPL-3.0-or-later
// What can be undone. Each command does one thing to the campaign at hand through SessionModel; CampaignUndo sees to
// it that this is the campaign it was made for.
#pragma once

#include <QUndoCommand>
#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "widgets/models/session_model.h"

namespace spindrift::gui {

/// Takes captures or observations out (with a reason) or brings them back (empty reason).
class ExcludeCommand : public QUndoCommand {
 public:
  ExcludeCommand(SessionModel& session, const QStringList& items, const QString& reason);
  void redo() override;
  void undo() override;

 private:
  SessionModel& session_;
  std::vector<std::pair<QString, QString>> before_;  // item, reason (empty: was in)
  QString reason_;
};

/// Puts one item that is taken out in the place of another (the mask of a scan after a stroke); item and reason each,
/// an empty item stands for none.
class ReplaceExclusionCommand : public QUndoCommand {
 public:
  using Entry = std::pair<QString, QString>;
  ReplaceExclusionCommand(SessionModel& session, Entry before, Entry after, const QString& text);
  void redo() override;
  void undo() override;

 private:
  void replace(const Entry& from, const Entry& to);
  SessionModel& session_;
  Entry before_, after_;
};

/// Changes the options of a step, kept in the session under `key`. `changed` tells the page.
class OptionsCommand : public QUndoCommand {
 public:
  OptionsCommand(SessionModel& session, const QString& text, const std::string& key, nlohmann::json after,
                 std::function<void()> changed);
  void redo() override;
  void undo() override;

 private:
  SessionModel& session_;
  std::string key_;
  nlohmann::json before_, after_;
  std::function<void()> changed_;
};

/// Replaces the machine by an edited one (or back by the file's).
class MachineCommand : public QUndoCommand {
 public:
  MachineCommand(SessionModel& session, nlohmann::json after);
  void redo() override;
  void undo() override;

 private:
  SessionModel& session_;
  nlohmann::json before_, after_;
};

}  // namespace spindrift::gui
