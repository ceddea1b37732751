// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/kinematics/nine_parameter_page.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QSplitter>
#include <QTabWidget>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/machine/parameter_meanings.h"
#include "core/tasks/task_options.h"
#include "core/workflows/fit_campaign.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

QString parameterName(int i) {
  return parameterTitle(std::string(nine_parameter_names[static_cast<std::size_t>(i)]));
}

QString meaningOf(int i) {
  return coreSentence(parameterMeaning(nine_parameter_names[static_cast<std::size_t>(i)]));
}

Cell parameterCell(double value, double sigma, std::string_view unit) {
  Cell cell;
  cell.text = shownNumbers(QString::fromStdString(withUncertainty(value, sigma, unit)));
  cell.right = true;
  return cell;
}

}  // namespace

NineParameterPage::NineParameterPage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Model, parent),
      states_([this] { refresh(); }),
      options_(session(), context().undo, [this] {
        refresh();
        runAlone("fit");
      }) {
  fit_button_ = makeButton(tr("Fit the model"), nullptr, "primary");
  addModelSwitch(true);
  addAction(fit_button_);

  auto* left = new Card;
  auto* choices = new QHBoxLayout;
  choices->addWidget(new QLabel(tr("State")));
  state_ = new QComboBox;
  state_->setAccessibleName(tr("Thermal state to fit"));
  choices->addWidget(state_, 1);
  choices->addWidget(new QLabel(tr("Outliers")));
  robust_ = new QComboBox;
  robust_->setAccessibleName(tr("How outliers are treated"));
  robust_->addItem(tr("keep"), 0);
  robust_->addItem(tr("Huber"), 1);
  robust_->addItem(tr("Tukey"), 2);
  choices->addWidget(robust_, 1);
  left->body()->addLayout(choices);
  left->body()->addWidget(makeLabel(tr("Points: checked ones are fitted, the others validate"), "sectionTitle"));
  points_ = new RowsModel({tr("Point"), tr("x / mm"), tr("y / mm"), tr("EX / µm"), tr("EY / µm"), tr("EZ / µm")}, this);
  auto* point_table = makeTable(points_, tr("Points"), tr("Points appear when there are observations."));
  left->body()->addWidget(point_table, 2);

  auto* tiles = new QHBoxLayout;
  tiles->setSpacing(16);
  rms_fit_ = new NumberTile(tr("rms of the fit"));
  rms_validation_ = new NumberTile(tr("rms of the validation"));
  condition_ = new NumberTile(tr("Condition number"));
  tiles->addWidget(rms_fit_, 1);
  tiles->addWidget(rms_validation_, 1);
  tiles->addWidget(condition_, 1);
  left->body()->addLayout(tiles);

  tabs_ = makeTabs(left);
  parameters_ = new RowsModel({tr("Parameter"), tr("Value"), tr("Meaning")}, this);
  tabs_->addTab(makeSentenceTable(parameters_, tr("Parameters"),
                                  tr("Nine parameters with their uncertainty appear after the fit.")),
                tr("Parameters"));
  residuals_ = new RowsModel(
      {tr("Point"), tr("Component"), tr("Measured"), tr("Residual"), tr("Residual / σ"), tr("Used")}, this);
  residual_table_ =
      makeTable(residuals_, tr("Residuals"), tr("What the model does not explain appears after the fit."));
  tabs_->addTab(residual_table_, tr("Residuals"));
  auto* compare = new QWidget;
  auto* compare_column = new QVBoxLayout(compare);
  compare_column->setContentsMargins(0, 8, 0, 0);
  comparison_verdict_ = new Callout;
  compare_column->addWidget(comparison_verdict_);
  comparison_ =
      new RowsModel({tr("Parameter"), tr("Checked points"), tr("Other points"), tr("Difference"), tr("p")}, this);
  compare_column->addWidget(
      makeTable(comparison_, tr("Comparison of two sets of points"), tr("Fit the model to compare sets of points.")),
      1);
  tabs_->addTab(compare, tr("Compare sets"));
  left->body()->addWidget(tabs_, 3);

  auto* right = new Card;
  auto* view_line = new WrapLayout;
  component_ = new Segments({QStringLiteral("EX"), QStringLiteral("EY"), QStringLiteral("EZ")}, tr("Component"));
  view_line->addWidget(component_);
  arrows_ = new QCheckBox(tr("Arrows"));
  arrows_->setChecked(true);
  same_scale_ = new QCheckBox(tr("One scale"));
  same_scale_->setToolTip(tr("The same limits for EX, EY and EZ, so that their pictures can be compared"));
  relief_ = new QCheckBox(tr("Relief"));
  machine_ = new QCheckBox(tr("Machine"));
  higher_ = new QCheckBox(tr("Higher order"));
  view_line->addWidget(higher_);
  view_line->addWidget(arrows_);
  view_line->addWidget(same_scale_);
  view_line->addWidget(relief_);
  view_line->addWidget(machine_);
  right->body()->addLayout(view_line);
  view_ = new View3D;
  view_->setEmptyText(tr("The heat map will appear here"),
                      tr("Fit the model: it is drawn over the table with the measured points on top."));
  view_->setMachineVisible(false);
  right->body()->addWidget(view_, 1);
  content()->addWidget(makeSplitter(this, left, right, 13, 10), 1);
  showHints(view_);

  connect(fit_button_, &QPushButton::clicked, this, [this] { runTask("fit"); });
  connect(state_, &QComboBox::activated, this, [this](int) {
    options_.change(tr("choose state"), [this](NineParameterChoice& o) { o.state = shownState(); });
  });
  connect(robust_, &QComboBox::activated, this, [this](int index) {
    options_.change(tr("treat outliers"),
                    [index](NineParameterChoice& o) { o.robust = static_cast<RobustLoss>(index); });
  });
  connect(points_, &RowsModel::checkedChanged, this, [this](const QString&, int, bool) {
    std::vector<std::string> chosen;
    for (const Row& row : points_->rows()) {
      if (row.cells[0].checked.value_or(false)) chosen.push_back(row.id.toStdString());
    }
    options_.change(tr("choose points"), [&](NineParameterChoice& o) { o.points = chosen; });
  });
  connect(component_, &Segments::chosen, this, &NineParameterPage::showField);
  connect(tabs_, &QTabWidget::currentChanged, this, &NineParameterPage::showField);
  connect(arrows_, &QCheckBox::toggled, this, &NineParameterPage::showField);
  connect(higher_, &QCheckBox::toggled, this, &NineParameterPage::showField);
  connect(same_scale_, &QCheckBox::toggled, this, &NineParameterPage::showField);
  connect(relief_, &QCheckBox::toggled, this, [this] {
    lookAgain();
    showField();
  });
  connect(machine_, &QCheckBox::toggled, this, [this](bool on) {
    view_->setMachineVisible(on);
    lookAgain();
  });
  connect(view_, &View3D::pointPicked, this, [this, point_table](const QString& id) {
    const int row = points_->rowOf(id);
    if (row >= 0) point_table->selectRow(row);
  });
  connect(point_table->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this](const QModelIndex& now) { view_->setSelected(points_->idAt(now.row())); });
  view_->lookAtMap();
}

void NineParameterPage::lookAgain() {
  if (relief_->isChecked() || machine_->isChecked()) return view_->resetCamera(StandardView::Isometric);
  view_->lookAtMap();
}

NineParameterOptions NineParameterPage::options() const {
  return options_.now().options();
}

void NineParameterPage::refresh() {
  const auto campaign = session().campaign();
  if (campaign == nullptr) return;
  if (noticeCampaign()) {
    state_->clear();
    changes_.reset();
    result_.reset();
    showFit();
  }
  const auto set = session().observations();
  options_.fill([&] {
    fillStates();
    robust_->setCurrentIndex(static_cast<int>(options().robust));
  });
  fit_button_->setEnabled(set != nullptr && canRun("fit"));
  fillPoints();
  if (!set) {
    result_.reset();
    showFit();
    callout()->show(Tone::Attention, tr("There are no observations yet. Evaluate the captures first."));
    callout()->setAction(tr("Go to Calibrate"), [this] { context().workflow.goTo(StepId::Calibrate); });
    return;
  }
  const ShownTask fit = shown("fit", tr("Reading the fit"));
  if (fit.reading) return;
  result_ = fit.as<NineParameterResult>();
  showFit();
  if (fit.state.there && !fit.state.current)
    callout()->show(Tone::Outdated,
                    tr("Changed since this was fitted: %1. Fit the model again.").arg(fit.state.changed));
}

void NineParameterPage::fillStates() {
  const auto set = session().observations();
  if (!set) return state_->clear();
  const auto states = states_.ask(set, {}, [](const ObservationSet& observations) {
    return States{observations.states(), lastStateToFit(observations)};
  });
  if (states == nullptr) return;
  state_->clear();
  for (std::size_t i = 0; i < states->all.size(); ++i) {
    if (i == 0 && states->all.size() > 1) continue;  // the reference
    const QString name = QString::fromStdString(states->all[i]);
    state_->addItem(name, name);
  }
  // What is fitted of an absolute set with few points in each state.
  const QString every = QString::fromStdString(std::string(every_state));
  if (states->last == every_state) state_->addItem(tr("all states together"), every);
  const std::string chosen = options().state.empty() ? states->last : options().state;
  const int index = state_->findData(QString::fromStdString(chosen));
  state_->setCurrentIndex(index >= 0 ? index : state_->count() - 1);
}

std::string NineParameterPage::shownState() const {
  return state_->currentData().toString().toStdString();
}

void NineParameterPage::fillPoints() {
  const auto set = session().observations();
  const std::string state = shownState();
  // While it is still to be found which states there are, that which is fitted if none is chosen is read.
  const bool fitted = state.empty() && states_.busy() && options().state.empty();
  if (set == nullptr || (state.empty() && !fitted)) {
    changes_.reset();
  } else if (changes_ == nullptr || changes_->of != set || (changes_->state != state && !fitted)) {
    display(tr("Reading the points"), [this, set, state](JobContext&) -> std::function<void()> {
      const std::string read = state.empty() ? lastStateToFit(*set) : state;
      return [this, now = std::make_shared<const Changes>(Changes{set, read, pointChanges(*set, read)})] {
        changes_ = now;
        showPoints();
      };
    });
  }
  showPoints();
}

void NineParameterPage::showPoints() {
  std::vector<Row> rows;
  const NineParameterOptions o = options();
  for (const PointChange& point : changes_ == nullptr ? std::vector<PointChange>() : changes_->points) {
    Row row;
    row.id = QString::fromStdString(point.point);
    Cell name{row.id};
    name.bold = true;
    name.checked = o.points.empty() || std::find(o.points.begin(), o.points.end(), point.point) != o.points.end();
    row.cells = {name, {decimalText(point.position_mm.x(), 'g', 5)}, {decimalText(point.position_mm.y(), 'g', 5)}};
    for (Eigen::Index c = 0; c < 3; ++c) {
      Cell cell;
      cell.text = std::isnan(point.value_um[c])
                      ? QStringLiteral("–")
                      : shownNumbers(QString::fromStdString(withUncertainty(point.value_um[c], point.sigma_um[c], "")));
      row.cells.push_back(cell);
    }
    for (std::size_t c = 1; c < row.cells.size(); ++c) row.cells[c].right = true;
    rows.push_back(std::move(row));
  }
  points_->setRows(std::move(rows));
}

void NineParameterPage::showFit() {
  if (!result_) {
    parameters_->setRows({});
    residuals_->setRows({});
    comparison_->setRows({});
    comparison_verdict_->set(Tone::Neutral, {});
    for (NumberTile* tile : {rms_fit_, rms_validation_, condition_}) tile->set(QStringLiteral("–"));
    higher_->setEnabled(false);
    view_->clear();
    callout()->setAction({}, {});
    callout()->show(Tone::Accent, tr("Choose the points to fit, then press Fit the model."));
    return;
  }
  const NineParameterFit& f = result_->fit;
  const TableOrderChoice& order = result_->order;
  callout()->setAction({}, {});
  const QString message = coreSentence(f.message);
  QString warnings;
  for (const std::string& w : f.warnings) warnings += QLatin1Char(' ') + coreSentence(w);
  higher_->setEnabled(order.richer());
  const QString reason = coreSentence(order.reason);
  higher_->setToolTip(onScreen(reason));
  if (f.status == FitStatus::Converged) {
    if (order.richer() || !warnings.isEmpty()) warnings += QLatin1Char(' ') + reason;
    if (!warnings.isEmpty()) {
      callout()->show(f.warnings.empty() ? Tone::Accent : Tone::Attention, warnings.trimmed());
    } else {
      callout()->show(Tone::Good,
                      tr("State %1 against %2: all nine parameters are determined.")
                          .arg(QString::fromStdString(f.state),
                               QString::fromStdString(f.reference_state.empty() ? "zero" : f.reference_state)));
    }
  } else {
    callout()->show(f.status == FitStatus::Degenerate ? Tone::Attention : Tone::Bad, message + warnings);
  }
  std::vector<Row> rows;
  for (int i = 0; i < nine_parameter_count; ++i) {
    Row row;
    row.id = parameterName(i);
    Cell name{parameterLabel(std::string(nine_parameter_names[static_cast<std::size_t>(i)]))};
    name.bold = true;
    Cell value;
    if (f.determined(i)) {
      value = parameterCell(f.parameters[i], f.standardUncertainty(i), nineParameterUnit(i));
    } else {
      value = {tr("not determined"), Tone::Attention, "alert"};
      value.right = true;
    }
    row.cells = {name, value, {meaningOf(i)}};
    rows.push_back(std::move(row));
  }
  if (order.richer()) {
    const std::vector<std::string> names = order.model->basis().names();
    for (std::size_t i = nine_parameter_count; i < names.size(); ++i) {
      const auto e = static_cast<Eigen::Index>(i);
      Row row;
      QString text = QString::fromStdString(names[i]);
      text.chop(3);  // _um
      row.id = text;
      row.cells = {{text.replace(QLatin1Char('_'), QLatin1Char(' '))},
                   parameterCell(order.model->parameters()(e), std::sqrt(order.model->covariance()(e, e)), "um"),
                   {tr("of higher order: at the edge of the measured points")}};
      rows.push_back(std::move(row));
    }
  }
  parameters_->setRows(std::move(rows));
  rows.clear();
  for (const NineParameterResidual& r : f.residuals) {
    Row row;
    row.id =
        QString::fromStdString(r.point) + QLatin1Char('/') + QString::fromStdString(std::string(toString(r.component)));
    Cell name{QString::fromStdString(r.point)};
    name.bold = true;
    Cell in_sigma{std::isfinite(r.residual_um) ? decimalText(std::abs(r.inSigmas()), 'f', 1) : QStringLiteral("–")};
    in_sigma.right = true;
    if (r.outlying()) {
      in_sigma.tone = Tone::Attention;
      in_sigma.icon = "alert";
    }
    Cell residual{std::isfinite(r.residual_um) ? decimalText(r.residual_um, 'f', 2) : QStringLiteral("–")};
    residual.right = true;
    row.cells = {name,
                 {QString::fromStdString(std::string(toString(r.component))) + QStringLiteral(" / µm")},
                 parameterCell(r.value_um, r.sigma_um, ""),
                 residual,
                 in_sigma,
                 {r.used ? (r.weight < 0.99 ? tr("weight %1").arg(decimalText(r.weight, 'f', 2)) : tr("fit"))
                         : tr("validation")}};
    for (const std::size_t i : {1, 2, 3}) row.cells[i].unit = QStringLiteral("um");
    rows.push_back(std::move(row));
  }
  residuals_->setRows(std::move(rows));
  const auto rms = [](const std::optional<double>& v) {
    return v ? QStringLiteral("%1 µm").arg(decimalText(*v, 'f', 2)) : QStringLiteral("–");
  };
  rms_fit_->set(rms(f.rms_fit_um), tr("over the checked points"));
  rms_validation_->set(rms(f.rms_validation_um),
                       f.rms_validation_um ? tr("over the other points") : tr("uncheck a point to validate"));
  condition_->set(std::isfinite(f.condition_number) ? decimalText(f.condition_number, 'g', 3) : QStringLiteral("–"),
                  f.p_value ? tr("χ² test: %1").arg(shownNumbers(QString::fromStdString(pValueText(*f.p_value))))
                            : tr("no degrees of freedom left"));
  showComparison();
  showField();
}

void NineParameterPage::showComparison() {
  comparison_->setRows({});
  if (!result_->not_compared.empty()) return comparison_verdict_->show(Tone::Bad, coreSentence(result_->not_compared));
  if (!result_->compared)
    return comparison_verdict_->show(
        Tone::Neutral, tr("Uncheck at least three points: the checked set is then compared with the other one."));
  const NineParameterComparison& c = *result_->compared;
  std::vector<Row> rows;
  QStringList differing;
  for (int i = 0; i < nine_parameter_count; ++i) {
    const auto cell = [&](bool known, double value, double sigma) {
      return known ? parameterCell(value, sigma, nineParameterUnit(i)) : Cell{QStringLiteral("–")};
    };
    const bool known = c.a.determined(i) && c.b.determined(i);
    Row row;
    row.cells = {nameCell(parameterLabel(std::string(nine_parameter_names[static_cast<std::size_t>(i)]))),
                 cell(c.a.determined(i), c.a.parameters[i], c.a.standardUncertainty(i)),
                 cell(c.b.determined(i), c.b.parameters[i], c.b.standardUncertainty(i)),
                 cell(known, c.difference[i], std::sqrt(std::max(0.0, c.covariance(i, i)))),
                 {known ? decimalText(c.p_value[static_cast<std::size_t>(i)], 'g', 2) : QStringLiteral("–")}};
    if (std::find(c.significant.begin(), c.significant.end(), i) != c.significant.end()) {
      row.cells[3].tone = Tone::Attention;
      row.cells[3].icon = "alert";
      differing << parameterName(i);
    }
    rows.push_back(std::move(row));
  }
  comparison_->setRows(std::move(rows));
  for (const NineParameterFit* fit : {&c.a, &c.b})
    if (fit->status == FitStatus::Rejected) return comparison_verdict_->show(Tone::Bad, coreSentence(fit->message));
  if (differing.isEmpty()) {
    comparison_verdict_->show(Tone::Good,
                              tr("Both sets of points give the same model within their uncertainty (p = %1).")
                                  .arg(decimalText(c.p_value_all, 'g', 2)));
  } else {
    comparison_verdict_->show(
        Tone::Attention, tr("The sets differ in %1: one of them contains an error that the model does not describe.")
                             .arg(differing.join(QStringLiteral(", "))));
  }
}

std::vector<Exportable> NineParameterPage::exportables() {
  std::vector<Exportable> items{exportableOf(tr("Parameters"), parameters_), exportableOf(tr("Residuals"), residuals_)};
  if (field_ != nullptr) {
    const QString name = QString::fromStdString(std::string(toString(field_->component)));
    items.push_back(exportableOf(tr("Heat map %1").arg(name), view_));
    const auto field = field_;
    items.push_back({tr("Heat map %1 values").arg(name), {QStringLiteral("csv")}, [field](const QString& file) {
                       writeFileAtomically(file.toStdString(), field->csv());
                     }});
  }
  return items;
}

}  // namespace spindrift::gui
