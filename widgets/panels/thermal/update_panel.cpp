// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/thermal/update_panel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>
#include <array>
#include <cmath>

#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/models/cells.h"
#include "widgets/plots/plot.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {

UpdatePanel::UpdatePanel(std::function<void(const QString&, Work)> run, QWidget* parent)
    : QWidget(parent), run_(std::move(run)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  auto* line = new QHBoxLayout;
  kind_ = new QComboBox;
  kind_->setAccessibleName(tr("How a measurement updates the model"));
  kind_->addItems({tr("Gain and offset"), tr("Gain: measured / simulated"), tr("State")});
  line->addWidget(kind_);
  line->addWidget(new QLabel(tr("every")));
  interval_ = new QSpinBox;
  interval_->setAccessibleName(tr("Time between two on-machine measurements"));
  interval_->setRange(5, 24 * 60);
  interval_->setValue(60);
  interval_->setSuffix(tr(" min"));
  interval_->setMinimumHeight(sizes::control_height);
  line->addWidget(interval_);
  button_ = makeButton(tr("Run the updates"), nullptr);
  line->addWidget(button_);
  line->addStretch();
  column->addLayout(line);
  summary_ = new Callout;
  column->addWidget(summary_);
  what_ = new Segments({tr("Over time"), tr("Fit"), tr("Peak to peak")}, tr("What is drawn of the updates"));
  column->addWidget(what_);
  plot_ = new Plot;
  plot_->setEmptyText(tr("The updated model will appear here"),
                      tr("Identify the model, then run the updates: prediction, and what the interval buys."));
  column->addWidget(plot_, 1);
  connect(button_, &QPushButton::clicked, this, &UpdatePanel::track);
  connect(what_, &Segments::chosen, this, [this](int) { show(); });
}

void UpdatePanel::set(std::shared_ptr<const TimeSeries> series, std::shared_ptr<const IdentifyResult> model,
                      double sigma) {
  if (model != model_) result_.reset();
  series_ = std::move(series);
  model_ = std::move(model);
  sigma_ = sigma;
  button_->setEnabled(series_ != nullptr && model_ != nullptr);
  show();
}

void UpdatePanel::track() {
  if (series_ == nullptr || model_ == nullptr) return;
  TrackRequest request;
  request.update = std::array{UpdateKind::Kalman, UpdateKind::Gain,
                              UpdateKind::Arx}[static_cast<std::size_t>(std::max(0, kind_->currentIndex()))];
  request.interval_s = 60.0 * interval_->value();
  request.measurement_sigma = sigma_;
  run_(tr("Running the updates"), [this, request, series = series_, model = model_](JobContext& job) {
    auto result = std::make_shared<TrackResult>(trackThermalModel(*series, model->model, request, job));
    return std::function<void()>([this, result, model] {
      if (model != model_) return;
      result_ = result;
      show();
    });
  });
}

void UpdatePanel::show() {
  if (result_ == nullptr) {
    summary_->set(Tone::Neutral, {});
    plot_->setContent({});
    return;
  }
  const TrackResult& r = *result_;
  const QString unit = unitText(r.unit);
  QString text = tr("From %1 h on: rms %2 %3 with %4 measurements, %5 %3 without; fit %6 %, without %7 %.")
                     .arg(decimalText(r.from_s / 3600, 'f', 1))
                     .arg(decimalText(r.with.rmse, 'g', 3))
                     .arg(unit)
                     .arg(r.run.events.size())
                     .arg(decimalText(r.without.rmse, 'g', 3))
                     .arg(decimalText(r.with.fit_percent, 'f', 0))
                     .arg(decimalText(r.without.fit_percent, 'f', 0));
  for (const std::string& note : r.notes) text += QLatin1Char(' ') + coreSentence(note);
  summary_->show(r.with.rmse <= r.without.rmse ? Tone::Good : Tone::Attention, text);
  std::vector<Series> all;
  if (what_->current() == 0) {
    const auto add = [&](const QString& name, const std::vector<double>& values, int colour, SeriesStyle style) {
      Series s;
      s.name = name;
      s.colour = colour;
      s.style = style;
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (r.time_s[i] < r.from_s || !std::isfinite(values[i])) continue;
        s.x.push_back(r.time_s[i] / 3600);
        s.y.push_back(values[i]);
      }
      all.push_back(std::move(s));
    };
    const auto count = std::count_if(r.measured.begin(), r.measured.end(), [](double v) { return std::isfinite(v); });
    const bool sparse = count * 5 < std::ssize(r.measured);
    add(tr("Measured"), r.measured, 0, sparse ? SeriesStyle::Points : SeriesStyle::Line);
    add(tr("Without update"), r.simulated, 2, SeriesStyle::Dashed);
    add(tr("With updates"), r.run.predicted, 1, SeriesStyle::Line);
    plot_->setAxes(tr("Time / h"), tr("%1 / %2").arg(fromCore(r.output), unit));
  } else {
    const bool fit = what_->current() == 1;
    Series with;
    with.name = tr("With updates");
    with.colour = 1;
    Series without;
    without.name = tr("Without update");
    without.style = SeriesStyle::Dashed;
    without.colour = 2;
    for (const IntervalPoint& p : r.sweep) {
      if (!std::isfinite(p.interval_s)) continue;
      with.x.push_back(p.interval_s / 60);
      with.y.push_back(fit ? p.fit_percent : p.p2p);
      without.x.push_back(p.interval_s / 60);
      without.y.push_back(fit ? r.without.fit_percent : r.without.p2p);
    }
    all = {with, without};
    plot_->setAxes(tr("Time between two measurements / min"), fit ? tr("Fit / %") : tr("Peak to peak / %1").arg(unit));
  }
  plot_->setContent(std::move(all));
}

}  // namespace spindrift::gui
