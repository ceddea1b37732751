// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/whole_rows.h"

#include <QHeaderView>
#include <QPainter>
#include <QTableView>

#include "widgets/theme/fonts.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {

void coverCutRows(QTableView& table) {
  if (table.verticalHeader()->count() < 2) return;
  QPainter painter(table.viewport());
  const QRect seen = table.viewport()->rect();
  const int first = table.rowAt(0);
  for (const int row : {first, table.rowAt(seen.height() - 1)}) {
    // Sentences that are higher than the table are scrolled through; the first one is where the eye is.
    if (row < 0 || (row == first && table.verticalScrollMode() == QAbstractItemView::ScrollPerPixel)) continue;
    const QRect place(0, table.rowViewportPosition(row), seen.width(), table.rowHeight(row));
    if (!seen.contains(place) && place.height() <= seen.height()) painter.fillRect(place & seen, theme().surface);
  }
}

void sayWhatIsEmpty(QTableView& table) {
  if (table.model() == nullptr || table.model()->rowCount() > 0) return;
  QPainter painter(table.viewport());
  painter.setFont(textFont(sizes::font_body));
  painter.setPen(theme().text_secondary);
  painter.drawText(table.viewport()->rect().adjusted(16, 8, -16, -8), Qt::AlignCenter | Qt::TextWordWrap,
                   table.property("emptyText").toString());
}

}  // namespace spindrift::gui
