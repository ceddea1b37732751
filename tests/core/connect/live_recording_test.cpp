// SPDX-License-Identifier: GPL-3.0-or-later
// What a window looks at while data come: newest values, the last hour, the machine at rest.
#include "core/connect/live_recording.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/machine/operating_log.h"
#include "tests/core/connect/collected.h"
#include "tests/core/connect/small_agent.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

using ::testing::HasSubstr;

Connections connectionsTo(const std::string& url) {
  const nlohmann::json json = {
      {"format", "spindrift-connections"},
      {"version", 1},
      {"sources", {{{"name", "mill"}, {"kind", "mtconnect"}, {"url", url}, {"interval_s", 0.05}}}},
      {"columns",
       {{{"column", "T_spindle_degC"}, {"source", "mill"}, {"item", "T1"}},
        {{"column", "spindle_rpm"}, {"source", "mill"}, {"item", "S1"}}}},
      {"interval_s", 0.1},
      {"settle_s", 0.1}};
  return Connections::parse(JsonNode::parse(json.dump(), "connections.json"));
}

RunnerOptions quickRecording() {
  RunnerOptions options;
  options.first_pause_s = 0.05;
  options.longest_pause_s = 0.1;
  return options;
}

TEST(LiveRecording, IsLookedAtWhileItWritesItsLog) {
  const TempFolder folder;
  SmallAgent agent;
  agent.observe("T1", "31.5", localUtc());
  agent.observe("S1", "600", localUtc());
  const double start_s = localUtc();
  LiveRecording live(connectionsTo(agent.url()), folder / "log.csv", start_s, quickRecording());
  EXPECT_TRUE(live.snapshot().recording);
  ASSERT_TRUE(waitUntil([&] {
    const LiveSnapshot now = live.snapshot();
    return now.columns[0].known && now.columns[1].known && now.rows > 0;
  }));
  LiveSnapshot now = live.snapshot();
  EXPECT_EQ(now.columns[0].newest.value, 31.5);
  EXPECT_LT(now.now_s - now.columns[0].came_s, 5.0);
  EXPECT_EQ(now.sources[0].status.state, SourceStatus::State::Live);
  MachineRest rest = machineRest(now);
  EXPECT_TRUE(rest.tells);
  EXPECT_FALSE(rest.at_rest);
  EXPECT_THAT(rest.sentence, ::testing::AllOf(HasSubstr("600 rpm"), HasSubstr("wait")));

  agent.observe("S1", "0", localUtc());
  ASSERT_TRUE(waitUntil([&] { return machineRest(live.snapshot()).at_rest; }));
  const auto held = live.at("spindle_rpm", localUtc());
  ASSERT_TRUE(held.has_value());
  EXPECT_EQ(held->value, 0.0);
  EXPECT_FALSE(live.at("spindle_rpm", start_s - 100.0).has_value());
  EXPECT_FALSE(live.at("no_column", localUtc()).has_value());
  EXPECT_GE(live.history(1).size(), 1U);

  // The row of an interval at whose end nothing is known is empty.
  const std::uint64_t rows = live.snapshot().rows;
  ASSERT_TRUE(waitUntil([&] { return live.snapshot().rows > rows; }));

  // What cannot be known is no rest.
  agent.observe("S1", "UNAVAILABLE", localUtc());
  ASSERT_TRUE(waitUntil([&] { return !live.snapshot().columns[1].known; }));
  rest = machineRest(live.snapshot());
  EXPECT_FALSE(rest.at_rest);
  EXPECT_THAT(rest.sentence, HasSubstr("spindle_rpm is not known"));
  EXPECT_FALSE(live.at("spindle_rpm", localUtc()).has_value());

  agent.stop();
  ASSERT_TRUE(waitUntil([&] { return live.snapshot().sources[0].status.state == SourceStatus::State::Lost; }));
  now = live.snapshot();
  EXPECT_TRUE(now.isLost(now.columns[0]));
  EXPECT_FALSE(now.sources[0].status.sentence.empty());

  live.requestStop();
  ASSERT_TRUE(waitUntil([&] { return live.ended(); }));
  const OperatingLog log = OperatingLog::read(folder / "log.csv");
  EXPECT_EQ(log.signal("spindle_rpm")->front(), 600.0);
  EXPECT_EQ(log.at("spindle_rpm", 1e6), 0.0);
}

TEST(LiveRecording, WithoutALogItOnlyLooks) {
  SmallAgent agent;
  agent.observe("T1", "20.25", localUtc());
  LiveRecording live(connectionsTo(agent.url()), {}, localUtc(), quickRecording());
  EXPECT_FALSE(live.snapshot().recording);
  ASSERT_TRUE(waitUntil([&] { return live.snapshot().columns[0].known; }));
  EXPECT_EQ(live.snapshot().columns[0].newest.value, 20.25);
  EXPECT_EQ(live.snapshot().rows, 0U);
  EXPECT_FALSE(machineRest(live.snapshot()).at_rest);
}

TEST(LiveValues, TheLastHourStaysSmallAtAnyRate) {
  const Connections connections = connectionsTo("http://127.0.0.1:1");
  LiveValues values(connections);
  constexpr double start_s = 1.7e9;
  // 10 a second for two hours; every other value of the speed is unknown.
  for (int i = 0; i < 72000; ++i) {
    Record record;
    record.time_s = record.received_s = start_s + 0.1 * i;
    record.value = i % 10;
    values.take({0, record});
    record.item = 1;
    if (i % 2 == 1) record.quality = Quality::Unavailable;
    values.take({0, record});
  }
  const std::vector<LivePoint> means = values.history(0);
  EXPECT_LE(means.size(), 3603U);
  EXPECT_GE(means.size(), 3590U);
  for (std::size_t i = 1; i + 1 < means.size(); ++i) EXPECT_NEAR(means[i].value, 4.5, 0.51);
  EXPECT_NEAR(means.back().time_s - means.front().time_s, 3600.0, 3.0);
  EXPECT_LE(values.history(1).size(), 2 * 3603U);
  // What held: nothing before the hour, the newest after it.
  EXPECT_FALSE(values.at(0, start_s).has_value());
  EXPECT_TRUE(values.at(0, start_s + 7199.0).has_value());
  EXPECT_FALSE(values.at(1, start_s + 8000.0).has_value());
  EXPECT_EQ(values.columns()[1].text, "UNAVAILABLE");
}

}  // namespace
}  // namespace spindrift::testing
