// SPDX-License-Identifier: GPL-3.0-or-later
// What can be undone, campaign by campaign: a change belongs to the campaign it was made on and can only be taken back
// while that one is at hand. Choosing another campaign and coming back finds everything as it was left; another session
// begins anew.
#pragma once

#include <QObject>
#include <QUndoGroup>
#include <QUndoStack>
#include <map>
#include <memory>

#include "widgets/models/session_model.h"

namespace spindrift::gui {

class CampaignUndo : public QObject {
  Q_OBJECT
 public:
  explicit CampaignUndo(const SessionModel& session, QObject* parent = nullptr);
  ~CampaignUndo() override;

  /// Does the command and keeps it for the campaign at hand. Takes ownership.
  void push(QUndoCommand* command);
  /// The same for a campaign of the session that may not be at hand any more: what was started on it has ended.
  void push(QUndoCommand* command, std::int64_t campaign);
  /// Nothing happens where there is nothing to take back.
  void undo();
  void redo();
  /// Of the campaign at hand; one without commands where there is none.
  [[nodiscard]] QUndoStack& stack();
  /// For actions and buttons: follows the campaign at hand.
  [[nodiscard]] QUndoGroup& group() { return group_; }

 private:
  void follow();
  [[nodiscard]] QUndoStack& stackOf(std::int64_t campaign);

  const SessionModel& session_;
  QUndoGroup group_;
  std::map<std::int64_t, std::unique_ptr<QUndoStack>> stacks_;  ///< by campaign, of the session that is open
  std::int64_t session_number_ = -1;
};

}  // namespace spindrift::gui
