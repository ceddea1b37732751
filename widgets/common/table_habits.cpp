// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/table_habits.h"

#include <QApplication>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QFileDialog>
#include <QHeaderView>
#include <QKeyEvent>
#include <QMenu>
#include <QMessageBox>
#include <QRegularExpression>
#include <QSignalBlocker>
#include <QTableView>
#include <QTimer>
#include <algorithm>
#include <numeric>
#include <optional>
#include <set>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/csv_rows.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "widgets/common/preferences.h"
#include "widgets/theme/icons.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {
namespace {

const QChar true_minus(0x2212);

/// What a cell is sorted by.
struct SortKey {
  int rank = 2;  ///< numbers, texts, nothing
  double number = 0.0;
  QString text;
};

SortKey sortKeyOf(const QModelIndex& index) {
  static const QRegularExpression leading(
      QStringLiteral("^[<>≤≥≈~]?\\s*([+-]?\\d+(?:\\.\\d+)?(?:[eE][+-]?\\d+)?)(?![\\w.:/-])"));
  SortKey key;
  const QVariant exact = index.data(Qt::UserRole);
  if (exact.typeId() == QMetaType::Double || exact.typeId() == QMetaType::Int ||
      exact.typeId() == QMetaType::LongLong) {
    key.rank = 0;
    key.number = exact.toDouble();
    return key;
  }
  QString text = index.data().toString().trimmed();
  const QVariant checked = index.data(Qt::CheckStateRole);
  if (text.isEmpty() && checked.isValid()) text = QString::number(checked.toInt());
  if (text.isEmpty() || text == QStringLiteral("–")) return key;
  key.text = text;
  const QRegularExpressionMatch match = leading.match(plainNumbers(text).replace(true_minus, QLatin1Char('-')));
  key.rank = match.hasMatch() ? 0 : 1;
  if (match.hasMatch()) key.number = match.captured(1).toDouble();
  return key;
}

/// As people order names: "F2" before "F10", upper and lower case alike. QCollator does not count in the locale C.
int compareNames(const QString& a, const QString& b) {
  qsizetype i = 0;
  qsizetype j = 0;
  const auto digits = [](const QString& text, qsizetype at) {
    qsizetype end = at;
    while (end < text.size() && text[end].isDigit()) ++end;
    return QStringView(text).mid(at, end - at);
  };
  while (i < a.size() && j < b.size()) {
    if (a[i].isDigit() && b[j].isDigit()) {
      const QStringView left = digits(a, i);
      const QStringView right = digits(b, j);
      const double difference = left.toDouble() - right.toDouble();
      if (difference != 0.0) return difference < 0.0 ? -1 : 1;
      i += left.size();
      j += right.size();
      continue;
    }
    const int compared = QString::localeAwareCompare(QString(a[i].toCaseFolded()), QString(b[j].toCaseFolded()));
    if (compared != 0) return compared;
    ++i;
    ++j;
  }
  return a.size() - i < b.size() - j ? -1 : a.size() - i > b.size() - j ? 1 : 0;
}

/// The order of the rows of a table by one column; what is alike keeps the order of the page.
std::vector<int> orderBy(const QAbstractItemModel& model, int column, Qt::SortOrder order) {
  std::vector<SortKey> keys;
  for (int row = 0; row < model.rowCount(); ++row) keys.push_back(sortKeyOf(model.index(row, column)));
  std::vector<int> rows(keys.size());
  std::iota(rows.begin(), rows.end(), 0);
  const bool up = order == Qt::AscendingOrder;
  std::stable_sort(rows.begin(), rows.end(), [&](int a, int b) {
    const SortKey& left = keys[static_cast<std::size_t>(a)];
    const SortKey& right = keys[static_cast<std::size_t>(b)];
    if (left.rank != right.rank) {
      // What is nothing stands last whichever way round.
      if (left.rank == 2 || right.rank == 2) return left.rank < right.rank;
      return up ? left.rank < right.rank : left.rank > right.rank;
    }
    if (left.rank == 0) return up ? left.number < right.number : left.number > right.number;
    if (left.rank == 2) return false;
    const int compared = compareNames(left.text, right.text);
    return up ? compared < 0 : compared > 0;
  });
  return rows;
}

QString plainField(const QModelIndex& index) {
  const QVariant exact = index.data(Qt::UserRole);
  QString text = exact.isValid() ? exact.toString() : plainNumbers(index.data().toString());
  const QVariant checked = index.data(Qt::CheckStateRole);
  if (text.isEmpty() && checked.isValid())
    text = checked.toInt() == Qt::Checked ? QStringLiteral("1") : QStringLiteral("0");
  QString ascii = text;
  ascii.replace(true_minus, QLatin1Char('-'));
  double number = 0.0;
  return parseNumber(ascii.toStdString(), number) ? ascii : text;
}

QString fieldText(QString plain, TableText kind) {
  if (kind == TableText::Csv) return QString::fromStdString(csvField(plain.toStdString()));
  for (const QChar separator : {QChar('\t'), QChar('\n'), QChar('\r')}) plain.replace(separator, QLatin1Char(' '));
  double number = 0.0;
  const std::string text = plain.toStdString();
  return isFormula(text) && !parseNumber(text, number) ? QLatin1Char('\'') + plain : plain;
}

class TableHabits : public QObject {
 public:
  TableHabits(QTableView* table, bool sorts) : QObject(table), table_(table), sorts_(sorts) {
    setObjectName(QStringLiteral("tableHabits"));
    table_->installEventFilter(this);
    if (!sorts_) return;
    table_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    QHeaderView* header = table_->horizontalHeader();
    header->setSectionsClickable(true);
    header->setSortIndicator(-1, Qt::AscendingOrder);
    header->setSortIndicatorClearable(true);
    connect(header, &QHeaderView::sortIndicatorChanged, this, [this](int column, Qt::SortOrder) {
      // Room for the arrow is taken only while there is one.
      table_->horizontalHeader()->setSortIndicatorShown(column >= 0);
      sort();
    });
    soon_.setSingleShot(true);
    soon_.setInterval(0);
    connect(&soon_, &QTimer::timeout, this, &TableHabits::sort);
    if (const QAbstractItemModel* model = table_->model()) {
      const auto again = [this] {
        if (table_->horizontalHeader()->sortIndicatorSection() >= 0) soon_.start();
      };
      connect(model, &QAbstractItemModel::modelReset, this, again);
      connect(model, &QAbstractItemModel::layoutChanged, this, again);
      connect(model, &QAbstractItemModel::dataChanged, this, again);
      connect(model, &QAbstractItemModel::rowsInserted, this, again);
      connect(model, &QAbstractItemModel::rowsRemoved, this, again);
    }
  }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress) {
      if (static_cast<QKeyEvent*>(event)->matches(QKeySequence::Copy)) {
        if (event->type() == QEvent::KeyPress) copy(true);
        event->accept();
        return true;
      }
    }
    if (event->type() == QEvent::ContextMenu && table_->contextMenuPolicy() == Qt::DefaultContextMenu) {
      openMenu(*static_cast<QContextMenuEvent*>(event));
      return true;
    }
    return QObject::eventFilter(watched, event);
  }

 private:
  void sort() {
    const QAbstractItemModel* model = table_->model();
    if (model == nullptr) return;
    const int column = table_->horizontalHeader()->sortIndicatorSection();
    std::vector<int> rows(static_cast<std::size_t>(model->rowCount()));
    std::iota(rows.begin(), rows.end(), 0);
    if (column >= 0 && column < model->columnCount())
      rows = orderBy(*model, column, table_->horizontalHeader()->sortIndicatorOrder());
    QHeaderView* sections = table_->verticalHeader();
    {
      const QSignalBlocker quiet(sections);
      for (int place = 0; place < static_cast<int>(rows.size()); ++place) {
        const int now = sections->visualIndex(rows[static_cast<std::size_t>(place)]);
        if (now != place) sections->moveSection(now, place);
      }
    }
    table_->viewport()->update();
  }

  /// Nothing selected: all of it.
  [[nodiscard]] std::vector<int> chosenRows() const {
    const std::vector<int> all = shownRows(*table_);
    std::set<int> chosen;
    if (const QItemSelectionModel* selection = table_->selectionModel()) {
      for (const QModelIndex& index : selection->selectedIndexes()) chosen.insert(index.row());
    }
    if (chosen.empty()) return all;
    std::vector<int> rows;
    std::copy_if(all.begin(), all.end(), std::back_inserter(rows), [&](int row) { return chosen.contains(row); });
    return rows;
  }

  /// Of whole rows all columns, else those in which something is selected.
  [[nodiscard]] std::vector<int> columns(bool all) const {
    std::set<int> chosen;
    if (!all && table_->selectionBehavior() != QAbstractItemView::SelectRows && table_->selectionModel() != nullptr) {
      for (const QModelIndex& index : table_->selectionModel()->selectedIndexes()) chosen.insert(index.column());
    }
    std::vector<int> shown;
    const QHeaderView* header = table_->horizontalHeader();
    for (int place = 0; place < header->count(); ++place) {
      const int column = header->logicalIndex(place);
      if (!header->isSectionHidden(column) && (chosen.empty() || chosen.contains(column))) shown.push_back(column);
    }
    return shown;
  }

  void copy(bool headers) const {
    if (table_->model() == nullptr) return;
    QApplication::clipboard()->setText(
        tableText(*table_->model(), chosenRows(), columns(false), headers, TableText::Tabs));
  }

  void exportCsv() const {
    const QString kind = QStringLiteral("export");
    QString file = QFileDialog::getSaveFileName(table_, QObject::tr("Export the table"), lastFolder(kind),
                                                QObject::tr("Table (*.csv)"));
    if (file.isEmpty()) return;
    if (!file.endsWith(QStringLiteral(".csv"), Qt::CaseInsensitive)) file += QStringLiteral(".csv");
    rememberFolder(kind, file);
    try {
      writeFileAtomically(
          file.toStdString(),
          tableText(*table_->model(), shownRows(*table_), columns(true), true, TableText::Csv).toStdString());
    } catch (const InputError& e) {
      QMessageBox::warning(table_, QObject::tr("Export the table"), QString::fromUtf8(e.what()));
    }
  }

  void openMenu(const QContextMenuEvent& event) {
    const QAbstractItemModel* model = table_->model();
    if (model == nullptr) return;
    auto* menu = new QMenu(table_);
    menu->setObjectName(QStringLiteral("tableMenu"));
    menu->setAttribute(Qt::WA_DeleteOnClose);
    const auto add = [&](const char* name, const char* icon_name, const QString& text, auto&& what) {
      QAction* action = menu->addAction(icon(icon_name), text);
      action->setObjectName(QLatin1String(name));
      connect(action, &QAction::triggered, this, what);
      return action;
    };
    const bool rows = model->rowCount() > 0;
    add("copyWithHeaders", "table", QObject::tr("Copy with headers"), [this] { copy(true); })->setEnabled(rows);
    menu->actions().back()->setShortcut(QKeySequence::Copy);
    add("copy", "note", QObject::tr("Copy"), [this] { copy(false); })->setEnabled(rows);
    if (table_->selectionMode() == QAbstractItemView::ExtendedSelection)
      add("selectAll", "check", QObject::tr("Select all"), [this] { table_->selectAll(); })->setEnabled(rows);
    menu->addSeparator();
    add("exportCsv", "export", QObject::tr("Export as CSV …"), [this] { exportCsv(); })->setEnabled(rows);
    // What a click on the header does, for the keyboard.
    const QModelIndex at =
        event.reason() == QContextMenuEvent::Mouse ? table_->indexAt(event.pos()) : table_->currentIndex();
    if (sorts_ && at.isValid()) {
      menu->addSeparator();
      const QString title = model->headerData(at.column(), Qt::Horizontal).toString();
      QHeaderView* header = table_->horizontalHeader();
      const int column = at.column();
      add("sortUp", "chevron-up", QObject::tr("Sort by %1, smallest first").arg(title),
          [header, column] { header->setSortIndicator(column, Qt::AscendingOrder); });
      add("sortDown", "chevron-down", QObject::tr("Sort by %1, largest first").arg(title),
          [header, column] { header->setSortIndicator(column, Qt::DescendingOrder); });
      if (header->sortIndicatorSection() >= 0)
        add("unsorted", "restore", QObject::tr("As the page lists them"),
            [header] { header->setSortIndicator(-1, Qt::AscendingOrder); });
    }
    menu->popup(event.globalPos());
  }

  QTableView* table_;
  bool sorts_;
  QTimer soon_;
};

}  // namespace

void giveTableHabits(QTableView* table) {
  (void)new TableHabits(table, true);
}

void giveTableCopying(QTableView* table) {
  (void)new TableHabits(table, false);
}

std::vector<int> shownRows(const QTableView& table) {
  std::vector<int> rows;
  const QHeaderView* header = table.verticalHeader();
  for (int place = 0; place < header->count(); ++place) {
    const int row = header->logicalIndex(place);
    if (!header->isSectionHidden(row)) rows.push_back(row);
  }
  return rows;
}

QString tableText(const QAbstractItemModel& model, const std::vector<int>& rows, const std::vector<int>& columns,
                  bool headers, TableText kind) {
  std::optional<FileUnits> of_files;
  if (kind == TableText::Csv) of_files.emplace();
  const QChar separator = kind == TableText::Csv ? QLatin1Char(',') : QLatin1Char('\t');
  QString text;
  const auto addLine = [&](auto&& field) {
    QStringList fields;
    for (const int column : columns) fields << fieldText(field(column), kind);
    text += fields.join(separator) + QLatin1Char('\n');
  };
  if (headers) addLine([&](int column) { return model.headerData(column, Qt::Horizontal).toString(); });
  for (const int row : rows) addLine([&](int column) { return plainField(model.index(row, column)); });
  return text;
}

}  // namespace spindrift::gui
