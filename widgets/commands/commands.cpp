// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/commands/commands.h"

#include <QCoreApplication>

namespace spindrift::gui {
namespace {

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
  for (const auto& [item, reason] : before_) session_.setExcluded(item, reason_);
}

void ExcludeCommand::undo() {
  for (const auto& [item, reason] : before_) session_.setExcluded(item, reason);
}

ReplaceExclusionCommand::ReplaceExclusionCommand(SessionModel& session, Entry before, Entry after, const QString& text)
    : session_(session), before_(std::move(before)), after_(std::move(after)) {
  setText(text);
}

void ReplaceExclusionCommand::replace(const Entry& from, const Entry& to) {
  // The new one first: at no time is less left out than before or after.
  if (!to.first.isEmpty()) session_.setExcluded(to.first, to.second);
  if (!from.first.isEmpty() && from.first != to.first) session_.setExcluded(from.first, {});
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

void OptionsCommand::redo() {
  session_.setSetting(key_, after_);
  if (changed_) changed_();
}

void OptionsCommand::undo() {
  session_.setSetting(key_, before_);
  if (changed_) changed_();
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
