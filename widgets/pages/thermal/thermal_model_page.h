// SPDX-License-Identifier: GPL-3.0-or-later
// Step Model over time, for a log alone or a log with sparse cycles and observations: a dynamic model of one output,
// trained on one range and judged in free run on another, beside the plain models; step responses, time constants,
// residuals.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "core/workflows/thermal_workflow.h"
#include "widgets/commands/bound_options.h"
#include "widgets/pages/page.h"

class QComboBox;
class QDoubleSpinBox;
class QTabWidget;

namespace spindrift::gui {

class IsoPanel;
class NumberTile;
class Plot;
class RowsModel;
class Segments;
class UpdatePanel;

class ThermalModelPage : public Page {
  Q_OBJECT
 public:
  explicit ThermalModelPage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return identify_; }
  void runAll() override { runTask("thermal"); }
  [[nodiscard]] Plot* seriesPlot() const { return series_plot_; }
  [[nodiscard]] Plot* stepPlot() const { return step_plot_; }
  [[nodiscard]] RowsModel* comparison() const { return comparison_; }
  [[nodiscard]] RowsModel* lags() const { return lags_; }
  [[nodiscard]] UpdatePanel* updates() const { return updates_; }
  [[nodiscard]] IsoPanel* iso() const { return iso_; }
  [[nodiscard]] RowsModel* inputs() const { return inputs_; }
  [[nodiscard]] const std::shared_ptr<const IdentifyResult>& result() const { return result_; }
  /// What the next identification would be asked for.
  [[nodiscard]] IdentifyRequest request() const;

 private:
  [[nodiscard]] QWidget* makeChoices();
  [[nodiscard]] QWidget* makeDetails();
  void changeRange(bool train, double from_s, double to_s);
  void load();
  /// Names what the series is made of: it is read again when this changes.
  [[nodiscard]] std::string inputsKey();
  [[nodiscard]] TaskInputs taskInputs() override;
  /// While it is looked at, and evaluated where it was not yet.
  void showStandardTest();
  void clear();
  void fillChoices();
  void fillInputs();
  void showSeries();
  void showResult();
  void showStep();
  void showLags();
  void showResiduals();
  [[nodiscard]] QString outputUnit() const;

  std::shared_ptr<const TimeSeries> series_;
  std::shared_ptr<const IdentifyResult> result_;
  std::string loaded_;                   ///< folder of the campaign whose log is in series_
  std::map<std::string, double> sigma_;  ///< of one value of a sparse output
  QString failure_;
  std::string tested_;  ///< what the test of ISO 230-3 was last asked for

  QPushButton* identify_;
  QComboBox* output_;
  QComboBox* method_;
  QDoubleSpinBox* edges_[4];  ///< train from, to, test from, to; h
  Segments* what_;
  Plot* series_plot_;
  NumberTile* rms_;
  NumberTile* fit_;
  NumberTile* p2p_;
  QTabWidget* tabs_;
  RowsModel* comparison_;
  RowsModel* inputs_;
  RowsModel* lags_;
  RowsModel* cross_;
  QComboBox* step_input_;
  Plot* step_plot_;
  Plot* residual_plot_;
  Callout* whiteness_;
  UpdatePanel* updates_;
  IsoPanel* iso_;
  BoundOptions<ThermalChoice> options_;
  BoundOptions<Iso230Choice> iso_options_;
};

}  // namespace spindrift::gui
