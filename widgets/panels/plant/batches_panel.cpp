// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/plant/batches_panel.h"

#include <QCoreApplication>
#include <QFileDialog>
#include <QFileInfo>
#include <QItemSelectionModel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableView>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/count_text.h"
#include "core/base/error.h"
#include "core/plant/batch_engine.h"
#include "core/plant/plant_store.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/plant/plant_parts.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {

BatchesPanel::BatchesPanel(JobRunner& jobs, Callout& callout, std::function<QString()> address, QWidget* parent)
    : QWidget(parent), jobs_(jobs), callout_(callout), address_(std::move(address)) {
  rows_ =
      new RowsModel({tr("Batch"), tr("Work"), tr("Done"), tr("Failed"), tr("Running"), tr("Cost"), tr("Left")}, this);
  table_ = makeTable(rows_, tr("Batches"), tr("Choose a plan to start a batch on this computer."));
  connect(table_->selectionModel(), &QItemSelectionModel::selectionChanged, this, &BatchesPanel::enableButtons);
  plan_ = new QLineEdit;
  plan_->setAccessibleName(tr("Plan of the batch"));
  plan_->setPlaceholderText(tr("PLAN.json (format spindrift-batch)"));
  auto* choose = makeButton(tr("Plan …"), "folder-open");
  start_ = makeButton(tr("Start"), "play");
  start_->setToolTip(
      tr("Processes the campaigns or seeds of the plan on all processors of this computer; starting the same plan "
         "again continues it"));
  cancel_ = makeButton(tr("Cancel the batch"), "stop");
  cancel_->setToolTip(tr("Stops the batch on every computer; finished items are kept"));
  resume_ = makeButton(tr("Resume on this computer"), "play");
  resume_->setToolTip(tr("Goes on after a cancellation, and tries again what has failed"));
  start_->setEnabled(false);
  connect(plan_, &QLineEdit::textChanged, this,
          [this](const QString& typed) { start_->setEnabled(!typed.trimmed().isEmpty()); });
  connect(plan_, &QLineEdit::returnPressed, start_, &QPushButton::click);
  connect(choose, &QPushButton::clicked, this, [this] {
    const QString file = QFileDialog::getOpenFileName(this, tr("Choose a plan"), {}, tr("Plan (*.json)"));
    if (!file.isEmpty()) plan_->setText(file);
  });
  connect(start_, &QPushButton::clicked, this, [this] { start(plan_->text().trimmed()); });
  connect(cancel_, &QPushButton::clicked, this, &BatchesPanel::cancel);
  connect(resume_, &QPushButton::clicked, this, &BatchesPanel::resume);
  enableButtons();

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(12, 12, 12, 12);
  layout->setSpacing(8);
  layout->addWidget(row({plan_, choose, start_}, 0));
  layout->addWidget(table_);
  layout->addWidget(row({new QWidget, cancel_, resume_}, 0));

  timer_.setInterval(3000);
  connect(&timer_, &QTimer::timeout, this, [this] {
    if (isVisible()) look();
  });
  timer_.start();
}

void BatchesPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  look();
}

void BatchesPanel::look() {
  if (address_().isEmpty()) return;
  try {
    const PlantAddress address = PlantAddress::parse(address_().toStdString());
    jobs_.run(displayJob(
        tr("Looking at batches"), "plant-batches",
        [address] {
          PlantStore store = PlantStore::open(address, {.as = PlantRole::Reader});
          return BatchQueue(store).all();
        },
        [this](const std::vector<BatchState>& batches) { show(batches); }));
  } catch (const InputError& e) {
    callout_.show(Tone::Bad, coreSentence(e.what()));
  }
}

void BatchesPanel::show(const std::vector<BatchState>& batches) {
  const auto hours = [](double s) {
    if (s < 120.0) return tr("%1 s").arg(decimalText(s, 'f', 0));
    return s < 7200.0 ? tr("%1 min").arg(decimalText(s / 60.0, 'f', 0))
                      : tr("%1 h").arg(decimalText(s / 3600.0, 'f', 1));
  };
  std::vector<Row> rows;
  for (const BatchState& b : batches) {
    const double part = b.items > 0 ? 100.0 * static_cast<double>(b.answered) / static_cast<double>(b.items) : 100.0;
    Cell running{coreSentence(countOf(b.running, "chunk"))};
    if (b.idle()) {
      running = {tr("nobody"), Tone::Attention, "alert"};
      running.tip = tr("Not running: it waits in Slurm, or its processes have ended; Resume continues it.");
    }
    if (b.finished()) running = {tr("finished"), Tone::Good, "check-circle"};
    if (b.cancelled) running = {tr("cancelled"), Tone::Attention, "stop"};
    Cell failed{QString::number(b.failed_items), b.failed_items > 0 ? Tone::Bad : Tone::Neutral,
                b.failed_items > 0 ? "error" : nullptr, true};
    failed.tip = coreSentence(b.error);
    rows.push_back(
        {QString::number(b.id),
         {{tr("%1 %2").arg(b.id).arg(text(b.name))},
          {text(b.work)},
          {tr("%1 of %2 (%3 %)").arg(b.answered).arg(b.items).arg(decimalText(std::floor(part), 'f', 0)), Tone::Neutral,
           nullptr, true},
          failed,
          running,
          {hours(b.spent_s), Tone::Neutral, nullptr, true},
          {b.remaining_s > 0.0 ? hours(b.remaining_s) : QStringLiteral("–"), Tone::Neutral, nullptr, true}}});
  }
  const BatchState* const batch = chosen();
  const QString again = batch != nullptr ? QString::number(batch->id) : QString();
  states_ = batches;
  rows_->setRows(std::move(rows));
  const int place = rows_->rowOf(again);
  if (place >= 0) table_->selectRow(place);
  enableButtons();
}

const BatchState* BatchesPanel::chosen() const {
  const QModelIndexList rows = table_->selectionModel()->selectedRows();
  if (rows.isEmpty()) return nullptr;
  const std::int64_t id = rows_->idAt(rows.front().row()).toLongLong();
  const auto found = std::find_if(states_.begin(), states_.end(), [id](const BatchState& b) { return b.id == id; });
  return found != states_.end() ? &*found : nullptr;
}

void BatchesPanel::enableButtons() {
  const BatchState* const b = chosen();
  cancel_->setEnabled(b != nullptr && !b->finished() && !b->cancelled);
  resume_->setEnabled(b != nullptr && (!b->finished() || b->cancelled || b->failed_items > 0));
}

void BatchesPanel::workOn(const QString& title, std::function<std::int64_t(const PlantAddress&)> begin) {
  try {
    const PlantAddress address = PlantAddress::parse(address_().toStdString());
    EngineOptions options;
    const QString program = worker_program_.isEmpty()
                                ? QCoreApplication::applicationDirPath() + QStringLiteral("/spindrift-cli")
                                : worker_program_;
    if (!QFileInfo(program).isExecutable())
      throw InputError({program.toStdString(), ""}, "is not there; batches run the command line of this program.");
    options.worker_command = {program.toStdString(), "batch", "work"};
    Job job;
    job.title = title;
    job.queue = JobQueue::Batch;
    job.work = [this, address, options, begin = std::move(begin)](JobContext& context) -> std::function<void()> {
      const std::int64_t id = begin(address);
      const EngineReport report = runLocally(address, id, options, context);
      if (!report.refused.empty()) throw InputError(report.refused);
      return [this, state = report.state] {
        const QString name = tr("Batch %1 %2").arg(state.id).arg(text(state.name));
        if (state.cancelled)
          callout_.show(Tone::Attention,
                        tr("%1 is cancelled; completed items are kept, and Resume continues.").arg(name));
        else if (state.failed_items > 0)
          callout_.show(Tone::Attention, tr("%1 is finished, %2 failed: spindrift-cli batch status %3 --results FILE "
                                            "says why.")
                                             .arg(name, coreSentence(countOf(state.failed_items, "item")))
                                             .arg(state.id));
        else
          callout_.show(Tone::Good, tr("%1 is finished: %2.").arg(name, coreSentence(countOf(state.answered, "item"))));
        look();
      };
    };
    job.failed = [this](const QString& sentence) { callout_.show(Tone::Bad, sentence); };
    callout_.set(Tone::Neutral, {});
    job.cancelled = [this] {
      callout_.show(Tone::Attention, tr("The batch has stopped; completed items are kept, and Resume continues."));
      look();
    };
    jobs_.run(std::move(job));
  } catch (const InputError& e) {
    callout_.show(Tone::Bad, coreSentence(e.what()));
  }
}

void BatchesPanel::start(const QString& plan_file) {
  workOn(tr("Batch of %1").arg(QFileInfo(plan_file).fileName()),
         [file = plan_file.toStdString()](const PlantAddress& address) {
           const BatchPlan plan = BatchPlan::read(file);
           plan.requireFiles();
           PlantStore store = PlantStore::openOrMake(address);
           return BatchQueue(store).submit(plan);
         });
}

void BatchesPanel::resume() {
  const BatchState* const batch = chosen();
  if (batch == nullptr) return;
  workOn(tr("Batch %1 %2").arg(batch->id).arg(text(batch->name)), [id = batch->id](const PlantAddress& address) {
    PlantStore store = PlantStore::open(address);
    BatchQueue(store).resume(id);
    return id;
  });
}

void BatchesPanel::cancel() {
  const BatchState* const batch = chosen();
  if (batch == nullptr) return;
  const PlantAddress address = PlantAddress::parse(address_().toStdString());
  Job job = displayJob(
      tr("Cancelling a batch"), "",
      [address, id = batch->id] {
        PlantStore store = PlantStore::open(address);
        BatchQueue(store).cancel(id);
        return id;
      },
      [this](std::int64_t) { look(); });
  job.failed = [this](const QString& sentence) { callout_.show(Tone::Bad, sentence); };
  jobs_.run(std::move(job));
}

}  // namespace spindrift::gui
