// SPDX-License-Identifier: GPL-3.0-or-later
// The parameters of a simulator: what each is, its value and bounds, the effects it can cause, and a tick for what is
// to be put in; after an update their values before and after.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "widgets/common/parts.h"
#include "widgets/panels/discrepancy/opened_simulator.h"

class QTableView;

namespace spindrift {
struct SimulationStory;
struct SimulationUpdate;
}  // namespace spindrift

namespace spindrift::gui {

class RowsModel;

class ParameterCard : public Card {
  Q_OBJECT
 public:
  explicit ParameterCard(QWidget* parent = nullptr);
  /// `story` and `update` may be null. Of `story` come the ticks that the user has not set.
  void show(const OpenedSimulator& simulator, const SimulationStory* story, const SimulationUpdate* update);
  /// Ticks are those of what was found again.
  void forgetTicks() { ticks_.reset(); }

  /// The user has changed a tick since they were forgotten.
  [[nodiscard]] bool ticksAreTheUsers() const { return ticks_.has_value(); }
  /// Names, in the order of the table.
  [[nodiscard]] std::vector<std::string> ticked() const;
  [[nodiscard]] RowsModel* model() const { return rows_; }
  [[nodiscard]] QTableView* table() const { return table_; }

 Q_SIGNALS:
  void ticksChanged();

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void arrange();
  void showChoice(const OpenedSimulator& simulator, const SimulationStory* story);
  void showUpdate(const SimulationUpdate& update);

  RowsModel* rows_;
  QTableView* table_;
  bool done_ = false;                           ///< an update is shown
  std::optional<std::set<std::string>> ticks_;  ///< nothing: those of what was found
};

}  // namespace spindrift::gui
