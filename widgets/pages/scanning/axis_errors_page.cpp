// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/scanning/axis_errors_page.h"

#include <QHBoxLayout>
#include <QSplitter>
#include <QTabWidget>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/units.h"
#include "core/scanning/evaluate_scans.h"
#include "core/scanning/scan_evaluation.h"
#include "core/tasks/task_options.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/plots/plot.h"
#include "widgets/plots/plot_grid.h"
#include "widgets/plots/surface_plot.h"
#include "widgets/services/scan_results.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

constexpr std::array<const char*, 2> models{"rigid", "push_broom"};

double factorOf(int component) {
  return component < 3 ? um_per_mm : urad_per_rad;
}

QString unitOfError(int component) {
  return unitText(unitOf(static_cast<Component>(component)));
}

/// Value at the slide's origin and its uncertainty, um or urad; NaN where it is not determined.
std::pair<double, double> atOrigin(const ScanResult& s, int i) {
  if (!s.axis.determined(i)) return {std::nan(""), std::nan("")};
  return {valueOf(s.axis.error, static_cast<Component>(i)), factorOf(i) * std::sqrt(s.axis.covariance(i, i))};
}

std::pair<double, double> atArtefact(const ScanResult& s, int i) {
  const double sigma = s.standardUncertaintyAtArtefact(i);
  if (!std::isfinite(sigma)) return {std::nan(""), std::nan("")};
  return {valueOf(SmallError{s.registration.translation_mm, s.registration.rotation_rad}, static_cast<Component>(i)),
          factorOf(i) * sigma};
}

/// Scans of one cycle belong together: the longest time that any cycle takes.
double cycleDuration(const ScanEvaluation& evaluation) {
  std::map<std::string, std::pair<double, double>> span;
  for (const ScanResult& s : evaluation.scans) {
    auto& [first, last] = span.try_emplace(s.capture.cycle, s.capture.time_s, s.capture.time_s).first->second;
    first = std::min(first, s.capture.time_s);
    last = std::max(last, s.capture.time_s);
  }
  double longest = 1.0;
  for (const auto& [cycle, times] : span) longest = std::max(longest, times.second - times.first + 1.0);
  return longest;
}

}  // namespace

AxisErrorsPage::AxisErrorsPage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Model, parent),
      results_(ScanResults::of(session())),
      options_(session(), context().undo, [this] {
        refresh();
        if (session().state("fit").there) runAlone("fit");
      }) {
  setInstruction(tr("See the six errors of the axis over positions and time, and which of them the scans can show."));
  fit_ = makeButton(tr("Find the six errors"), nullptr, "primary");
  addModelSwitch(true);
  addAction(fit_);
  auto* choices = new QHBoxLayout;
  QStringList components;
  for (const Component c : all_components) components << QString::fromUtf8(toString(c));
  component_ = new Segments(components, tr("Error of the axis"));
  model_ = new Segments({tr("Rigid"), tr("Push broom")}, tr("Scan model"));
  model_->button(0)->setToolTip(tr("The cloud moves as one body"));
  model_->button(1)->setToolTip(tr("Every profile is taken at its own position of the carriage"));
  choices->addWidget(component_);
  choices->addStretch();
  choices->addWidget(makeLabel(tr("Scan model"), "secondaryText"));
  choices->addWidget(model_);
  content()->addLayout(choices);

  auto* left = new Card(tr("At the slide's origin"));
  over_ = new Segments({tr("Over time"), tr("Over position")}, tr("Horizontal axis"));
  left->addToTitle(over_);
  series_ = new PlotGrid;
  series_->setAxes(tr("Time / min"), tr("Error / µm"));
  series_->setEmptyText(tr("Errors of the axis will appear here"),
                        tr("Find the six errors: each is drawn over time with its uncertainty."));
  left->body()->addWidget(series_, 1);
  auto* right = new Card(tr("Over position and time"));
  tabs_ = makeTabs(right);
  values_ = new RowsModel({tr("Scan"), tr("At the origin"), tr("At the artefact"), tr("Observed")}, this);
  tabs_->addTab(makeTable(values_, tr("Values"), tr("Every scan's error with its uncertainty appears here.")),
                tr("Values"));
  observability_ = new RowsModel({tr("Error"), tr("± at the origin"), tr("± at the artefact"), tr("Observable")}, this);
  tabs_->addTab(makeTable(observability_, tr("What the scan model can observe"),
                          tr("Which errors this scan model can show appears after the fit.")),
                tr("Observability"));
  surface_ = new SurfacePlot;
  surface_->setEmptyText(tr("The surface will appear here"),
                         tr("It needs at least two positions and two times with a determined error."));
  right->body()->addWidget(surface_, 6);
  right->body()->addWidget(tabs_, 4);
  content()->addWidget(makeSplitter(this, left, right, 6, 6), 1);
  showHints(series_);
  showHints(surface_);
  connect(fit_, &QPushButton::clicked, this, [this] { runTask("fit"); });
  connect(model_, &Segments::chosen, this, &AxisErrorsPage::chooseModel);
  const auto again = [this] {
    if (evaluation_ != nullptr) show(*evaluation_);
  };
  connect(component_, &Segments::chosen, this, again);
  connect(over_, &Segments::chosen, this, again);
}

std::string AxisErrorsPage::chosenModel() const {
  const std::string model = options_.now().model;
  return model.empty() ? results_.modelOfMachine() : model;
}

void AxisErrorsPage::chooseModel(int index) {
  const std::string model = models[static_cast<std::size_t>(index)];
  if (model != chosenModel())
    options_.change(tr("choose the scan model"), [&](ScanModelChoice& o) { o.model = model; });
}

void AxisErrorsPage::nameErrors(const std::string& axis) {
  for (const Component c : all_components) {
    const QString name = QString::fromUtf8(toString(c)) + QString::fromStdString(axis);
    QPushButton* button = component_->button(static_cast<int>(c));
    button->setText(name);
    button->setAccessibleName(tr("Error of the axis") + QStringLiteral(": ") + name);
  }
}

void AxisErrorsPage::setComponent(int index) {
  component_->setCurrent(index);
  if (evaluation_ != nullptr) show(*evaluation_);
}

void AxisErrorsPage::clear() {
  values_->setRows({});
  observability_->setRows({});
  series_->setContent({});
  surface_->setData({}, {});
}

void AxisErrorsPage::refresh() {
  if (session().campaign() == nullptr) return;
  if (noticeCampaign()) {
    evaluation_ = nullptr;
    clear();
  }
  const auto& profiler = session().campaign()->machine.profiler;
  nameErrors(profiler ? profiler->axis : ProfilerDescription{}.axis);
  model_->setCurrent(chosenModel() == models[1] ? 1 : 0);
  const bool evaluated = session().state("evaluate").there;
  fit_->setEnabled(evaluated && canRun("fit"));
  callout()->setAction({}, {});
  if (!evaluated) {
    callout()->show(Tone::Attention, tr("The scans are not evaluated yet."));
    callout()->setAction(tr("Go to Calibrate"), [this] { context().workflow.goTo(StepId::Calibrate); });
    return;
  }
  const ShownTask stored = shown("fit", tr("Reading the six errors"));
  const ResultState& state = stored.state;
  if (!state.there) {
    clear();
    callout()->show(Tone::Accent, tr("Press Find the six errors. They hold at the origin of the slide, far from the "
                                     "artefact: the levers of the machine carry the rotations there."));
    return;
  }
  if (stored.reading) return;
  const auto found = stored.as<AxisErrorResult>();
  evaluation_ = found == nullptr ? nullptr : found->scans;
  if (evaluation_ == nullptr) {
    clear();
    callout()->show(Tone::Outdated, tr("Changed since: %1. Find the errors again.").arg(state.changed));
    return;
  }
  if (!state.current) {
    callout()->show(Tone::Outdated, tr("Changed since: %1. Find the errors again.").arg(state.changed));
  } else if (chosenModel() != results_.modelOfMachine()) {
    callout()->show(Tone::Attention, tr("The machine description says that its scans are %1. Under another scan model "
                                        "the numbers below are wrong by more than they say.")
                                         .arg(model_->button(model_->current() == 0 ? 1 : 0)->text().toLower()));
  } else {
    callout()->show(Tone::Good, tr("%n scans, six errors each, relative to the first scan of their artefact.", nullptr,
                                   static_cast<int>(evaluation_->scans.size())));
  }
  show(*evaluation_);
}

void AxisErrorsPage::show(const ScanEvaluation& evaluation) {
  nameErrors(evaluation.axis);
  const int c = component_->current();
  const QString name = component_->button(c)->text();
  double last = 0;
  for (const ScanResult& s : evaluation.scans) last = std::max(last, s.capture.time_s);
  const TimeUnit unit = timeUnit(last);
  const bool over_time = over_->current() == 0;
  std::map<std::string, Series> by_group;
  std::vector<std::string> order;
  for (const ScanResult& s : evaluation.scans) {
    const auto [value, sigma] = atOrigin(s, c);
    if (!std::isfinite(value)) continue;
    const std::string group = over_time ? s.capture.artefact : s.capture.cycle;
    if (!by_group.contains(group)) {
      order.push_back(group);
      by_group[group].name =
          over_time ? tr("%1 at %2 mm").arg(fromCore(group)).arg(decimalText(s.capture.y_mm, 'f', 0)) : fromCore(group);
      by_group[group].colour = static_cast<int>(order.size()) - 1;
    }
    Series& series = by_group[group];
    series.x.push_back(over_time ? s.capture.time_s / unit.seconds : s.capture.y_mm);
    series.y.push_back(value);
    series.sigma.push_back(std::isfinite(sigma) ? sigma : 0.0);
  }
  std::vector<Series> series;
  for (const std::string& group : order) series.push_back(std::move(by_group[group]));
  series_->setAxes(over_time ? tr("Time / %1").arg(unit.name) : tr("Position of the carriage / mm"),
                   tr("%1 / %2").arg(name, unitOfError(c)));
  series_->setContent(std::move(series));

  std::vector<AxisErrorSample> samples;
  for (const ScanResult& s : evaluation.scans) {
    if (s.axis.determined(c)) samples.push_back({s.capture.time_s, s.capture.y_mm, s.axis});
  }
  ViewSurface grid;
  double largest = 0;
  if (!samples.empty()) {
    const AxisErrorSurface found = axisErrorSurfaces(samples, cycleDuration(evaluation))[static_cast<std::size_t>(c)];
    grid.x = found.positions_mm;
    for (const double t : found.times_s) grid.y.push_back(t / unit.seconds);
    grid.value = found.values;
    grid.sigma = found.sigmas;
    for (const double v : grid.value) {
      if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
    }
  }
  grid.x_title = tr("Position / mm");
  grid.y_title = tr("Time / %1").arg(unit.name);
  grid.value_title = tr("%1 / %2").arg(name, unitOfError(c));
  surface_->setData(std::move(grid), ColourScale::symmetric(std::max(largest, 0.1), name, unitOfError(c)));
  showValues(evaluation);
  showObservability(evaluation);
}

void AxisErrorsPage::showValues(const ScanEvaluation& evaluation) {
  const int c = component_->current();
  values_->setHeaders({tr("Scan"), tr("At the origin / %1").arg(unitOfError(c)),
                       tr("At the artefact / %1").arg(unitOfError(c)), tr("Observed")});
  std::vector<Row> rows;
  for (const ScanResult& s : evaluation.scans) {
    if (s.reference) continue;
    Row row;
    row.id = fromCore(s.capture.cloud);
    row.cells = {nameCell(QStringLiteral("%1 · %2").arg(fromCore(s.capture.artefact), fromCore(s.capture.cycle)))};
    const auto origin = atOrigin(s, c);
    const auto artefact = atArtefact(s, c);
    row.cells.push_back(quantityCell(origin.first, origin.second));
    row.cells.push_back(quantityCell(artefact.first, artefact.second));
    const auto why = std::find_if(s.not_observed.begin(), s.not_observed.end(),
                                  [&](const auto& n) { return static_cast<int>(n.first) == c; });
    // What is less than twice its uncertainty was looked for and not seen.
    row.cells.push_back(why != s.not_observed.end()                        ? toneCell(tr("no"), Tone::Attention)
                        : std::abs(artefact.first) < 2.0 * artefact.second ? toneCell(tr("in the noise"), Tone::Neutral)
                                                                           : toneCell(tr("yes"), Tone::Good));
    if (why != s.not_observed.end()) row.cells.back().tip = fromCore(why->second);
    rows.push_back(std::move(row));
  }
  values_->setRows(std::move(rows));
}

void AxisErrorsPage::showObservability(const ScanEvaluation& evaluation) {
  std::vector<Row> rows;
  for (int c = 0; c < 6; ++c) {
    double origin = 0, artefact = 0;
    QString reason;
    int seen = 0, all = 0;
    for (const ScanResult& s : evaluation.scans) {
      if (s.reference) continue;
      ++all;
      const auto a = atOrigin(s, c);
      const auto b = atArtefact(s, c);
      if (std::isfinite(a.second)) origin = std::max(origin, a.second);
      if (std::isfinite(b.second)) {
        artefact = std::max(artefact, b.second);
        ++seen;
      }
      for (const auto& [component, sentence] : s.not_observed) {
        if (static_cast<int>(component) == c) reason = coreSentence(sentence);
      }
    }
    Row row;
    row.id = component_->button(c)->text();
    const auto text = [&](double v) {
      Cell cell = dashCell();
      if (v > 0) cell.text = QStringLiteral("%1 %2").arg(decimalText(v, 'g', 2)).arg(unitOfError(c));
      return cell;
    };
    row.cells = {nameCell(row.id), text(origin), text(artefact),
                 all > 0 && seen == all ? toneCell(tr("yes"), Tone::Good)
                 : seen > 0             ? toneCell(tr("in %1 of %2 scans").arg(seen).arg(all), Tone::Attention)
                                        : toneCell(tr("no"), Tone::Bad)};
    row.cells.back().tip = reason;
    rows.push_back(std::move(row));
  }
  observability_->setRows(std::move(rows));
}

std::vector<Exportable> AxisErrorsPage::exportables() {
  std::vector<Exportable> items{exportableOf(tr("Errors of the axis"), values_),
                                exportableOf(tr("Observability"), observability_)};
  const std::vector<Plot*> panels = series_->panels();
  for (std::size_t i = 0; i < panels.size(); ++i)
    items.push_back(exportableOf(tr("Errors, %1").arg(series_->titleOf(static_cast<int>(i))), panels[i]));
  if (!surface_->empty()) {
    items.push_back({tr("Surface over position and time"),
                     {QStringLiteral("png"), QStringLiteral("csv")},
                     [this](const QString& file) { surface_->exportTo(file); }});
  }
  return items;
}

}  // namespace spindrift::gui
