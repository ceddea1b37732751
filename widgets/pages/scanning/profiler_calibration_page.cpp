// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/scanning/profiler_calibration_page.h"

#include <QHBoxLayout>
#include <QSplitter>
#include <QTabWidget>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/units.h"
#include "core/workflows/evaluate_campaign.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {

ProfilerCalibrationPage::ProfilerCalibrationPage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Calibrate, parent) {
  setInstruction(tr("Find where the profiler sits in the tool frame, and register every scan onto the first one."));
  evaluate_ = makeButton(tr("Evaluate the scans"), nullptr, "primary");
  addAction(evaluate_);
  auto* tiles = new Card;
  auto* line = new QHBoxLayout;
  line->setSpacing(24);
  rim_ = new NumberTile(tr("Rim of the pocket, rms"));
  plane_ = new NumberTile(tr("Plate, rms"));
  scans_ = new NumberTile(tr("Scans compared"));
  rejected_count_ = new NumberTile(tr("Scans left out"));
  for (NumberTile* tile : {rim_, plane_, scans_, rejected_count_}) line->addWidget(tile, 1);
  tiles->body()->addLayout(line);
  content()->addWidget(tiles);

  auto* left = new Card;
  tabs_ = makeTabs(left);
  auto* first = new QWidget;
  auto* column = new QVBoxLayout(first);
  column->setContentsMargins(0, 8, 0, 0);
  undetermined_ = new Callout;
  column->addWidget(undetermined_);
  calibration_ = new RowsModel({tr("Parameter"), tr("Value"), tr("From the scan")}, this);
  column->addWidget(makeTable(calibration_, tr("Calibration"),
                              tr("Three angles and three lengths with their uncertainty appear after the evaluation.")),
                    1);
  tabs_->addTab(first, tr("Calibration"));
  registrations_ = new RowsModel({tr("Scan"), tr("X"), tr("Y"), tr("Z"), tr("rms / µm")}, this);
  tabs_->addTab(makeTable(registrations_, tr("Registrations"),
                          tr("The deviation at every artefact appears after the evaluation.")),
                tr("At the artefacts"));
  rejected_ = new RowsModel({tr("Scan"), tr("Why it was left out")}, this);
  tabs_->addTab(makeSentenceTable(rejected_, tr("Left out"), tr("Nothing was left out.")), tr("Left out"));
  left->body()->addWidget(tabs_, 1);
  auto* right = new Card(tr("Residuals of the rim"));
  residuals_ = new Plot;
  residuals_->setAxes(tr("Angle around the pocket / °"), tr("Distance from the circle / µm"));
  residuals_->setEmptyText(tr("Residuals will appear here"),
                           tr("Evaluate the scans: every crossing of the rim is compared with the fitted circle."));
  right->body()->addWidget(residuals_, 1);
  content()->addWidget(makeSplitter(this, left, right, 9, 5), 1);
  showHints(residuals_);
  connect(evaluate_, &QPushButton::clicked, this, [this] { runTask("evaluate"); });
}

void ProfilerCalibrationPage::clear() {
  for (RowsModel* rows : {calibration_, registrations_, rejected_}) rows->setRows({});
  residuals_->setContent({});
  undetermined_->set(Tone::Neutral, {});
  for (NumberTile* tile : {rim_, plane_, scans_, rejected_count_}) tile->set(QStringLiteral("–"));
}

void ProfilerCalibrationPage::refresh() {
  if (session().campaign() == nullptr) return;
  if (noticeCampaign()) {
    clear();
  }
  const auto stored = session().evaluation();
  if (stored == nullptr) {
    clear();
    callout()->show(Tone::Accent, tr("Press Evaluate the scans. Those that cannot be used are listed with the reason, "
                                     "the others are evaluated."));
    return;
  }
  const ShownTask shown_now = shown("evaluate", tr("Reading the evaluation"));
  const ResultState& state = shown_now.state;
  const auto detail = shown_now.as<EvaluationDetail>();
  if (!state.current) {
    callout()->show(Tone::Outdated, tr("Changed since this was evaluated: %1. Evaluate again.").arg(state.changed));
  } else if (!stored->good_enough || !stored->warnings.empty() || !stored->rejected.empty()) {
    QStringList sentences;
    if (!stored->rejected.empty()) sentences << context().workflow.status(step()).sentence;  // how many of how many
    // What the calibration cannot determine stands beside its numbers.
    for (const EvaluationWarning& w : stored->warnings)
      if (w.kind == WarningKind::Finding) sentences << coreSentence(w.sentence);
    if (sentences.isEmpty()) {
      callout()->show(Tone::Good, tr("Deviations found: %1; see what the calibration cannot determine.")
                                      .arg(static_cast<int>(stored->observations.rows.size())));
    } else {
      callout()->show(Tone::Attention,
                      sentences.mid(0, 2).join(QLatin1Char(' ')) +
                          (sentences.size() > 2 ? tr(" And %1 more.").arg(sentences.size() - 2) : QString()));
    }
  } else {
    callout()->show(Tone::Good,
                    tr("Deviations found: %1, no warnings.").arg(static_cast<int>(stored->observations.rows.size())));
  }
  if (detail == nullptr || detail->scans == nullptr) return;
  showCalibration(*detail->scans);
  showScans(*detail->scans);
}

void ProfilerCalibrationPage::showCalibration(const ScanEvaluation& evaluation) {
  const ProfilerCalibration& c = evaluation.mounting.calibration;
  const std::array<const char*, 6> keys{"alpha_rad", "beta_rad", "gamma_rad", "dx_mm", "dy_mm", "dz_mm"};
  const std::array<double, 6> values{c.alpha_rad,     c.beta_rad,      c.gamma_rad,
                                     c.offset_mm.x(), c.offset_mm.y(), c.offset_mm.z()};
  const std::array<QString, 6> names{tr("α about X"), tr("β about Y"), tr("γ about Z"), tr("dx"), tr("dy"), tr("dz")};
  std::vector<Row> rows;
  for (std::size_t i = 0; i < 6; ++i) {
    Row row;
    row.id = QString::fromLatin1(keys[i]);
    const bool open = std::find(c.undetermined.begin(), c.undetermined.end(), keys[i]) != c.undetermined.end();
    const double factor = i < 3 ? 1e3 : 1.0;
    Cell value{quantityText(factor * values[i], factor * c.standardUncertainty(static_cast<int>(i)),
                            i < 3 ? QStringLiteral("mrad") : QStringLiteral("mm"))};
    value.right = true;
    row.cells = {
        nameCell(names[i]), value,
        open ? toneCell(tr("no: taken from the mounting"), Tone::Attention) : toneCell(tr("determined"), Tone::Good)};
    rows.push_back(std::move(row));
  }
  calibration_->setRows(std::move(rows));
  if (!c.usable()) {
    undetermined_->show(Tone::Attention, coreSentence(c.message.empty() && !evaluation.warnings.empty()
                                                          ? evaluation.warnings.front().sentence
                                                          : c.message));
  } else {
    undetermined_->set(c.undetermined.empty() ? Tone::Neutral : Tone::Attention, coreSentence(c.message));
  }
  rim_->set(c.usable() ? QStringLiteral("%1 µm").arg(decimalText(c.rim_rms_um, 'f', 2)) : QStringLiteral("–"),
            tr("%1 crossings").arg(c.rim.size()));
  plane_->set(c.usable() ? QStringLiteral("%1 µm").arg(decimalText(c.plane_rms_um, 'f', 2)) : QStringLiteral("–"),
              tr("around the pocket"));
  Series used, unused;
  used.name = tr("Used");
  used.style = unused.style = SeriesStyle::Points;
  unused.name = tr("Left out");
  unused.colour = 1;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const RimPoint& p : c.rim) centre += p.point_mm / static_cast<double>(c.rim.size());
  for (const RimPoint& p : c.rim) {
    Series& s = p.used ? used : unused;
    const Eigen::Vector3d d = p.point_mm - centre;
    s.x.push_back(std::atan2(d.y(), d.x()) * 180.0 / 3.14159265358979323846);
    s.y.push_back(p.residual_um);
  }
  std::vector<Series> series;
  if (!used.x.empty()) series.push_back(std::move(used));
  if (!unused.x.empty()) series.push_back(std::move(unused));
  residuals_->setContent(std::move(series));
}

void ProfilerCalibrationPage::showScans(const ScanEvaluation& evaluation) {
  std::vector<Row> rows;
  int compared = 0;
  for (const ScanResult& s : evaluation.scans) {
    if (!s.reference) ++compared;
    // Two rows a scan: the displacement and the rotation of the tool at the artefact.
    for (const int first : {0, 3}) {
      Row row;
      row.id = fromCore(s.capture.cloud) + (first == 0 ? QString() : QStringLiteral("/rotation"));
      const QString scan = QStringLiteral("%1 · %2").arg(fromCore(s.capture.artefact), fromCore(s.capture.cycle));
      row.cells = {first == 0 ? nameCell(tr("%1 / µm").arg(scan)) : Cell{s.reference ? tr("reference") : tr("µrad")}};
      const QString unit = first == 0 ? QStringLiteral("um") : QStringLiteral("urad");
      row.cells[0].unit = unit;
      row.cells[0].tip = tr("%1 % of the reference seen").arg(decimalText(100.0 * s.registration.overlap, 'f', 0));
      if (const auto& form = s.registration.free_form; form && first == 0) {
        const QString seen = row.cells[0].tip;
        row.cells[0] = toneCell(row.cells[0].text, Tone::Attention);
        row.cells[0].unit = unit;
        row.cells[0].tip =
            seen + QStringLiteral("; ") +
            tr("the surface has changed its shape by %1 µm rms").arg(decimalText(um_per_mm * form->rms_mm(), 'g', 2));
      }
      const double factor = first == 0 ? um_per_mm : urad_per_rad;
      for (int i = first; i < first + 3; ++i) {
        const double value = i < 3 ? s.registration.translation_mm(i) : s.registration.rotation_rad(i - 3);
        const double sigma = s.standardUncertaintyAtArtefact(i);
        if (s.reference || !std::isfinite(sigma)) {
          row.cells.push_back(dashCell());
          row.cells.back().tip =
              s.reference ? tr("All others are compared with this scan") : tr("Not observed under this scan model");
        } else {
          row.cells.push_back(quantityCell(factor * value, factor * sigma));
          row.cells.back().unit = unit;
        }
      }
      row.cells.push_back(first == 0 ? numberCell(s.registration.rms_mm * um_per_mm, 2) : Cell{});
      rows.push_back(std::move(row));
    }
  }
  registrations_->setRows(std::move(rows));
  scans_->set(QString::number(compared), tr("scan model %1").arg(coreSentence(printedName(evaluation.scan_model))));
  rows.clear();
  for (const RejectedCapture& r : evaluation.rejected) {
    Row row;
    row.id = fromCore(r.capture);
    row.cells = {toneCell(row.id, Tone::Bad), Cell{coreSentence(r.reason)}};
    row.cells[1].tip = row.cells[1].text;
    rows.push_back(std::move(row));
  }
  tabs_->setTabText(2, tr("Left out (%1)").arg(rows.size()));
  rejected_count_->set(QString::number(rows.size()), rows.empty() ? tr("every scan was used") : tr("see the list"),
                       rows.empty() ? Tone::Neutral : Tone::Attention);
  rejected_->setRows(std::move(rows));
}

std::vector<Exportable> ProfilerCalibrationPage::exportables() {
  std::vector<Exportable> items{exportableOf(tr("Calibration of the profiler"), calibration_),
                                exportableOf(tr("Deviations at the artefacts"), registrations_),
                                exportableOf(tr("Scans left out"), rejected_)};
  if (!residuals_->empty()) items.push_back(exportableOf(tr("Residuals of the rim"), residuals_));
  return items;
}

}  // namespace spindrift::gui
