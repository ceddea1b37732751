// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/commands/commands.h"

#include <QCoreApplication>
#include <utility>

namespace spindrift::gui {
namespace {

constexpr int draft_command = 1;  ///< commands of this id may be merged

QString commandText(const char* text) {
  return QCoreApplication::translate("Commands", text);
}

}  // namespace

ExcludeCommand::ExcludeCommand(SessionModel& session, const QStringList& items, const QString& reason)
    : session_(session), reason_(reason) {
  for (const QString& item : items) {
    const auto found = session.excluded().find(item);
    before_.emplace_back(item, found == session.excluded().end() ? QString() : found->second);
  }
  const QString what = items.size() == 1 ? items.front() : commandText("%1 items").arg(items.size());
  setText((reason.isEmpty() ? commandText("restore %1") : commandText("exclude %1")).arg(what));
}

void ExcludeCommand::redo() {
  auto after = before_;
  for (auto& [item, reason] : after) reason = reason_;
  session_.setExcluded(after);
}

void ExcludeCommand::undo() {
  session_.setExcluded(before_);
}

ReplaceExclusionCommand::ReplaceExclusionCommand(SessionModel& session, Entry before, Entry after, const QString& text)
    : session_(session), before_(std::move(before)), after_(std::move(after)) {
  setText(text);
}

void ReplaceExclusionCommand::replace(const Entry& from, const Entry& to) {
  std::vector<Entry> items;
  if (!from.first.isEmpty() && from.first != to.first) items.emplace_back(from.first, QString());
  if (!to.first.isEmpty()) items.push_back(to);
  session_.setExcluded(items);
}

void ReplaceExclusionCommand::redo() {
  replace(before_, after_);
}

void ReplaceExclusionCommand::undo() {
  replace(after_, before_);
}

OptionsCommand::OptionsCommand(SessionModel& session, const QString& text, const std::string& key, nlohmann::json after,
                               std::function<void()> changed)
    : session_(session),
      key_(key),
      before_(session.setting(key, nullptr)),
      after_(std::move(after)),
      changed_(std::move(changed)) {
  setText(text);
}

void OptionsCommand::put(const nlohmann::json& value) {
  session_.setOption(key_, value);
}

void OptionsCommand::redo() {
  put(after_);
  if (changed_) changed_();
}

void OptionsCommand::undo() {
  put(before_);
  if (changed_) changed_();
}

DraftCommand::DraftCommand(SessionModel& session, const QString& text, const std::string& name, nlohmann::json after,
                           std::string place, std::function<void()> show)
    : OptionsCommand(session, text, session.draftKey(name), std::move(after), std::move(show)),
      place_(std::move(place)) {}

void DraftCommand::put(const nlohmann::json& value) {
  session_.setSetting(key_, value);
}

void DraftCommand::redo() {
  put(after_);
  if (std::exchange(done_, true) && changed_) changed_();
}

int DraftCommand::id() const {
  return draft_command;
}

bool DraftCommand::mergeWith(const QUndoCommand* next) {
  const auto& other = static_cast<const DraftCommand&>(*next);  // the stack asks those of the same id alone
  const bool here = !place_.empty() && (other.place_ == place_ || other.place_.starts_with(place_ + "/"));
  if (!here || other.key_ != key_) return false;
  after_ = other.after_;
  return true;
}

ApplyCommand::ApplyCommand(SessionModel& session, const std::string& draft, std::unique_ptr<QUndoCommand> command)
    : session_(session),
      key_(session.draftKey(draft)),
      typed_(session.setting(key_, nullptr)),
      command_(std::move(command)) {
  setText(command_->text());
}

void ApplyCommand::redo() {
  session_.setSetting(key_, nullptr);
  command_->redo();
}

void ApplyCommand::undo() {
  session_.setSetting(key_, typed_);
  command_->undo();
}

NoteCommand::NoteCommand(SessionModel& session, Note note, bool add)
    : session_(session), note_(std::move(note)), add_(add) {
  setText(add ? commandText("add a note") : commandText("remove a note"));
}

void NoteCommand::put() {
  note_.id = session_.addNote(note_);
  if (note_.id == 0) setObsolete(true);
}

void NoteCommand::redo() {
  if (add_) {
    put();
  } else {
    session_.removeNote(note_.id);
  }
}

void NoteCommand::undo() {
  if (add_) {
    session_.removeNote(note_.id);
  } else {
    put();
  }
}

MachineCommand::MachineCommand(SessionModel& session, nlohmann::json after)
    : session_(session),
      before_(session.machineEdited() ? session.campaign()->machine.source : nlohmann::json::object()),
      after_(std::move(after)) {
  setText(commandText("edit machine"));
}

void MachineCommand::redo() {
  session_.setMachine(after_);
}
void MachineCommand::undo() {
  session_.setMachine(before_);
}

}  // namespace spindrift::gui
