// SPDX-License-Identifier: GPL-3.0-or-later
// What can be undone. Each command does one thing to the campaign at hand through SessionModel; CampaignUndo sees to
// it that this is the campaign it was made for.
#pragma once

#include <QUndoCommand>
#include <functional>
#include <memory>
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

/// Changes what is kept in the session under `key`: the options of a step, so that every step that depends on them is
/// judged anew. `changed` tells the page.
class OptionsCommand : public QUndoCommand {
 public:
  OptionsCommand(SessionModel& session, const QString& text, const std::string& key, nlohmann::json after,
                 std::function<void()> changed);
  void redo() override;
  void undo() override;

 protected:
  virtual void put(const nlohmann::json& value);

  SessionModel& session_;
  std::string key_;
  nlohmann::json before_, after_;
  std::function<void()> changed_;
};

/// Changes what is typed and not applied yet (SessionModel::draft): see Draft. What is typed into one place without a
/// break is one step. `show` tells the page when it is taken back or done again; what is typed stands there already.
class DraftCommand : public OptionsCommand {
 public:
  /// `place` is a JSON pointer into what is typed; empty: more than one place has changed.
  DraftCommand(SessionModel& session, const QString& text, const std::string& name, nlohmann::json after,
               std::string place, std::function<void()> show);
  void redo() override;
  [[nodiscard]] int id() const override;
  bool mergeWith(const QUndoCommand* next) override;

 private:
  /// No result depends on what is not applied.
  void put(const nlohmann::json& value) override;

  std::string place_;
  bool done_ = false;
};

/// Does what was typed: the draft goes when the command is done, and stands there again when it is undone.
class ApplyCommand : public QUndoCommand {
 public:
  ApplyCommand(SessionModel& session, const std::string& draft, std::unique_ptr<QUndoCommand> command);
  void redo() override;
  void undo() override;

 private:
  SessionModel& session_;
  std::string key_;
  nlohmann::json typed_;
  std::unique_ptr<QUndoCommand> command_;
};

/// Adds a note, or removes one; either way it comes back as it was, in its place.
class NoteCommand : public QUndoCommand {
 public:
  NoteCommand(SessionModel& session, Note note, bool add);
  void redo() override;
  void undo() override;

 private:
  void put();
  SessionModel& session_;
  Note note_;
  bool add_;
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
