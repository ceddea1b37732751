// SPDX-License-Identifier: Apache-2.0
// All sources of connections.json into one log, until it is told to end.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/connect/connections.h"
#include "core/connect/log_recorder.h"
#include "core/connect/source_runner.h"

namespace spindrift {

class Recording {
 public:
  /// Starts at once. `start_utc_s`: where time_s is 0. Throws InputError: the log cannot be written.
  Recording(const Connections& connections, const std::filesystem::path& log, double start_utc_s,
            const RunnerOptions& options = {});

  /// Takes what has come, waiting for at most `wait_s`, and writes what is due. One thread calls this.
  void turn(double wait_s);
  /// Ends all sources within a few seconds, takes what they have delivered and closes the log.
  void finish();

  [[nodiscard]] const Connections& connections() const noexcept { return connections_; }
  [[nodiscard]] std::vector<SourceStatus> sources() const;
  [[nodiscard]] const RecorderStatus& log() const noexcept { return recorder_.status(); }
  /// Sentences about sources that were never reached and columns that never had a value.
  [[nodiscard]] std::vector<std::string> shortcomings() const;
  [[nodiscard]] nlohmann::json json() const;

 private:
  Connections connections_;
  LogRecorder recorder_;
  std::shared_ptr<RecordQueue> queue_;
  std::vector<std::unique_ptr<SourceRunner>> runners_;
  std::vector<Arrival> taken_;
};

}  // namespace spindrift
