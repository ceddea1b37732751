// SPDX-License-Identifier: GPL-3.0-or-later
// What every table of results can do: sort by a click on a header, select several rows, copy, export as CSV. One place
// for all tables (makeTable gives it to each).
//
// Sorting changes only the order in which rows are shown, as the sections of the vertical header: rows of the model,
// and with them what pages know of a row, stay what they are. A first click sorts upwards, a second downwards, a third
// brings the order of the page back. Numbers are compared as numbers ("−5.1", "12.4 ± 0.3", "3.2 min"), texts as people
// do ("F2" before "F10"); what is empty or a dash stands last.
#pragma once

#include <QString>
#include <vector>

class QAbstractItemModel;
class QModelIndex;
class QTableView;

namespace spindrift::gui {

/// Sorting, several rows, Ctrl+C and the context menu.
void giveTableHabits(QTableView* table);
/// Ctrl+C and the context menu alone, for tables that are typed into: their order has a meaning.
void giveTableCopying(QTableView* table);

enum class TableText { Tabs, Csv };
/// Rows and columns in this order. Numbers as a program reads them: exactly where the model knows them (Qt::UserRole),
/// else as shown with a plain minus. What a spreadsheet would run as a formula is made a text.
/// A file has the units of files, whatever is shown.
[[nodiscard]] QString tableText(const QAbstractItemModel& model, const std::vector<int>& rows,
                                const std::vector<int>& columns, bool headers, TableText kind);
/// The rows as they are shown now, from the top.
[[nodiscard]] std::vector<int> shownRows(const QTableView& table);

}  // namespace spindrift::gui
