// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a table are shown whole or not at all: what would be seen of one that has no room for all of its height is
// covered.
#pragma once

class QTableView;

namespace spindrift::gui {

/// To be called at the end of the table's paintEvent.
void coverCutRows(QTableView& table);

}  // namespace spindrift::gui
