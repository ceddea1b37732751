// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/job_context.h"

#include <gmock/gmock.h>

#include <atomic>
#include <mutex>
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
