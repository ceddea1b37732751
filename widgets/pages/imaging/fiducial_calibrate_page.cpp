// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/imaging/fiducial_calibrate_page.h"

#include <Eigen/Core>
#include <QComboBox>
#include <QHBoxLayout>
#include <QSplitter>
#include <QTabWidget>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "core/base/text.h"
#include "core/workflows/evaluate_campaign.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/panels/thermal/resolution_check_panel.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

Cell dash() {
  Cell cell{QStringLiteral("–")};
  cell.right = true;
  return cell;
}

/// {"value", "standard_uncertainty"} as one text.
Cell cellOf(const nlohmann::json& quantity) {
  Cell cell = dash();
  if (!quantity.is_object() || !quantity.value("value", nlohmann::json()).is_number()) return cell;
  const nlohmann::json sigma = quantity.value("standard_uncertainty", nlohmann::json());
  cell.text = shownNumbers(QString::fromStdString(withUncertainty(quantity["value"].get<double>(),
                                                                  sigma.is_number() ? sigma.get<double>() : 0.0, "")))
                  .trimmed();
  return cell;
}

}  // namespace

FiducialCalibratePage::FiducialCalibratePage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Calibrate, parent) {
  evaluate_ = makeButton(tr("Evaluate the captures"), nullptr, "primary");
  addAction(evaluate_);
  auto* tiles = new Card;
  auto* line = new QHBoxLayout;
  line->setSpacing(16);
  pixel_ = new NumberTile(tr("Pixel length"));
  centre_ = new NumberTile(tr("Centre of rotation in the image"));
  axes_ = new NumberTile(tr("Angle from X to Y"));
  rejected_count_ = new NumberTile(tr("Captures left out"));
  for (NumberTile* tile : {pixel_, centre_, axes_, rejected_count_}) line->addWidget(tile, 1);
  tiles->body()->addLayout(line);
  content()->addWidget(tiles);

  tabs_ = makeTabs(this);
  auto* left = new Card(tr("Deviations"));
  displacements_ = new RowsModel({tr("Fiducial"), tr("State"), tr("EX / µm"), tr("EY / µm"), tr("EZ / µm")}, this);
  left->body()->addWidget(
      makeTable(displacements_, tr("Deviations"), tr("Deviations of each fiducial appear after the evaluation.")), 1);
  auto* right = new Card(tr("Contrast over height"));
  fiducial_ = new QComboBox;
  fiducial_->setAccessibleName(tr("Fiducial whose contrast curves are shown"));
  fiducial_->setMinimumWidth(120);
  right->addToTitle(fiducial_);
  connect(fiducial_, &QComboBox::activated, this, &FiducialCalibratePage::showContrast);
  contrast_ = new Plot;
  contrast_->setAxes(tr("Commanded height / µm"), tr("Contrast, normalised"));
  contrast_->setEmptyText(tr("Contrast curves will appear here"),
                          tr("Evaluate the captures: the peak of each curve is the height of its fiducial."));
  right->body()->addWidget(contrast_, 1);
  tabs_->addTab(makeSplitter(nullptr, left, right, 6, 6), tr("Deviations"));
  const auto add = [this](QWidget* content, const QString& title) {
    auto* card = new Card;
    card->body()->addWidget(content, 1);
    tabs_->addTab(card, title);
  };
  sets_ = new RowsModel({tr("Fiducial"), tr("State"), tr("Centre x / px"), tr("Centre y / px"), tr("Scatter / µm"),
                         tr("X to Y − 90° / µrad"), tr("Peak / µm")},
                        this);
  add(makeTable(sets_, tr("Sets"), tr("Centres, directions and heights appear after the evaluation.")), tr("Sets"));
  rejected_ = new RowsModel({tr("Capture"), tr("Why it was left out")}, this);
  add(makeSentenceTable(rejected_, tr("Left out"), tr("Nothing was left out.")), tr("Left out"));
  auto* checks = new QWidget;
  auto* checks_column = new QVBoxLayout(checks);
  checks_column->setContentsMargins(0, 0, 0, 0);
  check_kind_ = new QComboBox;
  check_kind_->setAccessibleName(tr("What the states are"));
  check_kind_->addItems({tr("The states are thermal states: nothing to check"), tr("Jogs within one resolution"),
                         tr("Cold repeatability within half the resolution")});
  checks_column->addWidget(check_kind_);
  check_verdict_ = new Callout;
  checks_column->addWidget(check_verdict_);
  resolution_ = new RowsModel(
      {tr("Axis"), tr("Largest / µm"), tr("At"), tr("rms / µm"), tr("Allowed / µm"), tr("Verdict")}, this);
  checks_column->addWidget(makeTable(resolution_, tr("Check against the resolution"),
                                     tr("Say what the states are to compare them with the resolution of the axes.")),
                           1);
  add(checks, tr("Resolution"));
  auto* comparison = new QWidget;
  auto* comparison_column = new QVBoxLayout(comparison);
  comparison_column->setContentsMargins(0, 0, 0, 0);
  circles_verdict_ = new Callout;
  comparison_column->addWidget(circles_verdict_);
  circles_ = new RowsModel({tr("Fiducial"), tr("State"), tr("Joint x / px"), tr("Joint y / px"), tr("Circles x / px"),
                            tr("Circles y / px"), tr("Difference in x / µm"), tr("Difference in y / µm"), tr("Tracks")},
                           this);
  comparison_column->addWidget(
      makeTable(circles_, tr("Circles"),
                tr("No mark was seen in enough spindle orientations for a circle through its track.")),
      1);
  add(comparison, tr("Circles"));
  connect(check_kind_, &QComboBox::activated, this, &FiducialCalibratePage::checkResolution);
  content()->addWidget(tabs_, 1);
  showHints(contrast_);
  connect(evaluate_, &QPushButton::clicked, this, [this] { runTask("evaluate"); });
}

void FiducialCalibratePage::refresh() {
  if (session().campaign() == nullptr) return;
  const auto evaluation = session().evaluation();
  const ResultState state = session().state("evaluate");
  if (evaluation == nullptr) {
    displacements_->setRows({});
    sets_->setRows({});
    rejected_->setRows({});
    circles_->setRows({});
    circles_verdict_->set(Tone::Neutral, {});
    contrast_->setContent({});
    fiducial_->clear();
    for (NumberTile* tile : {pixel_, centre_, axes_, rejected_count_}) tile->set(QStringLiteral("–"));
    callout()->show(Tone::Accent, tr("Press Evaluate the captures. Those that cannot be used are listed with the "
                                     "reason, the others are evaluated."));
    return;
  }
  if (!state.current) {
    callout()->show(Tone::Outdated, tr("Changed since this was evaluated: %1. Evaluate again.").arg(state.changed));
  } else if (!evaluation->good_enough || !evaluation->warnings.empty() || !evaluation->rejected.empty()) {
    QStringList sentences;
    if (!evaluation->rejected.empty()) sentences << context().workflow.status(step()).sentence;  // how many of how many
    for (const EvaluationWarning& w : evaluation->warnings) sentences << coreSentence(w.sentence);
    callout()->show(Tone::Attention,
                    sentences.mid(0, 2).join(QLatin1Char(' ')) +
                        (sentences.size() > 2 ? tr(" And %1 more.").arg(sentences.size() - 2) : QString()));
  } else {
    callout()->show(Tone::Good, tr("Deviations found: %1, no warnings.").arg(evaluation->observations.rows.size()));
  }
  showDetails(*evaluation);
}

void FiducialCalibratePage::showDetails(const StoredEvaluation& evaluation) {
  std::map<std::pair<std::string, std::string>, std::map<Component, const Observation*>> table;
  std::vector<std::pair<std::string, std::string>> order;
  for (const Observation& o : evaluation.observations.rows) {
    const auto key = std::make_pair(o.point, o.state);
    if (!table.contains(key)) order.push_back(key);
    table[key][o.component] = &o;
  }
  std::vector<Row> rows;
  for (const auto& key : order) {
    Row row;
    row.id = QString::fromStdString(key.second + "/" + key.first);
    Cell name{QString::fromStdString(key.first)};
    name.bold = true;
    row.cells = {name, {QString::fromStdString(key.second)}};
    for (const Component c : {Component::EX, Component::EY, Component::EZ}) {
      const auto found = table[key].find(c);
      Cell cell;
      cell.right = true;
      cell.text =
          found == table[key].end()
              ? QStringLiteral("–")
              : shownNumbers(QString::fromStdString(withUncertainty(found->second->value, found->second->sigma, "")))
                    .trimmed();
      row.cells.push_back(cell);
    }
    rows.push_back(std::move(row));
  }
  displacements_->setRows(std::move(rows));
  rows.clear();
  for (const RejectedCapture& r : evaluation.rejected) {
    Row row;
    row.id = QString::fromStdString(r.capture);
    row.cells = {{coreSentence(r.capture), Tone::Bad, "error"}, {coreSentence(r.reason)}};
    row.cells[1].tip = row.cells[1].text;
    rows.push_back(std::move(row));
  }
  tabs_->setTabText(2, tr("Left out (%1)").arg(rows.size()));
  rejected_count_->set(QString::number(rows.size()), rows.empty() ? tr("every capture was used") : tr("see the list"),
                       rows.empty() ? Tone::Neutral : Tone::Attention);
  rejected_->setRows(std::move(rows));
  showSets(evaluation);
  showCircles(evaluation);
  showContrast();
  showChosenCheck();
}

void FiducialCalibratePage::checkResolution() {
  const std::string task = chosenCheck();
  if (task.empty() || session().state(task).current || !canRun(task)) {
    showChosenCheck();
    return;
  }
  runTask(task, {.done = [this] { showChosenCheck(); }, .failed = [this](const QString&) { showChosenCheck(); }});
}

std::string FiducialCalibratePage::chosenCheck() const {
  constexpr std::array tasks{"", "check-jogs", "check-repeatability"};
  return tasks[static_cast<std::size_t>(std::max(0, check_kind_->currentIndex()))];
}

void FiducialCalibratePage::showChosenCheck() {
  check_verdict_->set(Tone::Neutral, {});
  const std::string task = chosenCheck();
  const auto check = task.empty() ? std::nullopt : showResolutionCheck(session(), task, *check_verdict_);
  std::vector<Row> rows;
  for (const AxisVerdict& v : check ? check->axes : std::vector<AxisVerdict>()) {
    Row row;
    row.id = QString::fromStdString(std::string(toString(v.component)));
    Cell name{row.id};
    name.bold = true;
    row.cells = {
        name,
        {shownNumbers(QString::fromStdString(withUncertainty(v.largest_um, v.largest_sigma_um, ""))).trimmed()},
        {QString::fromStdString(v.largest_at)},
        {decimalText(v.rms_um, 'f', 2)},
        {decimalText(v.limit_um, 'f', 2)},
        {v.passed ? tr("passed") : tr("not passed"), v.passed ? Tone::Good : Tone::Bad,
         v.passed ? "check-circle" : "error"}};
    rows.push_back(std::move(row));
  }
  resolution_->setRows(std::move(rows));
}

void FiducialCalibratePage::showSets(const StoredEvaluation& evaluation) {
  const nlohmann::json& d = evaluation.details;
  std::vector<Row> rows;
  nlohmann::json centre;
  const QString chosen = fiducial_->currentText();
  fiducial_->clear();
  for (const auto& fiducial : d.value("fiducials", nlohmann::json::array())) {
    const QString name = QString::fromStdString(fiducial.value("fiducial", std::string()));
    fiducial_->addItem(name);
    for (const auto& state : fiducial.value("states", nlohmann::json::array())) {
      Row row;
      row.id = name + QLatin1Char('/') + QString::fromStdString(state.value("state", std::string()));
      Cell first{name};
      first.bold = true;
      row.cells = {first, {QString::fromStdString(state.value("state", std::string()))}};
      const nlohmann::json c = state.value("centre_of_rotation", nlohmann::json());
      const nlohmann::json a = state.value("axis_directions", nlohmann::json());
      const nlohmann::json f = state.value("focus", nlohmann::json());
      if (c.is_object() && centre.is_null()) centre = c;
      row.cells.push_back(c.is_object() ? cellOf(c.value("x_px", nlohmann::json())) : dash());
      row.cells.push_back(c.is_object() ? cellOf(c.value("y_px", nlohmann::json())) : dash());
      Cell scatter = dash();
      if (c.is_object() && c.value("rms_um", nlohmann::json()).is_number()) {
        scatter.text = decimalText(c["rms_um"].get<double>(), 'f', 2);
      }
      row.cells.push_back(scatter);
      row.cells.push_back(cellOf(a.is_object() ? a.value("orthogonality_urad", nlohmann::json()) : nlohmann::json()));
      row.cells.push_back(f.is_object() ? cellOf(f.value("peak_z_um", nlohmann::json())) : dash());
      rows.push_back(std::move(row));
    }
  }
  sets_->setRows(std::move(rows));
  fiducial_->setCurrentIndex(std::max(0, fiducial_->findText(chosen)));

  const nlohmann::json camera = d.value("camera", nlohmann::json::object());
  const nlohmann::json length = camera.value("pixel_length_um", nlohmann::json());
  pixel_->set(
      length.is_number() ? QStringLiteral("%1 µm").arg(decimalText(length.get<double>(), 'f', 4)) : QStringLiteral("–"),
      tr("from the pattern itself"));
  const nlohmann::json pooled = d.value("centre_of_rotation", nlohmann::json::object());
  if (centre.is_object()) {
    const double x = centre["x_px"].value("value", 0.0);
    const double y = centre["y_px"].value("value", 0.0);
    const double s = centre["x_px"].value("standard_uncertainty", 0.0);
    const QString pooling = coreSentence(pooled.value("pooling", std::string("?")));
    centre_->set(tr("%1, %2 px", "place in an image").arg(decimalText(x, 'f', 1)).arg(decimalText(y, 'f', 1)),
                 tr("± %1 px, %2; spindle repeats to %3 µm")
                     .arg(decimalText(s, 'f', 2))
                     .arg(pooling)
                     .arg(decimalText(pooled.value("spindle_repeatability_um", 0.0), 'f', 2)));
  } else {
    centre_->set(QStringLiteral("–"), tr("needs three spindle orientations"));
  }
  const nlohmann::json mean = d.value("orthogonality_urad", nlohmann::json());
  if (mean.is_object()) {
    axes_->set(shownNumbers(
                   QString::fromStdString(withUncertainty(mean.at("value"), mean.at("standard_uncertainty"), "urad"))),
               tr("deviation from 90°, mean of all fiducials"));
  } else {
    axes_->set(QStringLiteral("–"), tr("needs positions along both axes"));
  }
}

void FiducialCalibratePage::showCircles(const StoredEvaluation& evaluation) {
  const nlohmann::json& d = evaluation.details;
  const nlohmann::json length = d.value("camera", nlohmann::json::object()).value("pixel_length_um", nlohmann::json());
  std::vector<Row> rows;
  for (const auto& fiducial : d.value("fiducials", nlohmann::json::array())) {
    for (const auto& state : fiducial.value("states", nlohmann::json::array())) {
      const nlohmann::json c = state.value("centre_of_rotation", nlohmann::json());
      if (!c.is_object() || !c.value("algebraic_px", nlohmann::json()).is_array() || !length.is_number()) continue;
      Row row;
      const QString name = QString::fromStdString(fiducial.value("fiducial", std::string()));
      const QString at = QString::fromStdString(state.value("state", std::string()));
      row.id = name + QLatin1Char('/') + at;
      Cell first{name};
      first.bold = true;
      row.cells = {first, {at}, cellOf(c.value("x_px", nlohmann::json())), cellOf(c.value("y_px", nlohmann::json()))};
      const std::array<double, 2> circles{c["algebraic_px"][0].get<double>(), c["algebraic_px"][1].get<double>()};
      const auto number = [&](double value, int decimals) {
        Cell cell{decimalText(value, 'f', decimals)};
        cell.right = true;
        row.cells.push_back(cell);
      };
      for (const double value : circles) number(value, 2);
      number((circles[0] - c["x_px"].value("value", 0.0)) * length.get<double>(), 1);
      number((circles[1] - c["y_px"].value("value", 0.0)) * length.get<double>(), 1);
      number(c.value("algebraic_tracks", 0), 0);
      rows.push_back(std::move(row));
    }
  }
  circles_->setRows(std::move(rows));
  const nlohmann::json pooled =
      d.value("centre_of_rotation", nlohmann::json::object()).value("algebraic_minus_joint_um", nlohmann::json());
  if (!pooled.is_object()) {
    circles_verdict_->set(Tone::Neutral, {});
    return;
  }
  circles_verdict_->show(
      Tone::Neutral,
      tr("Algebraic circles through the tracks of the marks lie %1, %2 µm from the joint "
         "evaluation in the mean, scatter %3, %4 µm: short arcs pull them. They are shown for comparison "
         "and not used.")
          .arg(decimalText(pooled["mean"][0].get<double>(), 'f', 1))
          .arg(decimalText(pooled["mean"][1].get<double>(), 'f', 1))
          .arg(decimalText(pooled["standard_deviation"][0].get<double>(), 'f', 1))
          .arg(decimalText(pooled["standard_deviation"][1].get<double>(), 'f', 1)));
}

void FiducialCalibratePage::showContrast() {
  const auto evaluation = session().evaluation();
  if (evaluation == nullptr) return;
  if (curves_of_ != evaluation) {
    contrast_->setContent({});
    return display(tr("Reading the contrast curves"), [this, evaluation](JobContext&) -> std::function<void()> {
      return [this, evaluation, curves = contrastCurves(evaluation->details)] {
        curves_of_ = evaluation;
        curves_ = curves;
        showContrast();
      };
    });
  }
  std::vector<Series> series;
  int colour = 0;
  for (const ContrastCurve& curve : curves_) {
    if (fromCore(curve.fiducial) != fiducial_->currentText()) continue;
    Series measured;
    measured.name = tr("state %1").arg(fromCore(curve.state));
    measured.style = SeriesStyle::Points;
    measured.colour = colour;
    measured.x = curve.height_um;
    measured.y = curve.contrast;
    if (!curve.fitted.empty()) {
      Series fitted;
      fitted.style = SeriesStyle::Line;
      fitted.colour = colour;
      fitted.legend = false;
      fitted.x = curve.fitted_height_um;
      fitted.y = curve.fitted;
      series.push_back(std::move(fitted));
    }
    series.push_back(std::move(measured));
    ++colour;
  }
  contrast_->setContent(std::move(series));
}

std::vector<Exportable> FiducialCalibratePage::exportables() {
  std::vector<Exportable> items{exportableOf(tr("Deviations"), displacements_), exportableOf(tr("Left out"), rejected_),
                                exportableOf(tr("Circles"), circles_)};
  if (!contrast_->empty()) items.push_back(exportableOf(tr("Contrast curves"), contrast_));
  return items;
}

}  // namespace spindrift::gui
