// SPDX-License-Identifier: GPL-3.0-or-later
// Card "The last hour" of the tab Connections: what the columns held.
#pragma once

#include <string>

#include "widgets/common/parts.h"

namespace spindrift::gui {

class ConnectionsService;
class Plot;

class HistoryCard : public Card {
  Q_OBJECT
 public:
  explicit HistoryCard(QWidget* parent = nullptr);
  /// The column `chosen`; without a choice all of the unit of the first, temperatures before anything else.
  void show(const ConnectionsService& service, const std::string& chosen);
  [[nodiscard]] Plot* plot() const { return plot_; }

 private:
  Plot* plot_;
};

}  // namespace spindrift::gui
