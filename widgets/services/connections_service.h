// SPDX-License-Identifier: GPL-3.0-or-later
// Data from machines and sensors while the user looks at something else. Belongs to the session, not to a page; the
// sources, the log and the clock of the recording live on threads of core (core/connect/live_recording.h), and a timer
// looks at their snapshot.
//
// What is connected (connections.json, without any secret) is kept for each campaign as a setting of the session.
#pragma once

#include <QObject>
#include <QTimer>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/connect/live_recording.h"
#include "widgets/jobs/job_runner.h"
#include "widgets/models/session_model.h"
#include "widgets/theme/theme.h"

namespace spindrift::gui {

class ConnectionsService : public QObject {
  Q_OBJECT
 public:
  /// The one that belongs to the session.
  [[nodiscard]] static ConnectionsService& of(SessionModel& session);
  ~ConnectionsService() override;

  /// connections.json of the campaign at hand; without sources if nothing was entered yet.
  [[nodiscard]] nlohmann::json description() const;
  /// Under which setting of the session it is kept.
  [[nodiscard]] std::string descriptionKey() const;

  /// Looks at what comes without writing it. Returns one sentence if that is not possible.
  QString look();
  /// Records into log.csv of the campaign at hand, on its clock.
  QString record();
  /// Ends looking or recording; the log is closed in the background.
  void stop();
  /// Ends it and waits for the log to be closed: before the session goes.
  void finishNow();
  [[nodiscard]] bool running() const { return live_ != nullptr; }
  [[nodiscard]] bool recording() const { return live_ != nullptr && snapshot_.recording; }
  /// A log is still being closed, or read.
  [[nodiscard]] bool ending() const { return !ending_.empty() || jobs_.busy(); }

  /// What came, as the last look found it; empty while nothing runs.
  [[nodiscard]] const LiveSnapshot& snapshot() const { return snapshot_; }
  [[nodiscard]] std::vector<LivePoint> history(std::size_t column) const;
  /// What a column held at a time of the campaign; nothing where that is not known.
  [[nodiscard]] std::optional<LivePoint> at(const std::string& column, double utc_s) const;
  [[nodiscard]] double startUtc() const;  ///< where the campaign's time is 0
  /// "mill is lost: no answer"; empty while all sources are there.
  [[nodiscard]] QString lost() const;
  /// What the machine did at a time of the campaign: "spindle 0 rpm, room 21.0 °C". From what comes now, else from the
  /// log; empty where neither knows.
  [[nodiscard]] QString machineAt(double campaign_s) const;
  /// How often it looks.
  void setPace(int look_ms) { timer_.setInterval(look_ms); }
  /// How quickly a lost source is tried again.
  void setRunnerOptions(const RunnerOptions& options) { options_ = options; }

 Q_SIGNALS:
  void changed();
  /// A source was lost or is there again.
  void told(spindrift::gui::Tone tone, const QString& sentence);

 private:
  explicit ConnectionsService(SessionModel& session);
  QString start(bool record);
  void follow();
  void poll();
  void reap();
  void takeOver(std::int64_t campaign);

  struct Ending {
    std::unique_ptr<LiveRecording> live;
    bool recorded = false;
    std::int64_t session = 0;
    std::int64_t campaign = 0;
  };

  SessionModel& session_;
  QTimer timer_;
  RunnerOptions options_;
  std::unique_ptr<LiveRecording> live_;
  std::int64_t live_campaign_ = 0;
  std::int64_t live_session_ = 0;
  LiveSnapshot snapshot_;
  std::vector<Ending> ending_;
  std::int64_t taking_over_ = 0;  ///< campaign whose log is being read; 0: none
  JobRunner jobs_;
};

/// "T_spindle_degC" -> "spindle"; "spindle_rpm" -> "spindle speed".
[[nodiscard]] QString columnTitle(const std::string& column);
/// A value with the unit of its column.
[[nodiscard]] QString columnValue(const std::string& column, double value);

}  // namespace spindrift::gui
