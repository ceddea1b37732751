// SPDX-License-Identifier: GPL-3.0-or-later
// The fields and tables of one artefact: JSON in, JSON out, findings shown where they belong.
#pragma once

#include <QWidget>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/probing/artefact_check.h"

class QGridLayout;
class QLineEdit;
class QTableWidget;

namespace spindrift::gui {

class ArtefactFields : public QWidget {
  Q_OBJECT
 public:
  explicit ArtefactFields(QWidget* parent = nullptr);
  void show(const nlohmann::json& artefact);
  /// What stands in the fields, over the keys of `before` that have no field. Cells that are no number stay texts.
  [[nodiscard]] nlohmann::json read(const nlohmann::json& before) const;
  /// Marks wrong cells, with the sentence as a tip.
  void mark(const std::vector<ArtefactFinding>& findings);
  [[nodiscard]] QTableWidget* features() const { return features_; }
  [[nodiscard]] QLineEdit* field(const char* key, int column = 0) const;

 Q_SIGNALS:
  void edited();

 private:
  void addField(QGridLayout* form, int row, int column, const QString& title, const std::string& key, int parts,
                const QString& tip);
  void addFeature();
  void showDistances();

  std::map<std::string, std::vector<QLineEdit*>> fields_;
  std::map<std::string, QWidget*> labels_;
  QTableWidget* features_;
  bool holes_ = false;
  bool filling_ = false;
};

/// Shows findings of a table's rows: wrong in the colour of bad, doubtful in that of attention.
void markCells(QTableWidget* table, const std::vector<ArtefactFinding>& findings, const std::string& key,
               int first_column);

}  // namespace spindrift::gui
