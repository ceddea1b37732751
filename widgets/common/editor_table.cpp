// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/editor_table.h"

#include <QHeaderView>
#include <QTableWidget>

#include "core/base/text.h"
#include "widgets/common/table_habits.h"
#include "widgets/common/table_titles.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {

QTableWidget* makeEditor(const QStringList& headers, const QString& accessible_name) {
  auto* table = new QTableWidget(0, static_cast<int>(headers.size()));
  table->setHorizontalHeader(new TableTitles(table));
  table->setHorizontalHeaderLabels(headers);
  table->setAccessibleName(accessible_name);
  table->setShowGrid(false);
  table->verticalHeader()->hide();
  table->verticalHeader()->setDefaultSectionSize(40);
  table->setSelectionMode(QAbstractItemView::SingleSelection);
  table->setTabKeyNavigation(false);
  table->setMinimumHeight(150);
  giveTableCopying(table);
  return table;
}

QString numberText(const std::optional<double>& value) {
  return value ? shownNumbers(QString::fromStdString(exactNumber(*value))) : QString();
}

QString textAt(const QTableWidget* table, int row, int column) {
  const QTableWidgetItem* item = table->item(row, column);
  return item == nullptr ? QString() : item->text().trimmed();
}

void setText(QTableWidget* table, int row, int column, const QString& text) {
  table->setItem(row, column, new QTableWidgetItem(text));
}

nlohmann::json numberOrText(const QString& text) {
  if (const std::optional<double> value = typedNumber(text)) return *value;
  return text.toStdString();
}

}  // namespace spindrift::gui
