// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/probing/cycle_model_page.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSplitter>
#include <QStackedWidget>
#include <QTabWidget>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/machine/parameter_meanings.h"
#include "core/tasks/task_options.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/common/callout_note.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/plots/plot.h"
#include "widgets/services/touch_results.h"
#include "widgets/theme/numbers.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

const std::array<const char*, 3> group_units{"µm", "µrad", "µm/m"};

/// "gZ +0.64, aX −0.62": the names without their units.
QString weakText(const Eigen::VectorXd& combination, const std::vector<std::string>& names) {
  std::vector<std::string> titles;
  for (const std::string& name : names) titles.push_back(parameterTitle(name).toStdString());
  return shownNumbers(QString::fromStdString(combinationText(combination, titles)));
}

}  // namespace

CycleModelPage::CycleModelPage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Model, parent),
      results_(TouchResults::of(session(), context().jobs)),
      options_(session(), context().undo, [this] {
        refresh();
        if (session().state("fit").there) runAlone("fit");
      }) {
  setInstruction(tr("Separate the errors of axes, table and artefact in every cycle, and see how well each is known."));
  fit_ = makeButton(tr("Fit all cycles"), nullptr, "primary");
  addModelSwitch(true);
  addAction(fit_);

  auto* left = new Card(tr("Errors over time"));
  group_ = new Segments({tr("Displacements"), tr("Rotations"), tr("Expansion")}, tr("Group of parameters"));
  left->addToTitle(group_);
  trends_ = new Plot;
  trends_->setAxes(tr("Time / h"), tr("Displacement / µm"));
  trends_->setEmptyText(tr("Trends will appear here"),
                        tr("Fit all cycles: every error parameter is drawn over time with its uncertainty."));
  left->body()->addWidget(trends_, 5);
  auto* choice = new QHBoxLayout;
  choice->addWidget(makeLabel(tr("Cycle"), "sectionTitle"));
  cycle_ = new QComboBox;
  cycle_->setAccessibleName(tr("Cycle shown in detail"));
  cycle_->setMinimumWidth(110);
  choice->addWidget(cycle_);
  condition_ = makeLabel({}, "secondaryText");
  condition_->setWordWrap(true);
  choice->addWidget(condition_, 1);
  left->body()->addLayout(choice);
  auto* tabs = makeTabs(left);
  parameters_ = new RowsModel({tr("Parameter"), tr("Value"), tr("Value / u"), tr("Meaning")}, this);
  tabs->addTab(makeSentenceTable(parameters_, tr("Parameters of the cycle"),
                                 tr("Every parameter with its uncertainty appears after the fit.")),
               tr("Parameters"));
  combinations_ =
      new RowsModel({tr("Cycle"), tr("Condition number"), tr("Least determined"), tr("Not determined")}, this);
  auto* combinations = makeTable(combinations_, tr("Weak combinations"),
                                 tr("Most strongly correlated parameters are listed after the fit."));
  stretchColumn(combinations, 2);
  tabs->addTab(combinations, tr("Weak combinations"));
  left->body()->addWidget(tabs, 5);

  right_ = new QStackedWidget;
  right_->addWidget(makeVolumePart());
  right_->addWidget(makeBarPart());
  content()->addWidget(makeSplitter(this, left, right_, 6, 6), 1);
  showHints(trends_);
  showHints(view_);
  showHints(line_);
  connect(&results_, &TouchResults::read, this, [this] {
    if (isVisible()) refresh();
  });
  connect(fit_, &QPushButton::clicked, this, [this] { runTask("fit"); });
  connect(group_, &Segments::chosen, this, &CycleModelPage::showTrends);
  connect(cycle_, &QComboBox::activated, this, [this](int) {
    showTrends();
    showCycle();
  });
}

TaskInputs CycleModelPage::taskInputs() {
  TaskInputs inputs = session().taskInputs();
  inputs.touches = results_.asListed();
  return inputs;
}

void CycleModelPage::clear() {
  evaluation_.reset();
  field_.reset();
  for (RowsModel* rows : {parameters_, combinations_, bias_}) rows->setRows({});
  trends_->setContent({});
  line_->setContent({});
  cycle_->clear();
  view_->clear();
  condition_->clear();
}

void CycleModelPage::refresh() {
  const auto campaign = session().campaign();
  if (campaign == nullptr) return;
  const auto list = results_.touches();
  if (noticeCampaign()) {
    clear();
  }
  const Artefact* artefact = artefactOf(*campaign, list.get());
  const bool holes = artefact != nullptr && artefact->kind == "hole_bar";
  right_->setCurrentIndex(holes ? 1 : 0);
  options_.fill([this] {
    const CycleChoice now = options_.now();
    second_axis_->setChecked(now.second_axis);
    growth_->setValue(now.growth_um_per_m);
    trust_->setValue(now.trust_um_per_m);
    growth_->setEnabled(second_axis_->isChecked());
    trust_->setEnabled(second_axis_->isChecked());
  });
  const ShownTask stored = shown("fit", tr("Reading the cycles"));
  if (list == nullptr) {
    callout()->show(results_.reading() ? Tone::Neutral : Tone::Bad, results_.whyNone());
    return;
  }
  const bool evaluated = session().state("evaluate").there;
  fit_->setEnabled(evaluated && canRun("fit"));
  if (!evaluated) {
    callout()->show(Tone::Attention, tr("The touches are not evaluated yet."));
    callout()->setAction(tr("Go to Calibrate"), [this] { context().workflow.goTo(StepId::Calibrate); });
    return;
  }
  callout()->setAction({}, {});
  if (stored.reading) return;
  evaluation_ = stored.as<TouchEvaluation>();
  const ResultState& state = stored.state;
  const CycleEvaluation* cycles = cyclesOf(evaluation_.get());
  if (cycles == nullptr) {
    clear();
    if (state.there) {
      callout()->show(Tone::Outdated, tr("Changed since: %1. Fit all cycles again.").arg(state.changed));
    } else {
      callout()->show(Tone::Accent, tr("Press Fit all cycles. One least squares over all touches separates the errors; "
                                       "everything is relative to the first cycle."));
    }
    return;
  }
  if (!state.current) {
    callout()->show(Tone::Outdated, tr("Changed since: %1. Fit all cycles again.").arg(state.changed));
  } else if (cycles->status == FitStatus::Converged && cycles->warnings.empty()) {
    callout()->show(Tone::Good, tr("%1 parameters are determined in each of %n cycles.", nullptr,
                                   static_cast<int>(cycles->cycles.size()))
                                    .arg(cycles->names.size()));
  } else {
    QStringList sentences;
    for (const std::string& w : cycles->warnings) sentences << coreSentence(w);
    if (sentences.isEmpty()) sentences << coreSentence(cycles->message);
    callout()->show(Tone::Attention, sentences.mid(0, 2).join(QLatin1Char(' ')));
  }
  const QString chosen = cycle_->currentText();
  cycle_->clear();
  for (const std::string& name : cycles->cycles) cycle_->addItem(fromCore(name));
  const int at = cycle_->findText(chosen);
  cycle_->setCurrentIndex(at >= 0 ? at : cycle_->count() - 1);
  if (evaluation_->hole_cycles.size() + evaluation_->ball_cycles.size() > 1) {
    addNote(*callout(), tr("This page shows %1. The other artefacts are evaluated too: their deviations stand in the "
                           "observations and in the report.")
                            .arg(fromCore(cycles->artefact)));
  }
  showTrends();
  showCycle();
  showBar();
}

void CycleModelPage::showTrends() {
  const CycleEvaluation* cycles = cyclesOf(evaluation_.get());
  if (cycles == nullptr || cycles->cycles.empty()) return;
  const QString unit = QString::fromUtf8(group_units[static_cast<std::size_t>(group_->current())]);
  const TimeUnit time = timeUnit(cycles->cycle_time_s.back() - cycles->cycle_time_s.front());
  std::vector<Series> series;
  for (std::size_t p = 0; p < cycles->names.size(); ++p) {
    if (parameterUnit(cycles->names[p]) != unit) continue;
    Series s;
    s.name = parameterTitle(cycles->names[p]);
    s.colour = static_cast<int>(series.size());
    for (std::size_t k = 0; k < cycles->cycles.size(); ++k) {
      const CycleParameter& value = cycles->parameters[k][p];
      if (!value.determined || !std::isfinite(value.value)) continue;
      s.x.push_back(cycles->cycle_time_s[k] / time.seconds);
      s.y.push_back(value.value);
      s.sigma.push_back(std::isfinite(value.standard_uncertainty) ? value.standard_uncertainty : 0.0);
    }
    if (!s.x.empty()) series.push_back(std::move(s));
  }
  const std::array<QString, 3> titles{tr("Displacement / µm"), tr("Rotation / µrad"), tr("Expansion / (µm/m)")};
  trends_->setAxes(tr("Time / %1").arg(time.name), titles[static_cast<std::size_t>(group_->current())]);
  trends_->setContent(std::move(series));
  const int k = cycle_->currentIndex();
  if (k >= 0 && k < static_cast<int>(cycles->cycle_time_s.size()) && !trends_->empty()) {
    trends_->addMark(cycles->cycle_time_s[static_cast<std::size_t>(k)] / time.seconds, cycle_->currentText());
  }
}

void CycleModelPage::showCycle() {
  const CycleEvaluation* cycles = cyclesOf(evaluation_.get());
  const int k = cycle_->currentIndex();
  if (cycles == nullptr || k < 0) return;
  const auto at = static_cast<std::size_t>(k);
  std::vector<Row> rows;
  for (std::size_t p = 0; p < cycles->names.size(); ++p) {
    const CycleParameter& value = cycles->parameters[at][p];
    Row row;
    row.id = fromCore(cycles->names[p]);
    row.cells = {nameCell(parameterLabel(cycles->names[p]))};
    const bool reference = k == cycles->problem.reference_cycle;
    if (!value.determined && !reference) {
      row.cells.push_back(toneCell(tr("not determined"), Tone::Attention));
      row.cells.push_back(dashCell());
    } else {
      Cell cell{quantityText(value.value, value.standard_uncertainty, parameterUnit(cycles->names[p]))};
      cell.right = true;
      row.cells.push_back(cell);
      row.cells.push_back(value.standard_uncertainty > 0
                              ? numberCell(std::abs(value.value) / value.standard_uncertainty, 1)
                              : dashCell());
    }
    row.cells.push_back(Cell{coreSentence(parameterMeaning(cycles->names[p]))});
    rows.push_back(std::move(row));
  }
  parameters_->setRows(std::move(rows));
  rows.clear();
  for (std::size_t c = 0; c < cycles->cycles.size(); ++c) {
    if (static_cast<int>(c) == cycles->problem.reference_cycle) continue;
    const CycleSolution& solution = cycles->fit.cycles[c];
    QStringList open;
    for (std::size_t p = 0; p < cycles->names.size(); ++p) {
      if (!solution.determined[p]) open << parameterTitle(cycles->names[p]);
    }
    Row row;
    row.id = fromCore(cycles->cycles[c]);
    row.cells = {
        nameCell(row.id), numberCell(solution.condition_number, 1), Cell{weakText(solution.weakest, cycles->names)},
        open.isEmpty() ? toneCell(tr("none"), Tone::Good) : toneCell(open.join(QStringLiteral(", ")), Tone::Bad)};
    rows.push_back(std::move(row));
  }
  combinations_->setRows(std::move(rows));
  const CycleSolution& solution = cycles->fit.cycles[at];
  if (k == cycles->problem.reference_cycle) {
    condition_->setText(tr("The reference: all others are relative to it."));
  } else {
    // The two that are told apart least; the table gives the whole combination.
    const QStringList parts = weakText(solution.weakest, cycles->names).split(QStringLiteral(", "));
    QString worst = parts.value(0).section(QLatin1Char(' '), 0, 0);
    if (parts.size() > 1) worst = tr("%1 and %2").arg(worst, parts[1].section(QLatin1Char(' '), 0, 0));
    condition_->setText(tr("Condition number %1; most strongly correlated: %2")
                            .arg(decimalText(solution.condition_number, 'f', 1))
                            .arg(worst));
  }
  showVolume();
}

std::vector<Exportable> CycleModelPage::exportables() {
  std::vector<Exportable> items{exportableOf(tr("Parameters of the cycle"), parameters_),
                                exportableOf(tr("Weak combinations"), combinations_)};
  if (!trends_->empty()) items.push_back(exportableOf(tr("Errors over time"), trends_));
  if (!line_->empty()) items.push_back(exportableOf(tr("Deviation from a straight line"), line_));
  if (field_ != nullptr) {
    items.push_back(exportableOf(tr("Volumetric error"), view_));
    const auto field = field_;
    items.push_back({tr("Volumetric error values"), {QStringLiteral("csv")}, [field](const QString& file) {
                       writeFileAtomically(file.toStdString(), field->csv());
                     }});
  }
  return items;
}

}  // namespace spindrift::gui
