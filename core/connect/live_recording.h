// SPDX-License-Identifier: Apache-2.0
// A recording on a thread of its own, for callers that must not wait (a window): they look at a snapshot.
//
//   sources (a thread each) -> queue -> this thread: log.csv, newest values, last hour  <- snapshot() at any time
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/connect/connections.h"
#include "core/connect/live_values.h"
#include "core/connect/source_runner.h"

namespace spindrift {

struct LiveSource {
  std::string name;
  std::string url;
  SourceStatus status;
};

struct LiveSnapshot {
  bool recording = false;  ///< into a log; false: only looked at
  double now_s = 0.0;      ///< UTC
  double start_s = 0.0;    ///< UTC where time_s of the log is 0
  std::vector<LiveSource> sources;
  std::vector<LiveColumn> columns;
  std::uint64_t rows = 0;
  std::string problem;                 ///< why rows wait (disk full), or why the recording broke off; empty: nothing
  std::vector<std::string> gaps;       ///< the last 100
  std::vector<std::string> sentences;  ///< about words and units

  [[nodiscard]] const LiveColumn* find(std::string_view column) const;
  /// True while nothing comes from the source of a column.
  [[nodiscard]] bool isLost(const LiveColumn& column) const;
};

class LiveRecording {
 public:
  /// As Recording; throws InputError.
  LiveRecording(const Connections& connections, const std::filesystem::path& log, double start_utc_s,
                const RunnerOptions& options = {});
  /// Ends it and waits until the log is closed: a few seconds where a source hangs.
  ~LiveRecording();
  LiveRecording(const LiveRecording&) = delete;
  LiveRecording& operator=(const LiveRecording&) = delete;

  void requestStop();
  /// The log is closed.
  [[nodiscard]] bool ended() const;
  [[nodiscard]] LiveSnapshot snapshot() const;
  [[nodiscard]] const Connections& connections() const;
  [[nodiscard]] std::vector<LivePoint> history(std::size_t column) const;
  /// As LiveValues::at, by the name of the column.
  [[nodiscard]] std::optional<LivePoint> at(std::string_view column, double utc_s) const;

 private:
  struct Shared;
  std::unique_ptr<Shared> shared_;
};

/// What the connected columns say of the machine at rest: `spindle_rpm` and the mean absolute feeds `feed_x_mm_min` (y,
/// z).
struct MachineRest {
  bool tells = false;    ///< at least one of them is connected and known
  bool at_rest = false;  ///< all that are known are at rest, and none of them is lost or unknown
  /// "The spindle is still turning (600 rpm): wait until it stands still."; empty at rest or where nothing tells.
  std::string sentence;
};
[[nodiscard]] MachineRest machineRest(const LiveSnapshot& snapshot);

}  // namespace spindrift
