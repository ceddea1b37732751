// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/wrap_layout.h"

#include <QWidget>
#include <algorithm>

namespace spindrift::gui {

WrapLayout::WrapLayout(int spacing) {
  setContentsMargins(0, 0, 0, 0);
  setSpacing(spacing);
}

WrapLayout::~WrapLayout() {
  for (QLayoutItem* item : items_) delete item;
}

void WrapLayout::addItem(QLayoutItem* item) {
  items_.push_back(item);
}

QLayoutItem* WrapLayout::itemAt(int index) const {
  return index >= 0 && index < count() ? items_[static_cast<std::size_t>(index)] : nullptr;
}

QLayoutItem* WrapLayout::takeAt(int index) {
  QLayoutItem* item = itemAt(index);
  if (item != nullptr) items_.erase(items_.begin() + index);
  return item;
}

int WrapLayout::widthOf(const QLayoutItem& item, int line_width) const {
  return std::max(item.minimumSize().width(), std::min(item.sizeHint().width(), line_width));
}

std::vector<std::pair<std::size_t, std::size_t>> WrapLayout::lines(int width) const {
  std::vector<std::pair<std::size_t, std::size_t>> result;
  int used = 0;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    if (items_[i]->isEmpty()) {
      if (!result.empty()) result.back().second = i + 1;
      continue;
    }
    const int wanted = widthOf(*items_[i], width);
    if (result.empty() || static_cast<int>(i) == break_before_ || used + spacing() + wanted > width) {
      result.emplace_back(i, i + 1);
      used = wanted;
    } else {
      result.back().second = i + 1;
      used += spacing() + wanted;
    }
  }
  return result;
}

int WrapLayout::place(const QRect& area, bool move) const {
  const QMargins margins = contentsMargins();
  const QRect inner = area.marginsRemoved(margins);
  int y = inner.top();
  for (const auto& [first, last] : lines(inner.width())) {
    int height = 0;
    int used = -spacing();
    int expanding = 0;
    for (std::size_t i = first; i < last; ++i) {
      const QLayoutItem& item = *items_[i];
      if (item.isEmpty()) continue;
      height = std::max(height, item.sizeHint().height());
      used += spacing() + widthOf(item, inner.width());
      if ((item.expandingDirections() & Qt::Horizontal) != 0) ++expanding;
    }
    const int extra = expanding > 0 ? std::max(0, inner.width() - used) / expanding : 0;
    int x = inner.left();
    for (std::size_t i = first; i < last && move; ++i) {
      QLayoutItem& item = *items_[i];
      if (item.isEmpty()) continue;
      const bool expands = (item.expandingDirections() & Qt::Horizontal) != 0;
      const int wide = widthOf(item, inner.width()) + (expands ? extra : 0);
      const int high = std::min(height, item.sizeHint().height());
      item.setGeometry(QRect(x, y + (height - high) / 2, wide, high));
      x += wide + spacing();
    }
    y += height + spacing();
  }
  if (y > inner.top()) y -= spacing();
  return y - area.top() + margins.bottom();
}

int WrapLayout::heightForWidth(int width) const {
  return place(QRect(0, 0, width, 0), false);
}

void WrapLayout::setBreakBefore(int index) {
  if (break_before_ == index) return;
  break_before_ = index;
  invalidate();
}

QSize WrapLayout::minimumSize() const {
  QSize size;
  for (const QLayoutItem* item : items_) {
    if (!item->isEmpty()) size = size.expandedTo(item->minimumSize());
  }
  const QMargins margins = contentsMargins();
  size += QSize(margins.left() + margins.right(), margins.top() + margins.bottom());
  // What lies between a page and this row (a splitter, tabs) asks for no height at a width: all lines that it has now.
  if (width_ > 0) size.setHeight(std::max(size.height(), heightForWidth(width_)));
  return size;
}

QSize WrapLayout::sizeHint() const {
  int width = 0;
  int height = 0;
  for (const QLayoutItem* item : items_) {
    if (item->isEmpty()) continue;
    width += item->sizeHint().width() + (width > 0 ? spacing() : 0);
    height = std::max(height, item->sizeHint().height());
  }
  const QMargins margins = contentsMargins();
  return {width + margins.left() + margins.right(), height + margins.top() + margins.bottom()};
}

void WrapLayout::setGeometry(const QRect& area) {
  const bool other_lines = width_ != area.width() && heightForWidth(width_) != heightForWidth(area.width());
  width_ = area.width();
  QLayout::setGeometry(area);
  place(area, true);
  if (other_lines) update();
}

}  // namespace spindrift::gui
