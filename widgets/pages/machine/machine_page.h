// SPDX-License-Identifier: GPL-3.0-or-later
// Step Machine: the description, editable, with what is missing for what; the machine in 3D.
#pragma once

#include "widgets/commands/draft.h"
#include "widgets/pages/page.h"

class QComboBox;
class QLineEdit;
class QSpinBox;
class QTableWidget;

namespace spindrift {
struct PlacementAnswer;
}

namespace spindrift::gui {

class ArtefactEditor;
class Badge;
class ConnectionsPanel;
class View3D;

class MachinePage : public Page {
  Q_OBJECT
 public:
  explicit MachinePage(PageContext context, QWidget* parent = nullptr);
  void refresh() override;
  [[nodiscard]] std::vector<Exportable> exportables() override;
  [[nodiscard]] ArtefactEditor* artefacts() const { return artefacts_; }
  /// Column of the log, what it is taken for, and from where that is known.
  [[nodiscard]] QTableWidget* sensors() const { return sensors_; }
  /// Null until its tab is shown for the first time.
  [[nodiscard]] ConnectionsPanel* connections() const { return connections_; }

 private:
  /// Keeps what is typed; `what` names the step for undo.
  void markEdited(const QString& what);
  void markTyped();
  void discard();
  /// Everything that stands in the fields, whether it can be read or not; and back.
  [[nodiscard]] nlohmann::json typed() const;
  void showTyped(const nlohmann::json& typed);
  /// What the fields of this page describe: the machine without what has an editor of its own.
  [[nodiscard]] nlohmann::json base() const;
  void apply();
  void suggestPoints();
  void showSuggestion(const PlacementAnswer& answer);
  [[nodiscard]] nlohmann::json edited() const;
  void showFindings();
  QWidget* makeSensorTab();
  void showSensors();
  void stateRole(int row);
  void sayRoleIsStated(int row);
  void makeConnections();

  QLineEdit* name_;
  QLineEdit* chain_;
  QTableWidget* axes_;
  QTableWidget* points_;
  QTableWidget* sensors_;
  ArtefactEditor* artefacts_;
  QWidget* connections_tab_;
  ConnectionsPanel* connections_ = nullptr;  ///< made when it is wanted: opening a session does not wait for it
  View3D* view_;
  QSpinBox* suggest_count_;
  QComboBox* suggest_goal_;
  QPushButton* suggest_;
  QPushButton* apply_;
  QPushButton* discard_;
  QPushButton* original_;
  bool filling_ = false;
  Draft draft_;
};

/// Sentences about what the description lacks for which use.
[[nodiscard]] QStringList machineFindings(const MachineDescription& machine);

}  // namespace spindrift::gui
