// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/notes_dialog.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTableView>
#include <QTextCursor>
#include <QVBoxLayout>
#include <nlohmann/json.hpp>

#include "widgets/commands/campaign_undo.h"
#include "widgets/commands/commands.h"
#include "widgets/common/parts.h"
#include "widgets/models/rows_model.h"
#include "widgets/models/session_model.h"
#include "widgets/workflow/workflow.h"

namespace spindrift::gui {

namespace {

/// What a note is about stands in the session in English, as in the report; steps are shown as the window calls them.
QString shownAbout(const std::string& about) {
  for (const StepId step : all_steps)
    if (about == toString(step)) return stepTitle(step);
  return QString::fromStdString(about);
}

std::string writtenAbout(const QString& about) {
  for (const StepId step : all_steps)
    if (about == stepTitle(step)) return std::string(toString(step));
  return about.toStdString();
}

}  // namespace

NotesDialog::NotesDialog(SessionModel& session, CampaignUndo& undo, const QString& about, const QString& item,
                         QWidget* parent)
    : QDialog(parent), session_(session), undo_(undo), draft_(session, "note") {
  setWindowTitle(tr("Notes"));
  resize(720, 520);
  auto* column = new QVBoxLayout(this);
  column->setSpacing(8);
  rows_ = new RowsModel({tr("When (UTC)"), tr("About"), tr("Item"), tr("Note")}, this);
  table_ = makeSentenceTable(rows_, tr("Notes"), tr("Notes that you add appear here and in the report."));
  column->addWidget(table_, 2);
  about_ = new QComboBox;
  about_->setEditable(true);
  about_->setAccessibleName(tr("What the note is about"));
  about_->setToolTip(tr("A step, or what you type: a result, the session"));
  about_->addItem(tr("Session"));
  for (const StepId step : all_steps) about_->addItem(stepTitle(step));
  about_->setCurrentText(about);
  item_ = new QComboBox;
  item_->setEditable(true);
  item_->setAccessibleName(tr("Which item of it the note is about"));
  item_->setToolTip(tr("A capture or an observation; what is picked on the page, or one that was taken out"));
  item_->addItem(QString());
  if (!item.isEmpty()) item_->addItem(item);
  for (const auto& [excluded, reason] : session_.excluded())
    if (excluded != item) item_->addItem(excluded);
  item_->setCurrentText(item);
  item_->lineEdit()->setPlaceholderText(tr("the step as a whole"));
  auto* what = new QHBoxLayout;
  what->addWidget(about_, 2);
  what->addWidget(item_, 3);
  column->addLayout(what);
  text_ = new QPlainTextEdit;
  text_->setAccessibleName(tr("Text of the note"));
  text_->setPlaceholderText(tr("What somebody who reads the report should know"));
  text_->setTabChangesFocus(true);
  column->addWidget(text_, 1);
  auto* line = new QHBoxLayout;
  remove_ = makeButton(tr("Remove"), "trash");
  add_ = makeButton(tr("Add the note"), "plus", "primary");
  auto* close = makeButton(tr("Close"), nullptr);
  line->addWidget(remove_);
  line->addStretch(1);
  line->addWidget(close);
  line->addWidget(add_);
  column->addLayout(line);
  connect(text_, &QPlainTextEdit::textChanged, this, &NotesDialog::updateButtons);
  connect(table_->selectionModel(), &QItemSelectionModel::currentChanged, this, &NotesDialog::updateButtons);
  connect(add_, &QPushButton::clicked, this, &NotesDialog::add);
  connect(remove_, &QPushButton::clicked, this, &NotesDialog::removeSelected);
  connect(close, &QPushButton::clicked, this, &QDialog::accept);
  connect(&session_, &SessionModel::sessionChanged, this, &QDialog::reject);
  connect(&session_, &SessionModel::campaignChanged, this, &QDialog::reject);
  connect(&session_, &SessionModel::inputsChanged, this, &NotesDialog::refresh);
  showTyped();
  connect(text_, &QPlainTextEdit::textChanged, this, &NotesDialog::keepTyped);
  connect(about_, &QComboBox::currentTextChanged, this, &NotesDialog::keepTyped);
  connect(item_, &QComboBox::currentTextChanged, this, &NotesDialog::keepTyped);
  refresh();
  text_->setFocus();
}

void NotesDialog::keepTyped() {
  const std::string text = text_->toPlainText().toStdString();
  const nlohmann::json typed = {{"text", text},
                                {"about", writtenAbout(about_->currentText().trimmed())},
                                {"item", item_->currentText().toStdString()}};
  draft_.keep(text.empty() ? nlohmann::json() : typed);
}

void NotesDialog::showTyped() {
  const nlohmann::json typed = draft_.typed();
  if (!typed.is_object()) return;
  about_->setCurrentText(shownAbout(typed.value("about", std::string())));
  item_->setCurrentText(QString::fromStdString(typed.value("item", std::string())));
  text_->setPlainText(QString::fromStdString(typed.value("text", std::string())));
  text_->moveCursor(QTextCursor::End);
}

void NotesDialog::updateButtons() {
  add_->setEnabled(!text_->toPlainText().trimmed().isEmpty());
  remove_->setEnabled(table_->currentIndex().isValid());
}

void NotesDialog::refresh() {
  std::vector<Row> rows;
  for (const Note& note : session_.notes()) {
    Row row;
    row.id = QString::number(note.id);
    row.cells = {{QString::fromStdString(note.created_utc).replace(QLatin1Char('T'), QLatin1Char(' ')).chopped(1)},
                 {shownAbout(note.step)},
                 {QString::fromStdString(note.item)},
                 {QString::fromStdString(note.text)}};
    for (const std::size_t cell : {2U, 3U}) row.cells[cell].tip = row.cells[cell].text;
    rows.push_back(std::move(row));
  }
  rows_->setRows(std::move(rows));
  updateButtons();  // a list that is filled anew tells nobody what is chosen in it
}

void NotesDialog::add() {
  const std::size_t before = session_.notes().size();
  undo_.push(
      new NoteCommand(session_,
                      {0, writtenAbout(about_->currentText().trimmed()), text_->toPlainText().trimmed().toStdString(),
                       utcNow(), item_->currentText().trimmed().toStdString()},
                      true));
  if (session_.notes().size() > before) text_->clear();
}

void NotesDialog::removeSelected() {
  const QModelIndex index = table_->currentIndex();
  if (!index.isValid()) return;
  const std::int64_t id = rows_->idAt(index.row()).toLongLong();
  for (const Note& note : session_.notes())
    if (note.id == id) undo_.push(new NoteCommand(session_, note, false));
}

}  // namespace spindrift::gui
