// SPDX-License-Identifier: GPL-3.0-or-later
// Step Calibrate for a laser profiler: where it sits in the tool frame, what the pocket cannot show, the residuals of
// its rim, and every scan registered onto the first of its artefact.
#pragma once

#include "widgets/pages/page.h"

class QTabWidget;

namespace spindrift {
struct ScanEvaluation;
}

namespace spindrift::gui {

class NumberTile;
class Plot;
class RowsModel;

class ProfilerCalibrationPage : public Page {
  Q_OBJECT
 public:
  explicit ProfilerCalibrationPage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return evaluate_; }
  void runAll() override { runTask("evaluate"); }
  [[nodiscard]] RowsModel* calibration() const { return calibration_; }
  [[nodiscard]] RowsModel* registrations() const { return registrations_; }
  [[nodiscard]] Plot* residuals() const { return residuals_; }

 private:
  void clear();
  void showCalibration(const ScanEvaluation& evaluation);
  void showScans(const ScanEvaluation& evaluation);

  QPushButton* evaluate_;
  NumberTile* rim_;
  NumberTile* plane_;
  NumberTile* scans_;
  NumberTile* rejected_count_;
  QTabWidget* tabs_;
  RowsModel* calibration_;
  RowsModel* registrations_;
  RowsModel* rejected_;
  Callout* undetermined_;
  Plot* residuals_;
};

}  // namespace spindrift::gui
