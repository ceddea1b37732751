// SPDX-License-Identifier: GPL-3.0-or-later
// What a worked-out correction shows: figures, points, files with their signs, arrows on the machine.
#include <QPlainTextEdit>
#include <QTableView>
#include <algorithm>
#include <cmath>

#include "core/workflows/compensation_sizes.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/models/cells.h"
#include "widgets/models/rows_model.h"
#include "widgets/pages/compensate/compensate_page.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {
namespace {

constexpr std::array<const char*, 3> axis_titles{"X", "Y", "Z"};
constexpr int preview_lines = 200;

/// Correction, measured and what remains of one axis as cells with their uncertainty.
QString valueText(double value, double sigma) {
  // Hundredths of a micrometre are the last that mean anything to a control.
  if (!(sigma > 0.0)) return sizeText(value, {});
  const double shown = std::max(sigma, 0.01);
  const int decimals = shown < 0.295 ? 2 : shown < 2.95 ? 1 : 0;
  QString text = decimalText(value, 'f', decimals);
  return text + QStringLiteral(" ± ") + decimalText(shown, 'f', decimals);
}

}  // namespace

void CompensatePage::showPlan() {
  export_->setEnabled(plan_ != nullptr);
  if (!plan_) {
    for (NumberTile* tile : {before_, after_, expected_, largest_}) tile->set(QStringLiteral("–"));
    model_->clear();
    points_->setRows({});
    files_->setRows({});
    convention_->clear();
    preview_->clear();
    view_->clear();
    return;
  }
  const QString um = QStringLiteral("um");
  const QString state = QString::fromStdString(plan_->state);
  before_->set(sizeText(plan_->rms_before_um, um), tr("state %1").arg(state));
  // What counts is what remains where nothing was fitted.
  const QString unseen = plan_->rms_after_unseen_um
                             ? tr("%1 (before %2) %3")
                                   .arg(sizeText(*plan_->rms_after_unseen_um, um),
                                        sizeText(*plan_->rms_before_unseen_um, um), coreSentence(plan_->unseen))
                             : coreSentence(plan_->unseen);
  after_->setToolTip(onScreen(tr("On data not used for fitting: %1.").arg(unseen)));
  if (plan_->rms_after_unseen_um) {
    after_->set(sizeText(*plan_->rms_after_unseen_um, um),
                tr("on data not fitted; on fitted data %1").arg(sizeText(plan_->rms_after_um, um)),
                *plan_->rms_after_unseen_um < *plan_->rms_before_unseen_um ? Tone::Good : Tone::Attention);
  } else {
    after_->set(sizeText(plan_->rms_after_um, um), tr("fitted values; noise included"),
                plan_->rms_after_um < plan_->rms_before_um ? Tone::Good : Tone::Attention);
  }
  expected_->set(QStringLiteral("± ") + sizeText(plan_->rms_sigma_um, um), tr("one standard uncertainty, rms"));
  largest_->set(sizeText(plan_->largest_um, um), tr("length of the vector at a point"));
  QString text = coreSentence(plan_->model) + QLatin1Char('.');
  if (request().source == CompensationSource::CompletedModel) {
    text = tr("Simulation completed by %1.").arg(effectTitles(request().added, tr("and"))) + QLatin1Char(' ') +
           tr("Relative to %1.").arg(coreSentence(plan_->reference));
  }
  if (!plan_->limitation.empty()) text += QLatin1Char(' ') + coreSentence(plan_->limitation);
  model_->setText(onScreen(text));
  showPoints();
  std::vector<Row> rows;
  for (const CompensationFile& f : plan_->files) {
    Row row;
    row.id = QString::fromStdString(f.name);
    Cell name{row.id};
    name.bold = true;
    row.cells = {name, {coreSentence(f.title)}};
    rows.push_back(std::move(row));
  }
  const QModelIndex chosen = file_table_->selectionModel()->currentIndex();
  const int row = chosen.isValid() ? chosen.row() : 0;
  files_->setRows(std::move(rows));
  file_table_->selectRow(std::min(row, files_->rowCount() - 1));
  showFiles();
  showView();
}

void CompensatePage::showPoints() {
  std::vector<Row> rows;
  for (const CompensationPoint& p : plan_->points) {
    Row row;
    row.id = QString::fromStdString(p.point);
    Cell name{row.id};
    name.bold = true;
    if (!p.used) name.tip = tr("Not used by the fit: it only validates");
    row.cells = {name};
    for (int i = 0; i < 3; ++i) row.cells.push_back(rightCell(valueText(p.correction_um[i], p.sigma_um[i])));
    row.cells.push_back(rightCell(sizeText(remainingLength_um(p), {})));
    QStringList parts;
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      if (p.remains_um[axis])
        parts << QString::fromLatin1(axis_titles[axis]) + QLatin1Char(' ') +
                     valueText(*p.remains_um[axis], remainingSigma_um(p, i)) + QStringLiteral(" µm");
    }
    row.cells.back().tip =
        tr("Measured %1; remains: %2")
            .arg(sizeText(measuredLength_um(p), QStringLiteral("um")), parts.join(QStringLiteral(", ")));
    rows.push_back(std::move(row));
  }
  points_->setHeaders({tr("Point"), tr("X / µm"), tr("Y / µm"), tr("Z / µm"), tr("Remains / µm")});
  points_->setRows(std::move(rows));
}

void CompensatePage::showFiles() {
  const QModelIndex now = file_table_->selectionModel()->currentIndex();
  if (!plan_ || !now.isValid() || now.row() >= static_cast<int>(plan_->files.size())) return;
  const CompensationFile& f = plan_->files[static_cast<std::size_t>(now.row())];
  convention_->setText(coreSentence(f.convention));
  const QStringList lines = QString::fromStdString(f.content).split(QLatin1Char('\n'));
  QString text = lines.mid(0, preview_lines).join(QLatin1Char('\n'));
  if (lines.size() > preview_lines) text += tr("\n… %1 lines in all").arg(lines.size() - 1);
  preview_->setPlainText(text);
}

void CompensatePage::showView() {
  if (!plan_) return;
  view_->setMachine(session().campaign()->machine);
  std::vector<ViewPoint> points;
  std::vector<ViewArrow> arrows;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d high = -low;
  double largest = plan_->largest_um;
  const int what = arrows_->current();
  for (const CompensationPoint& p : plan_->points) {
    ViewPoint point;
    point.id = point.label = QString::fromStdString(p.point);
    point.position_mm = p.position_mm;
    point.used = p.used;
    ViewArrow arrow;
    arrow.from_mm = p.position_mm;
    arrow.tone = what == 0 ? Tone::Accent : what == 1 ? Tone::Attention : Tone::Good;
    Eigen::Vector3d measured = Eigen::Vector3d::Zero();
    Eigen::Vector3d remains = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      measured[static_cast<Eigen::Index>(i)] = p.measured_um[i].value_or(0.0);
      remains[static_cast<Eigen::Index>(i)] = p.remains_um[i].value_or(0.0);
    }
    largest = std::max(largest, measured.norm());
    const Eigen::Vector3d correction = p.correction_um.array().isFinite().select(p.correction_um, 0.0);
    arrow.deviation_um = what == 0 ? correction : what == 1 ? measured : remains;
    point.value_text = sizeText(arrow.deviation_um.norm(), QStringLiteral("um"));
    points.push_back(std::move(point));
    arrows.push_back(arrow);
    low = low.cwiseMin(p.position_mm);
    high = high.cwiseMax(p.position_mm);
  }
  // The same exaggeration for all three, so that they can be compared.
  const double size = plan_->points.empty() ? 100.0 : std::max(50.0, (high - low).norm());
  view_->setPoints(std::move(points));
  view_->setArrows(std::move(arrows), exaggerationFor(0.3 * size, largest));
  const QString state = QString::fromStdString(plan_->state);
  view_->setCaption(what == 0   ? tr("Correction to add to the command, state %1").arg(state)
                    : what == 1 ? tr("Measured deviation of state %1").arg(state)
                                : tr("What remains of state %1 with the correction").arg(state));
}

}  // namespace spindrift::gui
