// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/page_room.h"

#include <QScrollArea>
#include <algorithm>

namespace spindrift::gui {

int roomOnPage(const QWidget& panel) {
  for (const QWidget* w = panel.parentWidget(); w != nullptr; w = w->parentWidget()) {
    const auto* area = qobject_cast<const QScrollArea*>(w);
    if (area == nullptr || area->widget() == nullptr) continue;
    return panel.height() - std::max(0, area->widget()->height() - area->maximumViewportSize().height());
  }
  return panel.height();
}

}  // namespace spindrift::gui
