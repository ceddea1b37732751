// SPDX-License-Identifier: GPL-3.0-or-later
// Step Model for one thermal state: nine parameters fitted to chosen points, validated on the others, shown as heat
// maps with the measured arrows; two sets of points compared.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/machine/field.h"
#include "core/machine/nine_parameter_model.h"
#include "core/machine/table_polynomial.h"
#include "core/workflows/nine_parameter_maps.h"
#include "widgets/commands/bound_options.h"
#include "widgets/pages/page.h"
#include "widgets/services/from_observations.h"

class QCheckBox;
class QComboBox;
class QTableView;
class QTabWidget;

namespace spindrift::gui {

class NumberTile;
class RowsModel;
class Segments;
struct FieldStyle;
class View3D;

class NineParameterPage : public Page {
  Q_OBJECT
 public:
  explicit NineParameterPage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return fit_button_; }
  void runAll() override { runTask("fit"); }
  void setComponent(int index);
  [[nodiscard]] View3D* view() const { return view_; }
  [[nodiscard]] QCheckBox* higherOrderBox() const { return higher_; }
  /// Null: none is shown.
  [[nodiscard]] const NineParameterFit* fit() const { return result_ == nullptr ? nullptr : &result_->fit; }
  [[nodiscard]] TableOrderChoice orderChoice() const { return result_ ? result_->order : TableOrderChoice(); }
  [[nodiscard]] const Field* field() const { return field_.get(); }

 private:
  void lookAgain();
  void fillStates();
  [[nodiscard]] std::string shownState() const;
  void fillPoints();
  void showPoints();
  void showFit();
  void showField();
  void showDifference();
  void showMap(const ComponentMap& map, double largest_um, const FieldStyle& style);
  void showComparison();
  [[nodiscard]] NineParameterOptions options() const;

  QPushButton* fit_button_;
  QComboBox* state_;
  /// What can be chosen in it.
  struct States {
    std::vector<std::string> all;  ///< in order of first appearance
    std::string last;              ///< lastStateToFit
  };
  FromObservations<States> states_;
  QComboBox* robust_;
  RowsModel* points_;
  /// What stands in the table of points.
  struct Changes {
    ObservationsToFit of;
    std::string state;
    std::vector<PointChange> points;
  };
  std::shared_ptr<const Changes> changes_;
  RowsModel* parameters_;
  RowsModel* residuals_;
  RowsModel* comparison_;
  QTableView* residual_table_;
  NumberTile* rms_fit_;
  NumberTile* rms_validation_;
  NumberTile* condition_;
  QTabWidget* tabs_;
  Callout* comparison_verdict_;
  Segments* component_;
  QCheckBox* arrows_;
  QCheckBox* same_scale_;
  QCheckBox* machine_;
  QCheckBox* relief_;
  View3D* view_;
  QCheckBox* higher_;  ///< draw the model of higher order; enabled where the evidence asks for one
  std::shared_ptr<const NineParameterResult> result_;
  std::shared_ptr<const Field> field_;
  BoundOptions<NineParameterChoice> options_;
};

}  // namespace spindrift::gui
