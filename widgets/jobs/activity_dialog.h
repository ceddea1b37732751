// SPDX-License-Identifier: GPL-3.0-or-later
// What runs and what waits, each with its progress and to be cancelled; and all messages so far.
#pragma once

#include <QDialog>

#include "widgets/jobs/job_runner.h"
#include "widgets/jobs/message_log.h"

class QPushButton;
class QTableView;

namespace spindrift::gui {

class RowsModel;

class ActivityDialog : public QDialog {
  Q_OBJECT
 public:
  ActivityDialog(JobRunner& jobs, const MessageLog& log, QWidget* parent = nullptr);
  [[nodiscard]] RowsModel* jobs() const { return jobs_; }
  [[nodiscard]] RowsModel* messages() const { return messages_; }
  [[nodiscard]] QTableView* jobTable() const { return job_table_; }
  [[nodiscard]] QPushButton* cancelButton() const { return cancel_; }

 private:
  void fillJobs();
  void fillMessages();
  void cancelChosen();

  JobRunner& runner_;
  const MessageLog& log_;
  RowsModel* jobs_;
  RowsModel* messages_;
  QTableView* job_table_;
  QPushButton* cancel_;
};

}  // namespace spindrift::gui
