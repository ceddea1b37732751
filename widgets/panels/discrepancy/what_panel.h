// SPDX-License-Identifier: GPL-3.0-or-later
// Which effects are missing: each with its rivals, evidence, parameters and physics; and the most probable of all,
// named or not, with their probabilities.
#pragma once

#include <QWidget>
#include <memory>
#include <vector>

#include "core/workflows/discrepancy_story.h"
#include "widgets/export/exportable.h"

class QLabel;
class QPushButton;
class QStackedWidget;
class QTableView;

namespace spindrift::gui {

class Callout;
class Card;
class NumberTile;
class Plot;
class RowsModel;
class Segments;

class WhatPanel : public QWidget {
  Q_OBJECT
 public:
  explicit WhatPanel(QWidget* parent = nullptr);
  void show(const std::shared_ptr<const DiscrepancyStory>& story);
  [[nodiscard]] std::vector<Exportable> exportables();
  /// Shows what the effects explain of this series.
  void choose(const std::string& point, Component component);
  /// Id that the user has marked: an effect or one of its rivals; empty: none.
  [[nodiscard]] std::string chosen() const;
  /// True if that one is in the model already.
  [[nodiscard]] bool chosenIsAdded() const;
  [[nodiscard]] QTableView* effectTable() const { return effect_table_; }
  [[nodiscard]] QTableView* candidateTable() const { return candidate_table_; }
  [[nodiscard]] QPushButton* rejectButton() const { return reject_; }

 Q_SIGNALS:
  void choiceChanged();
  void hovered(const QString& text);
  void rejectAsked(const std::string& id);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void arrange();
  void showEffect();
  void fillCandidates();
  [[nodiscard]] const FoundEffect* effectOf(const std::string& id) const;

  RowsModel* effects_;
  RowsModel* candidates_;
  RowsModel* parameters_;
  QTableView* effect_table_;
  QTableView* candidate_table_;
  Segments* which_;
  QStackedWidget* below_;
  Card* detail_;
  QLabel* physics_title_;
  QLabel* physics_;
  QLabel* drivers_;
  Callout* rivals_;
  NumberTile* confidence_;
  NumberTile* gain_;
  NumberTile* held_out_;
  QPushButton* reject_;
  QLabel* plot_title_;
  QLabel* legend_;
  Plot* plot_;
  bool has_plot_ = false;
  std::shared_ptr<const DiscrepancyStory> story_;
};

}  // namespace spindrift::gui
