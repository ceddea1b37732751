// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/commands/campaign_undo.h"

namespace spindrift::gui {

CampaignUndo::CampaignUndo(const SessionModel& session, QObject* parent) : QObject(parent), session_(session) {
  connect(&session, &SessionModel::sessionChanged, this, &CampaignUndo::follow);
  connect(&session, &SessionModel::campaignChanged, this, &CampaignUndo::follow);
  follow();
}

CampaignUndo::~CampaignUndo() {
  // The group outlives no stack that it shows.
  group_.setActiveStack(nullptr);
}

void CampaignUndo::follow() {
  if (session_number_ != session_.sessionNumber()) {
    session_number_ = session_.sessionNumber();
    group_.setActiveStack(nullptr);
    stacks_.clear();
  }
  group_.setActiveStack(&stack());
}

CampaignUndo::Stack& CampaignUndo::ownOf(std::int64_t campaign) {
  std::unique_ptr<Stack>& own = stacks_[campaign];
  if (own == nullptr) {
    own = std::make_unique<Stack>();
    group_.addStack(&own->commands);
  }
  return *own;
}

QUndoStack& CampaignUndo::stack() {
  return own().commands;
}

void CampaignUndo::push(QUndoCommand* command) {
  Stack& to = own();
  // Before it is done: who is told of the change asks where it was.
  if (here_) to.places[command] = here_();
  to.commands.push(command);
  // One that was merged into another, or came to nothing, is gone.
  if (to.commands.index() == 0 || to.commands.command(to.commands.index() - 1) != command) to.places.erase(command);
}

const UndoPlace* CampaignUndo::placeAt(int index) {
  const Stack& of = own();
  if (index < 0 || index >= of.commands.count()) return nullptr;
  const auto found = of.places.find(of.commands.command(index));
  return found == of.places.end() || !found->second.go ? nullptr : &found->second;
}

void CampaignUndo::push(QUndoCommand* command, std::int64_t campaign) {
  // Where it was begun is not the place at hand: nobody is led there.
  ownOf(campaign).commands.push(command);
}

void CampaignUndo::undo() {
  if (const UndoPlace* place = placeAt(stack().index() - 1)) place->go();
  group_.undo();
}

void CampaignUndo::redo() {
  if (const UndoPlace* place = placeAt(stack().index())) place->go();
  group_.redo();
}

QString CampaignUndo::undoText() {
  const UndoPlace* place = placeAt(stack().index() - 1);
  return place == nullptr ? stack().undoText() : tr("%1 (%2)").arg(stack().undoText(), place->name);
}

QString CampaignUndo::redoText() {
  const UndoPlace* place = placeAt(stack().index());
  return place == nullptr ? stack().redoText() : tr("%1 (%2)").arg(stack().redoText(), place->name);
}

}  // namespace spindrift::gui
