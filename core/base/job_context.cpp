// SPDX-License-Identifier: Apache-2.0
#include "core/base/job_context.h"

#include <algorithm>
#include <atomic>
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

void parallelFor(std::size_t count, const JobContext& job, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&] {
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
  };
  const std::size_t threads = std::min<std::size_t>(threadCount(), count);
  {
    std::vector<std::jthread> pool;
    for (std::size_t i = 1; i < threads; ++i) pool.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
  job.throwIfCancelled();
}

}  // namespace spindrift
