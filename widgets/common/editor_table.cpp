// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/editor_table.h"

#include <QCoreApplication>
#include <QHeaderView>
#include <QPushButton>
#include <QScrollBar>
#include <QTableWidget>
#include <QToolTip>
#include <algorithm>
#include <utility>

#include "core/base/text.h"
#include "widgets/common/table_habits.h"
#include "widgets/common/table_titles.h"
#include "widgets/common/whole_rows.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {

namespace {

/// All columns are in sight, and three rows.
class Editor : public QTableWidget {
 public:
  using QTableWidget::QTableWidget;
  [[nodiscard]] QSize minimumSizeHint() const override {
    const QSize hint = QTableWidget::minimumSizeHint();
    const int width = leastWidth(true) + beside_columns;
    const int bar = width > this->width() ? horizontalScrollBar()->sizeHint().height() : 0;
    const int height = horizontalHeader()->sizeHint().height() + fewest_rows * verticalHeader()->defaultSectionSize() +
                       bar + 2 * frameWidth() + 2;
    return {std::max(hint.width(), std::min(width, most_asked_width)), std::max(hint.height(), height)};
  }

 protected:
  void updateGeometries() override {
    if (auto* titles = dynamic_cast<TableTitles*>(horizontalHeader()))
      titles->fit(leastWidth(false), columnCount() > 0 ? sizeHintForColumn(columnCount() - 1) : 0);
    QTableWidget::updateGeometries();
  }
  void paintEvent(QPaintEvent* event) override {
    QTableWidget::paintEvent(event);
    coverCutRows(*this);
    sayWhatIsEmpty(*this);
  }

 private:
  [[nodiscard]] int leastWidth(bool narrow) const {
    const auto* titles = dynamic_cast<const TableTitles*>(horizontalHeader());
    int width = 0;
    for (int c = 0; titles != nullptr && c < titles->count(); ++c)
      width += std::max(titles->titleWidth(c, narrow), sizeHintForColumn(c));
    return width;
  }

  static constexpr int fewest_rows = 3;
  static constexpr int beside_columns = 24;  ///< frame and scroll bar of the style sheet
  static constexpr int most_asked_width = 610;
};

}  // namespace

void sayBeside(QWidget* button, const QString& sentence) {
  QToolTip::showText(button->mapToGlobal(button->rect().bottomLeft()), sentence, button);
}

void makeRemoving(QPushButton* button, QTableWidget* table, std::function<void()> removed) {
  QObject::connect(button, &QPushButton::clicked, table, [button, table, removed = std::move(removed)] {
    if (table->currentRow() < 0)
      return sayBeside(button, QCoreApplication::translate("EditorTable", "Choose a row of the table first."));
    table->removeRow(table->currentRow());
    removed();
  });
}

QTableWidget* makeEditor(const QStringList& headers, const QString& accessible_name, const QString& empty_text) {
  auto* table = new Editor(0, static_cast<int>(headers.size()));
  table->setProperty("emptyText", empty_text);
  table->setHorizontalHeader(new TableTitles(table));
  table->setHorizontalHeaderLabels(headers);
  table->setAccessibleName(accessible_name);
  table->setShowGrid(false);
  table->verticalHeader()->hide();
  table->verticalHeader()->setDefaultSectionSize(40);
  table->setSelectionMode(QAbstractItemView::SingleSelection);
  table->setTabKeyNavigation(false);
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
