// SPDX-License-Identifier: Apache-2.0
// All sources of connections.json into one log, until it is told to end. Without a log they are only looked at.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/connect/connections.h"
#include "core/connect/log_recorder.h"
#include "core/connect/source_runner.h"

namespace spindrift {

class Recording {
 public:
  /// Starts at once. `log`: empty for none; `start_utc_s`: where time_s is 0. Throws InputError: the log cannot be
  /// written.
  Recording(const Connections& connections, const std::filesystem::path& log, double start_utc_s,
            const RunnerOptions& options = {});

  /// Sees every arrival before the log does.
  using Onlooker = std::function<void(const Arrival&)>;
  /// Takes what has come, waiting for at most `wait_s`, and writes what is due. One thread calls this.
  void turn(double wait_s, const Onlooker& onlooker = {});
  /// Ends all sources within a few seconds, takes what they have delivered and closes the log.
  void finish(const Onlooker& onlooker = {});

  [[nodiscard]] const Connections& connections() const noexcept { return connections_; }
  [[nodiscard]] std::vector<SourceStatus> sources() const;
  [[nodiscard]] const RecorderStatus& log() const noexcept { return recorder_ ? recorder_->status() : unrecorded_; }
  [[nodiscard]] double startUtc() const noexcept { return recorder_ ? recorder_->startUtc() : start_s_; }
  /// Sentences about sources that were never reached and columns that never had a value.
  [[nodiscard]] std::vector<std::string> shortcomings() const;
  [[nodiscard]] nlohmann::json json() const;

 private:
  void takeAll(const Onlooker& onlooker);

  Connections connections_;
  double start_s_;
  RecorderStatus unrecorded_;  ///< what there is to say without a log
  std::unique_ptr<LogRecorder> recorder_;
  std::shared_ptr<RecordQueue> queue_;
  std::vector<std::unique_ptr<SourceRunner>> runners_;  ///< null where no column is mapped
  std::vector<Arrival> taken_;
};

}  // namespace spindrift
