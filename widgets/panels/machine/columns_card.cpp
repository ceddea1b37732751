// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/machine/columns_card.h"

#include <QComboBox>
#include <QHeaderView>
#include <QPushButton>
#include <QTableWidget>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/machine/operating_log.h"
#include "core/machine/sensor_role.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/editor_table.h"
#include "widgets/models/cells.h"
#include "widgets/services/connections_service.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

enum ColumnOfTable { ColumnName, Now, Age, QualityWord, From, Unit, Role };

QString ageText(double age_s) {
  if (!std::isfinite(age_s)) return QStringLiteral("–");
  if (age_s < 1.0) return ColumnsCard::tr("< 1 s");
  if (age_s < 120.0) return ColumnsCard::tr("%1 s").arg(decimalText(age_s, 'f', 0));
  if (age_s < 7200.0) return ColumnsCard::tr("%1 min").arg(decimalText(age_s / 60.0, 'f', 0));
  return ColumnsCard::tr("%1 h").arg(decimalText(age_s / 3600.0, 'f', 0));
}

}  // namespace

ColumnsCard::ColumnsCard(Edited edited, QWidget* parent)
    : Card(tr("Columns of the log"), parent), edited_(std::move(edited)) {
  options_ = makeButton({}, "settings");
  options_->setToolTip(tr("More of the column: scale, words, dead band …"));
  options_->setAccessibleName(tr("More of the column"));
  remove_ = makeButton({}, "trash");
  remove_->setToolTip(tr("Take the column away"));
  remove_->setAccessibleName(tr("Remove the column"));
  addToTitle(options_);
  addToTitle(remove_);
  // What changes stands first: the rest may be scrolled out of sight.
  table_ = makeEditor({tr("Column"), tr("Now"), tr("Age"), tr("Quality"), tr("From"), tr("Unit there"), tr("Role")},
                      tr("Columns of the log"), tr("Data items that are ticked become columns."));
  table_->verticalHeader()->setDefaultSectionSize(44);  // boxes stand in the rows
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  body()->addWidget(table_, 1);
  connect(table_, &QTableWidget::cellChanged, this, &ColumnsCard::cellEdited);
  connect(table_, &QTableWidget::currentCellChanged, this, [this] {
    if (!filling_) Q_EMIT chosenChanged();
  });
  connect(options_, &QPushButton::clicked, this, &ColumnsCard::optionsWanted);
  connect(remove_, &QPushButton::clicked, this, &ColumnsCard::removeWanted);
}

int ColumnsCard::chosen() const {
  return table_->currentRow();
}

std::string ColumnsCard::chosenName() const {
  return chosen() < 0 ? std::string() : textAt(table_, chosen(), ColumnName).toStdString();
}

void ColumnsCard::tell(int row, const nlohmann::json& entry, const QString& what) {
  QMetaObject::invokeMethod(
      this, [this, row, entry, what] { edited_(row, entry, what); }, Qt::QueuedConnection);
}

void ColumnsCard::cellEdited(int row, int column) {
  if (filling_ || (column != ColumnName && column != Unit) || row >= static_cast<int>(entries_.size())) return;
  nlohmann::json entry = entries_[static_cast<std::size_t>(row)];
  const std::string text = textAt(table_, row, column).toStdString();
  if (column == ColumnName) {
    entry["column"] = text;
    // A role is of temperatures only.
    if (!OperatingLog::isTemperature(text)) entry.erase("role");
  } else if (text.empty()) {
    entry.erase("unit");
  } else {
    entry["unit"] = text;
  }
  tell(row, entry, tr("change a column"));
}

void ColumnsCard::roleChosen(int row, const std::string& role) {
  if (row >= static_cast<int>(entries_.size())) return;
  nlohmann::json entry = entries_[static_cast<std::size_t>(row)];
  if (role.empty()) {
    entry.erase("role");
  } else {
    entry["role"] = role;
  }
  tell(row, entry, tr("state the role of a sensor"));
}

void ColumnsCard::show(const nlohmann::json& description, const UnitThere& unit_there, bool recording) {
  entries_ = description["columns"];
  const nlohmann::json& columns = description["columns"];
  filling_ = true;
  const int selected = table_->currentRow();
  table_->setRowCount(0);
  table_->setRowCount(static_cast<int>(columns.size()));
  int role_width = 0;
  for (int row = 0; row < table_->rowCount(); ++row) {
    const nlohmann::json& entry = columns[static_cast<std::size_t>(row)];
    const std::string name = entry.value("column", std::string());
    setText(table_, row, ColumnName, fromCore(name));
    const std::string item = entry.value("item", std::string());
    const std::string whole = entry.value("source", std::string()) + ", " + item;
    setText(table_, row, From, fromCore(description["sources"].size() > 1 ? whole : item));
    setText(table_, row, Unit, fromCore(entry.value("unit", unit_there(entry))));
    for (const int c : {Role, Now, Age, QualityWord}) setText(table_, row, c, {});
    for (int c = 0; c < table_->columnCount(); ++c) {
      QTableWidgetItem* cell = table_->item(row, c);
      const bool typed = (c == ColumnName || c == Unit) && !recording;
      cell->setFlags(Qt::ItemIsSelectable | Qt::ItemIsEnabled | (typed ? Qt::ItemIsEditable : Qt::NoItemFlags));
    }
    if (!entry.contains("unit")) table_->item(row, Unit)->setForeground(theme().text_secondary);
    table_->item(row, Unit)->setToolTip(entry.contains("unit") ? tr("Stated here")
                                                               : tr("As the source says; type another to state it"));
    table_->item(row, From)->setToolTip(fromCore(whole));
    if (!OperatingLog::isTemperature(name)) continue;
    auto* role = new QComboBox;
    role->setAccessibleName(tr("Role of %1").arg(fromCore(name)));
    role->addItem(tr("not stated"), QString());
    for (const std::string& each : sensorRoleNames()) {
      const std::string_view text = describe(*sensorRoleFromString(each));
      role->addItem(coreSentence(text), fromCore(each));
    }
    role->setCurrentIndex(std::max(0, role->findData(fromCore(entry.value("role", std::string())))));
    role->setEnabled(!recording);
    connect(role, &QComboBox::activated, this,
            [this, row, role] { roleChosen(row, role->currentData().toString().toStdString()); });
    table_->setCellWidget(row, Role, role);
    role_width = std::max(role_width, role->sizeHint().width());
  }
  // The header's own mode looks at texts alone, not at the boxes in the cells.
  table_->horizontalHeader()->setSectionResizeMode(Role,
                                                   role_width > 0 ? QHeaderView::Fixed : QHeaderView::ResizeToContents);
  if (role_width > 0) table_->horizontalHeader()->resizeSection(Role, std::min(role_width, 170));
  if (selected >= 0 && selected < table_->rowCount()) table_->setCurrentCell(selected, ColumnName);
  filling_ = false;
}

void ColumnsCard::showLive(const LiveSnapshot& snapshot, bool recording) {
  filling_ = true;
  for (int row = 0; row < table_->rowCount(); ++row) {
    const std::string name = textAt(table_, row, ColumnName).toStdString();
    const LiveColumn* column = snapshot.find(name);
    QString now = QStringLiteral("–"), age = QStringLiteral("–"), word;
    Tone tone = Tone::Neutral;
    if (column != nullptr) {
      if (std::isfinite(column->newest.value)) now = columnValue(name, column->newest.value);
      age = ageText(snapshot.now_s - column->came_s);
      if (snapshot.isLost(*column)) {
        word = column->records > 0 ? tr("lost") : tr("waiting");
        tone = column->records > 0 ? Tone::Bad : Tone::Neutral;
      } else if (column->known) {
        word = tr("good");
        tone = Tone::Good;
      } else if (column->records + column->refused == 0 && column->text.empty()) {
        word = tr("waiting");
      } else {
        word = column->text.empty() ? tr("unknown") : fromCore(column->text).left(16).toLower();
        tone = Tone::Attention;
      }
    }
    table_->item(row, Now)->setText(now);
    table_->item(row, Age)->setText(age);
    table_->item(row, QualityWord)->setText(word);
    table_->item(row, QualityWord)->setForeground(tone == Tone::Neutral ? theme().text_secondary : theme().tone(tone));
    table_->item(row, Now)->setToolTip(column == nullptr ? QString() : coreSentence(column->conversion));
  }
  filling_ = false;
  for (QPushButton* button : {options_, remove_}) button->setEnabled(table_->rowCount() > 0 && !recording);
}

}  // namespace spindrift::gui
