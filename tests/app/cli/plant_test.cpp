// SPDX-License-Identifier: GPL-3.0-or-later
// `plant ...` and `batch ...`: two processes, a real store, a real Slurm.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>

#include "core/base/random.h"
#include "core/plant/plant_store.h"
#include "core/session/session.h"
#include "core/tasks/campaign_state.h"
#include "tests/app/cli/child_process.h"
#include "tests/core/plant/temporary_postgres.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A session with one campaign that has a fit.
void makeSession(const std::filesystem::path& folder, const std::string& start_utc, double value) {
  Session s = Session::create(folder);
  const std::int64_t id = s.newCampaign("warm-up", start_utc,
                                        R"({"format":"spindrift-machine","version":1,"name":"mill",
                                            "chain":"V [w-X'-Y'-b-Z-t]","axes":[{"name":"X","travel_mm":[0,300]}]})");
  const TaskLedger nothing_runs;
  (void)s.keepResult(CampaignState::read(s, id).tasks(s, nothing_runs).origin("fit"),
                     {{"status", "converged"},
                      {"state", "M1"},
                      {"parameters", {{"EX_um", {{"value", value}, {"standard_uncertainty", 0.2}}}}}});
}

TEST(PlantCommand, PublishesListsTrendsAndExports) {
  const TempFolder folder;
  const std::string store = (folder / "plant.sqlite").string();
  for (int month = 1; month <= 9; ++month) {
    const std::string session = (folder / ("s" + std::to_string(month))).string();
    makeSession(session, "2025-0" + std::to_string(month) + "-01T08:00:00Z", 0.1 * month);
    const auto answer = jsonOf({"plant", "publish", session, "--store", store});
    EXPECT_EQ(answer.at("campaigns_new"), 1);
  }
  EXPECT_EQ(jsonOf({"plant", "publish", (folder / "s3").string(), "--store", store}).at("campaigns_new"), 0);
  const auto list = jsonOf({"plant", "list", "--store", store});
  EXPECT_EQ(list.at("machines").at(0).at("name"), "mill");
  EXPECT_EQ(list.at("campaigns").size(), 9U);
  EXPECT_GT(list.at("machines").at(0).at("overdue_days").get<double>(), 30.0);
  (void)jsonOf({"plant", "event", "mill", "--kind", "re_levelled", "--time", "2025-05-15T00:00:00Z", "--note", "twice",
                "--store", store});
  const auto trend =
      jsonOf({"plant", "trend", "mill", "EX_um", "--store", store, "--csv", (folder / "t.csv").string()});
  EXPECT_EQ(trend.at("points").size(), 9U);
  EXPECT_EQ(trend.at("events").at(0).at("note"), "twice");
  EXPECT_THAT(textOf(folder / "t.csv"), HasSubstr("time_utc,campaign,value"));
  const auto exported = jsonOf({"plant", "export", "--machine", "mill", "--html", (folder / "m.html").string(), "--out",
                                (folder / "all.json").string(), "--store", store});
  EXPECT_EQ(exported.at("campaigns").size(), 9U);
  EXPECT_THAT(textOf(folder / "m.html"), HasSubstr("re_levelled"));
  const auto compared = jsonOf({"plant", "compare", "1", "3", "--store", store});
  EXPECT_EQ(compared.at("parameters").at(0).at("parameter"), "EX_um");
  EXPECT_NEAR(compared.at("parameters").at(0).at("largest_difference_in_sigma").get<double>(),
              0.2 / std::hypot(0.2, 0.2), 1e-9);
  expectBadInput({"plant", "compare", "1", "--store", store}, {"two or more"});
  expectBadInput({"plant", "trend", "mill", "EQ_um", "--store", store}, {"no parameter \"EQ_um\"", "fit/EX_um"});
  expectBadInput({"plant", "list", "--store", (folder / "none.sqlite").string()}, {"is not there"});
  expectBadInput({"plant", "list", "--store", "postgresql:host=a password=b"}, {"holds a password"});
  expectBadInput({"plant", "event", "mill", "--store", store}, {"Nothing is entered"});
  expectBadInput({"plant", "list"}, {"No plant store is named"});
}

TEST(PlantCommand, WhatCannotBePublishedWaitsInTheSession) {
  const TempFolder folder;
  makeSession(folder / "s", "2025-01-01T08:00:00Z", 1.0);
  const std::string away = "postgresql:host=" + (folder / "nowhere").string() + " dbname=plant user=me";
  const Outcome said = runCli({"plant", "publish", (folder / "s").string(), "--store", away});
  EXPECT_EQ(said.status, 1);
  EXPECT_THAT(said.output, HasSubstr("1 campaign waits in the session"));
  EXPECT_THAT(said.output, HasSubstr("cannot be reached"));
}

std::string planOf(const TempFolder& folder, const std::string& command, int items, const std::string& more = "") {
  return folder
      .write("plan.json", R"({"format":"spindrift-batch","version":1,"name":"n","work":"command","seeds":[1,)" +
                              std::to_string(items) + R"(],"options":{"run":["sh","-c",")" + command +
                              R"(","sh","{seed}"]})" + more + "}")
      .string();
}

TEST(BatchCommand, RunsOnThisComputerAndReplacesWorkersThatDie) {
  const TempFolder folder;
  const std::string store = (folder / "plant.sqlite").string();
  // Item 5 takes its worker with it the first time.
  const std::string die = folder.path().string() + "/died";
  const std::string plan = planOf(
      folder, "[ $1 = 5 ] && [ ! -e " + die + " ] && touch " + die + " && kill -9 $PPID; echo $(( $1 * $1 ))", 12);
  const auto answer = jsonOf({"batch", plan, "--engine", "local", "--processes", "2", "--store", store});
  EXPECT_EQ(answer.at("answered"), 12);
  EXPECT_EQ(answer.at("processes_killed"), 1);
  EXPECT_EQ(answer.at("lost_attempts"), 1);
  EXPECT_EQ(jsonOf({"batch", plan, "--store", store}).at("attempts"), answer.at("attempts")) << "the same plan is done";
  const auto status = jsonOf({"batch", "status", "n", "--store", store, "--results", (folder / "r.jsonl").string()});
  EXPECT_EQ(status.at("open_chunks"), 0);
  const auto lines = linesOf(folder / "r.jsonl");
  ASSERT_EQ(lines.size(), 12U);
  EXPECT_EQ(nlohmann::json::parse(lines[4]).at("answer"), 25);
  EXPECT_EQ(nlohmann::json::parse(lines[4]).at("name"), "seed 5");
  EXPECT_EQ(jsonOf({"batch", "status", "--store", store}).at("batches").size(), 1U);
  expectBadInput({"batch", "status", "m", "--store", store}, {"holds no batch \"m\""});
  expectBadInput({"batch", "--store", store}, {"PLAN.json"});
}

TEST(BatchCommand, CancelledBatchesAreResumedAndFailuresTold) {
  const TempFolder folder;
  const std::string store = (folder / "plant.sqlite").string();
  const std::string gate = folder.path().string() + "/gate";
  const std::string plan = planOf(folder, "[ -e " + gate + " ] || exit 3; echo 1", 3, R"(,"retries":0)");
  const auto failed = jsonOf({"batch", plan, "--store", store}, 1);
  EXPECT_EQ(failed.at("failed_items"), 3);
  (void)folder.write("gate", "");
  const auto resumed = jsonOf({"batch", "resume", "n", "--store", store});
  EXPECT_EQ(resumed.at("failed_items"), 0);
  EXPECT_EQ(resumed.at("answered"), 3);
  EXPECT_EQ(jsonOf({"batch", "cancel", "1", "--store", store}).at("cancelled"), true);
}

/// What the store holds is what the command says of the same campaign alone, number by number.
TEST(BatchCommand, AnswersAsTheCommandsDoAlone) {
  const TempFolder folder;
  const std::string store = (folder / "plant.sqlite").string();
  const std::string scenarios = sourceFolder().string() + "/resources/scenarios/";
  for (const char* seed : {"1", "2"}) {
    for (const char* scenario : {"discrepancy_vertical", "hole_bar"})
      (void)jsonOf({"simulate", scenarios + scenario + ".json", "--seed", seed, "--out",
                    (folder / (std::string(scenario) + "-" + seed)).string()});
  }
  struct Work {
    std::string work;
    std::string scenario;
    std::string options;
    std::vector<std::string> before;  ///< the command alone
    std::vector<std::string> after;
    std::vector<std::string> left_out;  ///< as large as the campaign, or not asked for in a batch
  };
  const std::vector<Work> all = {
      {"evaluate", "hole_bar", "{}", {"evaluate"}, {}, {}},
      {"fit",
       "discrepancy_vertical",
       R"({"state":"M20","points":["F1","F2","F3","F4","F5","F6","F7"]})",
       {"fit"},
       {"--state", "M20", "--points", "F1,F2,F3,F4,F5,F6,F7"},
       {"residuals"}},
      {"identify",
       "discrepancy_vertical",
       R"({"output":"F1_EZ_um","inputs":["T_spindle_degC","T_ambient_degC"],"train":"0:28800","test":"28800:43170"})",
       {"thermal", "identify"},
       {"--output", "F1_EZ_um", "--inputs", "T_spindle_degC,T_ambient_degC", "--train", "0:28800", "--test",
        "28800:43170"},
       {"elapsed_ms"}},
      {"discrepancy",
       "discrepancy_vertical",
       R"({"max_effects":2})",
       {"discrepancy"},
       {"--max-effects", "2"},
       {"explained_fraction", "decided", "message", "model", "noise", "outliers", "outlying_readings", "remainder",
        "sensor_roles", "state_shifts", "steps", "suggestion", "tail_dof", "unmatched_observations", "warnings",
        "where", "clock_offset_uncertainty_s"}},
  };
  for (const Work& w : all) {
    SCOPED_TRACE(w.work);
    const std::string plan =
        folder
            .write(w.work + ".json", R"({"format":"spindrift-batch","version":1,"name":")" + w.work + R"(","work":")" +
                                         w.work + R"(","campaigns":[")" + w.scenario + "-1\",\"" + w.scenario +
                                         R"(-2"],"options":)" + w.options + "}")
            .string();
    const std::string results = (folder / (w.work + ".jsonl")).string();
    EXPECT_EQ(jsonOf({"batch", plan, "--processes", "2", "--store", store}).at("failed_items"), 0);
    (void)jsonOf({"batch", "status", w.work, "--store", store, "--results", results});
    const auto lines = linesOf(results);
    ASSERT_EQ(lines.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      std::vector<std::string> command = w.before;
      command.push_back((folder / (w.scenario + "-" + std::to_string(i + 1))).string());
      command.insert(command.end(), w.after.begin(), w.after.end());
      command.insert(command.end(), {"--json", "-"});
      // 1: done, and not good enough.
      const Outcome said = runCli(command);
      EXPECT_TRUE(said.status == 0 || said.status == 1) << said.error;
      nlohmann::json alone = said.json();
      nlohmann::json stored = nlohmann::json::parse(lines[i]).at("answer");
      for (const std::string& key : w.left_out) {
        EXPECT_TRUE(alone.contains(key)) << key;
        alone.erase(key);
        stored.erase(key);
      }
      EXPECT_GE(alone.size(), 4U);
      EXPECT_EQ(stored, alone) << nlohmann::json::diff(alone, stored).dump(1).substr(0, 2000);
    }
  }
}

/// Runs a script of bash beside a Slurm of its own, SLURM_TOOLS at hand; gives exit status and what was said.
std::pair<int, std::string> besideSlurm(const TempFolder& folder, const std::string& script) {
  const std::string file = folder.write("go.sh", "set -e\n. $SLURM_TOOLS\n" + script).string();
  const std::string command = sourceFolder().string() + "/tests/app/cli/temporary_slurm.sh " +
                              (folder / "slurm").string() + " bash " + file + " 2>&1";
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return {-1, "no shell"};
  std::string said;
  std::array<char, 4096> buffer{};
  for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) said.append(buffer.data(), n);
  const int status = ::pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, said};
}

constexpr int no_slurm = 77;
constexpr const char* why_no_slurm = "Slurm (packages slurm-wlm, munge) or namespaces are not to be had here: ";

/// `batch ARGUMENTS --store STORE` as a command of a shell.
std::string batchCommand(const std::string& arguments, const std::string& store) {
  return SPINDRIFT_CLI " batch " + arguments + " --store '" + store + "'";
}

/// Functions of a shell: `number NAME`, of the batch's state; `until_number NAME LEAST`, fails after a minute.
std::string watching(const std::string& store) {
  return "number() { " + batchCommand("status n --json -", store) +
         " | sed -n \"s/^ \\\"$1\\\": \\([0-9]*\\).*/\\1/p\"; }\n" +
         "until_number() { for i in $(seq 300); do [ \"$(number $1)\" -ge $2 ] && return 0; sleep 0.2; done; return 1; "
         "}\n";
}

/// A worker and the controller of Slurm are killed on the way; the sweep starts what is left.
TEST(BatchCommand, RunsThroughSlurm) {
  const TempFolder folder;
  const std::string store = (folder / "plant.sqlite").string();
  const std::string die = folder.path().string() + "/died";
  const std::string plan =
      planOf(folder,
             "[ $1 = 5 ] && [ ! -e " + die + " ] && touch " + die + " && kill -9 $PPID; sleep 0.1; echo $(( $1 * $1 ))",
             30, R"(,"lease_s":1)");
  const std::string on_slurm = " --engine slurm --tasks 3 --logs " + (folder / "logs").string();
  // What the controller had not saved when it was killed is lost, the sweep too: then the batch is given again.
  const auto [status, said] = besideSlurm(
      folder, watching(store) + batchCommand(plan + on_slurm, store) +
                  "\nuntil_number answered 1; kill_controller\n"
                  "for i in $(seq 300); do [ \"$(number open_chunks)\" = 0 ] && exit 0; administer\n"
                  "[ -n \"$(squeue -h)\" ] || " +
                  batchCommand("resume n" + on_slurm, store) + "\nsleep 0.2; done\n" + batchCommand("status n", store));
  if (status == no_slurm) GTEST_SKIP() << why_no_slurm << said;
  EXPECT_EQ(status, 0) << said;
  const auto answer = jsonOf({"batch", "status", "n", "--store", store});
  EXPECT_EQ(answer.at("answered"), 30) << said;
  EXPECT_GE(answer.at("lost_attempts").get<int>(), 1) << said;
}

/// A controller that is killed forgets what it had not saved: nothing is left of the batch in Slurm.
TEST(BatchCommand, WhatSlurmLostIsToldAndGivenAgain) {
  const TempFolder folder;
  const std::string store = (folder / "plant.sqlite").string();
  const std::string plan = planOf(folder, "echo $(( $1 * $1 ))", 8);
  const std::string on_slurm = " --engine slurm --tasks 2 --logs " + (folder / "logs").string();
  const auto [status, said] = besideSlurm(
      folder,
      watching(store) + "scontrol update nodename=plantnode state=drain reason=full\n" +
          batchCommand(plan + on_slurm, store) + "\necho WAITING; sleep 0.5; " + batchCommand("status n", store) +
          " || true" + "\necho AGAIN; " + batchCommand("resume n" + on_slurm, store) +
          "\nsqueue -h -r -o %j | grep -vc sweep\nkill -9 $(cat $(dirname $SLURM_CONF)/slurmctld.pid); sleep 0.3\n"
          "rm -rf $(dirname $SLURM_CONF)/state/job* $(dirname $SLURM_CONF)/state/hash*; slurmctld\n"
          "until squeue -h; do sleep 0.2; done\necho LOST; " +
          batchCommand("status n", store) + " || true" + "\nscontrol update nodename=plantnode state=resume || true\n" +
          batchCommand("resume n --wait" + on_slurm, store));
  if (status == no_slurm) GTEST_SKIP() << why_no_slurm << said;
  EXPECT_EQ(status, 0) << said;
  const auto part = [&](const std::string& from, const std::string& to) {
    const std::size_t at = said.find(from);
    return said.substr(at, said.find(to, at) - at);
  };
  EXPECT_THAT(part("WAITING", "AGAIN"), HasSubstr("nothing works on it")) << said;
  EXPECT_THAT(part("WAITING", "AGAIN"), HasSubstr("Slurm holds 2 tasks of it, 2 waiting (")) << said;
  EXPECT_THAT(part("AGAIN", "LOST"), HasSubstr("Slurm holds its tasks already")) << said;
  EXPECT_THAT(part("AGAIN", "LOST"), HasSubstr("\n2\n")) << said;
  EXPECT_THAT(said.substr(said.find("LOST")),
              HasSubstr("Slurm has no task of it that will begin; batch resume 1 --engine slurm continues it"))
      << said;
  EXPECT_EQ(jsonOf({"batch", "status", "n", "--store", store}).at("answered"), 8) << said;
}

/// Slurm alone, whatever is killed at random: workers, tasks, the controller and the database server.
/// SPINDRIFT_TEST_ITEMS says how many items (10,000 were tried).
TEST(BatchCommand, SlurmAloneAnswersEachItemOnceWhateverIsKilled) {
  if (const std::string why = TemporaryPostgres::missing(); !why.empty()) GTEST_SKIP() << why;
  const char* wanted = std::getenv("SPINDRIFT_TEST_ITEMS");
  const int items = wanted != nullptr ? std::atoi(wanted) : 400;
  const TempFolder folder;
  TemporaryPostgres& server = TemporaryPostgres::shared();
  const std::string store = server.address(server.freshDatabase(), "owner");
  (void)PlantStore::make(PlantAddress::parse(store));
  const std::string plan = planOf(folder, "echo $(( $1 * $1 ))", items, R"(,"lease_s":1,"chunk":10,"retries":100)");
  std::atomic<bool> over{false};
  int servers = 0;
  std::thread killing([&] {
    Random random(3);
    const auto begin = std::chrono::steady_clock::now();
    double next_s = 3.0;
    while (!over) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      if (std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() < next_s) continue;
      server.kill();
      server.start();
      ++servers;
      next_s =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() + random.uniform(2.0, 8.0);
    }
  });
  const auto begin = std::chrono::steady_clock::now();
  const auto [status, said] = besideSlurm(
      folder, "RANDOM=5; workers=0; controllers=0\n" +
                  batchCommand(plan + " --engine slurm --wait --tasks 4 --logs " + (folder / "logs").string(), store) +
                  " & engine=$!\n"
                  "while kill -0 $engine 2>/dev/null; do sleep $((RANDOM % 3 + 1)).$((RANDOM % 10))\n"
                  "if [ $((RANDOM % 10)) = 0 ]; then kill_controller && controllers=$((controllers + 1))\n"
                  "else one=$(pgrep -f 'batch (work|tend)' | shuf -n 1); [ -n \"$one\" ] || continue\n"
                  "kill -9 $one && workers=$((workers + 1)); fi\nadminister; done\n"
                  "wait $engine; echo \"$workers workers and tasks, $controllers controllers\"");
  over = true;
  killing.join();
  if (status == no_slurm) GTEST_SKIP() << why_no_slurm << said;
  EXPECT_EQ(status, 0) << said;
  const auto answer = jsonOf({"batch", "status", "n", "--store", store, "--results", (folder / "r.jsonl").string()});
  std::printf("%d items in %.0f s; killed: %d servers, %s%d of %d attempts lost\n", items,
              std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), servers,
              said.substr(said.rfind('\n', said.size() - 2) + 1).c_str(), answer.at("lost_attempts").get<int>(),
              answer.at("attempts").get<int>());
  EXPECT_EQ(answer.at("answered"), items) << said;
  EXPECT_EQ(answer.at("failed_items"), 0) << said;
  const auto lines = linesOf(folder / "r.jsonl");
  ASSERT_EQ(lines.size(), static_cast<std::size_t>(items));
  for (std::int64_t i = 0; i < items; ++i) {
    const auto line = nlohmann::json::parse(lines[static_cast<std::size_t>(i)]);
    ASSERT_EQ(line.at("item"), i);
    ASSERT_EQ(line.at("answer"), (i + 1) * (i + 1));
  }
}

}  // namespace
}  // namespace spindrift::testing
