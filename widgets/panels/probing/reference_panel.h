// SPDX-License-Identifier: GPL-3.0-or-later
// A parameter of the cycles beside the record of a reference instrument (P1 Fig. 3): both over time, their difference
// with its uncertainty, rms. The record is copied into the session, so that it is still there on another computer.
#pragma once

#include <QWidget>
#include <filesystem>

#include "core/probing/cycle_studies.h"
#include "widgets/export/exportable.h"
#include "widgets/panels/page_context.h"

class QComboBox;
class QPushButton;

namespace spindrift {
struct TouchEvaluation;
}

namespace spindrift::gui {

class Callout;
class Plot;

class ReferencePanel : public QWidget {
  Q_OBJECT
 public:
  explicit ReferencePanel(PageContext context, QWidget* parent = nullptr);
  /// The cycles to compare; null: none. Shows the comparison again.
  void setCycles(std::shared_ptr<const TouchEvaluation> evaluation);
  /// Takes a record (`time_s,value[,sigma]`); says in one sentence what is wrong with it.
  void load(const QString& file);
  void setParameter(const QString& name);
  [[nodiscard]] const ReferenceComparison& comparison() const { return comparison_; }
  [[nodiscard]] Callout* verdict() const { return verdict_; }
  [[nodiscard]] Plot* curves() const { return curves_; }
  [[nodiscard]] Plot* differences() const { return differences_; }
  [[nodiscard]] std::vector<Exportable> exportables() const;

 private:
  void compare();
  void change(const QString& what, const nlohmann::json& change);
  [[nodiscard]] nlohmann::json options() const;
  [[nodiscard]] std::string key() const;

  PageContext context_;
  std::shared_ptr<const TouchEvaluation> evaluation_;
  ReferenceComparison comparison_;
  QComboBox* parameter_;
  QPushButton* load_;
  Callout* verdict_;
  Plot* curves_;
  Plot* differences_;
};

}  // namespace spindrift::gui
