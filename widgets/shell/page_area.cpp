// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/page_area.h"

#include <QEvent>
#include <QLayout>
#include <QScrollBar>
#include <QTimer>

namespace spindrift::gui {

PageArea::PageArea(QWidget* parent) : QScrollArea(parent) {
  setFrameShape(QFrame::NoFrame);
  setFocusPolicy(Qt::NoFocus);
  viewport()->setAutoFillBackground(false);
}

void PageArea::take(QWidget* page) {
  setWidget(page);
  page->setAutoFillBackground(false);
}

void PageArea::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  fit();
}

bool PageArea::eventFilter(QObject* watched, QEvent* event) {
  const bool handled = QScrollArea::eventFilter(watched, event);
  if (watched == widget() && event->type() == QEvent::LayoutRequest) {
    fit();
    // Sentences within it follow their width only now.
    QTimer::singleShot(0, this, &PageArea::fit);
  }
  return handled;
}

void PageArea::fit() {
  if (widget() == nullptr) return;
  // A page that has not heard of a change yet tells what was.
  if (QLayout* layout = widget()->layout()) layout->activate();
  const QSize least = widget()->minimumSizeHint();
  QSize room = maximumViewportSize();
  // A bar at one side takes from the other.
  const int bar = verticalScrollBar()->sizeHint().width();
  bool down = least.height() > room.height();
  const bool sideways = least.width() > room.width() - (down ? bar : 0);
  down = down || least.height() > room.height() - (sideways ? bar : 0);
  setHorizontalScrollBarPolicy(sideways ? Qt::ScrollBarAlwaysOn : Qt::ScrollBarAlwaysOff);
  setVerticalScrollBarPolicy(down ? Qt::ScrollBarAlwaysOn : Qt::ScrollBarAlwaysOff);
  room -= QSize(down ? bar : 0, sideways ? bar : 0);
  widget()->resize(room.expandedTo(least));
}

bool PageStack::holds(const QWidget* page) const {
  for (int i = 0; i < count(); ++i) {
    if (static_cast<const PageArea*>(widget(i))->widget() == page) return true;
  }
  return false;
}

QWidget* PageStack::makePlace() {
  auto* area = new PageArea(this);
  addWidget(area);
  return area->viewport();
}

void PageStack::add(QWidget* page) {
  for (int i = 0; i < count(); ++i) {
    auto* area = static_cast<PageArea*>(widget(i));
    if (area->viewport() == page->parentWidget()) area->take(page);
  }
  Q_ASSERT(holds(page));
}

void PageStack::show(QWidget* page) {
  for (int i = 0; i < count(); ++i) {
    if (static_cast<PageArea*>(widget(i))->widget() == page) setCurrentIndex(i);
  }
}

}  // namespace spindrift::gui
