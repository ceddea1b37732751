// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/jobs/activity_dialog.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QPushButton>
#include <QTableView>
#include <QVBoxLayout>

#include "widgets/common/parts.h"
#include "widgets/models/rows_model.h"

namespace spindrift::gui {
namespace {

const char* iconOf(Tone tone) {
  switch (tone) {
    case Tone::Good:
      return "check-circle";
    case Tone::Bad:
      return "error";
    case Tone::Attention:
      return "alert";
    default:
      return "info";
  }
}

}  // namespace

ActivityDialog::ActivityDialog(JobRunner& jobs, const MessageLog& log, QWidget* parent)
    : QDialog(parent), runner_(jobs), log_(log) {
  setWindowTitle(tr("Jobs and messages"));
  resize(760, 520);
  auto* column = new QVBoxLayout(this);
  column->setSpacing(8);
  column->addWidget(makeLabel(tr("Running and waiting"), "sectionTitle"));
  jobs_ = new RowsModel({tr("Job"), tr("Progress")}, this);
  job_table_ = makeTable(jobs_, tr("Jobs"), tr("No job is running."));
  column->addWidget(job_table_, 2);
  auto* line = new QHBoxLayout;
  cancel_ = makeButton(tr("Cancel the job"), "x");
  cancel_->setToolTip(tr("Stop it, or take it out before it begins; nothing of it is applied"));
  line->addStretch(1);
  line->addWidget(cancel_);
  column->addLayout(line);
  column->addWidget(makeLabel(tr("Messages"), "sectionTitle"));
  messages_ = new RowsModel({tr("When"), tr("Message")}, this);
  column->addWidget(makeSentenceTable(messages_, tr("Messages"), tr("There are no messages yet.")), 3);
  auto* close = makeButton(tr("Close"), nullptr);
  auto* last = new QHBoxLayout;
  last->addStretch(1);
  last->addWidget(close);
  column->addLayout(last);
  connect(close, &QPushButton::clicked, this, &QDialog::close);
  connect(cancel_, &QPushButton::clicked, this, &ActivityDialog::cancelChosen);
  connect(&runner_, &JobRunner::changed, this, &ActivityDialog::fillJobs);
  connect(&log_, &MessageLog::added, this, &ActivityDialog::fillMessages);
  connect(job_table_->selectionModel(), &QItemSelectionModel::currentChanged, this, &ActivityDialog::fillJobs);
  fillJobs();
  fillMessages();
}

void ActivityDialog::fillJobs() {
  std::vector<Row> rows;
  for (const JobEntry& job : runner_.entries()) {
    Row row;
    row.id = QString::number(job.id);
    QString far = tr("waits");
    if (job.running) {
      far = tr("%1 %").arg(static_cast<int>(100 * job.fraction));
      if (!job.stage.isEmpty()) far += QStringLiteral(", ") + job.stage;
    }
    row.cells = {{job.title, Tone::Neutral, job.running ? "in-progress" : "clock"}, {far}};
    rows.push_back(std::move(row));
  }
  jobs_->setRows(std::move(rows));
  cancel_->setEnabled(jobs_->rowCount() == 1 || job_table_->currentIndex().isValid());
}

void ActivityDialog::fillMessages() {
  std::vector<Row> rows;
  for (const Message& message : log_.messages()) {
    Row row;
    row.id = QString::number(rows.size());
    Cell text{message.text, Tone::Neutral, iconOf(message.tone)};
    text.tip = message.text;
    row.cells = {{message.time.toString(QStringLiteral("HH:mm:ss"))}, text};
    rows.push_back(std::move(row));
  }
  messages_->setRows(std::move(rows));
}

void ActivityDialog::cancelChosen() {
  const QModelIndex chosen = job_table_->currentIndex();
  const QString id = jobs_->idAt(chosen.isValid() ? chosen.row() : 0);
  if (!id.isEmpty()) runner_.cancel(id.toInt());
}

}  // namespace spindrift::gui
