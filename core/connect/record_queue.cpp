// SPDX-License-Identifier: Apache-2.0
#include "core/connect/record_queue.h"

#include <algorithm>
#include <chrono>

namespace spindrift {

RecordQueue::RecordQueue(std::size_t capacity) : capacity_(std::max<std::size_t>(1, capacity)) {
  waiting_.reserve(std::min<std::size_t>(capacity_, 1024));
}

bool RecordQueue::push(Arrival arrival, const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  if (!room_.wait(lock, stop, [&] { return waiting_.size() < capacity_; })) return false;
  waiting_.push_back(std::move(arrival));
  if (waiting_.size() == 1) news_.notify_one();
  return true;
}

void RecordQueue::take(std::vector<Arrival>& out, double wait_s) {
  out.clear();
  std::unique_lock lock(mutex_);
  news_.wait_for(lock, std::chrono::duration<double>(wait_s), [&] { return !waiting_.empty(); });
  out.swap(waiting_);
  room_.notify_all();
}

std::size_t RecordQueue::size() const {
  const std::scoped_lock lock(mutex_);
  return waiting_.size();
}

}  // namespace spindrift
