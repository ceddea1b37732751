// SPDX-License-Identifier: GPL-3.0-or-later
// A table of texts with meanings, for lists and results that are replaced as a whole.
#pragma once

#include <QAbstractTableModel>
#include <QPixmap>
#include <QString>
#include <QStringList>
#include <functional>
#include <optional>
#include <vector>

#include "widgets/theme/theme.h"

class QTableView;

namespace spindrift::gui {

struct Cell {
  QString text;
  Tone tone = Tone::Neutral;   ///< other than Neutral: the text has that colour
  const char* icon = nullptr;  ///< a line icon in front
  bool right = false;          ///< numbers stand at the right
  bool bold = false;
  std::optional<bool> checked;  ///< a box to check in this cell
  QString tip;
  QPixmap picture;  ///< in place of the icon
  /// As in files, where the title of the column names none: of the number, or named by the text ("µm", "EX / µm").
  QString unit;
};

struct Row {
  QString id;
  std::vector<Cell> cells;
  bool faded = false;  ///< excluded
};

class RowsModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  explicit RowsModel(QStringList headers, QObject* parent = nullptr);
  /// Their units are printed as people write them: "EX / um" becomes "EX / µm", or "EX / µin" where the user wants
  /// that. Cells have the units of files in any case; they are converted when they are shown.
  void setHeaders(const QStringList& titles);
  void setRows(std::vector<Row> rows);
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
  [[nodiscard]] QString idAt(int row) const;
  [[nodiscard]] int rowOf(const QString& id) const;  ///< -1 if it is not there

  [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
  [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  [[nodiscard]] Qt::ItemFlags flags(const QModelIndex& index) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;

 Q_SIGNALS:
  /// The user changed a box; the model shows it at once, the owner decides what it means.
  void checkedChanged(const QString& id, int column, bool checked);

 private:
  [[nodiscard]] QString shownText(const Row& row, int column) const;

  QStringList headers_;
  std::vector<Row> rows_;
};

/// The ids of the rows that are selected in a table of this model, in the order of the rows.
[[nodiscard]] QStringList selectedIds(const QTableView& table, const RowsModel& rows);

}  // namespace spindrift::gui
