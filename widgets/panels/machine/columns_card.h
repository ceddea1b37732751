// SPDX-License-Identifier: GPL-3.0-or-later
// Card "Columns of the log" of the tab Connections: what becomes which column, and what it holds now.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "core/connect/live_recording.h"
#include "widgets/common/parts.h"

class QPushButton;
class QTableWidget;

namespace spindrift::gui {

class ColumnsCard : public Card {
  Q_OBJECT
 public:
  /// The unit of a column's data item as its source says it.
  using UnitThere = std::function<std::string(const nlohmann::json& column)>;
  /// The entry of a row as it was edited, and what that was.
  using Edited = std::function<void(int row, const nlohmann::json& entry, const QString& what)>;

  explicit ColumnsCard(Edited edited, QWidget* parent = nullptr);
  void show(const nlohmann::json& description, const UnitThere& unit_there, bool recording);
  void showLive(const LiveSnapshot& snapshot, bool recording);
  /// Row that is chosen; -1: none.
  [[nodiscard]] int chosen() const;
  /// Name of the column that is chosen; empty: none.
  [[nodiscard]] std::string chosenName() const;
  [[nodiscard]] QTableWidget* table() const { return table_; }

 Q_SIGNALS:
  void chosenChanged();
  void optionsWanted();
  void removeWanted();

 private:
  void cellEdited(int row, int column);
  void roleChosen(int row, const std::string& role);
  /// After the editor of the cell has gone.
  void tell(int row, const nlohmann::json& entry, const QString& what);

  Edited edited_;
  nlohmann::json entries_;
  QTableWidget* table_;
  QPushButton* options_;
  QPushButton* remove_;
  bool filling_ = false;
};

}  // namespace spindrift::gui
