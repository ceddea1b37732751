// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/jobs/job_runner.h"
#include "widgets/jobs/latest_work.h"

#include <gtest/gtest.h>

#include <QPushButton>
#include <QSignalSpy>
#include <QTableView>
#include <QTest>
#include <atomic>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include "core/base/error.h"
#include "widgets/jobs/activity_dialog.h"
#include "widgets/jobs/job_bar.h"
#include "widgets/models/rows_model.h"

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

// Another session: what waits is not begun, and whoever asked for it is told.
TEST(JobRunner, WhatWaitsIsToldWhenItWillNotBeBegun) {
  JobRunner runner;
  Job running;
  running.title = QStringLiteral("running");
  running.work = [](JobContext& context) -> std::function<void()> {
    while (!context.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return [] {};
  };
  bool cancelled = false;
  Job waiting;
  waiting.title = QStringLiteral("waiting");
  waiting.work = [](JobContext&) -> std::function<void()> { return [] {}; };
  waiting.cancelled = [&] { cancelled = true; };
  QSignalSpy finished(&runner, &JobRunner::finished);
  runner.run(std::move(running));
  runner.run(std::move(waiting));
  runner.cancelOfSession();
  EXPECT_TRUE(cancelled);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, 10000));
  ASSERT_EQ(finished.count(), 2);
  EXPECT_EQ(finished[0][0].toString(), QStringLiteral("waiting"));
  EXPECT_EQ(finished[0][1].value<JobOutcome>(), JobOutcome::Cancelled);
}

// A fit fails while a page reads what it shows: the sentence stays, however quickly or slowly the page is.
TEST(JobRunner, WhatIsReadToBeShownDoesNotHideWhatFailed) {
  for (const auto& [shown, display_ends_last] :
       {std::pair{JobQueue::Display, true}, std::pair{JobQueue::Display, false}, std::pair{JobQueue::Reading, true},
        std::pair{JobQueue::Reading, false}}) {
    JobRunner runner;
    JobBar bar(runner);
    bar.setMessage(QStringLiteral("opened"));
    std::promise<void> display_may_end, work_may_end;
    Job display;
    display.title = QStringLiteral("reading the points");
    display.queue = shown;
    display.work = [&](JobContext&) -> std::function<void()> {
      display_may_end.get_future().wait();
      return [] {};
    };
    Job work;
    work.title = QStringLiteral("fitting");
    work.work = [&](JobContext&) -> std::function<void()> {
      work_may_end.get_future().wait();
      throw InputError({"a.csv"}, "is not there.");
    };
    runner.run(std::move(display));
    EXPECT_EQ(bar.message(), QStringLiteral("reading the points"));
    runner.run(std::move(work));
    (display_ends_last ? work_may_end : display_may_end).set_value();
    const JobQueue first = display_ends_last ? JobQueue::Work : shown;
    EXPECT_TRUE(QTest::qWaitFor([&] { return runner.firstOf(first).isEmpty(); }, 10000));
    (display_ends_last ? display_may_end : work_may_end).set_value();
    EXPECT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, 10000));
    EXPECT_TRUE(bar.message().contains(QStringLiteral("is not there"))) << bar.message().toStdString();
    for (const Message& message : bar.log().messages())
      EXPECT_FALSE(message.text.contains(QStringLiteral("done"))) << message.text.toStdString();
    // Another page is another matter.
    bar.leaveFailure();
    std::atomic<int> applied{0};
    Job next = counting(applied);
    next.queue = shown;
    runner.run(std::move(next));
    EXPECT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, 10000));
    EXPECT_EQ(bar.message(), QStringLiteral("counting: done"));
  }
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

/// Runs until it is stopped or let go.
Job lasting(std::atomic<bool>& go_on, std::vector<std::string>& applied, const std::string& name) {
  Job job;
  job.title = QString::fromStdString(name);
  job.work = [&go_on, &applied, name](JobContext& context) -> std::function<void()> {
    while (!go_on) {
      context.throwIfCancelled();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return [&applied, name] { applied.push_back(name); };
  };
  return job;
}

TEST(JobRunner, WhatIsToBeShownDoesNotWaitForLongWork) {
  JobRunner runner;
  std::atomic<bool> go_on{false};
  std::vector<std::string> applied;
  runner.run(lasting(go_on, applied, "long"));
  std::atomic<int> shown{0};
  Job job = counting(shown);
  job.queue = JobQueue::Display;
  runner.run(std::move(job));
  EXPECT_TRUE(QTest::qWaitFor([&] { return shown == 1; }, 10000));
  EXPECT_TRUE(applied.empty());
  EXPECT_TRUE(runner.working());
  EXPECT_EQ(runner.title(), QStringLiteral("long"));
  go_on = true;
  EXPECT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, 10000));
  EXPECT_EQ(applied, std::vector<std::string>{"long"});
}

TEST(JobRunner, APictureWaitsForNothingThatTakesAWhileToRead) {
  JobRunner runner;
  std::atomic<bool> go_on{false};
  std::vector<std::string> applied;
  for (const JobQueue queue :
       {JobQueue::Campaign, JobQueue::Work, JobQueue::Reading, JobQueue::Files, JobQueue::Batch}) {
    Job slow = lasting(go_on, applied, "slow");
    slow.queue = queue;
    runner.run(std::move(slow));
  }
  std::atomic<int> shown{0};
  Job picture = counting(shown);
  picture.queue = JobQueue::Display;
  runner.run(std::move(picture));
  EXPECT_TRUE(QTest::qWaitFor([&] { return shown == 1; }, 10000));
  EXPECT_TRUE(applied.empty());
  runner.cancelOfSession();
  EXPECT_TRUE(QTest::qWaitFor([&] { return runner.entries().size() == 1; }, 10000)) << "the batch alone goes on";
  go_on = true;
  EXPECT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, 10000));
}

TEST(JobRunner, ABatchKeepsNobodyFromWorking) {
  JobRunner runner;
  std::atomic<bool> go_on{false};
  std::atomic<bool> at_once{true};
  std::vector<std::string> applied;
  Job batch = lasting(go_on, applied, "batch");
  batch.queue = JobQueue::Batch;
  runner.run(std::move(batch));
  EXPECT_EQ(runner.title(), QStringLiteral("batch"));
  runner.run(lasting(at_once, applied, "work"));
  EXPECT_EQ(runner.title(), QStringLiteral("work")) << "what one waits for is told first";
  EXPECT_TRUE(QTest::qWaitFor([&] { return applied.size() == 1; }, 10000));
  EXPECT_FALSE(runner.working());
  EXPECT_TRUE(runner.busy());
  EXPECT_EQ(runner.title(), QStringLiteral("batch"));
  go_on = true;
  EXPECT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, 10000));
  EXPECT_EQ(applied, (std::vector<std::string>{"work", "batch"}));
}

TEST(LatestWork, SaysThatItIsBusyUntilTheAnswerIsThere) {
  ASSERT_FALSE(LatestWork::anyBusy());
  int answered = 0;
  std::promise<void> go;
  {
    LatestWork work;
    work.ask([done = go.get_future().share(), &answered] {
      done.wait();
      return [&answered] { ++answered; };
    });
    EXPECT_TRUE(LatestWork::anyBusy());
    work.ask([&answered] { return [&answered] { answered += 10; }; });
    go.set_value();
    EXPECT_TRUE(QTest::qWaitFor([] { return !LatestWork::anyBusy(); }, 5000));
    EXPECT_EQ(answered, 10) << "the first was not wanted any more";
    work.ask([] { return [] {}; });
    EXPECT_TRUE(LatestWork::anyBusy());
  }
  EXPECT_FALSE(LatestWork::anyBusy()) << "nobody waits for what is gone";
}

TEST(JobRunner, TheLatestOfAKeyWins) {
  for (const JobQueue queue :
       {JobQueue::Campaign, JobQueue::Work, JobQueue::Display, JobQueue::Reading, JobQueue::Files, JobQueue::Batch}) {
    JobRunner runner;
    std::atomic<bool> go_on{false};
    std::vector<std::string> applied;
    int given_up = 0;
    for (const char* name : {"first", "second", "third"}) {
      Job job = lasting(go_on, applied, name);
      job.queue = queue;
      job.key = "picture";
      job.cancelled = [&] { ++given_up; };
      runner.run(std::move(job));
    }
    go_on = true;
    EXPECT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, 10000));
    EXPECT_EQ(applied, std::vector<std::string>{"third"});
    EXPECT_EQ(given_up, 2) << "whoever asked is told";
  }
}

// A file is being read that cannot be left in the middle: what was chosen instead does not wait for its end.
TEST(JobRunner, NobodyWaitsForWhatIsAbandoned) {
  JobRunner runner;
  JobBar bar(runner);
  std::atomic<bool> go_on{false};
  std::vector<std::string> applied;
  int given_up = 0;
  const auto reading = [&](const char* name) {
    Job job;
    job.title = QString::fromLatin1(name);
    job.work = [&go_on, &applied, name](JobContext&) -> std::function<void()> {
      while (std::string_view(name) != "small" && !go_on) std::this_thread::sleep_for(std::chrono::milliseconds(2));
      return [&applied, name] { applied.emplace_back(name); };
    };
    job.cancelled = [&] { ++given_up; };
    job.queue = JobQueue::Campaign;
    job.key = "campaign";
    job.abandonable = true;
    return runner.run(std::move(job));
  };
  reading("large");
  EXPECT_EQ(runner.title(), QStringLiteral("large"));
  reading("small");
  EXPECT_EQ(given_up, 1);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, 10000));
  EXPECT_EQ(applied, std::vector<std::string>{"small"});
  const int id = reading("another large");
  runner.cancel(id);
  EXPECT_FALSE(runner.busy());
  EXPECT_EQ(given_up, 2);
  EXPECT_TRUE(bar.cancelButton()->isHidden());
  EXPECT_FALSE(bar.log().messages().empty());
  go_on = true;
  QTest::qWait(50);
  EXPECT_EQ(applied, std::vector<std::string>{"small"}) << "nothing of them is applied when they end";
}

TEST(JobRunner, WhatFailsBesideLongWorkIsAmongTheMessages) {
  JobRunner runner;
  JobBar bar(runner);
  std::atomic<bool> go_on{false};
  std::vector<std::string> applied;
  runner.run(lasting(go_on, applied, "long"));
  for (const JobQueue queue : {JobQueue::Display, JobQueue::Batch}) {
    Job job;
    job.title = QStringLiteral("reading");
    job.work = [](JobContext&) -> std::function<void()> { throw InputError({"a.csv", "line 3"}, "that cannot be."); };
    job.queue = queue;
    const std::size_t before = bar.log().messages().size();
    runner.run(std::move(job));
    ASSERT_TRUE(QTest::qWaitFor([&] { return bar.log().messages().size() > before; }, 10000));
    EXPECT_EQ(bar.log().messages().front().tone, Tone::Bad);
    EXPECT_TRUE(bar.log().messages().front().text.contains(QStringLiteral("a.csv")));
    EXPECT_EQ(bar.message(), QStringLiteral("long")) << "the bar goes on telling of the long work";
    EXPECT_FALSE(bar.cancelButton()->isHidden());
  }
  go_on = true;
  EXPECT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, 10000));
  EXPECT_EQ(bar.log().messages().size(), 3U);
}

TEST(ActivityDialog, ListsWhatRunsAndWaitsAndCancelsOne) {
  JobRunner runner;
  JobBar bar(runner);
  std::atomic<bool> go_on{false};
  std::vector<std::string> applied;
  for (const char* name : {"first", "second", "third"}) runner.run(lasting(go_on, applied, name));
  ActivityDialog dialog(runner, bar.log());
  dialog.show();
  ASSERT_EQ(dialog.jobs()->rowCount(), 3);
  EXPECT_EQ(dialog.jobs()->rows()[1].cells[1].text, QStringLiteral("waits"));
  EXPECT_TRUE(bar.activityButton()->text().contains(QStringLiteral("2")));
  dialog.jobTable()->selectRow(1);
  QTest::mouseClick(dialog.cancelButton(), Qt::LeftButton);
  EXPECT_EQ(dialog.jobs()->rowCount(), 2);
  go_on = true;
  EXPECT_TRUE(QTest::qWaitFor([&] { return !runner.busy(); }, 10000));
  EXPECT_EQ(applied, (std::vector<std::string>{"first", "third"}));
  EXPECT_EQ(dialog.jobs()->rowCount(), 0);
  // Both ends are still to be read, the newest first; so is what the next message overwrote in the bar.
  bar.setMessage(QStringLiteral("one"));
  bar.setMessage(QStringLiteral("two"));
  ASSERT_EQ(dialog.messages()->rowCount(), 4);
  EXPECT_EQ(dialog.messages()->rows()[1].cells[1].text, QStringLiteral("one"));
  EXPECT_TRUE(dialog.messages()->rows()[3].cells[1].text.contains(QStringLiteral("first")));
  if (const QString folder = qEnvironmentVariable("SPINDRIFT_PICTURES"); !folder.isEmpty())
    dialog.grab().save(folder + QStringLiteral("/activity.png"));
}

}  // namespace
}  // namespace spindrift::gui
