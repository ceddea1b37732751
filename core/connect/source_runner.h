// SPDX-License-Identifier: Apache-2.0
// Keeps one source connected on a thread of its own: connects, subscribes, polls, and after any fault connects again
// with a growing pause. Whatever the source throws ends nothing but the present connection.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/connect/record_queue.h"
#include "core/connect/source.h"

namespace spindrift {

struct RunnerOptions {
  double first_pause_s = 0.5;  ///< before the second attempt; doubles each time
  double longest_pause_s = 30.0;
  double poll_s = 0.1;           ///< longest single wait inside the source
  double stop_patience_s = 3.0;  ///< after that a thread that hangs in the system is left behind
};

struct SourceStatus {
  enum class State { Connecting, Live, Lost, Stopped };
  State state = State::Connecting;
  std::string sentence;       ///< why it is lost; empty while live
  std::uint64_t records = 0;  ///< delivered into the queue
  std::uint64_t connections = 0;
  std::uint64_t missed = 0;       ///< how often something was missed
  std::uint64_t undelivered = 0;  ///< came while stopping with a full queue
  double last_s = 0.0;            ///< when the last record came, our clock; 0: none yet
  double clock_offset_s = 0.0;    ///< source minus ours, of its first clock; NaN: it sends no times
  int clock_steps = 0;            ///< how often one of its clocks was set
};

class SourceRunner {
 public:
  /// Starts at once. `index` marks its arrivals.
  SourceRunner(std::uint32_t index, std::unique_ptr<Source> source, std::vector<std::string> items,
               std::shared_ptr<RecordQueue> queue, const RunnerOptions& options = {});
  ~SourceRunner();
  SourceRunner(const SourceRunner&) = delete;
  SourceRunner& operator=(const SourceRunner&) = delete;

  [[nodiscard]] SourceStatus status() const;
  void requestStop();
  /// Returns within stop_patience_s. False: the thread hangs and was left behind; it delivers nothing any more.
  bool stop();

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
  bool stopped_ = false;
};

}  // namespace spindrift
