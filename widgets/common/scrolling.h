// SPDX-License-Identifier: GPL-3.0-or-later
// Content that may be higher than its place: it keeps its height and scrolls, instead of being squeezed until texts lie
// on each other. Needed where a tab lies between a page and lines that wrap: a tab widget knows no height for a width.
#pragma once

#include <QScrollArea>
#include <QScrollBar>

namespace spindrift::gui {

[[nodiscard]] inline QScrollArea* makeScrolling(QWidget* content) {
  auto* scroll = new QScrollArea;
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFocusPolicy(Qt::NoFocus);
  scroll->setWidget(content);
  scroll->setMinimumWidth(content->minimumSizeHint().width() + scroll->verticalScrollBar()->sizeHint().width());
  return scroll;
}

}  // namespace spindrift::gui
