// SPDX-License-Identifier: GPL-3.0-or-later
// Step Verify: the same plan measured again with the compensation on, beside the measurement from before; the verdict
// against the goal that the user set, with the uncertainty taken into account.
#pragma once

#include <QString>
#include <memory>

#include "core/workflows/verify_compensation.h"
#include "widgets/commands/bound_options.h"
#include "widgets/pages/page.h"

class QComboBox;
class QDoubleSpinBox;
class QStackedWidget;

namespace spindrift::gui {

class NumberTile;
class Plot;
class RowsModel;
class Segments;
class TableAngleChoice;
class VerifyMaps;

class VerifyPage : public Page {
  Q_OBJECT
 public:
  explicit VerifyPage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return compare_; }
  void runAll() override;
  /// The campaign measured with the compensation on; the folder is remembered in the session.
  void setAfter(const QString& folder);
  [[nodiscard]] QDoubleSpinBox* goal() const { return goal_um_; }
  [[nodiscard]] RowsModel* components() const { return components_; }
  [[nodiscard]] RowsModel* points() const { return points_; }
  [[nodiscard]] Plot* plot() const { return plot_; }
  [[nodiscard]] VerifyMaps* maps() const { return maps_; }
  /// Of the table, for the values that are drawn.
  [[nodiscard]] TableAngleChoice* angleChoice() const { return angle_; }
  [[nodiscard]] QString pointsTitle() const;
  /// 0: every value, 1: on the table.
  void setShown(int index);
  [[nodiscard]] const std::shared_ptr<const VerifyResult>& result() const { return result_; }

 private:
  [[nodiscard]] QWidget* makeChoices();
  void fillChoices();
  void showResult();
  /// Curves and table of the points, of the component that is chosen.
  void showPlot();
  void showMaps();
  /// The table of the points at the angle of the table that is drawn beside it.
  void showPoints();
  /// Angle of the table of what is drawn: of the curves, or of the state on the table; deg.
  [[nodiscard]] double shownAngle(Component component) const;

  std::shared_ptr<const VerifyResult> result_;

  QPushButton* compare_;
  QComboBox* after_;
  QDoubleSpinBox* goal_um_;
  QDoubleSpinBox* goal_urad_;
  QComboBox* criterion_;
  NumberTile* before_;
  NumberTile* left_;
  NumberTile* verdict_;
  QComboBox* component_;
  TableAngleChoice* angle_;
  RowsModel* components_;
  RowsModel* points_;
  QLabel* points_title_;
  Segments* shown_;
  QStackedWidget* stack_;
  Plot* plot_;
  VerifyMaps* maps_;
  BoundOptions<VerifyOptions> options_;
};

}  // namespace spindrift::gui
