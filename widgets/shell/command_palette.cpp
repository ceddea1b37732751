// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/command_palette.h"

#include <QCoreApplication>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLineEdit>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <limits>

#include "widgets/common/parts.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/common/effect_titles.h"

namespace spindrift::gui {
namespace {

constexpr int letter_found = 2;
constexpr int follows_letter =
    9;  ///< more than a new word: "pre" is the beginning of Preferences, not Print the REport
constexpr int begins_word = 8;
constexpr int begins_text = 4;
constexpr int in_title = 12;
constexpr int can_be_run = 3;

/// The best of all ways to find the letters of `word` in `text` in their order. best[j]: the letters so far, the last
/// of them at text[j].
std::optional<int> wordScore(const QString& word, const QString& text) {
  constexpr int none = std::numeric_limits<int>::min() / 2;
  const auto length = static_cast<std::size_t>(text.size());
  std::vector<int> best(length, none);
  for (qsizetype i = 0; i < word.size(); ++i) {
    std::vector<int> next(length, none);
    int before = i == 0 ? 0 : none;  // the best that ends left of j
    for (std::size_t j = 0; j < length; ++j) {
      const auto at = static_cast<qsizetype>(j);
      if (j > 0 && i > 0) before = std::max(before, best[j - 1]);
      if (text[at] != word[i]) continue;
      int score = before;
      if (i > 0 && j > 0 && best[j - 1] > none) score = std::max(score, best[j - 1] + follows_letter);
      if (score <= none) continue;
      score += letter_found;
      if (j == 0) score += begins_text;
      if (j == 0 || !text[at - 1].isLetterOrNumber()) score += begins_word;
      next[j] = score;
    }
    best = std::move(next);
  }
  const int most = best.empty() ? none : *std::max_element(best.begin(), best.end());
  return most > none ? std::optional(most) : std::nullopt;
}

}  // namespace

std::optional<int> commandScore(const QString& letters, const Command& command) {
  const QString title = command.title.toCaseFolded();
  const QString where = command.where.toCaseFolded();
  int sum = 0;
  for (const QString& word : letters.toCaseFolded().split(QLatin1Char(' '), Qt::SkipEmptyParts)) {
    const std::optional<int> of_title = wordScore(word, title);
    const std::optional<int> of_place = wordScore(word, where);
    if (!of_title && !of_place) return std::nullopt;
    sum += std::max(of_title ? *of_title + in_title : 0, of_place.value_or(0));
  }
  if (command.why_not.isEmpty()) sum += can_be_run;
  // Of two that fit alike, the shorter title is meant.
  return 100 * sum - static_cast<int>(std::min<qsizetype>(title.size(), 99));
}

CommandPalette::CommandPalette(std::vector<Command> commands, QWidget* parent)
    : QDialog(parent), commands_(std::move(commands)) {
  setObjectName(QStringLiteral("commandPalette"));
  setWindowTitle(tr("Find a command"));
  setAttribute(Qt::WA_DeleteOnClose);
  resize(parent == nullptr ? 960 : std::clamp(parent->width() - 160, 640, 1120), 480);
  auto* column = new QVBoxLayout(this);
  column->setSpacing(8);
  field_ = new QLineEdit;
  field_->setPlaceholderText(tr("A few letters of what you want to do"));
  field_->setAccessibleName(tr("Find a command"));
  field_->setAccessibleDescription(tr("The arrows choose in the list, Enter runs, Escape closes"));
  field_->installEventFilter(this);
  column->addWidget(field_);
  rows_ = new RowsModel({tr("Command"), tr("Where"), tr("Keys")}, this);
  table_ = makeTable(rows_, tr("Commands"), tr("Nothing the window can do fits these letters."));
  table_->horizontalHeader()->setSectionsClickable(false);  // the order is that of the letters
  stretchColumn(table_, 1);                                 // a reason may be long; the keys stay in sight
  table_->setFocusPolicy(Qt::NoFocus);                      // the letters go on being typed
  column->addWidget(table_, 1);
  reason_ = new Callout;
  column->addWidget(reason_);
  connect(field_, &QLineEdit::textChanged, this, &CommandPalette::fill);
  connect(table_, &QTableView::clicked, this, &CommandPalette::runChosen);
  connect(table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this] { reason_->set(Tone::Neutral, {}); });
  fill();
  field_->setFocus();
}

void CommandPalette::fill() {
  std::vector<std::pair<int, std::size_t>> found;
  for (std::size_t i = 0; i < commands_.size(); ++i) {
    if (const auto score = commandScore(field_->text(), commands_[i])) found.emplace_back(*score, i);
  }
  // As the menus have them while nothing is typed.
  if (!field_->text().trimmed().isEmpty())
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Row> rows;
  for (const auto& [score, i] : found) {
    const Command& command = commands_[i];
    Row row;
    row.id = QString::number(i);
    Cell title{command.title};
    title.icon = command.why_not.isEmpty() ? "chevron-right" : "blocked";
    row.cells = {title, {command.where}, {command.keys}};
    if (!command.why_not.isEmpty()) row.cells[1].text += QStringLiteral(" · ") + command.why_not;
    row.cells[1].tip = row.cells[1].text;
    rows.push_back(std::move(row));
  }
  rows_->setRows(std::move(rows));
  reason_->set(Tone::Neutral, {});
  table_->selectRow(0);
  table_->scrollToTop();
}

bool CommandPalette::eventFilter(QObject* watched, QEvent* event) {
  if (watched == field_ && event->type() == QEvent::KeyPress) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key == Qt::Key_Up || key == Qt::Key_Down || key == Qt::Key_PageUp || key == Qt::Key_PageDown) {
      QCoreApplication::sendEvent(table_, event);
      return true;
    }
    if (key == Qt::Key_Return || key == Qt::Key_Enter) {
      runChosen();
      return true;
    }
  }
  return QDialog::eventFilter(watched, event);
}

void CommandPalette::runChosen() {
  const QString id = rows_->idAt(table_->currentIndex().row());
  if (id.isEmpty()) return;
  const Command& command = commands_[static_cast<std::size_t>(id.toInt())];
  if (!command.why_not.isEmpty()) {
    reason_->show(Tone::Attention, command.why_not);
    return;
  }
  // What runs may open a window of its own: this one is gone by then.
  QMetaObject::invokeMethod(parent() != nullptr ? parent() : QCoreApplication::instance(), command.run,
                            Qt::QueuedConnection);
  accept();
}

}  // namespace spindrift::gui
