// SPDX-License-Identifier: GPL-3.0-or-later
// Notes of people on the session: on a step, a capture or a result. They go into the report.
#pragma once

#include <QDialog>

#include "widgets/commands/draft.h"

class QComboBox;
class QPlainTextEdit;
class QPushButton;
class QTableView;

namespace spindrift::gui {

class CampaignUndo;
class RowsModel;
class SessionModel;

class NotesDialog : public QDialog {
  Q_OBJECT
 public:
  /// `about` is what a new note is about unless the user says otherwise: the step that is shown, and `item`, what is
  /// picked on its page (may be empty).
  NotesDialog(SessionModel& session, CampaignUndo& undo, const QString& about, const QString& item,
              QWidget* parent = nullptr);

  [[nodiscard]] RowsModel* rows() const { return rows_; }
  [[nodiscard]] QComboBox* about() const { return about_; }
  [[nodiscard]] QComboBox* item() const { return item_; }
  [[nodiscard]] QPlainTextEdit* text() const { return text_; }
  [[nodiscard]] QPushButton* addButton() const { return add_; }
  [[nodiscard]] QPushButton* removeButton() const { return remove_; }

 private:
  void refresh();
  void updateButtons();
  /// What is typed and not added yet is on the disk with every letter; the dialog begins with it.
  void keepTyped();
  void showTyped();
  void add();
  void removeSelected();

  SessionModel& session_;
  CampaignUndo& undo_;
  WindowDraft draft_;
  RowsModel* rows_;
  QTableView* table_;
  QComboBox* about_;
  QComboBox* item_;
  QPlainTextEdit* text_;
  QPushButton* add_;
  QPushButton* remove_;
};

}  // namespace spindrift::gui
