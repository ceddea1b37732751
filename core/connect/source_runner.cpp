// SPDX-License-Identifier: Apache-2.0
#include "core/connect/source_runner.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>

#include "core/connect/source_clock.h"

namespace spindrift {

/// Kept alive by the thread, which may outlive the runner.
struct SourceRunner::Shared final : RecordSink {
  std::uint32_t index = 0;
  std::unique_ptr<Source> source;
  std::vector<std::string> items;
  std::shared_ptr<RecordQueue> queue;
  RunnerOptions options;
  std::stop_source stop;
  std::map<std::uint16_t, SourceClock> clocks;
  double last_time_s = 0.0;  ///< of the newest record; 0: none yet
  bool delivered = false;    ///< by the present connection

  mutable std::mutex mutex;
  std::condition_variable_any changed;
  SourceStatus status;
  bool ended = false;
  std::thread thread;

  bool push(Delivery what) { return queue->push({index, std::move(what)}, stop.get_token()); }

  void record(Record record) override {
    const double now = localUtc();
    if (std::isnan(record.received_s)) record.received_s = now;
    // Since when a state holds says nothing of the clock.
    SourceClock& clock = clocks[record.clock];
    record.time_s = record.snapshot ? record.received_s : clock.toLocal(record.source_s, record.received_s);
    last_time_s = std::max(last_time_s, record.time_s);
    delivered = true;
    const bool in_queue = push(std::move(record));
    const std::scoped_lock lock(mutex);
    ++(in_queue ? status.records : status.undelivered);
    status.last_s = now;
    status.clock_offset_s = clocks.begin()->second.offset_s();
    status.clock_steps = 0;
    for (const auto& [number, each] : clocks) status.clock_steps += each.steps();
  }

  void missed(const std::string& why) override { missedOf({}, why); }

  void missedOf(const std::vector<std::uint32_t>& which, const std::string& why) override {
    const double now = localUtc();
    {
      const std::scoped_lock lock(mutex);
      ++status.missed;
    }
    (void)push(Notice{Notice::Kind::Missed, last_time_s > 0.0 ? last_time_s : now, now, why, which});
  }

  void units(ItemUnits learnt) override { (void)push(std::move(learnt)); }

  void note(const std::string& sentence) override {
    (void)push(Notice{Notice::Kind::Note, localUtc(), localUtc(), sentence});
  }

  void enter(SourceStatus::State state, const std::string& sentence) {
    const std::scoped_lock lock(mutex);
    status.state = state;
    status.sentence = sentence;
    if (state == SourceStatus::State::Live) ++status.connections;
  }

  /// Ends with an exception, or when stopped.
  void connection(bool first) {
    const std::stop_token token = stop.get_token();
    source->connect(token);
    if (token.stop_requested()) return;
    enter(SourceStatus::State::Live, "");
    (void)push(Notice{first ? Notice::Kind::Connected : Notice::Kind::Resumed, last_time_s, localUtc(), ""});
    ItemUnits told;
    for (const std::string& item : items) told.units.push_back(source->unit(item));
    (void)push(std::move(told));
    source->subscribe(items, *this, token);
    while (!token.stop_requested()) source->poll(options.poll_s, *this);
  }

  void run() {
    double pause_s = options.first_pause_s;
    bool first = true;
    bool told = false;  // that it is lost
    while (!stop.stop_requested()) {
      delivered = false;
      std::string reason;
      const std::uint64_t before = status.connections;
      try {
        connection(first);
        source->close();
        break;
      } catch (const std::exception& error) {
        reason = error.what();
      } catch (...) {
        reason = "an unknown fault";
      }
      source->close();
      if (status.connections > before) {
        first = false;
        told = false;
      }
      if (delivered) pause_s = options.first_pause_s;
      enter(SourceStatus::State::Lost, reason);
      if (!told) (void)push(Notice{Notice::Kind::Lost, last_time_s, localUtc(), reason});
      told = true;
      std::unique_lock lock(mutex);
      changed.wait_for(lock, stop.get_token(), std::chrono::duration<double>(pause_s), [] { return false; });
      pause_s = std::min(2.0 * pause_s, options.longest_pause_s);
    }
    const std::scoped_lock lock(mutex);
    status.state = SourceStatus::State::Stopped;
    ended = true;
    changed.notify_all();
  }
};

SourceRunner::SourceRunner(std::uint32_t index, std::unique_ptr<Source> source, std::vector<std::string> items,
                           std::shared_ptr<RecordQueue> queue, const RunnerOptions& options)
    : shared_(std::make_shared<Shared>()) {
  shared_->index = index;
  shared_->source = std::move(source);
  shared_->items = std::move(items);
  shared_->queue = std::move(queue);
  shared_->options = options;
  shared_->thread = std::thread([shared = shared_] { shared->run(); });
}

SourceRunner::~SourceRunner() {
  stop();
}

SourceStatus SourceRunner::status() const {
  const std::scoped_lock lock(shared_->mutex);
  return shared_->status;
}

void SourceRunner::requestStop() {
  shared_->stop.request_stop();
}

bool SourceRunner::stop() {
  if (stopped_) return true;
  stopped_ = true;
  requestStop();
  std::unique_lock lock(shared_->mutex);
  const bool in_time = shared_->changed.wait_for(lock, std::chrono::duration<double>(shared_->options.stop_patience_s),
                                                 [&] { return shared_->ended; });
  lock.unlock();
  if (in_time) {
    shared_->thread.join();
  } else {
    shared_->thread.detach();
  }
  return in_time;
}

}  // namespace spindrift
