// SPDX-License-Identifier: GPL-3.0-or-later
// The titles over the columns of a table. A title is as wide as its text and keeps no place for the mark of an order
// that is not there: with a style sheet the style takes that place from every title, and cuts short ones ("Bal",
// "Stat").
#pragma once

#include <QHeaderView>

namespace spindrift::gui {

class TableTitles : public QHeaderView {
 public:
  explicit TableTitles(QWidget* parent);

 protected:
  [[nodiscard]] QSize sectionSizeFromContents(int section) const override;
  void paintSection(QPainter* painter, const QRect& place, int section) const override;

 private:
  [[nodiscard]] QString title(int section) const;
  [[nodiscard]] bool ordered(int section) const;
};

}  // namespace spindrift::gui
