// SPDX-License-Identifier: GPL-3.0-or-later
// The batches of a plant store: started from a plan, worked on by this computer, cancelled, resumed. What runs
// somewhere else is looked at every few seconds while the panel is seen.
#pragma once

#include <QTimer>
#include <QWidget>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/plant/batch_queue.h"
#include "core/plant/plant_address.h"
#include "widgets/jobs/job_runner.h"

class QLineEdit;
class QPushButton;
class QTableView;

namespace spindrift::gui {

class Callout;
class RowsModel;

class BatchesPanel : public QWidget {
  Q_OBJECT
 public:
  /// `address` gives the store as typed; what happens is said in `callout`.
  BatchesPanel(JobRunner& jobs, Callout& callout, std::function<QString()> address, QWidget* parent = nullptr);

  void show(const std::vector<BatchState>& batches);
  /// Reads the batches of the store, and shows them.
  void look();
  /// Works on the batch of a plan (JSON) on this computer; the same plan again goes on where it ended.
  void start(const QString& plan_file);
  /// spindrift-cli, which batches run; without it the one beside this program.
  void setWorkerProgram(const QString& program) { worker_program_ = program; }

  [[nodiscard]] RowsModel* rows() const { return rows_; }
  [[nodiscard]] QTableView* table() const { return table_; }

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void cancel();
  void resume();
  /// Works on a batch in the job bar. `begin` gives its number, once it is in the store.
  void workOn(const QString& title, std::function<std::int64_t(const PlantAddress&)> begin);
  void enableButtons();
  [[nodiscard]] const BatchState* chosen() const;

  JobRunner& jobs_;
  Callout& callout_;
  std::function<QString()> address_;
  std::vector<BatchState> states_;
  RowsModel* rows_;
  QTableView* table_;
  QLineEdit* plan_;
  QPushButton* start_;
  QPushButton* cancel_;
  QPushButton* resume_;
  QString worker_program_;
  QTimer timer_;
};

}  // namespace spindrift::gui
