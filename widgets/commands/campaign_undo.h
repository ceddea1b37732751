// SPDX-License-Identifier: GPL-3.0-or-later
// What can be undone, campaign by campaign: a change belongs to the campaign it was made on and can only be taken back
// while that one is at hand. Choosing another campaign and coming back finds everything as it was left; another session
// begins anew. Every change knows where in the window it was made, and what is undone or redone is looked at there.
#pragma once

#include <QObject>
#include <QUndoGroup>
#include <QUndoStack>
#include <functional>
#include <map>
#include <memory>

#include "widgets/models/session_model.h"

namespace spindrift::gui {

/// Where in the window something is done.
struct UndoPlace {
  QString name;              ///< "Capture"
  std::function<void()> go;  ///< shows it
};

class CampaignUndo : public QObject {
  Q_OBJECT
 public:
  explicit CampaignUndo(const SessionModel& session, QObject* parent = nullptr);
  ~CampaignUndo() override;

  /// Who knows the place where commands are done from now on.
  void setPlace(std::function<UndoPlace()> here) { here_ = std::move(here); }
  /// Does the command and keeps it for the campaign at hand. Takes ownership.
  void push(QUndoCommand* command);
  /// The same for a campaign of the session that may not be at hand any more: what was started on it has ended.
  void push(QUndoCommand* command, std::int64_t campaign);
  /// First goes where the command was done. Nothing happens where there is nothing to take back.
  void undo();
  void redo();
  /// What they would take back or do again, and where: "exclude M3/P2/EZ (Discrepancy)"; empty: nothing.
  [[nodiscard]] QString undoText();
  [[nodiscard]] QString redoText();
  /// Of the campaign at hand; one without commands where there is none.
  [[nodiscard]] QUndoStack& stack();
  /// For actions and buttons: follows the campaign at hand.
  [[nodiscard]] QUndoGroup& group() { return group_; }

 private:
  struct Stack {
    QUndoStack commands;
    std::map<const QUndoCommand*, UndoPlace> places;
  };
  void follow();
  [[nodiscard]] Stack& own() { return ownOf(session_.campaignId()); }
  [[nodiscard]] Stack& ownOf(std::int64_t campaign);
  /// Of the command that stands at `index` of the stack; null: there is none, or nobody knows.
  [[nodiscard]] const UndoPlace* placeAt(int index);

  const SessionModel& session_;
  QUndoGroup group_;
  std::function<UndoPlace()> here_;
  std::map<std::int64_t, std::unique_ptr<Stack>> stacks_;  ///< by campaign, of the session that is open
  std::int64_t session_number_ = -1;
};

}  // namespace spindrift::gui
