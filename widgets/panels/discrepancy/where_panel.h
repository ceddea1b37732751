// SPDX-License-Identifier: GPL-3.0-or-later
// Where measurement and simulation disagree: places, points, the machine and the residual over time, selected together.
// What was measured with the table at several angles is shown at one of them: that of the reading at which the place
// chosen shows most, or another that the user chooses.
#pragma once

#include <QWidget>
#include <memory>
#include <vector>

#include "core/machine/machine_description.h"
#include "core/workflows/discrepancy_story.h"
#include "widgets/export/exportable.h"

class QCheckBox;
class QLabel;
class QTableView;
class QVBoxLayout;

namespace spindrift::gui {

class Card;
class Plot;
class RowsModel;
class Segments;
class TableAngleChoice;
class View3D;
class WrappedLabel;

class WherePanel : public QWidget {
  Q_OBJECT
 public:
  explicit WherePanel(QWidget* parent = nullptr);
  /// Null: nothing has been searched.
  void show(const std::shared_ptr<const DiscrepancyStory>& story, const MachineDescription* machine);
  /// Selects what was chosen elsewhere: point and component, the place that holds them, the time.
  void choose(const std::string& point, Component component);
  void markTime(double time_s);
  [[nodiscard]] std::vector<Exportable> exportables();
  [[nodiscard]] View3D* view() const { return view_; }
  [[nodiscard]] Plot* plot() const { return plot_; }
  [[nodiscard]] QTableView* placeTable() const { return place_table_; }
  [[nodiscard]] QTableView* pointTable() const { return point_table_; }
  [[nodiscard]] TableAngleChoice* angleChoice() const { return angle_; }
  [[nodiscard]] Component component() const { return component_; }
  [[nodiscard]] const std::string& point() const { return point_; }

 Q_SIGNALS:
  void hovered(const QString& text);
  /// The user chose another component or point.
  void chosen();
  /// The user chose a value over time, or a place, whose clearest value it is.
  void timeChosen(double time_s);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fillPlaces();
  void fillSegments();
  void fillPoints();
  void showView();
  void showPlot();
  void choosePlace(int row);
  void chooseComponent(Component component);
  void choosePoint(const std::string& point);
  void selectPoint(const std::string& point);
  void chooseTime(double time_s);
  /// Points, machine and plot at the angle of the table that is chosen; another point where this one was not measured.
  void showAngle();
  /// Chooses an angle of the table at which the point chosen was measured, the clearest, unless this is one.
  void chooseMeasuredAngle();
  /// What is named, with the angle of the table behind it where there are several.
  [[nodiscard]] QString withAngle(const QString& what) const;
  [[nodiscard]] double c_deg() const;
  void arrange();

  RowsModel* places_;
  RowsModel* points_;
  QTableView* place_table_;
  QTableView* point_table_;
  QVBoxLayout* segment_place_;
  Segments* segments_ = nullptr;
  QCheckBox* machine_box_;
  WrappedLabel* points_title_;
  QLabel* plot_title_;
  QLabel* legend_;
  Segments* which_;
  TableAngleChoice* angle_;
  Card* view_card_;
  Card* plot_card_;
  View3D* view_;
  Plot* plot_;
  std::shared_ptr<const DiscrepancyStory> story_;
  std::vector<Component> components_;
  Component component_ = Component::EX;
  std::string point_;
  int place_ = -1;
  double plot_second_ = 1.0;  ///< one second on the plot's axis of time
  bool following_ = false;    ///< a selection is being carried over
};

}  // namespace spindrift::gui
