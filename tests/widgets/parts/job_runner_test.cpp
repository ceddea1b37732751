// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/jobs/job_runner.h"

#include <gtest/gtest.h>

#include <QPushButton>
#include <QSignalSpy>
#include <QTest>
#include <atomic>
#include <thread>

#include "core/base/error.h"
#include "widgets/jobs/job_bar.h"

namespace spindrift::gui {
namespace {

Job counting(std::atomic<int>& applied, std::thread::id* thread_of_apply = nullptr) {
  Job job;
  job.title = QStringLiteral("counting");
  job.work = [&applied, thread_of_apply](JobContext& context) -> std::function<void()> {
    context.report(0.5, "half");
    return [&applied, thread_of_apply] {
      ++applied;
      if (thread_of_apply != nullptr) *thread_of_apply = std::this_thread::get_id();
    };
  };
  return job;
}

TEST(JobRunner, AppliesOnTheGuiThreadOneAfterAnother) {
  JobRunner runner;
  std::atomic<int> applied{0};
  std::thread::id where;
  for (int i = 0; i < 3; ++i) runner.run(counting(applied, &where));
  EXPECT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, 10000));
  EXPECT_EQ(applied, 3);
  EXPECT_EQ(where, std::this_thread::get_id());
}

// The user presses Cancel: the job stops soon and nothing of it is applied.
TEST(JobRunner, CancelAppliesNothing) {
  JobRunner runner;
  JobBar bar(runner);
  bar.resize(900, 52);
  bar.show();
  std::atomic<bool> started{false};
  bool applied = false;
  bool cancelled = false;
  Job job;
  job.title = QStringLiteral("endless");
  job.work = [&](JobContext& context) -> std::function<void()> {
    started = true;
    for (;;) {
      context.throwIfCancelled();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return [&] { applied = true; };
  };
  job.cancelled = [&] { cancelled = true; };
  runner.run(std::move(job));
  ASSERT_TRUE(QTest::qWaitFor([&] { return started.load(); }, 10000));
  ASSERT_TRUE(bar.cancelButton()->isVisible());
  QTest::mouseClick(bar.cancelButton(), Qt::LeftButton);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, 10000));
  EXPECT_FALSE(applied);
  EXPECT_TRUE(cancelled);
  EXPECT_TRUE(bar.message().contains(QStringLiteral("cancelled")));
  EXPECT_FALSE(bar.cancelButton()->isVisible());
}

TEST(JobRunner, BadInputBecomesASentence) {
  JobRunner runner;
  QString sentence;
  Job job;
  job.title = QStringLiteral("reading");
  job.work = [](JobContext&) -> std::function<void()> { throw InputError({"a.csv", "line 3"}, "that cannot be."); };
  job.failed = [&](const QString& text) { sentence = text; };
  QSignalSpy finished(&runner, &JobRunner::finished);
  runner.run(std::move(job));
  EXPECT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, 10000));
  EXPECT_TRUE(sentence.contains(QStringLiteral("a.csv")));
  ASSERT_EQ(finished.count(), 1);
  EXPECT_EQ(finished[0][1].value<JobOutcome>(), JobOutcome::Failed);
}

TEST(JobRunner, ClosingWhileAJobRunsIsSafe) {
  std::atomic<bool> started{false};
  bool applied = false;
  {
    JobRunner runner;
    Job job;
    job.work = [&](JobContext& context) -> std::function<void()> {
      started = true;
      while (!context.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
      return [&] { applied = true; };
    };
    runner.run(std::move(job));
    while (!started) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_FALSE(applied);
}

}  // namespace
}  // namespace spindrift::gui
