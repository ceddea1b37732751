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

QUndoStack& CampaignUndo::stack() {
  return stackOf(session_.campaignId());
}

QUndoStack& CampaignUndo::stackOf(std::int64_t campaign) {
  std::unique_ptr<QUndoStack>& own = stacks_[campaign];
  if (own == nullptr) {
    own = std::make_unique<QUndoStack>();
    group_.addStack(own.get());
  }
  return *own;
}

void CampaignUndo::push(QUndoCommand* command) {
  stack().push(command);
}

void CampaignUndo::push(QUndoCommand* command, std::int64_t campaign) {
  stackOf(campaign).push(command);
}

void CampaignUndo::undo() {
  group_.undo();
}

void CampaignUndo::redo() {
  group_.redo();
}

}  // namespace spindrift::gui
