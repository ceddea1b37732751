// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/compensate/live_compensation_panel.h"

#include <QHBoxLayout>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/base/unit_text.h"
#include "core/thermal/thermal_model.h"
#include "core/workflows/campaign_series.h"
#include "core/workflows/live_compensation.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/models/cells.h"
#include "widgets/models/session_model.h"
#include "widgets/plots/plot.h"
#include "widgets/services/connections_service.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {

LiveCompensationPanel::LiveCompensationPanel(SessionModel& session, QWidget* parent)
    : QWidget(parent), session_(session), service_(ConnectionsService::of(session)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 8, 0, 0);
  column->setSpacing(8);
  state_ = new Callout;
  column->addWidget(state_);
  auto* card = new Card;
  auto* tiles = new QHBoxLayout;
  prediction_ = new NumberTile(tr("Predicted now"));
  measurement_ = new NumberTile(tr("Measured now"));
  remainder_ = new NumberTile(tr("Measured minus predicted, rms"));
  for (NumberTile* tile : {prediction_, measurement_, remainder_}) tiles->addWidget(tile, 1);
  card->body()->addLayout(tiles);
  plot_ = new Plot;
  plot_->setEmptyText(tr("Prediction and measurement will appear here as data come"),
                      tr("Connect the columns of the model (Machine, Connections), and look at them live."));
  card->body()->addWidget(plot_, 1);
  column->addWidget(card, 1);
  connect(&service_, &ConnectionsService::changed, this, [this] {
    if (isVisible() && (!since_shown_.isValid() || since_shown_.elapsed() >= 1000)) refresh();
  });
}

LiveCompensationPanel::~LiveCompensationPanel() = default;

LiveCompensation* LiveCompensationPanel::compensator() {
  const StoredResult* stored = session_.latest("thermal");
  const std::int64_t id = stored == nullptr ? 0 : stored->id;
  if (visit_ == session_.visit() && model_ == id) return compensator_.get();
  visit_ = session_.visit();
  model_ = id;
  compensator_.reset();
  problem_.clear();
  good_enough_ = true;
  if (stored == nullptr) return nullptr;
  try {
    const ThermalModel model = ThermalModel::parse(JsonNode::parse(stored->payload.at("model").dump(), "model"));
    compensator_ = std::make_unique<LiveCompensation>(model);
    const ThermalOutput* output = model.findOutput(compensator_->output());
    good_enough_ = output == nullptr || !output->verdict || output->verdict->good_enough;
  } catch (const InputError& e) {
    problem_ = e.what();
  }
  return compensator_.get();
}

void LiveCompensationPanel::refresh() {
  since_shown_.start();
  LiveCompensation* run = compensator();
  const LiveSnapshot& snapshot = service_.snapshot();
  if (run == nullptr) {
    state_->show(
        problem_.empty() ? Tone::Neutral : Tone::Bad,
        problem_.empty() ? tr("There is no model over time yet: identify one (Model).") : coreSentence(problem_));
  } else if (!service_.running()) {
    state_->show(Tone::Neutral,
                 tr("Nothing is connected at present: look at the columns live, or record them (Machine, "
                    "Connections)."));
  } else {
    run->advance(
        snapshot.now_s, [&](const std::string& column, double time_s) -> std::optional<LiveCompensation::Held> {
          const LiveColumn* known = snapshot.find(column);
          const auto held = service_.at(column, time_s);
          if (known == nullptr || !held) return std::nullopt;
          // Of the past it is only known what held; at present a source that is lost says nothing.
          const bool lost = snapshot.isLost(*known) && known->source < snapshot.sources.size();
          return LiveCompensation::Held{held->value, lost ? snapshot.sources[known->source].status.last_s : time_s};
        });
    QStringList absent;
    for (const std::string& input : run->inputs()) {
      const LiveColumn* column = snapshot.find(input);
      if (column == nullptr) absent << fromCore(input);
    }
    const auto last = run->points().empty() ? CompensatorState::Empty : run->points().back().state;
    if (!absent.isEmpty()) {
      state_->show(Tone::Attention, tr("The model needs columns that are not connected: %1.").arg(firstOf(absent)));
    } else if (last == CompensatorState::Empty) {
      state_->show(Tone::Neutral, tr("Waiting for a first value of every column that the model needs."));
    } else if (last == CompensatorState::Fallback) {
      state_->show(Tone::Bad, tr("Fall-back: %1 has been bad for too long; a control would fade its correction out.")
                                  .arg(fromCore(run->refusedInput())));
    } else if (last == CompensatorState::Holding) {
      state_->show(Tone::Attention,
                   tr("%1 is bad at present; its last good value is used.").arg(fromCore(run->refusedInput())));
    } else if (!good_enough_) {
      state_->show(Tone::Attention, tr("The model was called not good enough when it was identified: look, and do not "
                                       "compensate with it."));
    } else {
      state_->show(Tone::Good, tr("The compensator runs as it would in the control; nothing is sent to the machine."));
    }
  }
  showValues();
}

void LiveCompensationPanel::showValues() {
  const LiveCompensation* run = compensator_.get();
  if (run == nullptr || !service_.running() || run->points().empty()) {
    for (NumberTile* tile : {prediction_, measurement_, remainder_}) tile->set(QStringLiteral("–"));
    if (!plot_->empty()) plot_->setContent({});
    return;
  }
  const QString unit = unitText(unitOfSignal(run->output()));
  const auto text = [&](double value) {
    return std::isfinite(value) ? decimalText(value, 'f', 2) + QLatin1Char(' ') + unit : QStringLiteral("–");
  };
  const LiveCompensation::Point& now = run->points().back();
  const double span_s = now.time_s - run->points().front().time_s;
  const TimeUnit time = timeUnit(span_s);
  prediction_->set(text(now.prediction), tr("%1; the correction is minus this").arg(fromCore(run->output())));
  measurement_->set(text(now.measured), std::isfinite(now.measured)
                                            ? fromCore(run->output())
                                            : tr("%1 is not connected").arg(fromCore(run->output())));
  remainder_->set(
      text(run->remainderRms()),
      tr("about its mean, since %1 min").arg(decimalText((now.time_s - run->points().front().time_s) / 60.0, 'f', 0)));
  Series predicted, measured;
  predicted.name = tr("predicted");
  predicted.style = SeriesStyle::Line;
  predicted.colour = 0;
  measured.name = tr("measured");
  measured.style = SeriesStyle::Line;
  measured.colour = 1;
  for (const LiveCompensation::Point& point : run->points()) {
    const double ago = (point.time_s - now.time_s) / time.seconds;
    predicted.x.push_back(ago);
    predicted.y.push_back(point.prediction);
    measured.x.push_back(ago);
    measured.y.push_back(point.measured);
  }
  plot_->setAxes(tr("Time from now / %1").arg(time.name), QStringLiteral("%1 / %2").arg(fromCore(run->output()), unit));
  const bool any = std::any_of(measured.y.begin(), measured.y.end(), [](double v) { return std::isfinite(v); });
  plot_->setContent(any ? std::vector<Series>{measured, predicted} : std::vector<Series>{predicted});
}

void LiveCompensationPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refresh();
}

}  // namespace spindrift::gui
