// SPDX-License-Identifier: GPL-3.0-or-later
// Many machines over years: what is due, one machine's trends, campaigns side by side, batches. Works without a
// session; with one, its campaigns can be published. Looks at the store only through jobs: the window never waits for a
// server.
#pragma once

#include <QWidget>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/plant/batch_queue.h"
#include "core/plant/plant_overview.h"
#include "widgets/jobs/job_runner.h"
#include "widgets/models/session_model.h"
#include "widgets/theme/theme.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QTabWidget;
class QTableView;

namespace spindrift {
struct Publication;
}

namespace spindrift::gui {

class BatchesPanel;
class Callout;
class Plot;
class RowsModel;

/// All that a look at the store gives.
struct PlantLook {
  std::vector<MachineState> machines;
  std::vector<ModelState> models;  ///< of the machines, in their order; empty: not looked at yet
  std::vector<std::vector<TrendName>> names;
  std::vector<PlantListing> campaigns;
  std::vector<BatchState> batches;
  std::vector<std::string> warnings;
};
[[nodiscard]] PlantLook lookAtPlant(const PlantAddress& address, double now_s);

class PlantPage : public QWidget {
  Q_OBJECT
 public:
  PlantPage(SessionModel& session, JobRunner& jobs, QWidget* parent = nullptr);

  /// Opens a store, and shows it when it has been read.
  void openStore(const QString& address);
  /// The page is shown: reads the store again.
  void refresh();
  void publish();
  /// Writes the report of the first selected machine (one HTML file).
  void writeReport(const QString& file);
  void selectMachines(const QStringList& names);

  [[nodiscard]] QTableView* machines() const { return machine_table_; }
  [[nodiscard]] QTableView* campaigns() const { return campaign_table_; }
  [[nodiscard]] QTabWidget* tabs() const { return tabs_; }
  [[nodiscard]] QComboBox* parameter() const { return parameter_; }
  [[nodiscard]] Plot* plot() const { return plot_; }
  [[nodiscard]] Callout* callout() const { return callout_; }
  [[nodiscard]] RowsModel* comparison() const { return comparison_; }
  [[nodiscard]] BatchesPanel* batches() const { return batches_; }
  [[nodiscard]] QString said() const;
  [[nodiscard]] QPushButton* publishButton() const { return publish_; }

 Q_SIGNALS:
  void closed();

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void show(const PlantLook& look);
  void showMachines();
  void lookAtModels();
  void select(const QStringList& names);
  void showParameters();
  void showTrends();
  void showCampaigns();
  void compareChecked();
  void enterEvent();
  [[nodiscard]] QStringList chosenMachines() const;
  void send(const std::shared_ptr<Publication>& publication, const PlantAddress& address);
  void fail(const QString& sentence);
  [[nodiscard]] QString addressText() const;

  SessionModel& session_;
  JobRunner& jobs_;
  PlantLook look_;
  std::vector<std::int64_t> compared_;
  std::optional<std::pair<Tone, QString>> notice_;  ///< for the next time the store has been read

  QLineEdit* address_;
  QPushButton* publish_;
  QPushButton* report_;
  Callout* callout_;
  RowsModel* machines_;
  QTableView* machine_table_;
  QTabWidget* tabs_;
  QComboBox* parameter_;
  Plot* plot_;
  QLabel* said_;
  RowsModel* campaigns_;
  QTableView* campaign_table_;
  RowsModel* comparison_;
  BatchesPanel* batches_;
  QComboBox* event_kind_;
  QLineEdit* event_time_;
  QLineEdit* event_note_;
  QPushButton* enter_event_;
};

}  // namespace spindrift::gui
