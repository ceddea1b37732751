// SPDX-License-Identifier: GPL-3.0-or-later
// Small multiples: the same quantity of several things, each in a plot of its own, all on the same axes.
#pragma once

#include <QWidget>
#include <vector>

#include "widgets/plots/plot.h"

class QGridLayout;
class QLabel;

namespace spindrift::gui {

class PlotGrid : public QWidget {
  Q_OBJECT
 public:
  explicit PlotGrid(QWidget* parent = nullptr);
  void setAxes(const QString& x_title, const QString& y_title);
  /// One panel a series, titled by its name. More than `most_panels` are drawn over each other in one.
  void setContent(std::vector<Series> series);
  void setEmptyText(const QString& title, const QString& how);
  [[nodiscard]] bool empty() const { return shown_ == 0; }
  /// Those that show something.
  [[nodiscard]] std::vector<Plot*> panels() const;
  [[nodiscard]] QString titleOf(int panel) const;

  static constexpr std::size_t most_panels = 9;

 Q_SIGNALS:
  void hovered(const QString& text);

 private:
  struct Panel {
    QLabel* title;
    Plot* plot;
  };
  void addPanel();
  void titleAxes();

  QGridLayout* grid_;
  std::vector<Panel> panels_;
  int shown_ = 0;
  int columns_ = 1;
  QString x_title_, y_title_;
};

}  // namespace spindrift::gui
