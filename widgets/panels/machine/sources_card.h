// SPDX-License-Identifier: GPL-3.0-or-later
// Card "Sources" of the tab Connections: what is connected, whether it answers, and what can be done with it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/connect/live_recording.h"
#include "widgets/common/parts.h"

class QPushButton;
class QTableView;

namespace spindrift::gui {

class RowsModel;

class SourcesCard : public Card {
  Q_OBJECT
 public:
  explicit SourcesCard(QWidget* parent = nullptr);
  void show(const nlohmann::json& description, const LiveSnapshot& snapshot, bool recording);
  /// Name of the source that is chosen, else of the first; empty if there is none.
  [[nodiscard]] std::string chosen() const;
  void choose(const std::string& source);
  [[nodiscard]] RowsModel* rows() const { return rows_; }

 Q_SIGNALS:
  void chosenChanged();
  void listWanted(const QString& source);
  void optionsWanted();
  void removeWanted();
  void fileWanted();

 private:
  RowsModel* rows_;
  QTableView* table_;
  QPushButton* options_;
  QPushButton* remove_;
  bool filling_ = false;
};

}  // namespace spindrift::gui
