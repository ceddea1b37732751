// SPDX-License-Identifier: GPL-3.0-or-later
// Step Calibrate for a touch probe: features with centre, diameter and form, what was left out, distances, health of
// the probe, and the deviations of every feature over time.
#pragma once

#include "core/probing/cycle_studies.h"
#include "core/probing/evaluate_touches.h"
#include "core/probing/probe_health.h"
#include "widgets/pages/page.h"

class QComboBox;
class QTabWidget;

namespace spindrift::gui {

class NumberTile;
class Plot;
class ReferencePanel;
class RowsModel;
class TouchResults;

class TouchEvaluationPage : public Page {
  Q_OBJECT
 public:
  explicit TouchEvaluationPage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return evaluate_; }
  void runAll() override { runTask("evaluate"); }
  [[nodiscard]] RowsModel* features() const { return features_; }
  [[nodiscard]] RowsModel* leftOut() const { return left_out_; }
  /// Closed forms of the papers, or the lengths of the certificate, beside the joint evaluation.
  [[nodiscard]] RowsModel* comparison() const { return comparison_; }
  [[nodiscard]] Plot* deviations() const { return plot_; }
  [[nodiscard]] ReferencePanel* reference() const { return reference_; }
  [[nodiscard]] QTabWidget* tabs() const { return tabs_; }

 private:
  /// What a job finds beside the stored result.
  [[nodiscard]] TaskInputs taskInputs() override;
  void clear();
  void showTiles(const CycleEvaluation& cycles);
  void showFeatures();
  void showLeftOut(const TouchEvaluation& evaluation, const CycleEvaluation& cycles);
  void showLengths();
  void showComparison();
  void showRepeatability();
  void showHealth();
  void showDeviations();

  TouchResults& results_;
  EvaluationDetail details_;
  QPushButton* evaluate_;
  NumberTile* used_;
  NumberTile* noise_;
  NumberTile* length_;
  NumberTile* probe_;
  QTabWidget* tabs_;
  QComboBox* cycle_;
  QComboBox* point_;
  RowsModel* features_;
  RowsModel* left_out_;
  RowsModel* lengths_;
  RowsModel* comparison_;
  RowsModel* repeatability_;
  RowsModel* health_;
  Callout* comparison_verdict_;
  Callout* repeatability_verdict_;
  Callout* health_verdict_;
  ReferencePanel* reference_;
  Plot* plot_;
  Plot* grown_;  ///< what the artefact expands, against its temperature
};

}  // namespace spindrift::gui
