// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/job_context.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <mutex>
#include <thread>
#include <vector>

#include "core/base/error.h"

namespace spindrift {
namespace {

class Recorder : public ProgressSink {
 public:
  void report(double fraction, std::string_view) override {
    const std::scoped_lock lock(mutex);
    fractions.push_back(fraction);
  }
  std::mutex mutex;
  std::vector<double> fractions;
};

TEST(JobContext, PartsMapTheirOwnProgress) {
  Recorder recorder;
  const JobContext job({}, &recorder);
  job.part(0.5, 1.0).part(0.0, 0.5).report(0.5, "inner");
  job.report(2.0, "clamped");
  EXPECT_THAT(recorder.fractions, ::testing::ElementsAre(0.625, 1.0));
}

TEST(JobContext, ParallelForVisitsEveryItemOnce) {
  std::vector<std::atomic<int>> visits(1000);
  parallelFor(visits.size(), JobContext(), [&](std::size_t i) { ++visits[i]; });
  for (const auto& v : visits) EXPECT_EQ(v.load(), 1);
}

TEST(JobContext, ParallelForStopsAtCancelAndRethrowsTheFirstFailure) {
  std::stop_source stop;
  std::atomic<int> done{0};
  EXPECT_THROW(parallelFor(100000, JobContext(stop.get_token(), nullptr),
                           [&](std::size_t) {
                             if (++done == 10) stop.request_stop();
                           }),
               Cancelled);
  EXPECT_LT(done.load(), 1000);
  EXPECT_THROW(parallelFor(100, JobContext(),
                           [](std::size_t i) {
                             if (i == 7) throw InputError("seven");
                           }),
               InputError);
  EXPECT_NO_THROW(parallelFor(0, JobContext(), [](std::size_t) { FAIL(); }));
}

std::size_t threadsOfProcess() {
  const std::filesystem::directory_iterator tasks("/proc/self/task");
  return static_cast<std::size_t>(std::distance(begin(tasks), end(tasks)));
}

/// SPINDRIFT_THREADS for the life of a test.
class Threads {
 public:
  explicit Threads(const char* count) { ::setenv("SPINDRIFT_THREADS", count, 1); }
  ~Threads() { ::unsetenv("SPINDRIFT_THREADS"); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;
};

TEST(JobContext, NestedLoopsShareTheThreadsOfOnePool) {
  const Threads four("4");
  parallelFor(4, JobContext(), [](std::size_t) {});
  const std::size_t before = threadsOfProcess();
  std::atomic<std::size_t> most{0};
  std::atomic<int> visits{0};
  parallelFor(8, JobContext(), [&](std::size_t) {
    parallelFor(8, JobContext(), [&](std::size_t) {
      parallelFor(8, JobContext(), [&](std::size_t) {
        const std::size_t now = threadsOfProcess();
        std::size_t seen = most.load();
        while (now > seen && !most.compare_exchange_weak(seen, now)) {
        }
        ++visits;
      });
    });
  });
  EXPECT_EQ(visits.load(), 512);
  EXPECT_LE(most.load(), before);
  EXPECT_EQ(threadsOfProcess(), before);
}

TEST(JobContext, OuterCallersOfTheirOwnThreadsDoNotAddWorkers) {
  const Threads four("4");
  parallelFor(4, JobContext(), [](std::size_t) {});
  const std::size_t before = threadsOfProcess();
  std::atomic<int> visits{0};
  std::atomic<std::size_t> most{0};
  {
    std::vector<std::jthread> jobs;
    for (int j = 0; j < 6; ++j)
      jobs.emplace_back([&] {
        for (int k = 0; k < 50; ++k)
          parallelFor(5, JobContext(),
                      [&](std::size_t) { parallelFor(3, JobContext(), [&](std::size_t) { ++visits; }); });
        most = std::max(most.load(), threadsOfProcess());
      });
  }
  EXPECT_EQ(visits.load(), 6 * 50 * 5 * 3);
  EXPECT_LE(most.load(), before + 6);
}

TEST(JobContext, AnInnerFailureReachesTheOuterCaller) {
  const Threads four("4");
  EXPECT_THROW(parallelFor(6, JobContext(),
                           [](std::size_t o) {
                             parallelFor(6, JobContext(), [o](std::size_t i) {
                               if (o == 3 && i == 4) throw InputError("inner");
                             });
                           }),
               InputError);
  std::atomic<int> after{0};
  parallelFor(100, JobContext(), [&](std::size_t) { ++after; });
  EXPECT_EQ(after.load(), 100);
}

TEST(JobContext, ManySmallLoopsAreFast) {
  const Threads four("4");
  const auto start = std::chrono::steady_clock::now();
  std::atomic<long> sum{0};
  for (int k = 0; k < 100'000; ++k) parallelFor(4, JobContext(), [&](std::size_t i) { sum += static_cast<long>(i); });
  const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(sum.load(), 600'000);
  EXPECT_LT(s, 10.0);  // below 0.1 s; with threads of their own for every loop more than 20 s
}

TEST(Error, AssertionNamesWhatWasViolated) {
  try {
    SPINDRIFT_ASSERT(1 + 1 == 3, "arithmetic");
    FAIL();
  } catch (const InternalError& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr("arithmetic"), ::testing::HasSubstr("1 + 1 == 3"),
                                               ::testing::HasSubstr("job_context_test.cpp")));
  }
}

}  // namespace
}  // namespace spindrift
