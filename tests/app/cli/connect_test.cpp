// SPDX-License-Identifier: GPL-3.0-or-later
// record: from an agent on loopback into a log and into a session.
#include <gmock/gmock.h>

#include <thread>

#include "core/connect/record.h"
#include "core/machine/operating_log.h"
#include "core/session/session.h"
#include "tests/app/cli/child_process.h"
#include "tests/core/connect/collected.h"
#include "tests/core/connect/small_agent.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

using ::testing::HasSubstr;

std::string connectionsFor(const SmallAgent& agent) {
  return nlohmann::json{
      {"format", "spindrift-connections"},
      {"version", 1},
      {"sources", {{{"name", "mill"}, {"kind", "mtconnect"}, {"url", agent.url()}, {"interval_s", 0.05}}}},
      {"columns",
       {{{"column", "T_spindle_degC"}, {"source", "mill"}, {"item", "T1"}, {"role", "spindle_housing"}},
        {{"column", "spindle_rpm"}, {"source", "mill"}, {"item", "S1"}},
        {{"column", "running"}, {"source", "mill"}, {"item", "EXEC"}, {"values", {{"ACTIVE", 1}}}, {"otherwise", 0}}}},
      {"interval_s", 0.1},
      {"settle_s", 0.2}}
      .dump();
}

TEST(Record, AnAgentIsListedAndRecorded) {
  const TempFolder folder;
  SmallAgent agent;
  agent.observe("T1", "31.5", localUtc());
  agent.observe("S1", "0", localUtc());
  agent.observe("EXEC", "READY", localUtc());
  const nlohmann::json listed = jsonOf({"record", "--list", agent.url()});
  ASSERT_EQ(listed["items"].size(), 6U);
  EXPECT_EQ(listed["items"][1]["unit"], "CELSIUS");
  EXPECT_EQ(listed["items"][1]["value"], "31.5");

  const std::string file = folder.write("connections.json", connectionsFor(agent)).string();
  const std::string log = (folder / "log.csv").string();
  const int streams = agent.requests("/sample");
  std::thread machine([&] {
    (void)waitUntil([&] { return agent.requests("/sample") > streams; }, 20.0);
    for (int i = 1; i <= 10; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      agent.observe("S1", std::to_string(600 * i), localUtc() + 3600.0);  // its clock is an hour ahead
    }
    agent.observe("EXEC", "ACTIVE", localUtc() + 3600.0);
  });
  const nlohmann::json result = jsonOf({"record", file, "--out", log, "--for", "6"});
  machine.join();
  EXPECT_EQ(result["sources"][0]["state"], "stopped");
  EXPECT_GT(result["rows"], 3);
  EXPECT_NEAR(result["sources"][0]["clock_offset_s"].get<double>(), 3600.0, 0.5);
  const OperatingLog read = OperatingLog::read(log);
  EXPECT_NEAR(read.at("T_spindle_degC", 1.0), 31.5, 1e-9);
  EXPECT_EQ(read.at("spindle_rpm", 1e6), 6000.0);
  EXPECT_EQ(read.at("running", 1e6), 1.0);
  EXPECT_EQ(read.signal("running")->front(), 0.0);
  EXPECT_LT(read.time_s().back(), 60.0);
}

TEST(Record, ASessionKeepsTheLogOnTheClockOfItsCampaign) {
  const TempFolder folder;
  SmallAgent agent;
  agent.observe("T1", "31.5", localUtc());
  agent.observe("S1", "600", localUtc());
  agent.observe("EXEC", "READY", localUtc());
  const std::string file = folder.write("connections.json", connectionsFor(agent)).string();
  std::int64_t id = 0;
  nlohmann::json before;
  {
    Session session = Session::create(folder / "session");
    id = session.newCampaign("warm-up", utcNow(), R"({"format":"spindrift-machine","version":1,"name":"mill",
      "chain":"V [w-X'-Y'-b-Z-t]","axes":[{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,300]},
      {"name":"Z","travel_mm":[0,300]}]})");
    before = session.inputs(id);
  }
  (void)jsonOf({"record", file, "--session", (folder / "session").string(), "--for", "3"});
  (void)jsonOf({"record", file, "--session", (folder / "session").string(), "--for", "3"});
  Session session = Session::open(folder / "session");
  EXPECT_NE(session.inputs(id), before);
  const Campaign campaign = Campaign::read(session.campaign(id).folder);
  ASSERT_TRUE(campaign.log.has_value());
  EXPECT_EQ(campaign.log->at("spindle_rpm", 100.0), 600.0);
  EXPECT_LT(campaign.log->time_s().back(), 60.0);
}

TEST(Record, SaysWhatIsWrong) {
  const TempFolder folder;
  expectBadInput({"record"}, {"--out", "--list"});
  expectBadInput({"record", "--list", "ftp://x"}, {"ftp://x", "http://"});
  expectBadInput({"record", "--list", "http://127.0.0.1:1"}, {"http://127.0.0.1:1"});
  SmallAgent agent;
  const std::string file = folder.write("connections.json", connectionsFor(agent)).string();
  expectBadInput({"record", file, "--out", (folder / "l.csv").string(), "--start", "noon"}, {"noon", "2026-"});
  // A log of other columns stays as it is.
  folder.write("other.csv", "time_s,x\n0,1\n");
  expectBadInput({"record", file, "--out", (folder / "other.csv").string()}, {"other.csv", "line 1", "time_s,x"});
  EXPECT_EQ(textOf(folder / "other.csv"), "time_s,x\n0,1\n");
  agent.stop();
  const nlohmann::json alone = jsonOf({"record", file, "--out", (folder / "l.csv").string(), "--for", "0.5"}, 1);
  EXPECT_THAT(alone["shortcomings"][0].get<std::string>(), HasSubstr("never reached"));
}

}  // namespace
}  // namespace spindrift::testing
