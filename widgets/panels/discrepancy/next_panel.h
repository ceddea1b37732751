// SPDX-License-Identifier: GPL-3.0-or-later
// What to measure next, what remains, and every step of the search with its evidence.
#pragma once

#include <QWidget>
#include <memory>
#include <vector>

#include "core/workflows/discrepancy_story.h"
#include "widgets/export/exportable.h"

class QLabel;

namespace spindrift::gui {

class Callout;
class NumberTile;
class RowsModel;

class NextPanel : public QWidget {
  Q_OBJECT
 public:
  explicit NextPanel(QWidget* parent = nullptr);
  void show(const std::shared_ptr<const DiscrepancyStory>& story);
  [[nodiscard]] std::vector<Exportable> exportables();

 private:
  void showSuggestion();

  QWidget* planned_;  ///< card of what to measure, where there is a plan
  Callout* nothing_;  ///< why there is none
  QLabel* suggestion_;
  NumberTile* gain_;
  RowsModel* times_;
  Callout* leftover_;
  QLabel* warnings_;
  RowsModel* steps_;
  std::shared_ptr<const DiscrepancyStory> story_;
};

}  // namespace spindrift::gui
