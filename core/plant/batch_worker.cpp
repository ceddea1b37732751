// SPDX-License-Identifier: Apache-2.0
#include "core/plant/batch_worker.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "core/base/error.h"
#include "core/base/log.h"
#include "core/base/steady_seconds.h"
#include "core/plant/batch_work.h"
#include "core/plant/plant_connection.h"

namespace spindrift {
namespace {

using Clock = std::chrono::steady_clock;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

bool asked(const WorkerOptions& options) {
  return options.stop != nullptr && options.stop->load();
}

/// A store that may go away and come back. `body` is one whole transaction that may be repeated.
class PatientStore {
 public:
  PatientStore(const PlantAddress& address, const WorkerOptions& options) : address_(address), options_(options) {}

  template <typename Body>
  auto run(Body body) {
    const auto begin = Clock::now();
    double pause_s = options_.patience_pause_s;
    for (;;) {
      try {
        if (!store_) store_ = std::make_unique<PlantStore>(PlantStore::open(address_));
        BatchQueue queue(*store_);
        return body(queue);
      } catch (const PlantUnreachable& away) {
        store_.reset();
        if (secondsSince(begin) > options_.patience_s) throw;
        log(LogLevel::Info, std::string("waiting for the plant store: ") + away.what());
      }
      std::this_thread::sleep_for(std::chrono::duration<double>(pause_s));
      pause_s = std::min(2.0, 1.6 * pause_s);
    }
  }

 private:
  PlantAddress address_;
  const WorkerOptions& options_;
  std::unique_ptr<PlantStore> store_;
};

/// Keeps a claim alive, and watches over the time of the item that is worked on.
class Heartbeat {
 public:
  Heartbeat(const PlantAddress& address, const WorkerOptions& options, const BatchPlan& plan, const BatchClaim& claim)
      : address_(address), options_(options), plan_(plan), claim_(claim), thread_([this] { beat(); }) {}
  ~Heartbeat() {
    {
      const std::scoped_lock lock(mutex_);
      over_ = true;
    }
    wake_.notify_all();
    thread_.join();
  }
  Heartbeat(const Heartbeat&) = delete;
  Heartbeat& operator=(const Heartbeat&) = delete;

  /// The item that begins now; gives its stop token.
  [[nodiscard]] std::stop_token begin(std::int64_t item) {
    const std::scoped_lock lock(mutex_);
    item_ = item;
    began_ = Clock::now();
    stop_ = std::stop_source();
    if (lost_ || asked(options_)) stop_.request_stop();
    timed_out_ = false;
    return stop_.get_token();
  }
  void end() {
    const std::scoped_lock lock(mutex_);
    item_ = -1;
  }
  [[nodiscard]] bool lost() const { return lost_; }
  [[nodiscard]] bool timedOut() const { return timed_out_; }

 private:
  void beat() {
    std::unique_ptr<PlantStore> store;
    auto last = Clock::now();
    std::unique_lock lock(mutex_);
    const double tick_s = std::clamp(std::min(plan_.lease_s / 3.0, plan_.item_time_limit_s / 4.0), 0.02, 0.5);
    while (!wake_.wait_for(lock, std::chrono::duration<double>(tick_s), [this] { return over_; })) {
      if (item_ >= 0 && (lost_ || asked(options_))) stop_.request_stop();
      if (item_ >= 0 && secondsSince(began_) > plan_.item_time_limit_s) {
        timed_out_ = true;
        stop_.request_stop();
        if (secondsSince(began_) > 2.0 * plan_.item_time_limit_s + 1.0) leaveBehind();
      }
      if (secondsSince(last) < plan_.lease_s / 3.0) continue;
      last = Clock::now();
      lock.unlock();
      try {
        if (!store) store = std::make_unique<PlantStore>(PlantStore::open(address_));
        if (!BatchQueue(*store).extend(claim_)) lost_ = true;
      } catch (const std::exception&) {
        store.reset();  // away: what is worked on goes on, the next beat tries again
      }
      lock.lock();
    }
  }

  /// The item does not stop when asked to: this process cannot go on.
  void leaveBehind() {
    try {
      PlantStore store = PlantStore::open(address_);
      (void)BatchQueue(store).finish(claim_, ChunkOutcome::Failed, {},
                                     fmt::format("{}: took longer than {} s and did not stop when asked to",
                                                 plan_.itemName(item_), plan_.item_time_limit_s),
                                     secondsSince(began_));
    } catch (const std::exception& away) {
      log(LogLevel::Warning, away.what());
    }
    std::_Exit(gave_up);
  }

  const PlantAddress& address_;
  const WorkerOptions& options_;
  const BatchPlan& plan_;
  const BatchClaim& claim_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool over_ = false;
  std::int64_t item_ = -1;
  Clock::time_point began_;
  std::stop_source stop_;
  std::atomic<bool> lost_{false};
  std::atomic<bool> timed_out_{false};
  std::thread thread_;
};

struct ChunkWork {
  ChunkOutcome outcome = ChunkOutcome::Done;
  std::vector<ItemAnswer> answers;
  std::string error;
};

ChunkWork workOnChunk(const PlantAddress& address, const BatchPlan& plan, const BatchClaim& claim,
                      const WorkerOptions& options) {
  ChunkWork done;
  Heartbeat heartbeat(address, options, plan, claim);
  for (std::int64_t item = claim.first_item; item < claim.first_item + claim.items; ++item) {
    if (asked(options) || heartbeat.lost()) return {ChunkOutcome::Released, {}, "stopped"};
    JobContext job(heartbeat.begin(item), nullptr);
    const auto begin = Clock::now();
    std::string error;
    bool of_the_data = false;
    ItemAnswer answer{item, 0.0, false, nullptr};
    try {
      answer.answer = options.work ? options.work(plan, item, claim.attempt, job) : workOut(plan, item, job);
    } catch (const Cancelled&) {
      if (!heartbeat.timedOut()) {
        heartbeat.end();
        return {ChunkOutcome::Released, {}, "stopped"};
      }
      error = fmt::format("took longer than {} s", plan.item_time_limit_s);
    } catch (const InputError& e) {
      error = e.what();
      of_the_data = true;
    } catch (const std::exception& e) {
      error = e.what();
    }
    heartbeat.end();
    answer.work_s = secondsSince(begin);
    if (!error.empty()) {
      error = plan.itemName(item) + ": " + error;
      // What the data refuse they refuse again; anything else is tried again, and told in the end in place of an
      // answer.
      if (!of_the_data && !claim.last_try) return {ChunkOutcome::Failed, {}, error};
      answer.failed = true;
      answer.answer = {{"error", error}};
    }
    done.answers.push_back(std::move(answer));
  }
  return done;
}

}  // namespace

std::string workerName() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  if (const std::string array = environment("SLURM_ARRAY_JOB_ID"); !array.empty())
    return fmt::format("slurm:{}_{}", array, environment("SLURM_ARRAY_TASK_ID"));
  return fmt::format("local:{}:{}", host.data(), ::getpid());
}

WorkerReport workOnBatch(const PlantAddress& address, std::int64_t batch, const WorkerOptions& options) {
  const std::string worker = options.worker.empty() ? workerName() : options.worker;
  PatientStore store(address, options);
  const BatchPlan plan = store.run([&](BatchQueue& queue) { return queue.plan(batch); });
  plan.requireFiles();
  // A task that Slurm started again frees what its own earlier run held.
  store.run([&](BatchQueue& queue) { queue.releaseDead(batch, worker); });
  WorkerReport report;
  const auto begin = Clock::now();
  const auto mayGoOn = [&] {
    return !asked(options) && (options.budget_s <= 0.0 || secondsSince(begin) < options.budget_s);
  };
  std::optional<BatchClaim> claim;
  if (mayGoOn()) claim = store.run([&](BatchQueue& queue) { return queue.claim(batch, worker, options.engine); });
  while (claim) {
    const auto chunk_begin = Clock::now();
    const ChunkWork done = workOnChunk(address, plan, *claim, options);
    const double spent_s = secondsSince(chunk_begin);
    const BatchQueue::Finished finished = store.run([&](BatchQueue& queue) -> BatchQueue::Finished {
      if (mayGoOn())
        return queue.finishAndClaim(*claim, done.outcome, done.answers, done.error, spent_s, worker, options.engine);
      return {queue.finish(*claim, done.outcome, done.answers, done.error, spent_s), std::nullopt};
    });
    if (!finished.held) ++report.dropped;
    if (finished.held && done.outcome == ChunkOutcome::Done) {
      ++report.chunks;
      report.items += claim->items;
    }
    claim = finished.next;
  }
  report.stopped = asked(options);
  return report;
}

}  // namespace spindrift
