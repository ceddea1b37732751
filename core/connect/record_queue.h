// SPDX-License-Identifier: Apache-2.0
// Between the threads of the sources and the one that records: bounded, so that memory stays flat. A full queue makes
// the sources wait, and with them their peers; nothing is thrown away.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <stop_token>
#include <vector>

#include "core/connect/record.h"

namespace spindrift {

class RecordQueue {
 public:
  explicit RecordQueue(std::size_t capacity = 1 << 16);

  /// Waits while the queue is full. False: `stop` was requested first, and the arrival is not in the queue.
  [[nodiscard]] bool push(Arrival arrival, const std::stop_token& stop);
  /// Moves everything into `out` (what it held is dropped), waiting for at most `wait_s` if there is nothing.
  void take(std::vector<Arrival>& out, double wait_s);
  [[nodiscard]] std::size_t size() const;

 private:
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable_any room_;
  std::condition_variable_any news_;
  std::vector<Arrival> waiting_;
};

}  // namespace spindrift
