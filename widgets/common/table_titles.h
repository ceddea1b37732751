// SPDX-License-Identifier: GPL-3.0-or-later
// The titles over the columns of a table. A title is as wide as its text and keeps no place for the mark of an order
// that is not there: with a style sheet the style takes that place from every title, and cuts short ones ("Bal",
// "Stat"). Where the columns have no room beside each other the titles go on in a second line.
#pragma once

#include <QHeaderView>

namespace spindrift::gui {

class TableTitles : public QHeaderView {
 public:
  explicit TableTitles(QWidget* parent);
  /// In two lines, each title as narrow as its words allow, where the columns have no room beside each other: they ask
  /// for `width_px` with titles in one line. A last column that takes what the others leave is never narrower than its
  /// title and `last_px`, what is in it; 0: it may be. For the updateGeometries of the table that the titles belong to.
  void fit(int width_px, int last_px);
  [[nodiscard]] bool narrow() const { return narrow_; }
  /// What a title asks for in one line, or in two.
  [[nodiscard]] int titleWidth(int section, bool narrow) const;

 protected:
  [[nodiscard]] QSize sectionSizeFromContents(int section) const override;
  void paintSection(QPainter* painter, const QRect& place, int section) const override;

 private:
  [[nodiscard]] QString title(int section) const;
  [[nodiscard]] bool ordered(int section) const;

  bool narrow_ = false;
};

}  // namespace spindrift::gui
