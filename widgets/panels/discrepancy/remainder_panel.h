// SPDX-License-Identifier: GPL-3.0-or-later
// What remains beside the effects and the noise: its size in every component, its pattern over the points and its time
// history beside what the effects explain.
#pragma once

#include <QWidget>
#include <memory>
#include <string>
#include <vector>

#include "core/workflows/discrepancy_story.h"
#include "widgets/common/parts.h"
#include "widgets/export/exportable.h"

class QLabel;
class QTableView;

namespace spindrift::gui {

class Card;
class Plot;
class RowsModel;
class Segments;

class RemainderPanel : public QWidget {
  Q_OBJECT
 public:
  explicit RemainderPanel(QWidget* parent = nullptr);
  /// Null: nothing has been searched.
  void show(const std::shared_ptr<const DiscrepancyStory>& story);
  /// Shows this series (carried over from the place that was chosen).
  void choose(const std::string& point, Component component);
  [[nodiscard]] const std::string& point() const { return point_; }
  [[nodiscard]] Component component() const { return component_; }
  [[nodiscard]] std::vector<Exportable> exportables();
  [[nodiscard]] QTableView* componentTable() const { return component_table_; }
  [[nodiscard]] QTableView* pointTable() const { return point_table_; }
  [[nodiscard]] Plot* plot() const { return plot_; }
  [[nodiscard]] QLabel* sentence() const { return sentence_; }

 Q_SIGNALS:
  void hovered(const QString& text);
  /// The user chose another component or point.
  void chosen();

 private:
  void fillComponents();
  void fillPoints();
  void showPlot();

  RowsModel* components_;
  RowsModel* points_;
  QTableView* component_table_;
  QTableView* point_table_;
  WrappedLabel* sentence_;
  QLabel* points_title_;
  QLabel* legend_;
  Card* plot_card_;
  Segments* which_;
  Plot* plot_;
  std::shared_ptr<const DiscrepancyStory> story_;
  Component component_ = Component::EX;
  std::string point_;
  bool following_ = false;  ///< a selection is being carried over
};

}  // namespace spindrift::gui
