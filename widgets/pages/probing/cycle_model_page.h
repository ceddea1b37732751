// SPDX-License-Identifier: GPL-3.0-or-later
// Step Model for a touch probe: the parameters of every cycle over time with their uncertainty, which combinations the
// cycle determines badly, and what they mean over the working space.
#pragma once

#include <memory>

#include "core/machine/field.h"
#include "core/probing/evaluate_touches.h"
#include "core/probing/volumetric_error.h"
#include "widgets/commands/bound_options.h"
#include "widgets/pages/page.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QSlider;
class QStackedWidget;

namespace spindrift::gui {

class Plot;
class RowsModel;
class Segments;
class TouchResults;
class View3D;

class CycleModelPage : public Page {
  Q_OBJECT
 public:
  explicit CycleModelPage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return fit_; }
  void runAll() override { runTask("fit"); }
  [[nodiscard]] Plot* trends() const { return trends_; }
  [[nodiscard]] RowsModel* parameters() const { return parameters_; }
  [[nodiscard]] View3D* view() const { return view_; }
  void setComponent(int index);
  /// The plane of the heat map: 0 normal to X, 1 to Y, 2 to Z.
  void setPlane(int normal_axis);
  [[nodiscard]] const Field* field() const { return field_.get(); }

 private:
  [[nodiscard]] QWidget* makeVolumePart();
  [[nodiscard]] QWidget* makeBarPart();
  [[nodiscard]] TaskInputs taskInputs() override;
  void clear();
  void showTrends();
  void showCycle();
  void showVolume();
  void resetLevel();
  void showBar();

  TouchResults& results_;
  std::shared_ptr<const TouchEvaluation> evaluation_;
  std::shared_ptr<const Field> field_;
  QPushButton* fit_;
  QComboBox* cycle_;
  Segments* group_;
  Plot* trends_;
  RowsModel* parameters_;
  RowsModel* combinations_;
  QLabel* condition_;
  QStackedWidget* right_;
  // ball artefact
  Segments* component_;
  QCheckBox* arrows_;
  Segments* normal_;  ///< axis the plane is normal to
  QSlider* level_;
  QLabel* level_text_;
  View3D* view_;
  // hole bar
  Plot* line_;
  QCheckBox* second_axis_;
  QDoubleSpinBox* growth_;
  QDoubleSpinBox* trust_;
  RowsModel* bias_;
  BoundOptions<CycleChoice> options_;
};

}  // namespace spindrift::gui
