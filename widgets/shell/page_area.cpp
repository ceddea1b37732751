// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/page_area.h"

#include <QEvent>
#include <algorithm>

namespace spindrift::gui {

PageArea::PageArea(QWidget* page) {
  setFrameShape(QFrame::NoFrame);
  setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setFocusPolicy(Qt::NoFocus);
  setWidget(page);
  viewport()->setAutoFillBackground(false);
  page->setAutoFillBackground(false);
}

void PageArea::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  fit();
}

bool PageArea::eventFilter(QObject* watched, QEvent* event) {
  const bool handled = QScrollArea::eventFilter(watched, event);
  if (watched == widget() && event->type() == QEvent::LayoutRequest) fit();
  return handled;
}

void PageArea::fit() {
  if (widget() == nullptr) return;
  const int width = std::max(viewport()->width(), widget()->minimumSizeHint().width());
  widget()->resize(width, viewport()->height());
}

bool PageStack::holds(const QWidget* page) const {
  for (int i = 0; i < count(); ++i) {
    if (static_cast<const PageArea*>(widget(i))->widget() == page) return true;
  }
  return false;
}

void PageStack::add(QWidget* page) {
  addWidget(new PageArea(page));
}

void PageStack::show(QWidget* page) {
  for (int i = 0; i < count(); ++i) {
    if (static_cast<PageArea*>(widget(i))->widget() == page) setCurrentIndex(i);
  }
}

}  // namespace spindrift::gui
