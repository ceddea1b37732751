// SPDX-License-Identifier: GPL-3.0-or-later
// Step Capture for a touch probe: cycles and touches with a verdict each, the cycle plan in 3D, the measuring programme
// for the control.
#pragma once

#include <optional>

#include "core/probing/checked_program.h"
#include "core/probing/touch_verdict.h"
#include "widgets/pages/page.h"

class QCheckBox;
class QComboBox;
class QTableView;

namespace spindrift::gui {

class RowsModel;
class TouchResults;
class View3D;

class TouchCapturePage : public Page {
  Q_OBJECT
 public:
  explicit TouchCapturePage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] QPushButton* primaryButton() const override { return check_; }
  void runAll() override;
  [[nodiscard]] View3D* view() const { return view_; }
  [[nodiscard]] RowsModel* touchRows() const { return touches_; }
  [[nodiscard]] RowsModel* cycleRows() const { return cycles_; }
  /// The programme as checked last; empty if none could be made.
  [[nodiscard]] const std::optional<CheckedProgram>& program() const { return program_; }
  void selectCycle(const QString& cycle);
  /// The touch that is selected; of several the first.
  [[nodiscard]] QString pickedItem() const override { return selectedTouches().value(0); }

 private:
  [[nodiscard]] TaskInputs taskInputs() override;
  void fillCycles();
  void fillTouches();
  void showVerdict();
  void showScene();
  void makeProgram();
  void toggleExcluded();
  [[nodiscard]] QStringList selectedTouches() const;
  [[nodiscard]] std::vector<TouchVerdict> verdictsOf(const QString& cycle) const;
  [[nodiscard]] const Artefact* artefact() const;

  TouchResults& results_;
  std::shared_ptr<const TouchEvaluation> evaluation_;  ///< that is shown; null: the bare list
  std::vector<TouchVerdict> verdicts_;
  bool judged_ = false;  ///< verdicts come from an evaluation, not from the bare list
  QString cycle_;
  /// Takes a programme away that was planned for another machine, and says so; false: there is none.
  bool forgetOldProgram();
  std::optional<CheckedProgram> program_;
  nlohmann::json program_machine_;  ///< what it was planned for
  QPushButton* check_;
  QComboBox* state_filter_;
  QComboBox* control_;
  RowsModel* cycles_;
  RowsModel* touches_;
  QTableView* cycle_table_;
  QTableView* touch_table_;
  QPushButton* exclude_;
  Callout* reason_;
  Callout* program_verdict_;
  QPushButton* make_program_;
  QCheckBox* path_;
  QCheckBox* machine_;
  View3D* view_;
  bool filling_ = false;
};

}  // namespace spindrift::gui
