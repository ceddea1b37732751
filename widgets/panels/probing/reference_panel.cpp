// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/probing/reference_panel.h"

#include <QComboBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QSplitter>
#include <QVBoxLayout>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/probing/evaluate_touches.h"
#include "core/tasks/task_work.h"
#include "widgets/commands/commands.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/models/cells.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/plots/plot.h"
#include "widgets/services/touch_results.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {

/// As a unit stands behind "/": composed ones in brackets.
static QString belowLine(const QString& unit) {
  return unit.contains(QLatin1Char('/')) ? QStringLiteral("(%1)").arg(unit) : unit;
}

ReferencePanel::ReferencePanel(PageContext page_context, QWidget* parent)
    : QWidget(parent), context_(std::move(page_context)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  auto* line = new QHBoxLayout;
  parameter_ = new QComboBox;
  parameter_->setAccessibleName(tr("Parameter to compare"));
  parameter_->setMinimumWidth(150);
  load_ = makeButton(tr("Load a record …"), "folder-open");
  load_->setToolTip(tr("CSV with time_s, value and, if known, sigma, in the unit of the parameter"));
  line->addWidget(parameter_);
  line->addWidget(load_);
  line->addStretch();
  column->addLayout(line);
  verdict_ = new Callout;
  column->addWidget(verdict_);
  curves_ = new Plot;
  curves_->setEmptyText(
      tr("Probe and reference will appear here"),
      tr("Evaluate the touches, then load what a grid encoder or interferometer recorded meanwhile."));
  differences_ = new Plot;
  differences_->setEmptyText(tr("The difference will appear here"), tr("With its uncertainty, cycle by cycle."));
  column->addWidget(makeSplitter(this, curves_, differences_, 1, 1), 1);
  connect(load_, &QPushButton::clicked, this, [this] {
    const QString file =
        QFileDialog::getOpenFileName(this, tr("Record of the reference instrument"), {}, tr("Record (*.csv)"));
    if (!file.isEmpty()) load(file);
  });
  connect(parameter_, &QComboBox::activated, this, [this] {
    change(tr("compare another parameter"), {{"parameter", parameter_->currentData().toString().toStdString()}});
  });
}

std::string ReferencePanel::key() const {
  return "reference/" + std::to_string(context_.session.campaignId());
}

nlohmann::json ReferencePanel::options() const {
  const nlohmann::json stored = context_.session.setting(key(), nlohmann::json::object());
  return stored.is_object() ? stored : nlohmann::json::object();
}

void ReferencePanel::change(const QString& what, const nlohmann::json& change) {
  nlohmann::json after = options();
  after.update(change);
  if (after == options()) return;
  context_.undo.push(new OptionsCommand(context_.session, what, key(), after, [this] { compare(); }));
}

void ReferencePanel::setCycles(std::shared_ptr<const TouchEvaluation> evaluation) {
  evaluation_ = std::move(evaluation);
  const CycleEvaluation* cycles = cyclesOf(evaluation_.get());
  parameter_->clear();
  if (cycles != nullptr) {
    for (const std::string& name : cycles->names) {
      parameter_->addItem(
          shownTitle(QStringLiteral("%1 / %2").arg(parameterTitle(name), belowLine(parameterUnit(name)))),
          fromCore(name));
    }
  }
  compare();
}

void ReferencePanel::setParameter(const QString& name) {
  const int at = parameter_->findData(name);
  if (at < 0) return;
  parameter_->setCurrentIndex(at);
  change(tr("compare another parameter"), {{"parameter", name.toStdString()}});
}

void ReferencePanel::load(const QString& file) {
  const CycleEvaluation* cycles = cyclesOf(evaluation_.get());
  if (cycles == nullptr) {
    verdict_->show(Tone::Attention, tr("Evaluate the touches first; then a record can be compared with them."));
    return;
  }
  try {
    const std::string parameter = parameter_->currentData().toString().toStdString();
    // Read before it is taken over: a record with a mistake changes nothing.
    (void)compareWithReference(*cycles, parameter, file.toStdString());
    const std::string name = QFileInfo(file).fileName().toStdString();
    writeFileAtomically(context_.session.folder() / "references" / name, readFile(file.toStdString()));
    change(tr("load %1").arg(QFileInfo(file).fileName()), {{"record", name}, {"parameter", parameter}});
    compare();
  } catch (const InputError& e) {
    verdict_->show(Tone::Bad, coreSentence(e.what()));
  }
}

void ReferencePanel::compare() {
  comparison_ = {};
  curves_->setContent({});
  differences_->setContent({});
  verdict_->set(Tone::Neutral, {});
  const CycleEvaluation* cycles = cyclesOf(evaluation_.get());
  load_->setEnabled(cycles != nullptr);
  const nlohmann::json json = options();
  if (cycles == nullptr || !json.contains("record")) return;
  const std::string parameter = json.value("parameter", cycles->names.front());
  if (const int at = parameter_->findData(fromCore(parameter)); at >= 0) parameter_->setCurrentIndex(at);
  const std::string record = json.at("record").get<std::string>();
  try {
    comparison_ = compareWithReference(*cycles, parameter, context_.session.folder() / "references" / record);
  } catch (const InputError& e) {
    verdict_->show(Tone::Bad, coreSentence(e.what()));
    return;
  }
  if (comparison_.status != FitStatus::Converged) {
    verdict_->show(Tone::Attention, coreSentence(comparison_.message) + QLatin1Char('.'));
    return;
  }
  const QString unit = parameterUnit(parameter);
  const TimeUnit time = timeUnit(comparison_.points.back().time_s - comparison_.points.front().time_s);
  Series probe, reference, difference;
  probe.name = tr("Probe");
  reference.name = fromCore(record);
  reference.style = SeriesStyle::Line;
  reference.colour = 1;
  difference.name = tr("Probe minus reference");
  difference.colour = 2;
  for (const ReferenceComparison::Point& p : comparison_.points) {
    for (Series* s : {&probe, &reference, &difference}) s->x.push_back(p.time_s / time.seconds);
    probe.y.push_back(p.probe);
    probe.sigma.push_back(p.standard_uncertainty);
    reference.y.push_back(p.reference);
    difference.y.push_back(p.difference);
    difference.sigma.push_back(p.standard_uncertainty);
  }
  const QString title = parameterTitle(parameter);
  const QString below = belowLine(unit);
  curves_->setAxes(tr("Time / %1").arg(time.name), QStringLiteral("%1 / %2").arg(title, below));
  curves_->setContent({probe, reference});  // the line over the marks: where both agree it would not be seen
  differences_->setAxes(tr("Time / %1").arg(time.name), tr("Difference / %1").arg(below));
  differences_->setLeastRange(0.1);
  differences_->setContent({difference});
  const auto n = static_cast<double>(comparison_.points.size());
  // The rms of n differences is itself known to 1 / sqrt(2 (n - 1)) of its value.
  const double rms_sigma = comparison_.rms / std::sqrt(2.0 * (n - 1.0));
  const bool good = comparison_.within_two_sigma >= 0.9;
  verdict_->show(
      good ? Tone::Good : Tone::Attention,
      tr("%1 differs from the reference by %2 rms, at most %3 %4; %5 % of %6 cycles agree within two standard "
         "uncertainties; correlation %7. A constant of %8 %4 is taken out: both zeros are arbitrary.")
          .arg(title, quantityText(comparison_.rms, rms_sigma, unit))
          .arg(sizeText(comparison_.largest, {}))
          .arg(unit)
          .arg(decimalText(100.0 * comparison_.within_two_sigma, 'f', 0))
          .arg(comparison_.judged)
          .arg(decimalText(comparison_.correlation, 'f', 3))
          .arg(sizeText(comparison_.offset, {})));
}

std::vector<Exportable> ReferencePanel::exportables() const {
  if (curves_->empty()) return {};
  return {exportableOf(tr("Probe and reference"), curves_), exportableOf(tr("Probe minus reference"), differences_)};
}

}  // namespace spindrift::gui
