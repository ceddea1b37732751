// SPDX-License-Identifier: GPL-3.0-or-later
// rms before and after beside the noise floor, on fitted and on held-out data: lying bars with their numbers, and below
// each pair peak-to-peak and fit.
#pragma once

#include <QPainter>
#include <QWidget>
#include <vector>

#include "core/reporting/discrepancy_report.h"

namespace spindrift::gui {

class GapBars : public QWidget {
  Q_OBJECT
 public:
  explicit GapBars(QWidget* parent = nullptr);
  /// `holdout`: the second group is of rows held out, else of blocks left out in turn (`held_out` is not shown then). A
  /// value that is not finite has no bar and no text.
  void set(const DiscrepancyGap& gap, bool holdout, const GapFigures& fitted, const GapFigures& held_out);
  void clear();
  /// PNG or SVG by the ending; throws InputError.
  void exportTo(const QString& file) const;
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Bar {
    QString name;
    double value;
    int kind;  ///< 0 before, 1 after
  };
  struct Group {
    QString title;
    std::vector<Bar> bars;
    QStringList more;  ///< lines below the bars; may be empty
  };
  void draw(QPainter& painter, const QRect& area) const;
  std::vector<Group> groups_;
  double noise_ = 0.0;
};

}  // namespace spindrift::gui
