// SPDX-License-Identifier: Apache-2.0
// Answers by the text of their question: what two threads ask for at once is made once, what was made is kept.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "core/base/error.h"
#include "core/base/job_context.h"

namespace spindrift {

template <typename Answer>
class AnswerCache {
 public:
  /// Keeps the `most` answers that were asked for last.
  explicit AnswerCache(std::size_t most) : most_(most) {}

  struct Kept {
    std::shared_ptr<const Answer> answer;
    bool fresh = false;  ///< made for this call
  };

  /// The answer to `key`, from `make()` (a shared pointer) where there is none. Whoever waits for the making of another
  /// thread gets its answer or its exception; a making that was cancelled is begun again by one who still wants it.
  /// Failures are not kept. Throws Cancelled.
  template <typename Make>
  [[nodiscard]] Kept get(const std::string& key, const JobContext& job, const Make& make) {
    std::unique_lock lock(mutex_);
    for (;;) {
      job.throwIfCancelled();
      const auto found = entries_.find(key);
      if (found == entries_.end()) break;
      if (found->second.answer) {
        found->second.used = ++clock_;
        return {found->second.answer, false};
      }
      const std::shared_ptr<Making> making = found->second.making;
      changed_.wait_for(lock, std::chrono::milliseconds(50));
      if (making->failure) std::rethrow_exception(making->failure);
    }
    const auto making = std::make_shared<Making>();
    entries_[key].making = making;
    lock.unlock();
    std::shared_ptr<const Answer> answer;
    try {
      answer = make();
    } catch (const Cancelled&) {
      forget(key);
      throw;
    } catch (...) {
      lock.lock();
      making->failure = std::current_exception();
      lock.unlock();
      forget(key);
      throw;
    }
    lock.lock();
    entries_[key] = {answer, nullptr, ++clock_};
    dropOldest();
    changed_.notify_all();
    return {answer, true};
  }

 private:
  struct Making {
    std::exception_ptr failure;
  };
  struct Entry {
    std::shared_ptr<const Answer> answer;  ///< null while it is being made
    std::shared_ptr<Making> making;
    std::uint64_t used = 0;
  };

  void forget(const std::string& key) {
    const std::scoped_lock lock(mutex_);
    entries_.erase(key);
    changed_.notify_all();
  }

  void dropOldest() {
    for (;;) {
      std::size_t kept = 0;
      auto oldest = entries_.end();
      for (auto it = entries_.begin(); it != entries_.end(); ++it) {
        if (!it->second.answer) continue;
        ++kept;
        if (oldest == entries_.end() || it->second.used < oldest->second.used) oldest = it;
      }
      if (kept <= most_) return;
      entries_.erase(oldest);
    }
  }

  std::size_t most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, Entry> entries_;
  std::uint64_t clock_ = 0;
};

}  // namespace spindrift
