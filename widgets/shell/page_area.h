// SPDX-License-Identifier: GPL-3.0-or-later
// The place of the pages. A page fills it; one that needs more room scrolls: nothing is cut, squeezed or lies over
// another.
//
// What a page needs is its own smallest size, asked of the page that is shown: Qt would ask every page that was ever
// shown for its smallest size and its height at every width whenever one sentence of one page changes.
#pragma once

#include <QScrollArea>
#include <QStackedWidget>

namespace spindrift::gui {

class PageArea : public QScrollArea {
  Q_OBJECT
 public:
  explicit PageArea(QWidget* parent);
  /// Takes a page that was made inside the viewport.
  void take(QWidget* page);
  [[nodiscard]] QSize sizeHint() const override { return minimumSizeHint(); }
  [[nodiscard]] QSize minimumSizeHint() const override { return {640, 480}; }

 protected:
  void resizeEvent(QResizeEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void fit();
};

class PageStack : public QStackedWidget {
  Q_OBJECT
 public:
  /// An empty place, in which a page is to be made.
  [[nodiscard]] QWidget* makePlace();
  [[nodiscard]] bool holds(const QWidget* page) const;
  /// Adds a page that was made in a place of this stack.
  void add(QWidget* page);
  void show(QWidget* page);
  [[nodiscard]] bool hasHeightForWidth() const override { return false; }
  [[nodiscard]] QSize sizeHint() const override { return minimumSizeHint(); }
  [[nodiscard]] QSize minimumSizeHint() const override { return {640, 480}; }
};

}  // namespace spindrift::gui
