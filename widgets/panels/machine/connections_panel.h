// SPDX-License-Identifier: GPL-3.0-or-later
// Tab "Connections" of the step Machine: address, what is there, which of it becomes which column of the log, what
// comes, and recording it.
#pragma once

#include <QWidget>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/connect/record.h"
#include "widgets/export/exportable.h"
#include "widgets/panels/page_context.h"

class QLineEdit;
class QPushButton;
class QTableWidget;

namespace spindrift::gui {

class Callout;
class ColumnsCard;
class ConnectionsService;
class FieldsDialog;
class HistoryCard;
class ItemsCard;
class Plot;
class RowsModel;
class SourcesCard;

class ConnectionsPanel : public QWidget {
  Q_OBJECT
 public:
  explicit ConnectionsPanel(PageContext context, QWidget* parent = nullptr);
  void refresh();
  [[nodiscard]] std::vector<Exportable> exportables();

  /// Connects to the address and shows what is there; it becomes a source of the campaign.
  void lookAt(const QString& address);
  /// Lists a source again.
  void list(const std::string& source);
  /// Maps an item of the source that is shown to a column, or takes its column away.
  void tick(const QString& item, bool on);
  FieldsDialog* editSource();
  FieldsDialog* editColumn();

  [[nodiscard]] QLineEdit* address() const { return address_; }
  [[nodiscard]] QPushButton* lookButton() const { return look_; }
  [[nodiscard]] QPushButton* liveButton() const { return live_; }
  [[nodiscard]] QPushButton* recordButton() const { return record_; }
  [[nodiscard]] RowsModel* sources() const;
  [[nodiscard]] RowsModel* items() const;
  [[nodiscard]] QTableWidget* columns() const;
  [[nodiscard]] Plot* plot() const;
  [[nodiscard]] Callout* state() const { return state_; }

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  /// Validates and stores; a sentence why not, or nothing.
  QString apply(const QString& what, const nlohmann::json& after);
  void change(const QString& what, const nlohmann::json& after);
  void removeSource();
  void removeColumn();
  void columnEdited(int row, const nlohmann::json& entry, const QString& what);
  void toggleLive();
  void toggleRecording();
  void openFile();
  /// Roles that were stated here are the machine's, too.
  void stateRoles();
  void showSources();
  void showItems();
  void showColumns();
  void showLive();
  void showState();
  void showPlot();
  [[nodiscard]] std::string unitThere(const nlohmann::json& column) const;
  void say(const QString& sentence);

  PageContext context_;
  ConnectionsService& service_;
  std::map<std::string, std::vector<DataItem>> found_;  ///< by the name of the source
  std::int64_t found_visit_ = -1;                       ///< of which campaign
  QString refusal_;                                     ///< why the last change was not taken

  QLineEdit* address_;
  QPushButton* look_;
  QPushButton* live_;
  QPushButton* record_;
  Callout* state_;
  SourcesCard* sources_;
  ItemsCard* items_;
  ColumnsCard* columns_;
  HistoryCard* history_;
};

}  // namespace spindrift::gui
