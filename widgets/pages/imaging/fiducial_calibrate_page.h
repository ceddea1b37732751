// SPDX-License-Identifier: GPL-3.0-or-later
// Step Calibrate for a microscope: captures to deviations, with everything in between that can go wrong made visible.
#pragma once

#include <string>

#include "core/imaging/contrast_curve.h"
#include "widgets/pages/page.h"

class QComboBox;
class QTabWidget;

namespace spindrift::gui {

class NumberTile;
class Plot;
class RowsModel;

class FiducialCalibratePage : public Page {
  Q_OBJECT
 public:
  explicit FiducialCalibratePage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return evaluate_; }
  void runAll() override { runTask("evaluate"); }

  /// Algebraic circles beside the joint evaluation.
  [[nodiscard]] RowsModel* circles() const { return circles_; }

 private:
  void showDetails(const StoredEvaluation& evaluation);
  void showSets(const StoredEvaluation& evaluation);
  void showCircles(const StoredEvaluation& evaluation);
  void showContrast();
  /// What the states are was chosen: the check is run unless its result holds.
  void checkResolution();
  [[nodiscard]] std::string chosenCheck() const;  ///< the task; empty: none
  void showChosenCheck();

  QPushButton* evaluate_;
  NumberTile* pixel_;
  NumberTile* centre_;
  NumberTile* axes_;
  NumberTile* rejected_count_;
  RowsModel* displacements_;
  RowsModel* sets_;
  RowsModel* rejected_;
  RowsModel* circles_;
  Callout* circles_verdict_;
  Plot* contrast_;
  std::shared_ptr<const StoredEvaluation> curves_of_;  ///< whose curves those are
  std::vector<ContrastCurve> curves_;
  QTabWidget* tabs_;
  QComboBox* fiducial_;
  QComboBox* check_kind_;
  Callout* check_verdict_;
  RowsModel* resolution_;
};

}  // namespace spindrift::gui
