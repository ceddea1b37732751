// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/capture/plan_panel.h"

#include <QDoubleSpinBox>
#include <QHeaderView>
#include <QLabel>
#include <QSpinBox>
#include <QTableView>
#include <QVBoxLayout>

#include "core/base/error.h"
#include "widgets/commands/commands.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/services/incoming_service.h"

namespace spindrift::gui {
namespace {

/// The name of an image says fiducial, role and number; what is to be done is where to move.
Cell todoCell(const PlannedItem& item) {
  const QString whole = coreSentence(item.instruction());
  const qsizetype colon = item.kind == PlannedKind::Image ? whole.indexOf(QLatin1String(": ")) : -1;
  Cell cell{colon < 0 ? whole : whole.mid(colon + 2)};
  cell.tip = whole;
  return cell;
}

}  // namespace

PlanPanel::PlanPanel(PageContext page_context, Instrument instrument, QWidget* parent)
    : QWidget(parent),
      context_(std::move(page_context)),
      service_(IncomingService::of(context_.session)),
      instrument_(instrument) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  next_ = new Callout;
  column->addWidget(next_);
  rows_ = new RowsModel({tr("Capture"), tr("Due / min"), tr("State"), tr("What to do")}, this);
  table_ = makeTable(rows_, tr("Measurement plan"), tr("Make a plan: it says what to measure next and when."));
  stretchColumn(table_, 3);
  column->addWidget(table_, 1);
  auto* line = new WrapLayout;
  states_ = new QSpinBox;
  states_->setRange(1, 200);
  states_->setValue(5);
  states_->setSuffix(tr(" states"));
  states_->setAccessibleName(tr("Number of thermal states"));
  interval_ = new QDoubleSpinBox;
  interval_->setRange(1, 1000);
  interval_->setDecimals(0);
  interval_->setValue(30);
  interval_->setPrefix(tr("every "));
  interval_->setSuffix(tr(" min"));
  interval_->setAccessibleName(tr("Time between thermal states"));
  make_ = makeButton(tr("New plan"), "clock");
  make_->setToolTip(tr("All points or artefacts of the machine in every thermal state; what is captured stays"));
  count_ = makeLabel({}, "secondaryText");
  for (QWidget* w : {static_cast<QWidget*>(states_), static_cast<QWidget*>(interval_)}) {
    w->setMinimumHeight(sizes::control_height);
    line->addWidget(w);
  }
  line->addWidget(make_);
  line->addWidget(count_);
  column->addLayout(line);
  second_.setInterval(1000);
  connect(&second_, &QTimer::timeout, this, &PlanPanel::showCountdown);
  connect(make_, &QPushButton::clicked, this, &PlanPanel::makePlan);
  connect(&service_, &IncomingService::planProgressed, this, &PlanPanel::refresh);
}

void PlanPanel::setInstrument(Instrument instrument) {
  instrument_ = instrument;
}

QString PlanPanel::sentence() const {
  return next_->sentence();
}

void PlanPanel::makePlan() {
  const auto campaign = context_.session.campaign();
  if (campaign == nullptr) return;
  PlanOptions options;
  options.kind = instrument_ == Instrument::Microscope   ? PlannedKind::Image
                 : instrument_ == Instrument::TouchProbe ? PlannedKind::Cycle
                                                         : PlannedKind::Scan;
  options.states = states_->value();
  options.interval_s = 60.0 * interval_->value();
  try {
    const MeasurementPlan plan = spindrift::makePlan(campaign->machine, options);
    context_.undo.push(new OptionsCommand(context_.session, tr("new measurement plan"),
                                          "plan/" + std::to_string(context_.session.campaignId()), plan.json(),
                                          [this] { service_.planChanged(); }));
  } catch (const InputError& e) {
    next_->show(Tone::Bad, coreSentence(e.what()));
  }
}

void PlanPanel::showCountdown() {
  if (service_.plan().empty()) {
    count_->clear();
    return next_->show(Tone::Neutral,
                       tr("There is no plan yet. It says what to measure when, and tells which capture a "
                          "file is that arrives."));
  }
  const PlanProgress progress = service_.progress();
  const Tone tone = !progress.next ? Tone::Good : progress.countdown_s > 0 ? Tone::Neutral : Tone::Accent;
  if (next_->sentence() != coreSentence(progress.sentence)) next_->show(tone, coreSentence(progress.sentence));
  count_->setText(tr("%1 of %2 captured").arg(progress.done).arg(service_.plan().items.size()));
}

void PlanPanel::refresh() {
  const MeasurementPlan& plan = service_.plan();
  const std::set<std::string>& done = service_.done();
  const PlanProgress progress = service_.progress();
  std::vector<Row> rows;
  for (std::size_t i = 0; i < plan.items.size(); ++i) {
    const PlannedItem& item = plan.items[i];
    Row row;
    row.id = fromCore(item.id);
    const bool there = done.contains(item.id);
    row.cells = {nameCell(row.id), numberCell(item.due_s / 60.0, 0),
                 there                                  ? toneCell(tr("captured"), Tone::Good)
                 : progress.next && *progress.next == i ? toneCell(tr("next"), Tone::Accent)
                                                        : Cell{tr("open")},
                 todoCell(item)};
    rows.push_back(std::move(row));
  }
  rows_->setRows(std::move(rows));
  if (progress.next) table_->scrollTo(rows_->index(static_cast<int>(*progress.next), 0));
  showCountdown();
}

void PlanPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refresh();
  second_.start();
}

void PlanPanel::hideEvent(QHideEvent* event) {
  second_.stop();
  QWidget::hideEvent(event);
}

}  // namespace spindrift::gui
