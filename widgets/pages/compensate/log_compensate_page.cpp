// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/compensate/log_compensate_page.h"

#include <QHBoxLayout>
#include <QTabWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/base/unit_text.h"
#include "core/workflows/campaign_series.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/models/cells.h"
#include "widgets/panels/compensate/live_compensation_panel.h"
#include "widgets/plots/plot.h"
#include "widgets/services/closed_loop_service.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

constexpr auto log_result = "log-compensation";
constexpr std::size_t most_plotted = 3000;

Series curve(const QString& name, const std::vector<double>& time_s, const std::vector<double>& values, double unit_s,
             int colour) {
  Series s;
  s.name = name;
  s.style = SeriesStyle::Line;
  s.colour = colour;
  const std::size_t stride = 1 + values.size() / most_plotted;
  for (std::size_t i = 0; i < values.size(); i += stride) {
    if (!std::isfinite(values[i])) continue;
    s.x.push_back(time_s[i] / unit_s);
    s.y.push_back(values[i]);
  }
  return s;
}

}  // namespace

LogCompensatePage::LogCompensatePage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Compensate, parent) {
  setInstruction(tr("Run the compensator that the control would run over the log, and export its model."));
  auto* live_button = makeButton(tr("Live …"), nullptr);
  live_button->setToolTip(tr("Measure, model and compensate at the control, while the machine works"));
  connect(live_button, &QPushButton::clicked, this, [this] { ClosedLoopService::of(session()).ask(); });
  addAction(live_button);
  run_button_ = makeButton(tr("Run the compensator"), nullptr, "primary");
  addAction(run_button_);
  auto* card = new Card;
  auto* tiles = new QHBoxLayout;
  before_ = new NumberTile(tr("Measured in the test range, rms"));
  after_ = new NumberTile(tr("With the compensator, rms"));
  largest_ = new NumberTile(tr("Largest correction"));
  for (NumberTile* tile : {before_, after_, largest_}) tiles->addWidget(tile, 1);
  card->body()->addLayout(tiles);
  plot_ = new Plot;
  plot_->setEmptyText(tr("Measured deviation, correction and residual will appear here"),
                      tr("Identify a model (Model), then press Run the compensator."));
  card->body()->addWidget(plot_, 1);
  auto* tabs = makeTabs(this);
  tabs->setObjectName(QStringLiteral("compensatorTabs"));
  tabs->addTab(card, tr("Over the log"));
  live_ = new LiveCompensationPanel(session());
  tabs->addTab(live_, tr("Live"));
  content()->addWidget(tabs, 1);
  showHints(plot_);
  showHints(live_->plot());
  connect(run_button_, &QPushButton::clicked, this, [this] { runTask(log_result); });
}

void LogCompensatePage::refresh() {
  if (session().campaign() == nullptr) return;
  live_->refresh();
  if (noticeCampaign()) {
    result_.reset();
    showResult();
  }
  const bool identified = session().latest("thermal") != nullptr;
  run_button_->setEnabled(identified && canRun(log_result));
  const ShownTask stored = shown(log_result, tr("Reading the compensation"));
  if (stored.reading) return;
  result_ = stored.as<LogCompensation>();
  const StepStatus& status = context().workflow.status(StepId::Compensate);
  if (!identified) {
    callout()->show(Tone::Attention, status.sentence);
  } else if (result_ == nullptr || !stored.state.current) {
    callout()->show(stored.state.there ? Tone::Outdated : Tone::Accent, status.sentence);
  } else {
    const CompensatorRun& run = result_->run;
    const QString unit = unitText(unitOfSignal(run.output));
    const bool better = run.after_rms < run.before_rms;
    // What speaks against the model is said before what it achieves.
    QString against;
    for (const std::string& warning : run.result.warnings) {
      against += coreSentence(warning) + QLatin1Char(' ');
    }
    callout()->show(
        better && against.isEmpty() ? Tone::Good : Tone::Attention,
        against + (better ? tr("In the test range %1 %3 rms remain of %2 %3. Export the thermal model for the control.")
                                .arg(decimalText(run.after_rms, 'g', 3))
                                .arg(decimalText(run.before_rms, 'g', 3))
                                .arg(unit)
                          : tr("rms in the test range: %1 %3 with, %2 %3 without compensation: no improvement. Train "
                               "on a longer range with more excitation (Model).")
                                .arg(decimalText(run.after_rms, 'g', 3))
                                .arg(decimalText(run.before_rms, 'g', 3))
                                .arg(unit)));
  }
  showResult();
}

void LogCompensatePage::showResult() {
  if (result_ == nullptr) {
    for (NumberTile* tile : {before_, after_, largest_}) tile->set(QStringLiteral("–"));
    plot_->setContent({});
    return;
  }
  const CompensatorRun& r = result_->run;
  const QString unit = unitText(unitOfSignal(r.output));
  const auto text = [&](double value) { return QStringLiteral("%1 %2").arg(decimalText(value, 'g', 3)).arg(unit); };
  before_->set(text(r.before_rms), tr("%1, about its mean").arg(fromCore(r.output)));
  after_->set(text(r.after_rms),
              r.result.fallback == 0
                  ? tr("about its mean, test range")
                  : tr("%1 of %2 cycles in fall-back").arg(r.result.fallback).arg(r.result.time_s.size()));
  largest_->set(text(r.result.outputs.front().largest), tr("added to the command, cycle %1 s").arg(r.result.cycle_s));
  const TimeUnit time = timeUnit(r.time_s.back() - r.time_s.front());
  plot_->setAxes(tr("Time / %1").arg(time.name), QStringLiteral("%1 / %2").arg(fromCore(r.output), unit));
  plot_->setContent({curve(tr("measured"), r.time_s, r.measured, time.seconds, 1),
                     curve(tr("correction"), r.result.time_s, r.result.outputs.front().compensation, time.seconds, 2),
                     curve(tr("residual"), r.time_s, r.left, time.seconds, 0)},
                    {{r.test.from_s / time.seconds, r.test.to_s / time.seconds, tr("test"), Tone::Accent}});
}

std::vector<Exportable> LogCompensatePage::exportables() {
  if (result_ == nullptr) {
    if (live_->plot()->empty()) return {};
    return {exportableOf(tr("Prediction and measurement, live"), live_->plot())};
  }
  const auto result = result_;
  return {{tr("Thermal model"),
           {QStringLiteral("json")},
           [result](const QString& file) { result->model.write(file.toStdString()); }},
          {tr("Corrections over time"),
           {QStringLiteral("csv")},
           [result](const QString& file) { result->run.result.write(file.toStdString()); }},
          exportableOf(tr("Compensator over the log"), plot_)};
}

}  // namespace spindrift::gui
