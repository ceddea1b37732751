// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/probing/cycle_model_page.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
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
#include "widgets/commands/commands.h"
#include "widgets/common/parts.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/common/cells.h"
#include "widgets/pages/probing/touch_results.h"
#include "widgets/plots/plot.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr auto options_key = "cycle-model";
constexpr std::array<Component, 3> shown_components{Component::EX, Component::EY, Component::EZ};
const std::array<const char*, 3> group_units{"um", "urad", "um/m"};

/// 1, 2 or 5 x 10^n, so that the largest arrow is about a tenth of the picture.
double roundExaggeration(double extent_mm, double largest_um) {
  if (!(largest_um > 0)) return 1000;
  const double raw = 0.12 * extent_mm / (largest_um * 1e-3);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double f : {5.0, 2.0, 1.0}) {
    if (f * power <= raw) return f * power;
  }
  return power;
}

/// "gZ +0.64, aX −0.62": the names without their units.
QString weakText(const Eigen::VectorXd& combination, const std::vector<std::string>& names) {
  std::vector<std::string> titles;
  for (const std::string& name : names) titles.push_back(parameterTitle(name).toStdString());
  return fromCore(combinationText(combination, titles)).replace(QLatin1Char('-'), QChar(0x2212));
}

QString meaningOf(const std::string& name) {
  const QString n = parameterTitle(name);
  const QString axis = n.mid(1, 1);
  const auto tr = [](const char* text) { return CycleModelPage::tr(text); };
  if (n.startsWith(QLatin1Char('h'))) return tr("head turns about %1").arg(axis);
  if (n.startsWith(QLatin1Char('a'))) return tr("column turns about %1").arg(axis);
  if (n.startsWith(QLatin1Char('d'))) return tr("spindle drifts along %1").arg(axis);
  if (n.startsWith(QLatin1Char('g'))) return tr("screw of %1 grows").arg(axis);
  if (n == QLatin1String("EME")) return tr("bar grows");
  if (n.startsWith(QLatin1String("ER"))) return tr("table radius grows");
  if (n.contains(QLatin1Char('0'))) {
    const bool turn = QStringLiteral("ABC").contains(axis);
    return turn ? tr("table turns, %1").arg(axis) : tr("table moves along %1").arg(axis);
  }
  return tr("axis %1 grows").arg(n.right(1));
}

}  // namespace

CycleModelPage::CycleModelPage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Model, parent), results_(TouchResults::of(session())) {
  setInstruction(tr("Separate the errors of axes, table and artefact in every cycle, and see how well each is known."));
  fit_ = makeButton(tr("Fit all cycles"), nullptr, "primary");
  addAction(fit_);

  auto* left = new Card(tr("Errors over time"));
  group_ = new Segments({tr("Displacements"), tr("Rotations"), tr("Growth")}, tr("Group of parameters"));
  left->addToTitle(group_);
  trends_ = new Plot;
  trends_->setAxes(tr("Time / h"), tr("Displacement / um"));
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
  auto* tabs = makeTabs();
  parameters_ = new RowsModel({tr("Parameter"), tr("Value"), tr("In sigma"), tr("Meaning")}, this);
  tabs->addTab(makeTable(parameters_, tr("Parameters of the cycle"),
                         tr("Every parameter with its uncertainty appears after the fit.")),
               tr("Parameters"));
  combinations_ =
      new RowsModel({tr("Cycle"), tr("Condition number"), tr("Determined worst"), tr("Not determined")}, this);
  tabs->addTab(makeTable(combinations_, tr("Weak combinations"),
                         tr("Which combinations of parameters the touches hardly tell apart appears after the fit.")),
               tr("Weak combinations"));
  left->body()->addWidget(tabs, 5);

  right_ = new QStackedWidget;
  right_->addWidget(makeVolumePart());
  right_->addWidget(makeBarPart());
  content()->addWidget(makeSplitter(left, right_, 6, 6), 1);
  showHints(trends_);
  showHints(view_);
  showHints(line_);
  connect(fit_, &QPushButton::clicked, this, [this] { fit(true); });
  connect(group_, &Segments::chosen, this, &CycleModelPage::showTrends);
  connect(cycle_, &QComboBox::activated, this, [this](int) {
    showTrends();
    showCycle();
  });
}

QWidget* CycleModelPage::makeVolumePart() {
  auto* card = new Card(tr("Volumetric error"));
  component_ = new Segments({QStringLiteral("EX"), QStringLiteral("EY"), QStringLiteral("EZ")}, tr("Component"));
  card->addToTitle(component_);
  view_ = new View3D;
  view_->setEmptyText(tr("The heat map will appear here"),
                      tr("Fit all cycles: the error is drawn on a plane through the working space."));
  view_->setMachineVisible(false);
  card->body()->addWidget(view_, 1);
  auto* line = new QHBoxLayout;
  line->addWidget(new QLabel(tr("Plane at Z")));
  level_ = new QSlider(Qt::Horizontal);
  level_->setAccessibleName(tr("Height of the plane"));
  level_->setMinimumHeight(sizes::control_height);
  line->addWidget(level_, 1);
  level_text_ = new QLabel;
  level_text_->setMinimumWidth(72);
  line->addWidget(level_text_);
  arrows_ = new QCheckBox(tr("Arrows in the volume"));
  arrows_->setChecked(true);
  line->addWidget(arrows_);
  card->body()->addLayout(line);
  connect(component_, &Segments::chosen, this, &CycleModelPage::showVolume);
  connect(arrows_, &QCheckBox::toggled, this, &CycleModelPage::showVolume);
  connect(level_, &QSlider::valueChanged, this, &CycleModelPage::showVolume);
  return card;
}

QWidget* CycleModelPage::makeBarPart() {
  auto* card = new Card(tr("Straightness and the second axis"));
  line_ = new Plot;
  line_->setAxes(tr("Along the bar / mm"), tr("Off line / um"));
  line_->setEmptyText(tr("Deviations from a straight line will appear here"),
                      tr("Fit all cycles: what the axis does beyond a uniform growth is drawn per hole."));
  card->body()->addWidget(line_, 3);
  auto* extend = new QHBoxLayout;
  second_axis_ = new QCheckBox(tr("Second axis expands too"));
  second_axis_->setToolTip(tr("One parameter more; needs a bar whose growth is known"));
  second_axis_->setObjectName(QStringLiteral("secondAxis"));
  growth_ = new QDoubleSpinBox;
  trust_ = new QDoubleSpinBox;
  const auto prepare = [](QDoubleSpinBox* box, double low, double high, double value, const QString& name) {
    box->setRange(low, high);
    box->setDecimals(2);
    box->setValue(value);
    box->setSuffix(QStringLiteral(" um/m"));
    box->setAccessibleName(name);
    box->setMinimumHeight(sizes::control_height);
  };
  prepare(growth_, -1000, 1000, 0, tr("Known growth of the bar"));
  prepare(trust_, 0.01, 100, 0.1, tr("Standard uncertainty of that growth"));
  card->body()->addWidget(second_axis_);
  extend->addWidget(new QLabel(tr("Bar grows by")));
  extend->addWidget(growth_);
  extend->addWidget(new QLabel(QStringLiteral("±")));
  extend->addWidget(trust_);
  extend->addStretch();
  card->body()->addLayout(extend);
  card->body()->addWidget(makeLabel(tr("What an unnoticed growth of the second axis does"), "sectionTitle"));
  bias_ = new RowsModel({tr("Parameter"), tr("Change per um/m"), tr("Unit")}, this);
  card->body()->addWidget(makeTable(bias_, tr("Bias by the second axis"), tr("The bias appears after the fit.")), 3);
  connect(second_axis_, &QCheckBox::toggled, this, [this](bool on) {
    changeOptions(tr("extend by the second axis"), {{"second_axis", on}});
  });
  connect(growth_, &QDoubleSpinBox::editingFinished, this, [this] {
    changeOptions(tr("growth of the bar"), {{"growth_um_per_m", growth_->value()}});
  });
  connect(trust_, &QDoubleSpinBox::editingFinished, this, [this] {
    changeOptions(tr("uncertainty of the bar"), {{"trust_um_per_m", trust_->value()}});
  });
  return card;
}

std::string CycleModelPage::optionsKey() {
  return options_key + ("/" + std::to_string(session().campaignId()));
}

nlohmann::json CycleModelPage::optionsJson() const {
  auto* self = const_cast<CycleModelPage*>(this);
  const nlohmann::json stored = self->session().setting(self->optionsKey(), nlohmann::json::object());
  return stored.is_object() ? stored : nlohmann::json::object();
}

HoleCycleOptions CycleModelPage::holeOptions() const {
  const nlohmann::json json = optionsJson();
  HoleCycleOptions options;
  options.second_axis = json.value("second_axis", false);
  if (options.second_axis) {
    StableLength length;
    length.growth_um_per_m = json.value("growth_um_per_m", 0.0);
    length.uncertainty_um_per_m = json.value("trust_um_per_m", 0.1);
    options.stable_length = length;
  }
  return options;
}

void CycleModelPage::changeOptions(const QString& what, const nlohmann::json& change) {
  if (filling_) return;
  nlohmann::json after = optionsJson();
  after.update(change);
  if (after == optionsJson()) return;
  context().undo.push(new OptionsCommand(session(), what, optionsKey(), after, [this] {
    refresh();
    if (session().state("fit").there) fit(true);
  }));
}

void CycleModelPage::fit(bool store) {
  if (!session().state("evaluate").there) return;
  const CampaignSnapshot snapshot = session().snapshot();
  const auto list = results_.touches();
  if (snapshot.campaign == nullptr || list == nullptr) return;
  const HoleCycleOptions options = holeOptions();
  run(tr("Fitting all cycles"),
      [this, snapshot, list, options, store, json = optionsJson(),
       key = results_.key()](JobContext& job) -> std::function<void()> {
        auto evaluation =
            std::make_shared<TouchEvaluation>(evaluateTouchList(*snapshot.campaign, *list, options, {}, job));
        return [this, evaluation, store, json, key] {
          if (key != results_.key()) return refresh();  // of inputs that are no more
          evaluation_ = evaluation;
          if (const CycleEvaluation* cycles = cyclesOf(evaluation.get()); cycles != nullptr && store) {
            session().storeResult(
                "fit", {{"model", evaluation->hole_cycles.empty() ? "ball-cycles" : "hole-cycles"}, {"options", json}},
                cyclesJson(*cycles));
          }
          refresh();
        };
      });
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
  if (shown_campaign_ != session().campaignId()) {
    shown_campaign_ = session().campaignId();
    clear();
  }
  const Artefact* artefact = artefactOf(*campaign, list.get());
  const bool holes = artefact != nullptr && artefact->kind == "hole_bar";
  right_->setCurrentIndex(holes ? 1 : 0);
  {
    filling_ = true;
    const nlohmann::json json = optionsJson();
    second_axis_->setChecked(json.value("second_axis", false));
    growth_->setValue(json.value("growth_um_per_m", 0.0));
    trust_->setValue(json.value("trust_um_per_m", 0.1));
    growth_->setEnabled(second_axis_->isChecked());
    trust_->setEnabled(second_axis_->isChecked());
    filling_ = false;
  }
  if (list == nullptr) {
    callout()->show(Tone::Bad, results_.failure());
    return;
  }
  const bool evaluated = session().state("evaluate").there;
  fit_->setEnabled(evaluated);
  if (!evaluated) {
    callout()->show(Tone::Attention, tr("The touches are not evaluated yet."));
    callout()->setAction(tr("Go to Calibrate"), [this] { context().workflow.goTo(StepId::Calibrate); });
    return;
  }
  callout()->setAction({}, {});
  const ResultState state = session().state("fit");
  const CycleEvaluation* cycles = cyclesOf(evaluation_.get());
  if (cycles == nullptr) {
    if (state.there) {
      fit(false);
    } else {
      callout()->show(Tone::Accent, tr("Press Fit all cycles. One least squares over all touches separates the errors; "
                                       "everything is relative to the first cycle."));
    }
    return;
  }
  if (!state.current) {
    callout()->show(Tone::Outdated, tr("Touches, exclusions or the machine have changed since. Fit all cycles again."));
  } else if (cycles->status == FitStatus::Converged && cycles->warnings.empty()) {
    callout()->show(
        Tone::Good,
        tr("%1 parameters are determined in each of %2 cycles.").arg(cycles->names.size()).arg(cycles->cycles.size()));
  } else {
    QStringList sentences;
    for (const std::string& w : cycles->warnings) sentences << fromCore(w);
    if (sentences.isEmpty()) sentences << fromCore(cycles->message);
    callout()->show(Tone::Attention, sentences.mid(0, 2).join(QLatin1Char(' ')));
  }
  const QString chosen = cycle_->currentText();
  cycle_->clear();
  for (const std::string& name : cycles->cycles) cycle_->addItem(fromCore(name));
  const int at = cycle_->findText(chosen);
  cycle_->setCurrentIndex(at >= 0 ? at : cycle_->count() - 1);
  if (evaluation_->hole_cycles.size() + evaluation_->ball_cycles.size() > 1) {
    callout()->show(Tone::Attention, tr("This page shows %1. The other artefacts are evaluated too: their deviations "
                                        "stand in the observations and in the report.")
                                         .arg(fromCore(cycles->artefact)));
  }
  showTrends();
  showCycle();
  showBar();
}

void CycleModelPage::showTrends() {
  const CycleEvaluation* cycles = cyclesOf(evaluation_.get());
  if (cycles == nullptr || cycles->cycles.empty()) return;
  const QString unit = QString::fromLatin1(group_units[static_cast<std::size_t>(group_->current())]);
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
  const std::array<QString, 3> titles{tr("Displacement / um"), tr("Rotation / urad"), tr("Growth / um/m")};
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
    row.cells = {nameCell(parameterTitle(cycles->names[p]))};
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
    row.cells.push_back(Cell{meaningOf(cycles->names[p])});
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
    condition_->setText(
        tr("Condition number %1; told apart worst: %2").arg(solution.condition_number, 0, 'f', 1).arg(worst));
  }
  showVolume();
}

void CycleModelPage::setComponent(int index) {
  component_->setCurrent(index);
  showVolume();
}

void CycleModelPage::showVolume() {
  const auto campaign = session().campaign();
  if (campaign == nullptr || evaluation_ == nullptr || evaluation_->ball_cycles.empty()) return;
  const BallCycleResult& result = evaluation_->ball_cycles.front();
  const int k = cycle_->currentIndex();
  const LinearAxis* z = campaign->machine.findAxis("Z");
  if (k < 0 || z == nullptr || campaign->machine.styli.empty()) return;
  if (view_->empty()) {
    const QSignalBlocker quiet(level_);
    level_->setRange(static_cast<int>(std::min(z->travel_mm[0], z->travel_mm[1])),
                     static_cast<int>(std::max(z->travel_mm[0], z->travel_mm[1])));
    level_->setValue((level_->minimum() + level_->maximum()) / 2);
    view_->setMachine(campaign->machine);
    view_->setMachineVisible(false);
  }
  level_text_->setText(QStringLiteral("%1 mm").arg(level_->value()));
  const Eigen::Vector3d offset = campaign->machine.styli.front().offset_mm;
  const BallCycleModel model(result, k);
  const Component component = shown_components[static_cast<std::size_t>(component_->current())];
  // One scale for the three components and all heights, so that pictures can be compared.
  double largest = 0;
  double largest_arrow = 0;
  std::vector<ViewArrow> arrows;
  for (const VolumetricArrow& a : volumetricArrows(model, campaign->machine, offset, 4)) {
    largest = std::max(largest, a.deviation_um.cwiseAbs().maxCoeff());
    largest_arrow = std::max(largest_arrow, a.deviation_um.norm());
    arrows.push_back({a.position_mm, a.deviation_um, Tone::Neutral});
  }
  auto field = std::make_shared<Field>(
      volumetricField(model, campaign->machine, component, 2, static_cast<double>(level_->value()), offset, 41));
  field_ = field;
  const QString name = fromCore(std::string(toString(component)));
  const double extent =
      std::max(field->grid.x_to_mm - field->grid.x_from_mm, field->grid.y_to_mm - field->grid.y_from_mm);
  view_->setColourScale(ColourScale::symmetric(std::max(largest, 0.1), name, QStringLiteral("um")));
  FieldStyle style;
  style.contours = true;
  view_->setField(field, style);
  if (!arrows_->isChecked()) arrows.clear();
  view_->setArrows(std::move(arrows), roundExaggeration(extent, largest_arrow));
  view_->setCaption(tr("%1 in cycle %2 against %3, stylus %4")
                        .arg(name, cycle_->currentText(), fromCore(result.cycles.front()),
                             fromCore(campaign->machine.styli.front().id)));
}

void CycleModelPage::showBar() {
  if (evaluation_ == nullptr || evaluation_->hole_cycles.empty()) return;
  const HoleCycleResult& holes = evaluation_->hole_cycles.front();
  Series rms, largest;
  rms.name = tr("rms over all cycles");
  rms.style = SeriesStyle::LinePoints;
  largest.name = tr("Largest");
  largest.style = SeriesStyle::Points;
  largest.colour = 1;
  for (const LinearityDeviation& d : holes.linearity) {
    const double s = holes.setup.along_mm[static_cast<std::size_t>(HoleBarSetup::holeIndex(d.feature))];
    rms.x.push_back(s);
    rms.y.push_back(d.rms_um);
    largest.x.push_back(s);
    largest.y.push_back(d.largest_um);
    largest.sigma.push_back(d.sigma_um);
  }
  line_->setLeastRange(0.5);
  line_->setContent({rms, largest});
  std::vector<Row> rows;
  const SecondAxisBias bias = secondAxisBias(holes, evaluation_->touches);
  for (std::size_t p = 0; p < bias.names.size(); ++p) {
    Row row;
    row.id = fromCore(bias.names[p]);
    row.cells = {nameCell(parameterTitle(bias.names[p])), numberCell(bias.bias_per_um_per_m[p], 3),
                 Cell{parameterUnit(bias.names[p])}};
    rows.push_back(std::move(row));
  }
  bias_->setRows(std::move(rows));
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
