// SPDX-License-Identifier: GPL-3.0-or-later
// Step Model for a laser profiler: the six errors of the axis that carries it, over positions and time, under either
// scan model, with what each model can observe.
#pragma once

#include <array>

#include "core/scanning/axis_errors.h"
#include "widgets/commands/bound_options.h"
#include "widgets/pages/page.h"

class QTabWidget;

namespace spindrift {
struct ScanEvaluation;
}

namespace spindrift::gui {

class PlotGrid;
class RowsModel;
class ScanResults;
class Segments;
class SurfacePlot;

class AxisErrorsPage : public Page {
  Q_OBJECT
 public:
  explicit AxisErrorsPage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return fit_; }
  void runAll() override { runTask("fit"); }
  [[nodiscard]] RowsModel* values() const { return values_; }
  [[nodiscard]] RowsModel* observability() const { return observability_; }
  [[nodiscard]] PlotGrid* series() const { return series_; }
  [[nodiscard]] SurfacePlot* surface() const { return surface_; }
  /// 0 ... 5: EX, EY, EZ, EA, EB, EC of the axis.
  void setComponent(int index);
  [[nodiscard]] Segments* component() const { return component_; }
  [[nodiscard]] Segments* scanModel() const { return model_; }

 private:
  [[nodiscard]] std::string chosenModel() const;
  void chooseModel(int index);
  void clear();
  /// The errors by the axis that carries the profiler (ISO 230-1: EX of the axis Z is EXZ).
  void nameErrors(const std::string& axis);
  void show(const ScanEvaluation& evaluation);
  void showValues(const ScanEvaluation& evaluation);
  void showObservability(const ScanEvaluation& evaluation);

  ScanResults& results_;
  std::shared_ptr<const ScanEvaluation> evaluation_;  ///< that is shown
  QPushButton* fit_;
  Segments* model_;
  Segments* component_;
  Segments* over_;
  PlotGrid* series_;
  SurfacePlot* surface_;
  QTabWidget* tabs_;
  RowsModel* values_;
  RowsModel* observability_;
  BoundOptions<ScanModelChoice> options_;
};

}  // namespace spindrift::gui
