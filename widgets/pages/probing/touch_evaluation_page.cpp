// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/probing/touch_evaluation_page.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QSplitter>
#include <QTabWidget>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/workflows/evaluate_campaign.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/preferences.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/common/callout_note.h"
#include "widgets/panels/probing/reference_panel.h"
#include "widgets/plots/plot.h"
#include "widgets/services/touch_results.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

QWidget* withVerdict(Callout* verdict, QWidget* table) {
  auto* page = new QWidget;
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(verdict);
  column->addWidget(table, 1);
  return page;
}

QString stationName(const ProbedFeature& f, bool holes) {
  if (!holes) return QStringLiteral("%1 / %2").arg(fromCore(f.feature), fromCore(f.stylus));
  return f.c_deg == 0.0 ? fromCore(f.feature) : QStringLiteral("%1 @ %2°").arg(fromCore(f.feature)).arg(f.c_deg);
}

QString lengthError(double error_um, double standard_uncertainty_um) {
  return shownNumbers(fromCore(withUncertainty(error_um, standard_uncertainty_um, "um")));
}

}  // namespace

TouchEvaluationPage::TouchEvaluationPage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Calibrate, parent), results_(TouchResults::of(session(), context().jobs)) {
  setInstruction(tr("Turn touches into features and deviations, and see whether probe and artefact can be trusted."));
  evaluate_ = makeButton(tr("Evaluate the touches"), nullptr, "primary");
  addAction(evaluate_);
  auto* tiles = new Card;
  auto* line = new QHBoxLayout;
  line->setSpacing(24);
  used_ = new NumberTile(tr("Touches used"));
  noise_ = new NumberTile(tr("Touch noise"));
  length_ = new NumberTile(tr("Largest length error"));
  probe_ = new NumberTile(tr("Probe"));
  for (NumberTile* tile : {used_, noise_, length_, probe_}) line->addWidget(tile, 1);
  tiles->body()->addLayout(line);
  content()->addWidget(tiles);

  tabs_ = makeTabs(this);
  auto* left = new Card(tr("Features"));
  cycle_ = new QComboBox;
  cycle_->setAccessibleName(tr("Cycle whose features are listed"));
  cycle_->setMinimumWidth(120);
  left->addToTitle(cycle_);
  features_ = new RowsModel(
      {tr("Feature"), tr("x / mm"), tr("y / mm"), tr("z / mm"), tr("± / µm"), tr("D / mm"), tr("Form / µm")}, this);
  left->body()->addWidget(makeTable(features_, tr("Features"),
                                    tr("Centre, diameter and form of every hole or ball appear after the evaluation.")),
                          1);
  auto* right = new Card(tr("Deviation over time"));
  point_ = new QComboBox;
  point_->setAccessibleName(tr("Feature whose deviations are shown"));
  point_->setMinimumWidth(140);
  right->addToTitle(point_);
  plot_ = new Plot;
  plot_->setAxes(tr("Time / h"), tr("Deviation / µm"));
  plot_->setEmptyText(tr("Deviations will appear here"),
                      tr("Evaluate the touches: every feature is compared with the first cycle."));
  right->body()->addWidget(plot_, 1);
  tabs_->addTab(makeSplitter(nullptr, left, right, 9, 5), tr("Features"));
  const auto add = [this](QWidget* content, const QString& title) {
    auto* card = new Card;
    card->body()->addWidget(content, 1);
    tabs_->addTab(card, title);
  };
  left_out_ = new RowsModel({tr("Touch"), tr("Why it was left out")}, this);
  add(makeSentenceTable(left_out_, tr("Left out"), tr("Nothing was left out.")), tr("Left out"));
  lengths_ = new RowsModel({}, this);
  add(makeTable(lengths_, tr("Lengths"), tr("Distances and straightness appear after the evaluation.")), tr("Lengths"));
  comparison_verdict_ = new Callout;
  comparison_ = new RowsModel({}, this);
  grown_ = new Plot;
  grown_->setEmptyText(
      tr("The expansion of the artefact will appear here"),
      tr("Its temperature and its expansion coefficient say how much it expands from cycle to cycle."));
  add(makeSplitter(nullptr,
                   withVerdict(comparison_verdict_,
                               makeTable(comparison_, tr("Comparison"),
                                         tr("Nothing to compare with: balls need three styli, a bar of holes its "
                                            "certificate or its expansion coefficient with a thermometer."))),
                   grown_, 7, 6),
      tr("Comparison"));
  repeatability_verdict_ = new Callout;
  repeatability_ =
      new RowsModel({tr("Parameter"), tr("Repeatability, k = 2"), tr("From touch noise"), tr("Unit")}, this);
  add(withVerdict(repeatability_verdict_,
                  makeTable(repeatability_, tr("Repeatability"), tr("Repeatability requires at least 18 cycles."))),
      tr("Repeatability"));
  health_verdict_ = new Callout;
  health_ = new RowsModel({tr("Stylus"), tr("Sphere"), tr("Radius / mm"), tr("Pre-travel / µm"),
                           tr("Repeatability / µm"), tr("Step / µm"), tr("Verdict")},
                          this);
  add(withVerdict(health_verdict_, makeTable(health_, tr("Health of the probe"),
                                             tr("Touch a sphere from at least five directions to qualify the styli."))),
      tr("Probe"));
  reference_ = new ReferencePanel(context());
  add(reference_, tr("Reference"));
  content()->addWidget(tabs_, 1);
  showHints(plot_);
  showHints(grown_);
  connect(&results_, &TouchResults::read, this, [this] {
    if (isVisible()) refresh();
  });
  connect(evaluate_, &QPushButton::clicked, this, [this] { runTask("evaluate"); });
  connect(cycle_, &QComboBox::activated, this, &TouchEvaluationPage::showFeatures);
  connect(point_, &QComboBox::activated, this, &TouchEvaluationPage::showDeviations);
}

TaskInputs TouchEvaluationPage::taskInputs() {
  TaskInputs inputs = session().taskInputs();
  inputs.touches = results_.asListed();
  return inputs;
}

void TouchEvaluationPage::clear() {
  for (RowsModel* rows : {features_, left_out_, lengths_, comparison_, repeatability_, health_}) rows->setRows({});
  plot_->setContent({});
  grown_->setContent({});
  cycle_->clear();
  point_->clear();
  comparison_verdict_->set(Tone::Neutral, {});
  repeatability_verdict_->set(Tone::Neutral, {});
  health_verdict_->set(Tone::Neutral, {});
  reference_->setCycles(nullptr);
  for (NumberTile* tile : {used_, noise_, length_, probe_}) tile->set(QStringLiteral("–"));
}

void TouchEvaluationPage::refresh() {
  if (session().campaign() == nullptr) return;
  if (noticeCampaign()) {
    details_ = {};
    clear();
  }
  const auto list = results_.touches();
  const ShownTask beside = shown("evaluate", tr("Reading the evaluation"));
  if (list == nullptr) {
    callout()->show(results_.reading() ? Tone::Neutral : Tone::Bad, results_.whyNone());
    return;
  }
  const auto stored = session().evaluation();
  if (stored == nullptr) {
    clear();
    callout()->show(Tone::Accent, tr("Press Evaluate the touches. Those that cannot be used are listed with the "
                                     "reason, the others are evaluated."));
    return;
  }
  const ResultState& state = beside.state;
  if (!state.current) {
    callout()->show(Tone::Outdated, tr("Changed since this was evaluated: %1. Evaluate again.").arg(state.changed));
  } else if (!stored->good_enough || !stored->warnings.empty() || !stored->rejected.empty()) {
    QStringList sentences;
    if (!stored->rejected.empty()) sentences << context().workflow.status(step()).sentence;  // how many of how many
    for (const EvaluationWarning& w : stored->warnings) sentences << coreSentence(w.sentence);
    callout()->show(Tone::Attention,
                    sentences.mid(0, 2).join(QLatin1Char(' ')) +
                        (sentences.size() > 2 ? tr(" And %1 more.").arg(sentences.size() - 2) : QString()));
  } else {
    callout()->show(Tone::Good, tr("Deviations found: %1.").arg(stored->observations.rows.size()));
  }
  if (!beside.reading) {
    const auto given = beside.as<EvaluationDetail>();
    details_ = given == nullptr ? EvaluationDetail() : *given;
    if (given == nullptr) clear();
  }
  const CycleEvaluation* cycles = cyclesOf(details_.touches.get());
  if (beside.reading || cycles == nullptr) {
    showDeviations();
    return;
  }
  const QString chosen = cycle_->currentText();
  cycle_->clear();
  for (const std::string& name : cycles->cycles) cycle_->addItem(fromCore(name));
  const int at = cycle_->findText(chosen);
  cycle_->setCurrentIndex(at >= 0 ? at : cycle_->count() - 1);
  if (details_.touches->hole_cycles.size() + details_.touches->ball_cycles.size() > 1) {
    addNote(*callout(), tr("This page shows %1. The other artefacts are evaluated too: their deviations stand in the "
                           "observations and in the report.")
                            .arg(fromCore(cycles->artefact)));
  }
  showTiles(*cycles);
  showFeatures();
  showLeftOut(*details_.touches, *cycles);
  showLengths();
  showComparison();
  showRepeatability();
  showHealth();
  showDeviations();
  reference_->setCycles(details_.touches);
}

void TouchEvaluationPage::showTiles(const CycleEvaluation& cycles) {
  const auto used = static_cast<std::size_t>(std::count(cycles.fit.used.begin(), cycles.fit.used.end(), true));
  used_->set(QString::number(used),
             cycles.rejected.empty() ? tr("none left out") : tr("%1 left out").arg(cycles.rejected.size()),
             cycles.rejected.empty() ? Tone::Neutral : Tone::Attention);
  const auto& sigma = cycles.fit.group_sigma_mm;
  if (!sigma.empty()) {
    QString note = tr("across the surface, one standard deviation");
    if (sigma.size() > 1) note = tr("%1 µm along the axis").arg(decimalText(sigma[1] * um_per_mm, 'f', 2));
    noise_->set(QStringLiteral("%1 µm").arg(decimalText(sigma[0] * um_per_mm, 'f', 2)), note);
  }
  if (!details_.touches->hole_cycles.empty()) {
    const HoleCycleResult& holes = details_.touches->hole_cycles.front();
    const auto largest = std::max_element(holes.linearity.begin(), holes.linearity.end(),
                                          [](const LinearityDeviation& a, const LinearityDeviation& b) {
                                            return std::abs(a.largest_um) < std::abs(b.largest_um);
                                          });
    length_->set(largest == holes.linearity.end() ? QStringLiteral("–")
                                                  : lengthError(std::abs(largest->largest_um), largest->sigma_um),
                 tr("deviation of a hole from the straight line, all cycles"));
  } else {
    const auto& distances = details_.touches->ball_cycles.front().distances;
    const auto largest =
        std::max_element(distances.begin(), distances.end(), [](const BallDistance& a, const BallDistance& b) {
          return std::abs(a.error_um) < std::abs(b.error_um);
        });
    length_->set(largest == distances.end()
                     ? QStringLiteral("–")
                     : lengthError(std::abs(largest->error_um), largest->standard_uncertainty_um),
                 tr("of a distance between balls"));
  }
  int known = 0;
  int healthy = 0;
  for (const StylusHealth& h : details_.health) {
    if (h.status != FitStatus::Converged) continue;
    ++known;
    if (h.healthy) ++healthy;
  }
  if (known == 0) {
    probe_->set(tr("not judged"), tr("needs touches on a sphere"));
  } else {
    probe_->set(tr("%1 of %2").arg(healthy).arg(known), tr("stylus-sphere pairs repeat"));
  }
}

void TouchEvaluationPage::showFeatures() {
  const CycleEvaluation* cycles = cyclesOf(details_.touches.get());
  if (cycles == nullptr) return;
  const bool holes = !details_.touches->hole_cycles.empty();
  std::vector<Row> rows;
  for (const ProbedFeature& f : cycles->features) {
    if (fromCore(f.cycle) != cycle_->currentText()) continue;
    Row row;
    const QString name = stationName(f, holes);
    row.id = fromCore(f.cycle) + QLatin1Char('/') + name;
    const bool good = f.status == FitStatus::Converged;
    row.cells = {good ? nameCell(name) : toneCell(name, Tone::Bad)};
    row.cells.front().tip = coreSentence(f.message);
    double largest_sigma = 0;
    for (int k = 0; k < 3; ++k) {
      row.cells.push_back(numberCell(good ? f.centre_mm(k) : std::nan(""), lengthDecimals(4)));
      largest_sigma = std::max(largest_sigma, std::sqrt(f.covariance(k, k)) * um_per_mm);
    }
    row.cells.push_back(numberCell(good ? largest_sigma : std::nan(""), 2));
    row.cells.back().tip = tr("The largest standard uncertainty of x, y and z");
    row.cells.push_back(numberCell(good ? f.diameter_mm : std::nan(""), lengthDecimals(4)));
    row.cells.back().tip = quantityText(f.diameter_mm, f.diameter_sigma_mm, QStringLiteral("mm"));
    row.cells.push_back(numberCell(good ? f.form_mm * um_per_mm : std::nan(""), 2));
    rows.push_back(std::move(row));
  }
  features_->setRows(std::move(rows));
}

void TouchEvaluationPage::showLeftOut(const TouchEvaluation& evaluation, const CycleEvaluation& cycles) {
  std::vector<Row> rows;
  for (const RejectedTouch& r : cycles.rejected) {
    const Touch& t = evaluation.touches.touches[r.touch];
    Row row;
    row.id = fromCore(t.id());
    row.cells = {toneCell(fromCore(t.label()), Tone::Bad), Cell{coreSentence(r.reason)}};
    row.cells[1].tip = row.cells[1].text;
    rows.push_back(std::move(row));
  }
  for (const Touch& t : evaluation.excluded) {
    Row row;
    row.id = fromCore(t.id());
    const auto reason = session().excluded().find(row.id);
    row.cells = {Cell{fromCore(t.label())},
                 Cell{tr("excluded: %1").arg(reason == session().excluded().end() ? QString() : reason->second)}};
    row.faded = true;
    rows.push_back(std::move(row));
  }
  tabs_->setTabText(1, tr("Left out (%1)").arg(rows.size()));
  left_out_->setRows(std::move(rows));
}

void TouchEvaluationPage::showLengths() {
  std::vector<Row> rows;
  if (!details_.touches->hole_cycles.empty()) {
    lengths_->setHeaders({tr("Hole"), tr("rms / µm"), tr("Largest / µm"), tr("In cycle"), tr("Noise / µm")});
    tabs_->setTabText(2, tr("Straight line"));
    for (const LinearityDeviation& d : details_.touches->hole_cycles.front().linearity) {
      Row row;
      row.id = fromCore(d.feature);
      row.cells = {nameCell(row.id), numberCell(d.rms_um, 2), numberCell(d.largest_um, 2),
                   Cell{fromCore(d.largest_cycle)}, numberCell(d.sigma_um, 2)};
      rows.push_back(std::move(row));
    }
  } else {
    lengths_->setHeaders(
        {tr("Balls"), tr("Cycle"), tr("Stylus"), tr("Error / µm"), tr("Calibrated / mm"), tr("Verdict")});
    tabs_->setTabText(2, tr("Distances"));
    for (const BallDistance& d : details_.touches->ball_cycles.front().distances) {
      Row row;
      row.id = fromCore(d.cycle + d.stylus + d.from + d.to);
      const bool inside = std::abs(d.error_um) <= 2.0 * d.standard_uncertainty_um;
      row.cells = {nameCell(fromCore(d.from + " – " + d.to)),
                   Cell{fromCore(d.cycle)},
                   Cell{fromCore(d.stylus)},
                   quantityCell(d.error_um, d.standard_uncertainty_um),
                   numberCell(d.certified_mm, lengthDecimals(4)),
                   inside ? toneCell(tr("within two uncertainties"), Tone::Good)
                          : toneCell(tr("the machine differs"), Tone::Attention)};
      rows.push_back(std::move(row));
    }
  }
  lengths_->setRows(std::move(rows));
}

void TouchEvaluationPage::showComparison() {
  // What states no uncertainty has no figure that would tell its digits.
  const auto grownCell = [](double value, double standard_uncertainty) {
    return standard_uncertainty > 0.0 ? quantityCell(value, standard_uncertainty) : numberCell(value, 1);
  };
  std::vector<Row> rows;
  if (!details_.touches->hole_cycles.empty()) {
    const HoleCycleResult& holes = details_.touches->hole_cycles.front();
    tabs_->setTabText(3, tr("Certificate"));
    grown_->show();
    const TimeUnit time = timeUnit(holes.cycle_time_s.empty() ? 0.0 : holes.cycle_time_s.back());
    Series expected{tr("coefficient × temperature")};
    Series touched{tr("touches")};
    touched.colour = 1;
    // A bar without certified positions has nothing to show against them.
    const bool any_certified = !holes.against_certificate.empty();
    QStringList headers{tr("Cycle")};
    if (any_certified)
      headers << tr("Bar / °C") << tr("%1 against certificate / (µm/m)").arg(fromCore(holes.setup.linear));
    headers << tr("Expansion, coefficient × temperature / (µm/m)") << tr("Expansion, touches / (µm/m)");
    comparison_->setHeaders(headers);
    for (const std::string& cycle : holes.cycles) {
      const auto lengths = std::find_if(holes.against_certificate.begin(), holes.against_certificate.end(),
                                        [&](const CertifiedLengths& c) { return c.cycle == cycle; });
      const auto growth = std::find_if(holes.growth.begin(), holes.growth.end(),
                                       [&](const ExpectedGrowth& g) { return g.cycle == cycle; });
      const bool certified = lengths != holes.against_certificate.end();
      const bool grown = growth != holes.growth.end();
      if (!certified && !grown) continue;
      if (grown) {
        const auto k = static_cast<std::size_t>(&cycle - holes.cycles.data());
        for (Series* series : {&expected, &touched}) series->x.push_back(holes.cycle_time_s[k] / time.seconds);
        expected.y.push_back(growth->expected_um_per_m);
        expected.sigma.push_back(growth->expected_sigma_um_per_m);
        touched.y.push_back(growth->measured_um_per_m);
        touched.sigma.push_back(growth->measured_sigma_um_per_m);
      }
      Row row;
      row.id = fromCore(cycle);
      row.cells = {nameCell(row.id)};
      if (any_certified) {
        row.cells.push_back(certified && lengths->temperature_degC ? numberCell(*lengths->temperature_degC, 2)
                                                                   : dashCell());
        row.cells.push_back(certified ? quantityCell(lengths->slope_um_per_m, lengths->standard_uncertainty_um_per_m)
                                      : dashCell());
      }
      row.cells.push_back(grown ? grownCell(growth->expected_um_per_m, growth->expected_sigma_um_per_m) : dashCell());
      row.cells.push_back(grown ? quantityCell(growth->measured_um_per_m, growth->measured_sigma_um_per_m)
                                : dashCell());
      rows.push_back(std::move(row));
    }
    grown_->setAxes(tr("Time / %1").arg(time.name), tr("Expansion / (µm/m)"));
    grown_->setContent(expected.x.empty() ? std::vector<Series>{} : std::vector<Series>{expected, touched});
    if (rows.empty()) {
      comparison_verdict_->set(Tone::Neutral, {});
    } else {
      comparison_verdict_->show(
          Tone::Neutral,
          holes.growth_combined
              ? tr("EME combines touches with expansion coefficient and temperature by their uncertainties; the "
                   "certificate counts in EME and EXX.")
              : tr("EME rests on the touches: coefficient and temperature are combined with them only where both state "
                   "their uncertainty and do not contradict them."));
    }
  } else {
    tabs_->setTabText(3, tr("Closed forms"));
    grown_->hide();
    comparison_->setHeaders({tr("Cycle"), tr("Ball"), tr("Closed forms X, Y, Z / µrad"),
                             tr("Joint evaluation X, Y, Z / µrad"), tr("Stylus 0 moved / µm"), tr("Joint drift / µm")});
    double off_urad = 0.0;
    for (const HeadComparison& c : details_.touches->ball_cycles.front().closed_forms) {
      Row row;
      row.id = fromCore(c.cycle + "/" + c.ball);
      QStringList closed;
      QStringList joint;
      for (int k = 0; k < 3; ++k) {
        closed << (c.closed_form_urad ? decimalText((*c.closed_form_urad)(k), 'f', 1) : QStringLiteral("–"));
        joint << shownNumbers(QString::fromStdString(withUncertainty(c.joint_urad(k), c.joint_sigma_urad(k), "")))
                     .trimmed();
      }
      if (c.closed_form_urad) off_urad = std::max(off_urad, (*c.closed_form_urad - c.joint_urad).cwiseAbs().maxCoeff());
      row.cells = {nameCell(fromCore(c.cycle)),
                   Cell{fromCore(c.ball)},
                   Cell{closed.join(QStringLiteral("; "))},
                   Cell{joint.join(QStringLiteral("; "))},
                   numberCell(c.spindle_drift_um, 2),
                   numberCell(c.joint_drift_um, 2)};
      row.cells[2].tip = coreSentence(c.message);
      rows.push_back(std::move(row));
    }
    if (rows.empty()) {
      comparison_verdict_->set(Tone::Neutral, {});
    } else {
      comparison_verdict_->show(Tone::Neutral,
                                tr("The closed forms take every translation for a rotation of the head: here they "
                                   "are off by up to %1 µrad. They are shown for comparison and not used.")
                                    .arg(decimalText(off_urad, 'f', 1)));
    }
  }
  comparison_->setRows(std::move(rows));
}

void TouchEvaluationPage::showRepeatability() {
  const RepeatabilityStudy& study = details_.repeatability;
  std::vector<Row> rows;
  for (const Repeatability& r : study.parameters) {
    Row row;
    row.id = fromCore(r.name);
    row.cells = {nameCell(parameterTitle(r.name)), quantityCell(r.repeatability, r.standard_uncertainty),
                 numberCell(r.expected, 2), Cell{parameterUnit(r.name)}};
    for (const std::size_t i : {1, 2, 3}) row.cells[i].unit = parameterUnit(r.name);
    rows.push_back(std::move(row));
  }
  repeatability_->setRows(std::move(rows));
  if (study.status == FitStatus::Converged) {
    repeatability_verdict_->show(
        Tone::Neutral,
        tr("Drift slower than nine cycles is removed; the residual scatter is the repeatability of one cycle."));
  } else {
    repeatability_verdict_->set(Tone::Attention, study.message.empty() ? QString() : coreSentence(study.message + "."));
  }
}

void TouchEvaluationPage::showHealth() {
  std::vector<Row> rows;
  QString worst;
  for (const StylusHealth& h : details_.health) {
    Row row;
    row.id = fromCore(h.stylus + "/" + h.feature);
    const bool good = h.status == FitStatus::Converged;
    row.cells = {nameCell(fromCore(h.stylus)),
                 Cell{fromCore(h.feature)},
                 good ? quantityCell(h.effective_radius_mm, h.effective_radius_sigma_mm) : dashCell(),
                 numberCell(good ? h.pre_travel_range_um : std::nan(""), 2),
                 numberCell(good && h.repeatability_dof > 0 ? h.repeatability_um : std::nan(""), 2),
                 numberCell(good ? h.largest_step_um : std::nan(""), 2),
                 !good     ? toneCell(tr("not judged"), Tone::Attention)
                 : h.loose ? toneCell(tr("loose"), Tone::Bad)
                 : h.movement.kind == MovementKind::Undecided
                     ? toneCell(tr("loose or still warming up"), Tone::Attention)
                 : h.healthy ? toneCell(tr("healthy"), Tone::Good)
                             : toneCell(tr("to be checked"), Tone::Attention)};
    row.cells.back().tip = coreSentence(h.message);
    if (!h.healthy && worst.isEmpty()) {
      worst = tr("%1 on %2: %3").arg(fromCore(h.stylus), fromCore(h.feature), coreSentence(h.message));
    }
    rows.push_back(std::move(row));
  }
  const bool none = rows.empty();
  health_->setRows(std::move(rows));
  if (none) {
    health_verdict_->set(Tone::Neutral, {});
  } else if (worst.isEmpty()) {
    health_verdict_->show(Tone::Good, tr("All styli repeat as well as an intact probe does."));
  } else {
    health_verdict_->show(Tone::Attention, worst + QLatin1Char('.'));
  }
}

void TouchEvaluationPage::showDeviations() {
  const auto stored = session().evaluation();
  if (stored == nullptr) return;
  const std::vector<std::string> points = stored->observations.points();
  const QString chosen = point_->currentText();
  point_->clear();
  for (const std::string& p : points) point_->addItem(fromCore(p));
  const int at = point_->findText(chosen);
  point_->setCurrentIndex(at >= 0 ? at : point_->count() - 1);
  const std::string point = point_->currentText().toStdString();
  double first = 1e300;
  double last = -1e300;
  for (const Observation& o : stored->observations.rows) {
    first = std::min(first, o.time_s);
    last = std::max(last, o.time_s);
  }
  const TimeUnit unit = timeUnit(last - first);
  std::vector<Series> series;
  for (const Component c : {Component::EX, Component::EY, Component::EZ}) {
    Series s;
    s.name = fromCore(std::string(toString(c)));
    s.colour = static_cast<int>(c);
    for (const Observation& o : stored->observations.rows) {
      if (o.point != point || o.component != c) continue;
      s.x.push_back(o.time_s / unit.seconds);
      s.y.push_back(o.value);
      s.sigma.push_back(o.sigma);
    }
    if (!s.x.empty()) series.push_back(std::move(s));
  }
  plot_->setAxes(tr("Time / %1").arg(unit.name), tr("Deviation of %1 / µm").arg(point_->currentText()));
  plot_->setContent(std::move(series));
}

std::vector<Exportable> TouchEvaluationPage::exportables() {
  std::vector<Exportable> items{exportableOf(tr("Features"), features_),
                                exportableOf(tr("Touches left out"), left_out_),
                                exportableOf(tr("Lengths"), lengths_),
                                exportableOf(tr("Comparison"), comparison_),
                                exportableOf(tr("Repeatability"), repeatability_),
                                exportableOf(tr("Health of the probe"), health_)};
  if (!plot_->empty()) items.push_back(exportableOf(tr("Deviation over time"), plot_));
  if (!grown_->empty()) items.push_back(exportableOf(tr("Expansion of the artefact"), grown_));
  for (Exportable& item : reference_->exportables()) items.push_back(std::move(item));
  return items;
}

}  // namespace spindrift::gui
