// SPDX-License-Identifier: Apache-2.0
#include "core/base/job_context.h"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "core/base/error.h"

namespace spindrift {

JobContext JobContext::part(double from, double to) const {
  JobContext sub = *this;
  sub.from_ = from_ + (to_ - from_) * from;
  sub.to_ = from_ + (to_ - from_) * to;
  return sub;
}

void JobContext::report(double fraction, std::string_view stage) const {
  if (sink_ != nullptr) sink_->report(from_ + (to_ - from_) * std::clamp(fraction, 0.0, 1.0), stage);
}

void JobContext::throwIfCancelled() const {
  if (cancelled()) throw Cancelled();
}

unsigned threadCount() {
  if (const char* text = std::getenv("SPINDRIFT_THREADS"); text != nullptr) {
    const long wanted = std::strtol(text, nullptr, 10);
    if (wanted >= 1) return static_cast<unsigned>(wanted);
  }
  return std::max(1U, std::thread::hardware_concurrency());
}

namespace {

/// One call of parallelFor, on the stack of its caller.
struct Loop {
  Loop(std::size_t items, const JobContext& context, const std::function<void(std::size_t)>& of_item)
      : count(items), job(context), body(of_item) {}

  const std::size_t count;
  const JobContext& job;
  const std::function<void(std::size_t)>& body;
  std::atomic<std::size_t> next{0};
  std::mutex failure_mutex;
  std::exception_ptr failure;
  // Under the pool's mutex:
  std::size_t places = 0;  ///< workers that may still join
  std::size_t joined = 0;  ///< workers in it now
  std::condition_variable left;

  void work() {
    for (;;) {
      const std::size_t index = next.fetch_add(1);
      if (index >= count || job.cancelled()) return;
      try {
        body(index);
      } catch (...) {
        const std::scoped_lock lock(failure_mutex);
        if (!failure) failure = std::current_exception();
        next.store(count);
        return;
      }
    }
  }
};

/// The workers of all loops of the process. A worker joins the newest loop that has a place, so that an inner loop is
/// over before more of the outer one begins. The caller of a loop works on it itself and then waits only for workers
/// that are in it: what they wait for in turn is always further inside, so nesting cannot block.
class Pool {
 public:
  /// Never destroyed: its threads sleep when the process ends. A process that is forked off has none of them, and
  /// begins with a pool of its own.
  static Pool& instance() {
    static const bool made = [] {
      current() = new Pool;
      return ::pthread_atfork([] { current()->mutex_.lock(); }, [] { current()->mutex_.unlock(); },
                              [] {
                                current()->mutex_.unlock();
                                current() = new Pool;
                              }) == 0;
    }();
    SPINDRIFT_ASSERT(made, "the pool is told of forks");
    return *current();
  }

  void run(Loop& loop, std::size_t helpers) {
    {
      const std::scoped_lock lock(mutex_);
      while (workers_.size() < helpers) workers_.emplace_back([this] { serve(); });
      loop.places = helpers;
      loops_.push_back(&loop);
    }
    if (helpers == 1) {
      wanted_.notify_one();
    } else {
      wanted_.notify_all();
    }
    loop.work();
    std::unique_lock lock(mutex_);
    std::erase(loops_, &loop);
    loop.left.wait(lock, [&] { return loop.joined == 0; });
  }

 private:
  static Pool*& current() {
    static Pool* pool = nullptr;
    return pool;
  }

  [[noreturn]] void serve() {
    std::unique_lock lock(mutex_);
    for (;;) {
      const auto open = std::find_if(loops_.rbegin(), loops_.rend(), [](const Loop* loop) {
        return loop->places > 0 && loop->next.load() < loop->count;
      });
      if (open == loops_.rend()) {
        wanted_.wait(lock);
        continue;
      }
      Loop& loop = **open;
      --loop.places;
      ++loop.joined;
      lock.unlock();
      loop.work();
      lock.lock();
      if (--loop.joined == 0) loop.left.notify_one();
    }
  }

  std::mutex mutex_;
  std::condition_variable wanted_;
  std::vector<Loop*> loops_;  ///< that may have places, oldest first
  std::vector<std::thread> workers_;
};

}  // namespace

void parallelFor(std::size_t count, const JobContext& job, const std::function<void(std::size_t)>& body) {
  Loop loop(count, job, body);
  const std::size_t threads = std::min<std::size_t>(threadCount(), count);
  if (threads > 1) {
    Pool::instance().run(loop, threads - 1);
  } else {
    loop.work();
  }
  if (loop.failure) std::rethrow_exception(loop.failure);
  job.throwIfCancelled();
}

}  // namespace spindrift
