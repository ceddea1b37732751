// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a table are shown whole or not at all: what would be seen of one that has no room for all of its height is
// covered. And a table without rows says what will stand in it.
#pragma once

class QTableView;

namespace spindrift::gui {

/// To be called at the end of the table's paintEvent.
void coverCutRows(QTableView& table);
/// As well: the table's property "emptyText", in the middle, while it has no rows.
void sayWhatIsEmpty(QTableView& table);

}  // namespace spindrift::gui
