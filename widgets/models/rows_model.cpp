// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/models/rows_model.h"

#include <QFont>
#include <QTableView>
#include <algorithm>

#include "widgets/common/words.h"
#include "widgets/theme/fonts.h"
#include "widgets/theme/icons.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {

RowsModel::RowsModel(QStringList headers, QObject* parent)
    : QAbstractTableModel(parent), headers_(printedTitles(std::move(headers))) {
  connect(&UnitsNotifier::instance(), &UnitsNotifier::changed, this, [this] {
    if (columnCount() == 0) return;
    Q_EMIT headerDataChanged(Qt::Horizontal, 0, columnCount() - 1);
    if (!rows_.empty()) Q_EMIT dataChanged(index(0, 0), index(rowCount() - 1, columnCount() - 1));
  });
}

QString RowsModel::shownText(const Row& row, int column) const {
  const Cell& cell = row.cells[static_cast<std::size_t>(column)];
  const QString unit = cell.unit.isEmpty() ? fileUnitOfTitle(headers_[column]) : cell.unit;
  if (cell.unit.isEmpty()) return cellOnScreen(cell.text, unit);
  // Of a cell that has a unit: its name alone, a title with it, or a number.
  if (cell.text == unitText(unit.toStdString())) return shownUnit(unit).name;
  return fileUnitOfTitle(cell.text).isEmpty() ? cellOnScreen(cell.text, unit) : shownTitle(cell.text);
}

void RowsModel::setHeaders(const QStringList& titles) {
  const QStringList headers = printedTitles(titles);
  if (headers == headers_) return;
  beginResetModel();
  headers_ = headers;
  endResetModel();
}

void RowsModel::setRows(std::vector<Row> rows) {
  if (rows.size() == rows_.size() && !rows.empty()) {
    // Same length: keep selection and scroll position.
    rows_ = std::move(rows);
    Q_EMIT dataChanged(index(0, 0), index(rowCount() - 1, columnCount() - 1));
    return;
  }
  beginResetModel();
  rows_ = std::move(rows);
  endResetModel();
}

QString RowsModel::idAt(int row) const {
  return row >= 0 && row < rowCount() ? rows_[static_cast<std::size_t>(row)].id : QString();
}

int RowsModel::rowOf(const QString& id) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (rows_[i].id == id) return static_cast<int>(i);
  }
  return -1;
}

int RowsModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}
int RowsModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(headers_.size());
}

QVariant RowsModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const Row& row = rows_[static_cast<std::size_t>(index.row())];
  if (index.column() >= static_cast<int>(row.cells.size())) return {};
  const Cell& cell = row.cells[static_cast<std::size_t>(index.column())];
  switch (role) {
    case Qt::DisplayRole:
      return shownText(row, index.column());
    case Qt::AccessibleTextRole:
      return shownTitle(headers_[index.column()]) + QStringLiteral(": ") + shownText(row, index.column());
    case Qt::ToolTipRole:
      return cell.tip.isEmpty() ? QVariant() : QVariant(onScreen(cell.tip));
    case Qt::TextAlignmentRole:
      return static_cast<int>(Qt::AlignVCenter | (cell.right ? Qt::AlignRight : Qt::AlignLeft));
    case Qt::ForegroundRole:
      if (row.faded) return theme().text_disabled;
      return cell.tone == Tone::Neutral ? QVariant() : QVariant(theme().tone(cell.tone));
    case Qt::DecorationRole:
      if (!cell.picture.isNull()) return cell.picture;
      if (cell.icon == nullptr) return {};
      return icon(cell.icon, row.faded                    ? theme().text_disabled
                             : cell.tone == Tone::Neutral ? theme().text_secondary
                                                          : theme().tone(cell.tone));
    case Qt::FontRole: {
      QFont font = textFont(sizes::font_body, cell.bold ? QFont::DemiBold : QFont::Normal);
      font.setStrikeOut(row.faded && index.column() == 0);
      return font;
    }
    case Qt::CheckStateRole:
      return cell.checked ? QVariant(*cell.checked ? Qt::Checked : Qt::Unchecked) : QVariant();
    default:
      return {};
  }
}

QVariant RowsModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || section >= headers_.size()) return {};
  if (role == Qt::DisplayRole) return shownTitle(headers_[section]);
  if (role == Qt::TextAlignmentRole && !rows_.empty()) {
    const auto& cells = rows_.front().cells;
    const bool right = section < static_cast<int>(cells.size()) && cells[static_cast<std::size_t>(section)].right;
    return static_cast<int>(Qt::AlignVCenter | (right ? Qt::AlignRight : Qt::AlignLeft));
  }
  return {};
}

Qt::ItemFlags RowsModel::flags(const QModelIndex& index) const {
  Qt::ItemFlags flags = QAbstractTableModel::flags(index);
  const Row& row = rows_[static_cast<std::size_t>(index.row())];
  if (index.column() < static_cast<int>(row.cells.size()) &&
      row.cells[static_cast<std::size_t>(index.column())].checked) {
    flags |= Qt::ItemIsUserCheckable;
  }
  return flags;
}

bool RowsModel::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (role != Qt::CheckStateRole || !index.isValid()) return false;
  Cell& cell = rows_[static_cast<std::size_t>(index.row())].cells[static_cast<std::size_t>(index.column())];
  if (!cell.checked) return false;
  cell.checked = value.toInt() == Qt::Checked;
  Q_EMIT dataChanged(index, index, {Qt::CheckStateRole});
  Q_EMIT checkedChanged(idAt(index.row()), index.column(), *cell.checked);
  return true;
}

QStringList selectedIds(const QTableView& table, const RowsModel& rows) {
  QModelIndexList chosen = table.selectionModel()->selectedRows();
  std::sort(chosen.begin(), chosen.end());
  QStringList ids;
  for (const QModelIndex& index : chosen) ids << rows.idAt(index.row());
  return ids;
}

}  // namespace spindrift::gui
