// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/connect/mtconnect_source.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/base/utc_time.h"
#include "tests/core/connect/collected.h"
#include "tests/core/connect/small_agent.h"

namespace spindrift::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double agent_t0 = 1769846400.0;  // 2026-01-31T08:00:00Z

MtconnectOptions quick(const SmallAgent& agent) {
  MtconnectOptions options;
  options.url = agent.url();
  options.interval_s = 0.01;
  options.heartbeat_s = 0.2;
  options.answer_s = 2.0;
  return options;
}

std::unique_ptr<Source> connected(const SmallAgent& agent, const std::vector<std::string>& items, Collected& sink) {
  auto source = makeMtconnectSource(quick(agent));
  source->connect({});
  source->subscribe(items, sink, {});
  return source;
}

TEST(UtcTime, ReadsWhatAdaptersWrite) {
  EXPECT_EQ(parseUtc("2026-01-31T08:00:00Z"), agent_t0);
  EXPECT_NEAR(*parseUtc("2026-01-31T08:00:00.123456Z"), agent_t0 + 0.123456, 1e-6);
  EXPECT_EQ(parseUtc("2026-01-31T09:00:00+01:00"), agent_t0);
  EXPECT_EQ(parseUtc("2026-01-31T08:00:00"), agent_t0);
  EXPECT_EQ(parseUtc("2026-01-31T08:00:00Z@10.5"), agent_t0);
  for (const char* wrong : {"", "yesterday", "2026-02-30T08:00:00Z", "2026-01-31T25:00:00Z", "2026-01-31T08:00:00Zoo"})
    EXPECT_FALSE(parseUtc(wrong)) << wrong;
  EXPECT_EQ(utcText(agent_t0 + 0.25), "2026-01-31T08:00:00.250Z");
}

struct Version {
  const char* name;
  SmallAgent::Manners manners;
};

class MtconnectVersions : public ::testing::TestWithParam<Version> {};

TEST_P(MtconnectVersions, ListStateAndStreamAreRead) {
  SmallAgent agent;
  agent.set(GetParam().manners);
  agent.observe("T1", "31.5", agent_t0);
  agent.observe("EXEC", "READY", agent_t0);
  Collected sink;
  auto source = makeMtconnectSource(quick(agent));
  source->connect({});
  const std::vector<DataItem> items = source->list(0.0, {});
  ASSERT_THAT(items, SizeIs(6));
  EXPECT_EQ(items[1].address, "T1");
  EXPECT_EQ(items[1].name, "Tspindle");
  EXPECT_EQ(items[1].unit, "CELSIUS");
  EXPECT_EQ(items[1].category, "sample");
  EXPECT_EQ(items[1].component, "mill / Axes / spindle");
  EXPECT_EQ(items[1].example, "31.5");
  EXPECT_EQ(items[2].type, "SPINDLE_SPEED ACTUAL");

  source->subscribe({"Tspindle", "EXEC", "P1[2]", "absent"}, sink, {});
  ASSERT_THAT(sink.notes, SizeIs(1));
  EXPECT_THAT(sink.notes[0], HasSubstr("\"absent\""));
  ASSERT_THAT(sink.records, SizeIs(2));
  EXPECT_TRUE(sink.records[0].snapshot);
  EXPECT_EQ(sink.records[0].value, 31.5);
  EXPECT_EQ(sink.records[1].text, "READY");
  for (int i = 0; i < 40; ++i) {
    agent.observe("T1", std::to_string(32 + i), agent_t0 + i);
    agent.observe("P1", "1 2 " + std::to_string(i), agent_t0 + i);
  }
  EXPECT_TRUE(pollUntil(*source, sink, [&] { return sink.records.size() >= 82; }));
  const std::vector<double> values = sink.values(0);
  ASSERT_THAT(values, SizeIs(41));
  for (int i = 0; i < 40; ++i) EXPECT_EQ(values[static_cast<std::size_t>(i) + 1], 32 + i);
  EXPECT_EQ(sink.values(2).back(), 39);
  EXPECT_FALSE(sink.records.back().snapshot);
  EXPECT_NEAR(sink.records.back().source_s, agent_t0 + 39, 1e-6);
  EXPECT_THAT(sink.missings, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    All, MtconnectVersions,
    ::testing::Values(Version{"v1_2", {.version = "1.2"}}, Version{"v1_3", {.version = "1.3", .chunked = false}},
                      Version{"v1_8prefix", {.version = "1.8", .prefix = "m:", .lower_case = true}},
                      Version{"v2_0", {.version = "2.0", .true_lengths = false}},
                      Version{"plain", {.version = "1.4", .multipart = false}},
                      Version{"powerOfTwo", {.version = "2.2", .pad = 4096}}),
    [](const auto& version) { return std::string(version.param.name); });

TEST(Mtconnect, WordsSeriesAndConditionsKeepTheirMeaning) {
  SmallAgent agent;
  agent.observe("T1", "UNAVAILABLE", agent_t0);
  agent.observe("C1", "Normal", agent_t0);
  Collected sink;
  const auto source = connected(agent, {"T1", "C1", "V1"}, sink);
  EXPECT_EQ(sink.records[0].quality, Quality::Unavailable);
  agent.observe("T1", "warm", agent_t0 + 1);
  agent.observe("C1", "Warning", agent_t0 + 1, " nativeCode=\"7\"");
  agent.observe("C1", "Fault", agent_t0 + 2, " nativeCode=\"8\"");
  agent.observe("C1", "Normal", agent_t0 + 3, " nativeCode=\"8\"");
  agent.observe("C1", "Normal", agent_t0 + 4);
  agent.observe("V1", "0.1 0.2 0.3", agent_t0 + 10, " sampleCount=\"3\" sampleRate=\"2\"");
  ASSERT_TRUE(pollUntil(*source, sink, [&] { return sink.values(2).size() == 3; }));
  EXPECT_EQ(sink.records[2].quality, Quality::Text);
  EXPECT_THAT(sink.values(1), ElementsAre(0, 1, 2, 1, 0));
  EXPECT_THAT(sink.values(2), ElementsAre(0.1, 0.2, 0.3));
  EXPECT_NEAR(sink.records[sink.records.size() - 3].source_s, agent_t0 + 9, 1e-6);
}

TEST(Mtconnect, AfterABrokenConnectionItGoesOnWhereItWas) {
  SmallAgent agent;
  SmallAgent::Manners manners;
  manners.most_parts = 2;  // the third document is cut in its middle
  agent.set(manners);
  Collected sink;
  auto source = connected(agent, {"S1"}, sink);
  int broken = 0;
  for (int i = 1; i <= 30; ++i) {
    agent.observe("S1", std::to_string(i), agent_t0 + i);
    try {
      source->poll(0.02, sink);
    } catch (const ConnectionError&) {
      ++broken;
      source->close();
      source->connect({});
      source->subscribe({"S1"}, sink, {});
    }
  }
  manners.most_parts = 1 << 30;
  agent.set(manners);
  const auto all = [&] { return sink.values().size() == 30; };
  try {
    EXPECT_TRUE(pollUntil(*source, sink, all));
  } catch (const ConnectionError&) {
    ++broken;
    source->connect({});
    source->subscribe({"S1"}, sink, {});
    EXPECT_TRUE(pollUntil(*source, sink, all));
  }
  EXPECT_GE(broken, 2);
  std::vector<double> expected;
  for (int i = 1; i <= 30; ++i) expected.push_back(i);
  EXPECT_EQ(sink.values(), expected);  // none twice, none lost
  EXPECT_THAT(sink.missings, IsEmpty());
}

TEST(Mtconnect, AnAgentThatWasStartedAnewIsReadFromItsState) {
  SmallAgent agent;
  agent.observe("S1", "1", agent_t0);
  Collected sink;
  const auto source = connected(agent, {"S1"}, sink);
  agent.observe("S1", "2", agent_t0 + 1);
  ASSERT_TRUE(pollUntil(*source, sink, [&] { return sink.records.size() == 2; }));
  agent.stop();
  agent.forget();
  for (int i = 0; i < 5; ++i)
    agent.observe("S1", std::to_string(100 + i), agent_t0 + 10 + i);  // numbers go beyond the old
  agent.start();
  EXPECT_THROW((void)pollUntil(
                   *source, sink, [] { return false; }, 2.0),
               ConnectionError);
  source->close();
  source->connect({});
  source->subscribe({"S1"}, sink, {});
  ASSERT_TRUE(pollUntil(*source, sink, [&] { return sink.records.size() >= 3; }));
  EXPECT_EQ(sink.values()[2], 104);
  EXPECT_TRUE(sink.records[2].snapshot);
  ASSERT_THAT(sink.missings, SizeIs(1));
  EXPECT_THAT(sink.missings[0], HasSubstr("started anew"));
  agent.observe("S1", "105", agent_t0 + 20);
  ASSERT_TRUE(pollUntil(*source, sink, [&] { return sink.records.size() >= 4; }));
  EXPECT_EQ(sink.values()[3], 105);
}

TEST(Mtconnect, ABufferThatHasRunOverIsToldAndLeftBehind) {
  SmallAgent agent;
  SmallAgent::Manners manners;
  manners.buffer = 8;
  agent.set(manners);
  agent.observe("S1", "0", agent_t0);
  Collected sink;
  const auto source = connected(agent, {"S1"}, sink);
  source->close();
  for (int i = 1; i <= 50; ++i) agent.observe("S1", std::to_string(i), agent_t0 + i);
  source->connect({});
  source->subscribe({"S1"}, sink, {});
  ASSERT_TRUE(pollUntil(*source, sink, [&] { return sink.records.size() >= 2; }));
  EXPECT_EQ(sink.values().back(), 50);
  ASSERT_THAT(sink.missings, SizeIs(1));
  EXPECT_THAT(sink.missings[0], HasSubstr("no longer has"));
}

TEST(Mtconnect, ComponentsThatAreTooDeepAreOneSentence) {
  SmallAgent agent;
  SmallAgent::Manners manners;
  manners.levels = 40;
  agent.set(manners);
  const auto source = makeMtconnectSource(quick(agent));
  source->connect({});
  EXPECT_THAT(source->list(0.0, {}), SizeIs(6));
  manners.levels = 100'000;
  agent.set(manners);
  try {
    source->connect({});
    FAIL() << "it was read";
  } catch (const ConnectionError& error) {
    EXPECT_THAT(error.what(), HasSubstr("describes components nested more than 64 levels deep"));
  }
}

TEST(Mtconnect, ASilentAgentAndNonsenseAreConnectionsLost) {
  SmallAgent agent;
  agent.observe("S1", "1", agent_t0);
  Collected sink;
  const auto source = connected(agent, {"S1"}, sink);
  agent.freeze(true);
  try {
    (void)pollUntil(
        *source, sink, [] { return false; }, 3.0);
    FAIL() << "silence was not noticed";
  } catch (const ConnectionError& error) {
    EXPECT_THAT(error.what(), HasSubstr("said nothing"));
  }
  agent.freeze(false);
  agent.stop();  // the stream that was given up takes nothing of what follows
  agent.start();
  source->connect({});
  agent.nextPart("<MTConnectStreams><Header instanceId=</MTConnectStreams>");
  source->subscribe({"S1"}, sink, {});
  EXPECT_THROW((void)pollUntil(
                   *source, sink, [] { return false; }, 2.0),
               ConnectionError);
  source->connect({});
  source->subscribe({"S1"}, sink, {});
  agent.observe("S1", "2", agent_t0 + 1);
  EXPECT_TRUE(pollUntil(*source, sink, [&] { return sink.values().back() == 2; }));
  agent.stop();
  try {
    source->connect({});
    FAIL() << "nobody is there";
  } catch (const ConnectionError& error) {
    EXPECT_THAT(error.what(), HasSubstr(agent.url()));
  }
}

}  // namespace
}  // namespace spindrift::testing
