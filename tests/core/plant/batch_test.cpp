// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <pthread.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <iterator>
#include <map>
#include <set>
#include <stop_token>
#include <thread>

#include "core/base/random.h"
#include "core/plant/batch_queue.h"
#include "core/plant/batch_work.h"
#include "core/plant/batch_worker.h"
#include "tests/core/plant/both_stores.h"
#include "tests/support/refusal.h"
#include "tests/support/source_folder.h"

namespace spindrift {
namespace {

using ::spindrift::testing::OnBothStores;
using ::spindrift::testing::refusal;
using ::spindrift::testing::TempFolder;
using ::spindrift::testing::TemporaryPostgres;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

void nap(double s) {
  std::this_thread::sleep_for(std::chrono::duration<double>(s));
}

BatchPlan seeds(std::int64_t count, std::int64_t chunk = 1, double lease_s = 30.0) {
  BatchPlan plan;
  plan.name = "study";
  plan.work = "hidden_effect";
  plan.first_seed = 100;
  plan.seeds = count;
  plan.chunk = chunk;
  plan.lease_s = lease_s;
  return plan;
}

nlohmann::json square(const BatchPlan& plan, std::int64_t item, int, JobContext&) {
  const auto seed = plan.first_seed + static_cast<std::uint64_t>(item);
  return {{"square", seed * seed}};
}

class BatchTest : public OnBothStores {
 protected:
  [[nodiscard]] std::int64_t submit(const BatchPlan& plan) {
    PlantStore store = make();
    return BatchQueue(store).submit(plan);
  }
  [[nodiscard]] BatchState state(std::int64_t id) {
    PlantStore store = PlantStore::open(address());
    return BatchQueue(store).state(id);
  }
  [[nodiscard]] std::map<std::int64_t, ItemAnswer> answers(std::int64_t id) {
    PlantStore store = PlantStore::open(address());
    std::map<std::int64_t, ItemAnswer> found;
    BatchQueue(store).answers(id, [&](const ItemAnswer& a) { found[a.item] = a; });
    return found;
  }
};
INSTANTIATE_TEST_SUITE_P(On, BatchTest, ::testing::Values("sqlite", "postgresql"), testing::storeName);

TEST_P(BatchTest, TheSamePlanTwiceIsOneBatch) {
  const std::int64_t id = submit(seeds(10, 4));
  EXPECT_EQ(submit(seeds(10, 4)), id);
  const std::int64_t other = submit(seeds(11, 4));
  EXPECT_NE(other, id);
  EXPECT_EQ(state(id).chunks, 3);
  EXPECT_EQ(state(id).items, 10);
  PlantStore store = PlantStore::open(address());
  EXPECT_EQ(BatchQueue(store).find(std::to_string(id)), id);
  EXPECT_EQ(BatchQueue(store).find("study"), other) << "of a name the newest";
  EXPECT_THAT(refusal([&] { (void)BatchQueue(store).find("no"); }), HasSubstr("holds no batch \"no\""));
  PlantStore writer = open(PlantRole::Writer);
  EXPECT_THAT(refusal([&] { (void)BatchQueue(writer).submit(seeds(12)); }), HasSubstr("needs an owner"));
}

TEST_P(BatchTest, EveryItemIsAnsweredOnce) {
  const std::int64_t id = submit(seeds(23, 5));
  WorkerOptions options;
  options.work = square;
  const WorkerReport report = workOnBatch(address("writer_one"), id, options);
  EXPECT_EQ(report.items, 23);
  const BatchState s = state(id);
  EXPECT_TRUE(s.finished());
  EXPECT_EQ(s.answered, 23);
  EXPECT_EQ(s.attempts, 5);
  EXPECT_EQ(answers(id).at(22).answer.at("square"), 122 * 122);
  EXPECT_EQ(workOnBatch(address("writer_one"), id, options).items, 0) << "nothing is left";
}

TEST_P(BatchTest, AnOvertakenWorkerStoresNothing) {
  const std::int64_t id = submit(seeds(1, 1, 0.2));
  PlantStore a = PlantStore::open(address());
  PlantStore b = PlantStore::open(address());
  const auto first = BatchQueue(a).claim(id, "a", "local");
  ASSERT_TRUE(first);
  EXPECT_FALSE(BatchQueue(b).claim(id, "b", "local")) << "the lease holds";
  nap(0.3);
  const auto second = BatchQueue(b).claim(id, "b", "local");
  ASSERT_TRUE(second);
  EXPECT_GT(second->attempt, first->attempt);
  EXPECT_FALSE(BatchQueue(a).extend(*first));
  EXPECT_FALSE(BatchQueue(a).finish(*first, ChunkOutcome::Done, {{0, 1.0, false, "late"}}, "", 1.0));
  EXPECT_TRUE(BatchQueue(b).finish(*second, ChunkOutcome::Done, {{0, 1.0, false, "right"}}, "", 1.0));
  EXPECT_TRUE(BatchQueue(b).finish(*second, ChunkOutcome::Done, {{0, 1.0, false, "right"}}, "", 1.0))
      << "again, when nobody knows whether the commit counted";
  EXPECT_FALSE(BatchQueue(a).finish(*first, ChunkOutcome::Done, {{0, 1.0, false, "late"}}, "", 1.0));
  EXPECT_EQ(answers(id).at(0).answer, "right");
  EXPECT_EQ(state(id).lost, 1);
}

TEST_P(BatchTest, AHeartbeatKeepsALongChunk) {
  const std::int64_t id = submit(seeds(1, 1, 1.2));
  std::thread slow([&] {
    WorkerOptions options;
    options.worker = "slow";
    options.work = [](const BatchPlan&, std::int64_t, int attempt, JobContext&) {
      nap(3.0);
      return nlohmann::json(attempt);
    };
    EXPECT_EQ(workOnBatch(address(), id, options).items, 1);
  });
  nap(2.2);
  PlantStore other = PlantStore::open(address());
  EXPECT_FALSE(BatchQueue(other).claim(id, "other", "local"));
  slow.join();
  EXPECT_EQ(answers(id).at(0).answer, 1);
}

TEST_P(BatchTest, WhatTheDataRefuseIsToldOnceAndWhatFailsIsTriedAgain) {
  BatchPlan plan = seeds(4, 4);
  plan.retries = 2;
  const std::int64_t id = submit(plan);
  int refused = 0;
  int failing = 0;
  WorkerOptions options;
  options.work = [&](const BatchPlan&, std::int64_t item, int attempt, JobContext&) -> nlohmann::json {
    if (item == 1 && ++refused > 0) throw InputError("no observations.");
    if (item == 2 && ++failing > 0) throw std::runtime_error("no memory");
    return attempt;
  };
  (void)workOnBatch(address(), id, options);
  const auto found = answers(id);
  ASSERT_EQ(found.size(), 4U) << "one bad item does not take the others of its chunk along";
  EXPECT_EQ(found.at(0).answer, 3);
  EXPECT_TRUE(found.at(1).failed);
  EXPECT_EQ(found.at(1).answer.at("error"), "seed 101: no observations.");
  EXPECT_TRUE(found.at(2).failed);
  EXPECT_EQ(failing, 3);
  EXPECT_EQ(state(id).failed_items, 2);
  EXPECT_EQ(state(id).attempts, 3);
}

TEST_P(BatchTest, AnItemThatTakesTooLongIsStopped) {
  BatchPlan plan = seeds(2);
  plan.item_time_limit_s = 0.2;
  plan.retries = 0;
  const std::int64_t id = submit(plan);
  WorkerOptions options;
  options.work = [](const BatchPlan&, std::int64_t item, int, JobContext& job) -> nlohmann::json {
    for (int i = 0; item == 0 && i < 1000; ++i) {
      job.throwIfCancelled();
      nap(0.01);
    }
    return "in time";
  };
  (void)workOnBatch(address(), id, options);
  EXPECT_THAT(answers(id).at(0).answer.at("error").get<std::string>(), HasSubstr("took longer than 0.2 s"));
  EXPECT_EQ(answers(id).at(1).answer, "in time");
}

TEST_P(BatchTest, AnItemThatNeverStopsLosesItsProcessAndNothingElse) {
  BatchPlan plan = seeds(2);
  plan.item_time_limit_s = 0.1;
  plan.retries = 0;
  const std::int64_t id = submit(plan);
  const PlantAddress where = address();
  const auto run = [&] {
    const pid_t child = ::fork();
    if (child == 0) {
      WorkerOptions options;
      options.work = [](const BatchPlan&, std::int64_t item, int, JobContext&) -> nlohmann::json {
        while (item == 0) nap(1.0);
        return "in time";
      };
      (void)workOnBatch(where, id, options);
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  EXPECT_EQ(run(), gave_up);
  EXPECT_EQ(run(), 0);
  EXPECT_EQ(state(id).failed, 1);
  EXPECT_THAT(state(id).error, HasSubstr("did not stop when asked to"));
  EXPECT_EQ(answers(id).at(1).answer, "in time");
}

TEST_P(BatchTest, CancelEndsWhatRunsAndResumeGoesOn) {
  const std::int64_t id = submit(seeds(40, 1, 0.3));
  std::thread worker([&] {
    WorkerOptions options;
    options.work = [](const BatchPlan& plan, std::int64_t item, int attempt, JobContext& job) {
      for (int i = 0; i < 10; ++i) {
        job.throwIfCancelled();
        nap(0.01);
      }
      return square(plan, item, attempt, job);
    };
    (void)workOnBatch(address(), id, options);
  });
  nap(0.8);
  {
    PlantStore store = PlantStore::open(address());
    BatchQueue(store).cancel(id);
  }
  worker.join();
  const BatchState cancelled = state(id);
  EXPECT_TRUE(cancelled.cancelled);
  EXPECT_LT(cancelled.answered, 40);
  EXPECT_EQ(cancelled.running, 0) << "given back, not left to its lease";
  WorkerOptions options;
  options.work = square;
  EXPECT_EQ(workOnBatch(address(), id, options).items, 0);
  {
    PlantStore store = PlantStore::open(address());
    BatchQueue(store).resume(id);
  }
  (void)workOnBatch(address(), id, options);
  EXPECT_EQ(state(id).answered, 40);
}

TEST_P(BatchTest, AWorkerOfAnotherProgramVersionIsRefused) {
  const std::int64_t id = submit(seeds(3));
  sql("update batch set program = '9.9.9'");
  EXPECT_THAT(refusal([&] { (void)workOnBatch(address(), id, {}); }),
              HasSubstr("was started with program version 9.9.9, this worker has " SPINDRIFT_VERSION));
  EXPECT_EQ(state(id).attempts, 0);
}

TEST_P(BatchTest, AComputerWithoutTheFilesIsRefused) {
  BatchPlan plan;
  plan.name = "monthly";
  plan.work = "fit";
  plan.campaigns = {folder_ / "not/here"};
  const std::int64_t id = submit(plan);
  const std::string said = refusal([&] { (void)workOnBatch(address(), id, {}); });
  EXPECT_THAT(said, HasSubstr("not/here: is not on the computer "));
  EXPECT_EQ(state(id).attempts, 0) << "another computer may have them: nothing has failed";
}

TEST_P(BatchTest, WorkersThatVanishTooOftenFailTheChunk) {
  BatchPlan plan = seeds(2, 1, 0.01);
  plan.retries = 1;
  const std::int64_t id = submit(plan);
  PlantStore store = PlantStore::open(address());
  BatchQueue queue(store);
  std::set<std::int64_t> chunks;
  for (int i = 0; i < 4; ++i) {
    const auto claim = queue.claim(id, "w", "local");
    ASSERT_TRUE(claim);
    chunks.insert(claim->chunk);
    nap(0.03);
  }
  EXPECT_FALSE(queue.claim(id, "w", "local"));
  EXPECT_EQ(queue.state(id).failed, 2);
  EXPECT_THAT(queue.state(id).error, HasSubstr("2 workers vanished over items"));
  queue.resume(id);
  EXPECT_TRUE(queue.claim(id, "w", "local"));
}

/// Workers killed at random while they work, and the server under them: each item has its answer, once.
TEST_P(BatchTest, KilledWorkersAndAKilledServerLoseNothing) {
  constexpr std::int64_t items = 400;
  BatchPlan plan = seeds(items, 5, 0.5);
  plan.retries = 50;
  const std::int64_t id = submit(plan);
  const PlantAddress where = address("writer_one");
  Random random(4);
  std::set<pid_t> workers;
  const auto start = [&] {
    const pid_t child = ::fork();
    if (child == 0) {
      WorkerOptions options;
      options.work = [](const BatchPlan& p, std::int64_t item, int attempt, JobContext& job) {
        nap(0.004);
        return square(p, item, attempt, job);
      };
      try {
        (void)workOnBatch(where, id, options);
      } catch (const std::exception& e) {
        std::fprintf(stderr, "worker: %s\n", e.what());
      }
      ::_exit(0);
    }
    workers.insert(child);
  };
  int killed = 0;
  bool server_killed = false;
  const auto begin = std::chrono::steady_clock::now();
  BatchState now;
  do {
    while (workers.size() < 4) start();
    nap(0.15);
    if (killed < 3 || (killed < 8 && random.uniform() < 0.6)) {
      ::kill(*std::next(workers.begin(), static_cast<long>(random.index(workers.size()))), SIGKILL);
      ++killed;
    }
    if (onServer() && !server_killed && killed >= 3) {
      TemporaryPostgres::shared().kill();
      TemporaryPostgres::shared().start();
      server_killed = true;
    }
    int status = 0;
    for (pid_t child; (child = ::waitpid(-1, &status, WNOHANG)) > 0;) workers.erase(child);
    now = state(id);
    ASSERT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(60)) << now.summary();
  } while (!now.finished());
  for (const pid_t child : workers) ::waitpid(child, nullptr, 0);
  EXPECT_GE(killed, 3);
  EXPECT_EQ(server_killed, onServer());
  const auto found = answers(id);
  ASSERT_EQ(found.size(), static_cast<std::size_t>(items));
  for (const auto& [item, answer] : found) EXPECT_EQ(answer.answer.at("square"), (100 + item) * (100 + item));
  EXPECT_EQ(now.answered, items);
  EXPECT_EQ(now.failed_items, 0);
}

TEST(BatchPlanTest, SaysWhatIsWrongWithAPlan) {
  const TempFolder folder;
  const auto refused = [&](const std::string& rest) {
    const auto file = folder.write("plan.json", R"({"format":"spindrift-batch","version":1,"name":"x",)" + rest + "}");
    return refusal([&] { (void)BatchPlan::read(file); });
  };
  EXPECT_THAT(refused(R"("work":"dance")"), HasSubstr("allowed: evaluate, fit"));
  EXPECT_THAT(refused(R"("work":"fit","seeds":[1,2])"), HasSubstr("a list \"campaigns\""));
  EXPECT_THAT(refused(R"("work":"hidden_effect","seeds":[5,2])"), HasSubstr("a whole number from 5"));
  EXPECT_THAT(refused(R"("work":"simulate","seeds":[1,2])"), HasSubstr("needs the option \"scenario\""));
  EXPECT_THAT(refused(R"("work":"command","seeds":[1,2],"options":{"run":[]})"), HasSubstr("the program first"));
  EXPECT_THAT(refused(R"("work":"fit","campaigns":["a"],"chunk":0)"), HasSubstr("a whole number from 1"));
  EXPECT_EQ(refused(R"("work":"fit","campaigns":["a","../b"])"), "");
  const BatchPlan plan = BatchPlan::read(folder / "plan.json");
  EXPECT_EQ(plan.campaigns[0], folder / "a");
  EXPECT_EQ(BatchPlan::parse(plan.json().dump(), "again").json(), plan.json());
}

TEST(BatchPlanTest, ProgramsAnswerAndAreEndedWithAllTheyStarted) {
  EXPECT_EQ(outputOf({"printf", "a b"}, JobContext()), "a b");
  EXPECT_THAT(refusal([] { (void)outputOf({"/no/such"}, JobContext()); }), HasSubstr("cannot be started"));
  EXPECT_THAT(refusal([] { (void)outputOf({"sh", "-c", "exit 7"}, JobContext()); }), HasSubstr("exit status 7"));
  std::stop_source stop;
  const auto begin = std::chrono::steady_clock::now();
  std::jthread later([&] {
    nap(0.2);
    stop.request_stop();
  });
  EXPECT_THROW((void)outputOf({"sh", "-c", "sleep 30 & sleep 30; wait"}, JobContext(stop.get_token(), nullptr)),
               Cancelled);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

/// A signal that asks a worker to stop comes while it waits for a program.
TEST(BatchPlanTest, ASignalEndsTheWaitForAProgram) {
  static std::stop_source stop;
  const auto before = std::signal(SIGUSR1, [](int) { stop.request_stop(); });
  const pthread_t waiting = ::pthread_self();
  std::jthread later([&] {
    nap(0.3);
    ::pthread_kill(waiting, SIGUSR1);
  });
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THROW((void)outputOf({"sleep", "20"}, JobContext(stop.get_token(), nullptr)), Cancelled);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
  (void)std::signal(SIGUSR1, before);
}

TEST(BatchWork, SimulatesAndFitsTheSameTwice) {
  const TempFolder folder;
  BatchPlan plan;
  plan.name = "made";
  plan.work = "simulate";
  plan.first_seed = 7;
  plan.seeds = 1;
  plan.options = {{"scenario", spindrift::testing::sourceFolder().string() + "/resources/scenarios/hole_bar.json"},
                  {"out", (folder / "made").string()}};
  JobContext job;
  const nlohmann::json made = workOut(plan, 0, job);
  EXPECT_EQ(workOut(plan, 0, job), made) << "a second attempt finds what the first one left";
  BatchPlan evaluate;
  evaluate.name = "evaluated";
  evaluate.work = "evaluate";
  evaluate.campaigns = {made.at("campaign").get<std::string>()};
  EXPECT_THAT(workOut(evaluate, 0, job).at("cycles"), Not(IsEmpty()));
  BatchPlan study = seeds(1);
  study.options = {{"kind", "one"}, {"strength", 6.0}};
  const nlohmann::json answer = workOut(study, 0, job);
  EXPECT_TRUE(answer.contains("verdict"));
  EXPECT_EQ(answer.at("hidden").size(), 1U);
}

}  // namespace
}  // namespace spindrift
