// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/probing/touch_capture_page.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QSplitter>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <map>

#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/preferences.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/capture/capture_tabs.h"
#include "widgets/panels/common/exclude_items.h"
#include "widgets/panels/common/probing_scene.h"
#include "widgets/services/touch_results.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

QString stateName(TouchState state) {
  switch (state) {
    case TouchState::Used:
      return TouchCapturePage::tr("plausible");
    case TouchState::LeftOut:
      return TouchCapturePage::tr("rejected");
    case TouchState::Missing:
      return TouchCapturePage::tr("missing");
    case TouchState::Excluded:
      return TouchCapturePage::tr("excluded");
  }
  return {};
}

QString direction(const Eigen::Vector3d& n) {
  int axis = 0;
  n.cwiseAbs().maxCoeff(&axis);
  if (std::abs(n(axis)) < 0.95) return TouchCapturePage::tr("slanted");
  return (n(axis) > 0 ? QStringLiteral("+") : QString(QChar(0x2212))) + QLatin1Char("XYZ"[axis]);
}

/// Of all artefacts of the campaign.
}  // namespace

TouchCapturePage::TouchCapturePage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Capture, parent), results_(TouchResults::of(session(), context().jobs)) {
  setInstruction(tr("Run the measuring cycle on the machine, check every touch, and take missing ones again."));
  check_ = makeButton(tr("Check the touches"), nullptr, "primary");
  addAction(check_);

  auto* list = new Card(tr("Cycles"));
  cycles_ = new RowsModel({tr("Cycle"), tr("Time / min"), tr("Good"), tr("Rejected"), tr("Missing")}, this);
  cycle_table_ = makeTable(cycles_, tr("Cycles"), tr("Cycles appear with the first touch."));
  list->body()->addWidget(cycle_table_, 2);
  auto* filters = new QHBoxLayout;
  filters->addWidget(makeLabel(tr("Touches of the cycle"), "sectionTitle"), 1);
  state_filter_ = new QComboBox;
  state_filter_->setAccessibleName(tr("Verdict on the touches"));
  state_filter_->addItems({tr("All verdicts"), tr("Plausible"), tr("Rejected"), tr("Excluded"), tr("Missing")});
  filters->addWidget(state_filter_);
  list->body()->addLayout(filters);
  touches_ = new RowsModel({tr("Touch"), tr("Verdict"), tr("Residual / µm"), tr("Station"), tr("Towards")}, this);
  touch_table_ = makeTable(touches_, tr("Touches"), tr("No touch of this cycle has this verdict."));
  touch_table_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  list->body()->addWidget(touch_table_, 4);
  reason_ = new Callout;
  list->body()->addWidget(reason_);
  auto* buttons = new QHBoxLayout;
  exclude_ = makeButton(tr("Exclude …"), "exclude");
  exclude_->setToolTip(tr("Leave the chosen touches out; they stay on the disk and can be brought back"));
  buttons->addWidget(exclude_);
  buttons->addStretch();
  list->body()->addLayout(buttons);

  auto* right = new Card(tr("Measuring cycle"));
  control_ = new QComboBox;
  control_->setAccessibleName(tr("Dialect of the control"));
  control_->addItem(tr("Fanuc"), QStringLiteral("fanuc"));
  control_->addItem(tr("Siemens"), QStringLiteral("siemens"));
  control_->addItem(tr("Heidenhain"), QStringLiteral("heidenhain"));
  control_->addItem(tr("Generic"), QStringLiteral("generic"));
  make_program_ = makeButton(tr("Program"), "check");
  make_program_->setToolTip(tr("Write the measuring program for this control, read it back and check it"));
  view_ = new View3D;
  view_->setEmptyText(tr("The measuring cycle will appear here"),
                      tr("It needs an artefact and a stylus in the machine description (step Machine)."));
  right->body()->addWidget(view_, 1);
  auto* shown = new WrapLayout;
  path_ = new QCheckBox(tr("Path"));
  path_->setChecked(true);
  machine_ = new QCheckBox(tr("Machine and travel"));
  for (QCheckBox* box : {path_, machine_}) shown->addWidget(box);
  shown->addWidget(control_);
  shown->addWidget(make_program_);
  right->body()->addLayout(shown);
  program_verdict_ = new Callout;
  right->body()->addWidget(program_verdict_);
  content()->addWidget(captureTabs(this, makeSplitter(nullptr, list, right, 6, 6), context(), Instrument::TouchProbe),
                       1);
  showHints(view_);
  view_->setMachineVisible(false);

  connect(&results_, &TouchResults::read, this, [this] {
    if (isVisible()) refresh();
  });
  connect(check_, &QPushButton::clicked, this, [this] { runTask("check"); });
  connect(make_program_, &QPushButton::clicked, this, &TouchCapturePage::makeProgram);
  connect(control_, &QComboBox::activated, this, &TouchCapturePage::makeProgram);
  connect(state_filter_, &QComboBox::activated, this, &TouchCapturePage::fillTouches);
  connect(exclude_, &QPushButton::clicked, this, &TouchCapturePage::toggleExcluded);
  for (QCheckBox* box : {path_, machine_}) connect(box, &QCheckBox::toggled, this, &TouchCapturePage::showScene);
  connect(machine_, &QCheckBox::toggled, view_, &View3D::setMachineVisible);
  connect(cycle_table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this](const QModelIndex& now) {
            if (filling_ || !now.isValid()) return;
            cycle_ = cycles_->idAt(now.row());
            fillTouches();
            showScene();
          });
  connect(touch_table_->selectionModel(), &QItemSelectionModel::selectionChanged, this, [this] {
    if (filling_) return;
    showVerdict();
    showScene();
  });
}

const Artefact* TouchCapturePage::artefact() const {
  return artefactOf(*session().campaign(), results_.touches().get());
}

void TouchCapturePage::runAll() {
  runTask("check");
  makeProgram();
}

TaskInputs TouchCapturePage::taskInputs() {
  TaskInputs inputs = session().taskInputs();
  inputs.touches = results_.asListed();
  return inputs;
}

void TouchCapturePage::refresh() {
  const auto campaign = session().campaign();
  if (campaign == nullptr) return;
  const bool other = noticeCampaign();
  if (other) {
    chooseCaptureTab(*this, session());
    program_.reset();
    program_verdict_->set(Tone::Neutral, {});
    cycle_.clear();
    view_->clear();
    view_->setMachine(campaign->machine);
    view_->setMachineVisible(machine_->isChecked());
  }
  const auto list = results_.touches();
  const ShownTask check = shown("check", tr("Reading the touches"));
  if (list == nullptr) {
    verdicts_.clear();
    fillCycles();
    callout()->show(results_.reading() ? Tone::Neutral : Tone::Bad, results_.whyNone());
    return;
  }
  forgetOldProgram();
  const ResultState& state = check.state;
  evaluation_ = check.as<TouchEvaluation>();
  judged_ = evaluation_ != nullptr;
  verdicts_.clear();
  if (judged_) {
    verdicts_ = allVerdicts(*evaluation_);
  } else {
    for (const Touch& t : list->touches) {
      TouchVerdict v;
      v.touch = t;
      verdicts_.push_back(std::move(v));
    }
  }
  fillCycles();
  const auto count = [&](TouchState s) {
    return std::count_if(verdicts_.begin(), verdicts_.end(), [s](const TouchVerdict& v) { return v.state == s; });
  };
  QStringList bad;
  const TouchVerdict* first_bad = nullptr;
  for (const TouchVerdict& v : verdicts_) {
    if (v.state != TouchState::LeftOut && v.state != TouchState::Missing) continue;
    if (first_bad == nullptr) first_bad = &v;
    bad << fromCore(v.touch.cycle + " " + v.touch.feature + " · " + std::to_string(v.touch.touch));
  }
  callout()->setAction({}, {});
  if (state.there && !state.current) {
    callout()->show(Tone::Outdated, tr("Changed since: %1. Check the touches again.").arg(state.changed));
  } else if (!judged_) {
    callout()->show(Tone::Accent, tr("%n touches are there and none is checked yet. Checking compares every touch "
                                     "with all others and says which to take again.",
                                     nullptr, static_cast<int>(verdicts_.size())));
  } else if (first_bad != nullptr) {
    callout()->setAction(tr("Show it"),
                         [this, cycle = fromCore(first_bad->touch.cycle), id = fromCore(first_bad->touch.id())] {
                           state_filter_->setCurrentIndex(0);
                           selectCycle(cycle);
                           fillTouches();
                           if (const int row = touches_->rowOf(id); row >= 0) touch_table_->selectRow(row);
                         });
    callout()->show(Tone::Attention,
                    tr("Rejected touches: %1, missing: %2 (%3). Take them again while the machine is in "
                       "this state; the others are evaluated without them.")
                        .arg(count(TouchState::LeftOut))
                        .arg(count(TouchState::Missing))
                        .arg(firstOf(bad)));
  } else {
    callout()->show(Tone::Good, cycles_->rowCount() > 1
                                    ? tr("All %n touches are plausible and none is missing.", nullptr,
                                         static_cast<int>(verdicts_.size()))
                                    : tr("All %n touches are plausible. Whether one is missing shows when a second "
                                         "cycle is there to compare with.",
                                         nullptr, static_cast<int>(verdicts_.size())));
  }
  showScene();
}

void TouchCapturePage::fillCycles() {
  struct Count {
    double time = 0;
    int all = 0;
    std::map<TouchState, int> of;
  };
  std::vector<std::string> order;
  std::map<std::string, Count> counts;
  for (const TouchVerdict& v : verdicts_) {
    if (!counts.contains(v.touch.cycle)) order.push_back(v.touch.cycle);
    Count& c = counts[v.touch.cycle];
    if (v.state != TouchState::Missing) {
      c.time += v.touch.time_s;
      ++c.all;
    }
    ++c.of[v.state];
  }
  std::vector<Row> rows;
  for (const std::string& name : order) {
    const Count& c = counts[name];
    Row row;
    row.id = fromCore(name);
    row.cells = {nameCell(row.id), numberCell(c.all > 0 ? c.time / c.all / 60.0 : std::nan(""), 1)};
    if (!judged_) {
      row.cells.push_back(toneCell(tr("not checked"), Tone::Neutral));
      row.cells.push_back(dashCell());
      row.cells.push_back(dashCell());
    } else {
      const auto of = [&](TouchState s) { return c.of.contains(s) ? c.of.at(s) : 0; };
      row.cells.push_back(toneCell(QString::number(of(TouchState::Used)), Tone::Good));
      for (const TouchState s : {TouchState::LeftOut, TouchState::Missing}) {
        row.cells.push_back(of(s) > 0 ? toneCell(QString::number(of(s)), toneOf(s)) : Cell{QStringLiteral("0")});
      }
    }
    rows.push_back(std::move(row));
  }
  filling_ = true;
  cycles_->setRows(std::move(rows));
  int at = cycles_->rowOf(cycle_);
  if (at < 0 && cycles_->rowCount() > 0) at = 0;
  if (at >= 0) {
    cycle_ = cycles_->idAt(at);
    cycle_table_->selectRow(at);
  }
  filling_ = false;
  fillTouches();
}

void TouchCapturePage::selectCycle(const QString& cycle) {
  const int row = cycles_->rowOf(cycle);
  if (row >= 0) cycle_table_->selectRow(row);
}

std::vector<TouchVerdict> TouchCapturePage::verdictsOf(const QString& cycle) const {
  std::vector<TouchVerdict> some;
  for (const TouchVerdict& v : verdicts_) {
    if (fromCore(v.touch.cycle) == cycle) some.push_back(v);
  }
  return some;
}

void TouchCapturePage::fillTouches() {
  const QStringList chosen = selectedTouches();
  const Artefact* a = session().campaign() == nullptr ? nullptr : artefact();
  std::vector<Row> rows;
  for (const TouchVerdict& v : verdictsOf(cycle_)) {
    const QString id = fromCore(v.touch.id());
    const bool taken_out = session().excluded().contains(id);
    const TouchState state = taken_out ? TouchState::Excluded : v.state;
    const int filter = state_filter_->currentIndex();
    if (filter == 1 && state != TouchState::Used) continue;
    if (filter == 2 && state != TouchState::LeftOut) continue;
    if (filter == 3 && state != TouchState::Excluded) continue;
    if (filter == 4 && state != TouchState::Missing) continue;
    Row row;
    row.id = id;
    row.faded = state == TouchState::Excluded;
    row.cells = {
        nameCell(QStringLiteral("%1 · %2").arg(fromCore(v.touch.feature)).arg(v.touch.touch)),
        !judged_ && !taken_out ? toneCell(tr("not checked"), Tone::Neutral) : toneCell(stateName(state), toneOf(state)),
        numberCell(v.residual_um, 2),
        Cell{a != nullptr && a->kind == "hole_bar" ? QStringLiteral("%1°").arg(v.touch.c_deg)
                                                   : fromCore(v.touch.stylus)},
        Cell{direction(v.touch.approach)}};
    row.cells[1].tip = coreSentence(v.reason);
    rows.push_back(std::move(row));
  }
  filling_ = true;
  touches_->setRows(std::move(rows));
  for (const QString& id : chosen) {
    const int row = touches_->rowOf(id);
    if (row >= 0) {
      touch_table_->selectionModel()->select(touches_->index(row, 0),
                                             QItemSelectionModel::Select | QItemSelectionModel::Rows);
    }
  }
  filling_ = false;
  showVerdict();
}

QStringList TouchCapturePage::selectedTouches() const {
  return selectedIds(*touch_table_, *touches_);
}

void TouchCapturePage::showVerdict() {
  const QStringList chosen = selectedTouches();
  bool any = false;
  QString sentence;
  Tone tone = Tone::Neutral;
  for (const TouchVerdict& v : verdicts_) {
    const QString id = fromCore(v.touch.id());
    if (!chosen.contains(id)) continue;
    if (v.state != TouchState::Missing) any = true;
    if (chosen.size() == 1) {
      const Eigen::Vector3d& p = v.touch.position_mm;
      sentence = tr("%1 · %2 at x %3, y %4, z %5 mm")
                     .arg(fromCore(v.touch.feature))
                     .arg(v.touch.touch)
                     .arg(decimalText(p.x(), 'f', lengthDecimals(4)))
                     .arg(decimalText(p.y(), 'f', lengthDecimals(4)))
                     .arg(decimalText(p.z(), 'f', lengthDecimals(4)));
      if (v.state == TouchState::Missing) sentence = tr("%1 · %2").arg(fromCore(v.touch.feature)).arg(v.touch.touch);
      if (!v.reason.empty()) sentence += QStringLiteral(": ") + coreSentence(v.reason);
      sentence += QLatin1Char('.');
      tone = judged_ ? toneOf(v.state) : Tone::Neutral;
    }
    if (chosen.size() == 1 && session().excluded().contains(id)) {
      sentence = tr("Excluded: %1.").arg(session().excluded().at(id));
      tone = Tone::Neutral;
    }
  }
  reason_->set(tone, sentence);
  exclude_->setEnabled(any);
  exclude_->setText(QChar(0x2009) + excludeText(session(), any ? chosen : QStringList()));
}

void TouchCapturePage::toggleExcluded() {
  excludeOrBringBack(context(), this, selectedTouches(), tr("bad touch"));
}

}  // namespace spindrift::gui
