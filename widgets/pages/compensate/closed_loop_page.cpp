// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/compensate/closed_loop_page.h"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "widgets/common/core_sentence.h"
#include "widgets/common/demo_names.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/models/session_model.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {
namespace {

QString signedNumber(double value, int digits) {
  if (std::abs(value) < 0.5 * std::pow(10.0, -digits)) value = 0.0;
  return decimalText(value, 'f', digits);
}

/// "+12.4 ± 0.6 µm".
QString sureNumber(double value, double sigma) {
  const QString sign = value > 0.05 ? QStringLiteral("+") : QString();
  if (!std::isfinite(sigma)) return sign + signedNumber(value, 1) + QStringLiteral(" µm");
  return QStringLiteral("%1%2 ± %3 µm").arg(sign, signedNumber(value, 1)).arg(decimalText(sigma, 'f', 1));
}

}  // namespace

ClosedLoopPage::ClosedLoopPage(SessionModel& session, QWidget* parent)
    : QWidget(parent), service_(ClosedLoopService::of(session)) {
  setAccessibleName(tr("Compensate: live"));
  auto* outer = new QVBoxLayout(this);
  outer->setContentsMargins(24, 16, 24, 16);
  outer->setSpacing(12);
  auto* head = new QHBoxLayout;
  head->setSpacing(8);
  auto* titles = new QVBoxLayout;
  titles->setSpacing(2);
  titles->addWidget(makeLabel(tr("Compensate: live"), "pageTitle"));
  titles->addWidget(
      makeLabel(tr("Measure, model and compensate at the control, while the machine works."), "instruction"));
  head->addLayout(titles, 1);
  auto* back = makeButton(tr("Back"), "chevron-left");
  stop_ = makeButton(tr("Stop and fade to zero"), nullptr);
  start_ = makeButton(tr("Start …"), nullptr, "primary");
  head->addWidget(back);
  head->addWidget(stop_);
  head->addWidget(start_);
  outer->addLayout(head);
  auto* line = new QHBoxLayout;
  line->setSpacing(8);
  plan_ = makeLabel({}, "secondaryText");
  plan_->setWordWrap(true);
  line->addWidget(plan_, 1);
  folder_ = makeButton(tr("Folder …"), "folder-open");
  folder_->setToolTip(tr("Where the loop leaves its campaign; one that was ended is continued there"));
  open_ = makeButton(tr("Open plan …"), "folder-open");
  line->addWidget(folder_);
  line->addWidget(open_);
  outer->addLayout(line);
  callout_ = new Callout;
  outer->addWidget(callout_);

  confirmation_ = new Card(tr("What will move"));
  dry_run_ = makeLabel({}, "instruction");
  dry_run_->setWordWrap(true);
  confirmation_->body()->addWidget(dry_run_);
  auto* answers = new QHBoxLayout;
  answers->setSpacing(8);
  auto* not_now = makeButton(tr("Not now"), nullptr);
  confirm_ = makeButton(tr("I am at the machine: start"), nullptr, "primary");
  answers->addStretch();
  answers->addWidget(not_now);
  answers->addWidget(confirm_);
  confirmation_->body()->addLayout(answers);
  outer->addWidget(confirmation_);

  decision_ = new Card(tr("Missing in the simulation: what is added?"));
  choice_ = new RowsModel({tr("Effect"), tr("Confidence"), tr("Indistinguishable from")}, this);
  auto* choice_table = makeTable(choice_, tr("Named effects"));
  stretchColumn(choice_table, 0);
  decision_->body()->addWidget(choice_table);
  auto* choose = new QHBoxLayout;
  choose->addStretch();
  accept_ = makeButton(tr("Add the selected effects"), nullptr, "primary");
  choose->addWidget(accept_);
  decision_->body()->addLayout(choose);

  auto* numbers = new Card;
  auto* tiles = new QHBoxLayout;
  tiles->setSpacing(16);
  for (std::size_t axis = 0; axis < axes_.size(); ++axis)
    axes_[axis] = new NumberTile(tr("%1, applied now").arg(QChar(QLatin1Char("XYZ"[axis]))));
  age_ = new NumberTile(tr("Age of the inputs"));
  spent_ = new NumberTile(tr("Measurements spent"));
  for (NumberTile* tile : {axes_[0], axes_[1], axes_[2], age_, spent_}) tiles->addWidget(tile, 1);
  numbers->body()->addLayout(tiles);
  auto* silent = new QHBoxLayout;
  silent->setSpacing(8);
  silent->addWidget(new QLabel(tr("If Spindrift stops responding:")));
  silence_ = new Segments({tr("Fade to zero"), tr("Hold")}, tr("Compensation if Spindrift stops responding"));
  silent->addWidget(silence_);
  silent->addStretch();
  silence_note_ = makeLabel({}, "secondaryText");
  silent->addWidget(silence_note_);
  numbers->body()->addLayout(silent);
  outer->addWidget(numbers);

  auto* left = new Card(tr("Error at the tool point, without and with"));
  component_ = new Segments({QStringLiteral("X"), QStringLiteral("Y"), QStringLiteral("Z")}, tr("Axis of the plot"));
  component_->setCurrent(2);
  left->addToTitle(component_);
  plot_ = new Plot;
  plot_->setLeastRange(1.0);
  plot_->setEmptyText(tr("The measuring cycles will appear here"),
                      tr("Open a plan, press Start, and confirm what will move."));
  left->body()->addWidget(plot_, 1);
  errors_ = makeLabel({}, "secondaryText");
  errors_->setWordWrap(true);
  left->body()->addWidget(errors_);
  auto* right = new Card(tr("Events"));
  events_ = new RowsModel({tr("Time"), tr("Event")}, this);
  event_table_ = makeTable(events_, tr("Events"), tr("Events of the loop appear here."));
  stretchColumn(event_table_, 1);
  right->body()->addWidget(event_table_, 1);
  happened_ = right;
  auto* side = new QWidget;
  auto* side_column = new QVBoxLayout(side);
  side_column->setContentsMargins(0, 0, 0, 0);
  side_column->setSpacing(12);
  side_column->addWidget(decision_);
  side_column->addWidget(right, 1);
  outer->addWidget(makeSplitter(this, left, side, 6, 5), 1);

  connect(back, &QPushButton::clicked, this, &ClosedLoopPage::closed);
  connect(open_, &QPushButton::clicked, this, [this] {
    const QString file = QFileDialog::getOpenFileName(this, tr("Open a plan of a loop"), {}, tr("Plan (*.json)"));
    if (!file.isEmpty()) openPlan(file);
  });
  connect(folder_, &QPushButton::clicked, this, [this] {
    service_.setFolder(QFileDialog::getExistingDirectory(this, tr("Folder for the campaign of the loop")));
  });
  connect(start_, &QPushButton::clicked, this, [this] {
    notice_.clear();
    asked_ = true;
    refresh();
    confirm_->setFocus();
  });
  connect(not_now, &QPushButton::clicked, this, [this] {
    asked_ = false;
    refresh();
  });
  connect(confirm_, &QPushButton::clicked, this, [this] {
    asked_ = false;
    notice_ = service_.start();
    refresh();
  });
  connect(stop_, &QPushButton::clicked, this, [this] {
    service_.stop();
    refresh();
  });
  connect(silence_, &Segments::chosen, this, [this](int index) { service_.setHold(index == 1); });
  connect(component_, &Segments::chosen, this, [this](int) {
    shown_cycles_ = static_cast<std::size_t>(-1);
    showCycles();
  });
  connect(choice_, &RowsModel::checkedChanged, this, [this](const QString&, int, bool) {
    bool any = false;
    for (const Row& row : choice_->rows()) any = any || row.cells[0].checked.value_or(false);
    accept_->setText(any ? tr("Add the selected effects") : tr("Add nothing"));
  });
  connect(accept_, &QPushButton::clicked, this, [this] {
    std::vector<std::string> ids;
    for (const Row& row : choice_->rows()) {
      if (row.cells[0].checked.value_or(false)) ids.push_back(row.id.toStdString());
    }
    service_.accept(ids);
  });
  connect(&service_, &ClosedLoopService::changed, this, [this] {
    if (isVisible()) refresh();
  });
  refresh();
}

QString ClosedLoopPage::dryRunText() const {
  return dry_run_->text();
}

void ClosedLoopPage::openPlan(const QString& file) {
  asked_ = false;
  notice_ = service_.load(file);
  refresh();
}

void ClosedLoopPage::refresh() {
  const LoopPlan* plan = service_.plan();
  const bool running = service_.running();
  if (plan == nullptr) {
    plan_->setText(
        tr("A plan (JSON, spindrift-loop-plan) says which control, what is touched, which program runs and when."));
  } else {
    plan_->setText(tr("%1 at %2:%3 · plan %4 · campaign in %5")
                       .arg(shownName(plan->machine.name), fromCore(plan->control.shell.peer.host))
                       .arg(plan->control.shell.peer.port)
                       .arg(service_.planFile(), service_.folder()));
  }
  const DryRun run = plan != nullptr ? service_.dryRun() : DryRun();
  start_->setText(service_.resumable() && !running ? tr("Go on …") : tr("Start …"));
  start_->setEnabled(plan != nullptr && !running && !asked_ && run.good());
  stop_->setEnabled(running && !service_.snapshot().status.stopping);
  open_->setEnabled(!running);
  folder_->setEnabled(plan != nullptr && !running);
  confirmation_->setVisible(asked_ && plan != nullptr);
  if (asked_ && plan != nullptr)
    dry_run_->setText(
        onScreen(tr("The machine will be switched on and homed. A measuring cycle moves: %1. Between cycles the "
                    "spindle turns by the program, %2 h in all. The compensation stays within ±%3 µm and changes "
                    "by at most %4 µm/s. Keep clear of the machine.")
                     .arg(coreSentence(run.summary()))
                     .arg(decimalText(plan->duration_s / 3600.0, 'g', 3))
                     .arg(plan->limits.limit_um)
                     .arg(plan->limits.rate_um_s)));
  if (plan != nullptr && !run.good() && notice_.isEmpty())
    notice_ = tr("The measuring cycle may not run: line %1: %2.")
                  .arg(run.issues.front().line)
                  .arg(coreSentence(run.issues.front().what));
  silence_->setCurrent(service_.hold() ? 1 : 0);
  silence_->setEnabled(plan != nullptr);
  silence_note_->setText(service_.hold()
                             ? tr("The last compensation value is held, whatever the machine does afterwards.")
                             : tr("No compensation is applied without supervision."));
  showState();
  showNumbers();
  showChoice();
  showCycles();
}

void ClosedLoopPage::showState() {
  const ClosedLoopService::Snapshot& now = service_.snapshot();
  const LoopStatus& status = now.status;
  if (!notice_.isEmpty()) {
    callout_->show(Tone::Bad, notice_);
  } else if (!now.failure.isEmpty()) {
    callout_->show(Tone::Bad, tr("The loop has ended: %1").arg(now.failure));
  } else if (service_.running() && !now.any) {
    callout_->show(Tone::Accent, tr("Connecting with the control, looking at its limits and its watchdog …"));
  } else if (service_.running() && status.stopping) {
    callout_->show(Tone::Attention,
                   tr("Stopping: the compensation fades to zero. %1").arg(coreSentence(status.control.sentence)));
  } else if (service_.running()) {
    const QString measuring = status.measuring ? tr(" A measuring cycle is running.") : QString();
    const QString control = coreSentence(status.control.sentence) + measuring;
    if (status.active) {
      callout_->show(Tone::Good,
                     tr("Active, by the %1. Control: %2").arg(coreSentence(toString(status.stage)), control));
    } else {
      callout_->show(Tone::Attention,
                     status.reason == status.control.sentence
                         ? tr("Not active. %1").arg(control)
                         : tr("Not active: %1. Control: %2").arg(coreSentence(status.reason), control));
    }
  } else if (now.any) {
    callout_->show(Tone::Neutral,
                   now.result.completed
                       ? tr("The plan has come to its end; the compensation is at zero. The report lies in "
                            "the folder of the campaign.")
                       : tr("Stopped; the compensation is at zero. The loop can go on from its folder."));
  } else if (service_.plan() == nullptr) {
    callout_->show(Tone::Accent, tr("Open the plan of a loop to begin."));
  } else if (service_.resumable()) {
    callout_->show(Tone::Accent,
                   tr("A loop of this plan was ended before its time: Go on takes it up where it stood."));
  } else {
    callout_->show(Tone::Accent, tr("Press Start to see what will move; nothing moves before you have confirmed it."));
  }
}

void ClosedLoopPage::showNumbers() {
  const ClosedLoopService::Snapshot& now = service_.snapshot();
  const LoopStatus& status = now.status;
  const bool known = now.any && service_.running();
  for (int axis = 0; axis < 3; ++axis) {
    const double sigma = status.sigma_um[axis];
    if (!known) {
      axisTile(axis)->set(QStringLiteral("–"));
    } else {
      // What fades has no uncertainty of a model.
      axisTile(axis)->set(sureNumber(status.applied_um[axis], status.active ? sigma : std::nan("")),
                          !status.active         ? tr("not active")
                          : std::isfinite(sigma) ? tr("± standard uncertainty")
                                                 : tr("uncertainty not yet known"));
    }
  }
  if (known) {
    age_->set(tr("%1 s").arg(decimalText(status.age_s, 'f', 0)),
              tr("machine time %1 h").arg(decimalText(status.time_s / 3600.0, 'f', 2)));
  } else {
    age_->set(QStringLiteral("–"));
  }
  if (now.any) {
    const double left_s = std::max(0.0, status.next_cycle_s - status.time_s);
    spent_->set(tr("%n cycles", nullptr, static_cast<int>(now.result.cycles.size())),
                service_.running() && !status.stopping
                    ? tr("the next in %1 min").arg(decimalText(left_s / 60.0, 'f', 0))
                    : QString());
  } else {
    spent_->set(QStringLiteral("–"));
  }
}

void ClosedLoopPage::showChoice() {
  const std::optional<DiscrepancyResult>& choice = service_.snapshot().choice;
  // In place of what happened: the plot keeps its room.
  const bool asking = choice.has_value() && service_.running();
  decision_->setVisible(asking);
  happened_->setVisible(!asking);
  std::vector<std::string> offered;
  if (choice) {
    for (const FoundEffect& effect : choice->effects) offered.push_back(effect.id);
  }
  if (offered == offered_) return;
  offered_ = offered;
  std::vector<Row> rows;
  if (choice) {
    for (const FoundEffect& effect : choice->effects) {
      Cell name{sentenceStart(effectTitle(effect.id))};
      name.checked = effect.rivals.empty();
      rows.push_back({fromCore(effect.id),
                      {name, Cell{percentOf(effect.confidence)},
                       Cell{effect.rivals.empty() ? QStringLiteral("–") : effectTitles(effect.rivals, tr("or"))}}});
    }
  }
  choice_->setRows(std::move(rows));
  accept_->setText(tr("Add the selected effects"));
}

void ClosedLoopPage::showCycles() {
  const LoopResult& result = service_.snapshot().result;
  if (result.events.size() != shown_events_) {
    shown_events_ = result.events.size();
    std::vector<Row> rows;
    for (std::size_t i = result.events.size(); i-- > 0;) {
      const LoopEvent& event = result.events[i];
      rows.push_back({QString::number(i),
                      {Cell{tr("%1 h").arg(decimalText(event.time_s / 3600.0, 'f', 2))},
                       Cell{sentenceStart(titledSentence(event.text))}}});
    }
    events_->setRows(std::move(rows));
    event_table_->resizeRowsToContents();
  }
  if (result.cycles.size() == shown_cycles_) return;
  shown_cycles_ = result.cycles.size();
  const int axis = component_->current();
  Series without{tr("without"), {}, {}, {}, SeriesStyle::LinePoints, 1};
  Series with{tr("with compensation"), {}, {}, {}, SeriesStyle::LinePoints, 0};
  for (const LoopCycle& cycle : result.cycles) {
    if (!std::isfinite(cycle.with_um[axis])) continue;
    for (Series* series : {&without, &with}) series->x.push_back(cycle.time_s / 3600.0);
    without.y.push_back(cycle.without_um[axis]);
    with.y.push_back(cycle.with_um[axis]);
  }
  plot_->setAxes(tr("Machine time / h"),
                 QStringLiteral("%1 / µm").arg(fromCore(std::string(toString(static_cast<Component>(axis))))));
  if (with.x.empty()) {
    plot_->setContent({});
  } else {
    plot_->setContent({without, with});
  }
  const auto count = std::count_if(result.cycles.begin(), result.cycles.end(), [axis](const LoopCycle& cycle) {
    return cycle.stage != LoopStage::None && std::isfinite(cycle.with_um[axis]);
  });
  errors_->setText(count == 0
                       ? tr("Error without and with: no cycle has been compensated yet.")
                       : onScreen(tr("%1: %2 µm rms without, %3 µm rms with, over %4 since the compensation began.")
                                      .arg(fromCore(std::string(toString(static_cast<Component>(axis)))))
                                      .arg(decimalText(result.rmsWithout(LoopStage::None)[axis], 'f', 1))
                                      .arg(decimalText(result.rmsWith(LoopStage::None)[axis], 'f', 1))
                                      .arg(tr("%n cycles", nullptr, static_cast<int>(count)))));
}

void ClosedLoopPage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refresh();
}

}  // namespace spindrift::gui
