// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/services/connections_service.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/base/utc_time.h"
#include "core/connect/connections.h"
#include "core/connect/unit_conversion.h"
#include "core/machine/operating_log.h"
#include "core/session/session.h"
#include "core/tasks/task_options.h"
#include "widgets/common/core_sentence.h"
#include "widgets/models/cells.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {

QString columnTitle(const std::string& column) {
  if (column == "spindle_rpm") return ConnectionsService::tr("spindle");
  QString text = fromCore(column);
  if (text.startsWith(QLatin1String("T_"))) text.remove(0, 2);
  const QString unit = QLatin1Char('_') + fromCore(unitOfColumn(column));
  if (unit.size() > 1 && text.endsWith(unit)) text.chop(unit.size());
  return coreSentence(text.replace(QLatin1Char('_'), QLatin1Char(' ')));
}

QString columnValue(const std::string& column, double value) {
  const std::string unit = unitOfColumn(column);
  const bool temperature = OperatingLog::isTemperature(column);
  QString text = temperature ? decimalText(value, 'f', 2) : decimalText(value, 'g', 6);
  if (unit.empty()) return text;
  return text + QLatin1Char(' ') +
         (unit == "degC"      ? QStringLiteral("°C")
          : unit == "mm_min"  ? QStringLiteral("mm/min")
          : unit == "percent" ? QStringLiteral("%")
                              : fromCore(unit));
}

ConnectionsService::ConnectionsService(SessionModel& session) : QObject(&session), session_(session) {
  timer_.setInterval(500);
  connect(&timer_, &QTimer::timeout, this, &ConnectionsService::poll);
  connect(&session_, &SessionModel::campaignChanged, this, &ConnectionsService::follow);
}

ConnectionsService::~ConnectionsService() = default;

ConnectionsService& ConnectionsService::of(SessionModel& session) {
  auto* found = session.findChild<ConnectionsService*>(QString(), Qt::FindDirectChildrenOnly);
  return found != nullptr ? *found : *new ConnectionsService(session);
}

nlohmann::json ConnectionsService::description() const {
  const nlohmann::json kept = session_.setting(descriptionKey(), nlohmann::json());
  if (kept.is_object() && kept.contains("sources")) return kept;
  return {{"format", "spindrift-connections"},
          {"version", 1},
          {"sources", nlohmann::json::array()},
          {"columns", nlohmann::json::array()}};
}

std::string ConnectionsService::descriptionKey() const {
  return session_.campaignKey(option_keys::connections);
}

double ConnectionsService::startUtc() const {
  if (session_.campaign() == nullptr) return localUtc();
  return parseUtc(session_.campaign()->start_utc).value_or(localUtc());
}

QString ConnectionsService::look() {
  return start(false);
}

QString ConnectionsService::record() {
  return start(true);
}

QString ConnectionsService::start(bool record) {
  if (session_.session() == nullptr || session_.campaign() == nullptr)
    return tr("Open a session or a new measurement first.");
  try {
    const Connections connections =
        Connections::parse(JsonNode::parse(description().dump(), "connections of the campaign"));
    if (connections.columns.empty()) return tr("No data item is mapped to a column yet: tick what is to be recorded.");
    // Two of them on one log, or a source that serves one client only, would be in each other's way.
    stop();
    for (const Ending& one : ending_) {
      if (one.live->ended()) continue;
      if (record && one.recorded) return tr("The log of the last recording is still being closed; try again soon.");
    }
    const std::int64_t campaign = session_.campaignId();
    const std::filesystem::path log = record ? session_.session()->recordsLog(campaign) : std::filesystem::path();
    live_ = std::make_unique<LiveRecording>(connections, log, startUtc(), options_);
    live_campaign_ = campaign;
    live_session_ = session_.sessionNumber();
    snapshot_ = live_->snapshot();
  } catch (const InputError& e) {
    return coreSentence(e.what());
  }
  timer_.start();
  Q_EMIT changed();
  return {};
}

void ConnectionsService::stop() {
  if (live_ == nullptr) return;
  live_->requestStop();
  ending_.push_back({std::move(live_), snapshot_.recording, live_session_, live_campaign_});
  snapshot_ = {};
  Q_EMIT changed();
}

void ConnectionsService::finishNow() {
  stop();
  const auto record = [this](std::int64_t campaign) {
    try {
      (void)session_.session()->recordsLog(campaign);
    } catch (const std::exception&) {
      // The session looks at its files when it is opened.
    }
  };
  jobs_.cancelAll();
  if (const std::int64_t campaign = std::exchange(taking_over_, 0); campaign != 0 && session_.session() != nullptr)
    record(campaign);
  for (Ending& one : ending_) {
    one.live.reset();  // waits
    if (one.recorded && session_.session() != nullptr && one.session == session_.sessionNumber()) record(one.campaign);
  }
  ending_.clear();
  timer_.stop();
}

/// Another campaign has other connections and another log.
void ConnectionsService::follow() {
  if (live_ == nullptr) return;
  if (session_.sessionNumber() != live_session_ || session_.campaignId() != live_campaign_) stop();
}

void ConnectionsService::poll() {
  if (live_ != nullptr) {
    const LiveSnapshot before = std::move(snapshot_);
    snapshot_ = live_->snapshot();
    for (std::size_t s = 0; s < snapshot_.sources.size(); ++s) {
      const LiveSource& now = snapshot_.sources[s];
      const auto was = s < before.sources.size() ? before.sources[s].status.state : SourceStatus::State::Connecting;
      if (now.status.state == was) continue;
      if (now.status.state == SourceStatus::State::Lost) {
        Q_EMIT told(Tone::Bad,
                    now.status.connections == 0
                        ? tr("%1 cannot be reached: %2").arg(fromCore(now.name), coreSentence(now.status.sentence))
                        : tr("%1 is lost: %2").arg(fromCore(now.name), coreSentence(now.status.sentence)));
      } else if (now.status.state == SourceStatus::State::Live && was == SourceStatus::State::Lost) {
        Q_EMIT told(Tone::Good, tr("%1 is there again.").arg(fromCore(now.name)));
      }
    }
    if (snapshot_.problem != before.problem && !snapshot_.problem.empty())
      Q_EMIT told(Tone::Bad, coreSentence(snapshot_.problem));
  }
  reap();
  if (live_ == nullptr && ending_.empty()) timer_.stop();
  Q_EMIT changed();
}

void ConnectionsService::reap() {
  for (std::size_t i = 0; i < ending_.size();) {
    if (!ending_[i].live->ended()) {
      ++i;
      continue;
    }
    const Ending one = std::move(ending_[i]);
    ending_.erase(ending_.begin() + static_cast<std::ptrdiff_t>(i));
    if (one.recorded && session_.session() != nullptr && one.session == session_.sessionNumber())
      takeOver(one.campaign);
  }
}

/// What was recorded becomes the log of the campaign: its results know, and its pages show it. Of the campaign at hand
/// both at once, when it has been read: nothing is worked out from the log before under the name of the new one.
void ConnectionsService::takeOver(std::int64_t campaign) {
  const auto take = [this, campaign, session = session_.sessionNumber()](ReadCampaign* read) {
    taking_over_ = 0;
    if (session_.session() == nullptr || session != session_.sessionNumber()) return;
    try {
      (void)session_.session()->recordsLog(campaign);
      if (read != nullptr && campaign == session_.campaignId()) session_.take(std::move(*read));
    } catch (const InputError& e) {
      Q_EMIT told(Tone::Bad, coreSentence(e.what()));
    }
    Q_EMIT changed();
  };
  if (campaign != session_.campaignId()) return take(nullptr);
  Job job;
  try {
    job.work = [reading = session_.reading(campaign), take](JobContext& context) -> std::function<void()> {
      auto read = std::make_shared<ReadCampaign>(reading.read(context));
      return [read, take] { take(read.get()); };
    };
  } catch (const InputError& e) {
    Q_EMIT told(Tone::Bad, coreSentence(e.what()));
    return;
  }
  job.failed = [this, take](const QString& sentence) {
    take(nullptr);
    Q_EMIT told(Tone::Bad, sentence);
  };
  taking_over_ = campaign;
  jobs_.run(std::move(job));
}

std::vector<LivePoint> ConnectionsService::history(std::size_t column) const {
  return live_ == nullptr ? std::vector<LivePoint>() : live_->history(column);
}

std::optional<LivePoint> ConnectionsService::at(const std::string& column, double utc_s) const {
  return live_ == nullptr ? std::nullopt : live_->at(column, utc_s);
}

QString ConnectionsService::lost() const {
  QStringList sentences;
  for (const LiveSource& source : snapshot_.sources) {
    if (source.status.state == SourceStatus::State::Lost)
      sentences << tr("%1 is lost: %2").arg(fromCore(source.name), coreSentence(source.status.sentence));
  }
  return sentences.join(QLatin1Char(' '));
}

QString ConnectionsService::machineAt(double campaign_s) const {
  const auto campaign = session_.campaign();
  if (campaign == nullptr) return {};
  std::vector<std::string> names{"spindle_rpm", "feed_x_mm_min", "feed_y_mm_min", "feed_z_mm_min"};
  std::size_t temperatures = 0;
  const auto add = [&](const std::string& name) {
    if (!OperatingLog::isTemperature(name) || std::find(names.begin(), names.end(), name) != names.end()) return;
    if (++temperatures <= 4) names.push_back(name);
  };
  for (const LiveColumn& column : snapshot_.columns) add(column.column);
  const OperatingLog* log = campaign->log ? &*campaign->log : nullptr;
  const bool covers = log != nullptr && !log->empty() && campaign_s >= log->time_s().front() - 1.0 &&
                      campaign_s <= log->time_s().back() + 1.0;
  if (covers) {
    for (const std::string& name : log->temperatureNames()) add(name);
  }
  QStringList parts;
  const double utc_s = startUtc() + campaign_s;
  for (const std::string& name : names) {
    std::optional<double> value;
    if (const auto live = at(name, utc_s)) value = live->value;
    if (!value && covers && log->has(name)) value = log->at(name, campaign_s);
    if (!value || !std::isfinite(*value)) continue;
    parts << columnTitle(name) + QLatin1Char(' ') + columnValue(name, *value);
  }
  return parts.join(QStringLiteral(", "));
}

}  // namespace spindrift::gui
