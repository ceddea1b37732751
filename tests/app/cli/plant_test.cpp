// SPDX-License-Identifier: GPL-3.0-or-later
// `plant ...` and `batch ...`: two processes, a real store, a real Slurm.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/plant/plant_store.h"
#include "core/session/session.h"
#include "tests/app/cli/child_process.h"
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
  s.addResult(id, "fit", {},
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

/// A worker and the controller of Slurm are killed on the way; the sweep starts what is left.
TEST(BatchCommand, RunsThroughSlurm) {
  const TempFolder folder;
  const std::string store = (folder / "plant.sqlite").string();
  const std::string die = folder.path().string() + "/died";
  const std::string plan =
      planOf(folder,
             "[ $1 = 5 ] && [ ! -e " + die + " ] && touch " + die + " && kill -9 $PPID; sleep 0.1; echo $(( $1 * $1 ))",
             30, R"(,"lease_s":1)");
  const std::string script =
      folder
          .write("go.sh", "set -e\n" SPINDRIFT_CLI " batch " + plan + " --engine slurm --tasks 3 --store " + store +
                              " --logs " + folder.path().string() +
                              "/logs\n"
                              "sleep 1; kill -9 $(cat $(dirname $SLURM_CONF)/slurmctld.pid); sleep 0.5; slurmctld\n"
                              "for i in $(seq 400); do [ -z \"$(squeue -h)\" ] && break\n"
                              "for j in $(squeue -h -t PD -o '%i %r' | awk '$2==\"BeginTime\"{print $1}'); do scontrol "
                              "update jobid=$j starttime=now || true; done\nsleep 0.1; done\n" SPINDRIFT_CLI
                              " batch status n --store " +
                              store + "\n")
          .string();
  const std::string command = std::string(SPINDRIFT_SOURCE_DIR) + "/tests/app/cli/temporary_slurm.sh " +
                              (folder / "slurm").string() + " bash " + script + " 2>&1";
  FILE* pipe = ::popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string said;
  std::array<char, 4096> buffer{};
  for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) said.append(buffer.data(), n);
  const int status = ::pclose(pipe);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 77)
    GTEST_SKIP() << "Slurm (packages slurm-wlm, munge) or namespaces are not to be had here: " << said;
  EXPECT_EQ(WEXITSTATUS(status), 0) << said;
  const auto answer = jsonOf({"batch", "status", "n", "--store", store});
  EXPECT_EQ(answer.at("answered"), 30) << said;
  EXPECT_GE(answer.at("lost_attempts").get<int>(), 1) << said;
}

}  // namespace
}  // namespace spindrift::testing
