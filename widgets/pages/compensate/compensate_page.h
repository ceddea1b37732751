// SPDX-License-Identifier: GPL-3.0-or-later
// Step Compensate: what the fitted model would command at each point, what would remain, and the files for the control,
// each with its sign.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/workflows/compensation_workflow.h"
#include "widgets/commands/bound_options.h"
#include "widgets/pages/page.h"
#include "widgets/services/from_observations.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QPlainTextEdit;
class QSpinBox;
class QDoubleSpinBox;
class QStackedWidget;
class QTableView;
class QTabWidget;

namespace spindrift::gui {

class EmptyState;
class NumberTile;
class RowsModel;
class Segments;
class View3D;
class WrappedLabel;

class CompensatePage : public Page {
  Q_OBJECT
 public:
  explicit CompensatePage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return compute_; }
  void runAll() override { compute(); }

  /// Writes all files into a folder and says so.
  void exportFiles(const QString& folder);
  [[nodiscard]] const CompensationPlan* plan() const { return plan_.get(); }
  [[nodiscard]] QComboBox* fanucBox() const { return fanuc_; }
  [[nodiscard]] QComboBox* stateBox() const { return state_; }
  [[nodiscard]] QTableView* pointTable() const { return point_table_; }
  [[nodiscard]] View3D* view() const { return view_; }

 private:
  void compute();
  /// Everything the result depends on besides the files.
  [[nodiscard]] CompensationRequest request() const;
  [[nodiscard]] bool hasSource(CompensationSource source) const;
  void fillChoices();
  void showPlan();
  void showPoints();
  void showFiles();
  void showView();

  QPushButton* compute_;
  QPushButton* export_;
  QStackedWidget* stack_;
  EmptyState* empty_;
  QComboBox* source_;
  QComboBox* state_;
  /// What can be chosen in it, and where the tables usually pass through then.
  struct Places {
    std::vector<std::string> states;  ///< without the reference
    std::string state;                ///< that is chosen, else the warmest
    Eigen::Vector3d reference_mm = Eigen::Vector3d::Zero();
  };
  FromObservations<Places> places_;
  QSpinBox* positions_;
  std::array<QDoubleSpinBox*, 3> reference_{};
  QComboBox* fanuc_;
  NumberTile* before_;
  NumberTile* after_;
  NumberTile* expected_;
  NumberTile* largest_;
  QLabel* model_;
  QTabWidget* tabs_;
  RowsModel* points_;
  QTableView* point_table_;
  RowsModel* files_;
  QTableView* file_table_;
  WrappedLabel* convention_;
  QPlainTextEdit* preview_;
  Segments* arrows_;
  QCheckBox* machine_;
  View3D* view_;
  std::shared_ptr<const CompensationPlan> plan_;
  BoundOptions<CompensationChoice> options_;
};

}  // namespace spindrift::gui
