// SPDX-License-Identifier: GPL-3.0-or-later
// Card "What is there" of the tab Connections: data items of the source that is chosen, ticked where they are columns.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/connect/record.h"
#include "widgets/common/parts.h"

class QLineEdit;

namespace spindrift::gui {

class RowsModel;

class ItemsCard : public Card {
  Q_OBJECT
 public:
  explicit ItemsCard(QWidget* parent = nullptr);
  /// What was found in the source, and the addresses of which there are columns.
  void show(std::vector<DataItem> found, std::set<std::string> ticked);
  [[nodiscard]] RowsModel* rows() const { return rows_; }

 Q_SIGNALS:
  /// A data item is to become a column, or no longer to be one.
  void ticked(const QString& item, bool on);

 private:
  void fill();

  std::vector<DataItem> found_;
  std::set<std::string> ticked_;
  RowsModel* rows_;
  QLineEdit* filter_;
};

}  // namespace spindrift::gui
