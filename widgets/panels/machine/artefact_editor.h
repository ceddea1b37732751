// SPDX-License-Identifier: GPL-3.0-or-later
// Hole bars, ball artefacts and styli of the machine description, edited in tables: one clear sentence per wrong cell,
// the artefact in 3D beside it, and undo. What is applied becomes the machine of the session, as on the other tab;
// machine.json of a campaign is never altered, the export of the page writes a new one.
#pragma once

#include <QWidget>

#include "core/probing/artefact_check.h"
#include "widgets/commands/draft.h"
#include "widgets/panels/page_context.h"

class QComboBox;
class QLabel;
class QPushButton;
class QTableWidget;

namespace spindrift::gui {

class ArtefactFields;
class Callout;
class View3D;

class ArtefactEditor : public QWidget {
  Q_OBJECT
 public:
  explicit ArtefactEditor(PageContext context, QWidget* parent = nullptr);
  /// Shows the artefacts of the session's machine, with what was typed and not applied yet.
  void refresh();
  [[nodiscard]] const std::vector<ArtefactFinding>& findings() const { return findings_; }
  [[nodiscard]] ArtefactFields* fields() const { return fields_; }
  [[nodiscard]] QTableWidget* styli() const { return styli_; }
  [[nodiscard]] View3D* view() const { return view_; }
  [[nodiscard]] Callout* verdict() const { return verdict_; }
  [[nodiscard]] QPushButton* applyButton() const { return apply_; }
  void addArtefact(const std::string& kind);

 private:
  void showArtefact(int index);
  void showStyli();
  void changed(const QString& what);
  void changed();
  void check();
  void showPreview();
  void apply();
  void discard();
  /// Artefacts and styli alone: what is edited here.
  [[nodiscard]] static nlohmann::json partOf(const nlohmann::json& machine);
  [[nodiscard]] nlohmann::json& current();

  PageContext context_;
  nlohmann::json machine_;  ///< as edited
  std::vector<ArtefactFinding> findings_;
  bool filling_ = false;
  bool edited_ = false;      ///< something is typed and not applied yet
  bool of_another_ = false;  ///< something was typed for artefacts that have become others
  Draft draft_;
  QComboBox* choice_;
  QPushButton* remove_;
  QPushButton* apply_;
  QPushButton* discard_;
  Callout* verdict_;
  ArtefactFields* fields_;
  QWidget* form_;  ///< the fields, which scroll
  QLabel* none_;   ///< in their place where there is no artefact
  QTableWidget* styli_;
  View3D* view_;
};

}  // namespace spindrift::gui
