// SPDX-License-Identifier: GPL-3.0-or-later
// What goes wrong in a workshop, through the whole of a recording: peers that are killed and come back, values faster
// than anybody needs, values of the wrong type.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "core/base/atomic_file.h"
#include "core/base/untrusted_text.h"
#include "core/connect/live_recording.h"
#include "core/connect/recording.h"
#include "core/machine/operating_log.h"
#include "tests/core/connect/broker.h"
#include "tests/core/connect/collected.h"
#include "tests/core/connect/small_agent.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

using ::testing::HasSubstr;

Connections connectionsOf(const nlohmann::json& sources, const nlohmann::json& columns) {
  const nlohmann::json json = {{"format", "spindrift-connections"},
                               {"version", 1},
                               {"sources", sources},
                               {"columns", columns},
                               {"interval_s", 0.1},
                               {"settle_s", 0.3}};
  return Connections::parse(JsonNode::parse(json.dump(), "connections.json"));
}

RunnerOptions quickWithFaults() {
  RunnerOptions options;
  options.first_pause_s = 0.02;
  options.longest_pause_s = 0.1;
  return options;
}

TEST(Faults, AnAgentAndABrokerThatAreKilledAgainAndAgainAreRecordedToTheirLastValue) {
  const TempFolder folder;
  SmallAgent agent;
  Broker broker;
  auto publisher = std::make_unique<Publisher>(broker);
  const Connections connections =
      connectionsOf({{{"name", "mill"}, {"kind", "mtconnect"}, {"url", agent.url()}, {"interval_s", 0.02}},
                     {{"name", "hall"}, {"kind", "mqtt"}, {"url", broker.url()}}},
                    {{{"column", "count"}, {"source", "mill"}, {"item", "S1"}},
                     {{"column", "T_room_degC"}, {"source", "hall"}, {"item", "room"}, {"reduce", "last"}}});
  agent.observe("S1", "0", localUtc());
  LiveRecording live(connections, folder / "log.csv", localUtc(), quickWithFaults());
  const auto isLive = [&](std::size_t source) {
    return live.snapshot().sources[source].status.state == SourceStatus::State::Live;
  };
  ASSERT_TRUE(waitUntil([&] { return isLive(0) && isLive(1) && live.snapshot().columns[0].known; }));
  int sent = 0;
  constexpr int rounds = 6;
  for (int round = 1; round <= rounds; ++round) {
    for (int i = 0; i < 40; ++i) agent.observe("S1", std::to_string(++sent), localUtc());
    agent.stop();
    broker.stop();
    publisher.reset();
    ASSERT_TRUE(waitUntil([&] { return !isLive(0) && !isLive(1); })) << round;
    // What an agent notes down while nobody can reach it is not lost.
    for (int i = 0; i < 40; ++i) agent.observe("S1", std::to_string(++sent), localUtc());
    agent.start();
    broker.start();
    publisher = std::make_unique<Publisher>(broker);
    ASSERT_TRUE(waitUntil([&] { return isLive(0) && isLive(1); })) << round;
    // The subscription may come a moment after the connection.
    ASSERT_TRUE(waitUntil([&] {
      publisher->publish("room", fmt::format("{}", 20 + round));
      const LiveSnapshot now = live.snapshot();
      return now.columns[0].newest.value == sent && now.columns[1].newest.value == 20 + round;
    })) << round;
  }
  const LiveSnapshot last = live.snapshot();
  EXPECT_EQ(last.columns[0].records, static_cast<std::uint64_t>(sent) + 1);
  for (const LiveSource& source : last.sources) EXPECT_GE(source.status.connections, rounds) << source.name;
  live.requestStop();
  ASSERT_TRUE(waitUntil([&] { return live.ended(); }));
  const OperatingLog log = OperatingLog::read(folder / "log.csv");
  EXPECT_EQ(log.signal("count")->back(), sent);
  EXPECT_EQ(log.signal("T_room_degC")->back(), 20 + rounds);
  EXPECT_TRUE(std::is_sorted(log.time_s().begin(), log.time_s().end()));
  const std::string text = readFile(folder / "log.csv");
  EXPECT_THAT(text, ::testing::AllOf(HasSubstr("# mill lost at"), HasSubstr("# hall is back at"),
                                     HasSubstr("# hall: values between")));
}

/// A logger at a TCP port that prints lines as fast as it is told.
class Logger {
 public:
  Logger() : listener_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    socklen_t size = sizeof address;
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    EXPECT_EQ(::listen(listener_, 4), 0);
  }
  ~Logger() {
    if (connection_ >= 0) ::close(connection_);
    ::close(listener_);
  }
  Logger(const Logger&) = delete;
  Logger& operator=(const Logger&) = delete;
  [[nodiscard]] std::string url() const { return fmt::format("tcp://127.0.0.1:{}", port_); }
  void accept() {
    connection_ = ::accept(listener_, nullptr, nullptr);
    ASSERT_GE(connection_, 0);
  }
  void print(std::string_view text) {
    while (!text.empty()) {
      const ssize_t sent = ::send(connection_, text.data(), text.size(), MSG_NOSIGNAL);
      ASSERT_GT(sent, 0);
      text.remove_prefix(static_cast<std::size_t>(sent));
    }
  }

 private:
  int listener_;
  int connection_ = -1;
  int port_ = 0;
};

TEST(Faults, TenThousandValuesASecondAreAllCounted) {
  const TempFolder folder;
  Logger logger;
  const Connections connections = connectionsOf(
      {{{"name", "logger"}, {"kind", "text"}, {"url", logger.url()}, {"line", "n={n} a={a} b={b} c={c} d={d}"}}},
      {{{"column", "n"}, {"source", "logger"}, {"item", "n"}},
       {{"column", "a"}, {"source", "logger"}, {"item", "a"}, {"reduce", "mean"}},
       {{"column", "b"}, {"source", "logger"}, {"item", "b"}, {"reduce", "max"}},
       {{"column", "c"}, {"source", "logger"}, {"item", "c"}, {"reduce", "min"}},
       {{"column", "d"}, {"source", "logger"}, {"item", "d"}, {"reduce", "mean_absolute"}}});
  LiveRecording live(connections, folder / "log.csv", localUtc(), quickWithFaults());
  logger.accept();
  // 2000 lines of five values a second, for three seconds.
  constexpr int lines = 6000;
  const double begin = localUtc();
  for (int i = 0; i < lines; ++i) {
    if (i % 20 == 0) {
      const double ahead = begin + i / 2000.0 - localUtc();
      if (ahead > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(ahead));
    }
    logger.print(fmt::format("n={} a={} b={} c={} d={}\r\n", i, i % 2, i % 100, -(i % 100), i % 2 == 0 ? -3 : 3));
  }
  ASSERT_TRUE(waitUntil([&] { return live.snapshot().columns[4].records >= lines; }))
      << live.snapshot().columns[4].records;
  live.requestStop();
  ASSERT_TRUE(waitUntil([&] { return live.ended(); }));
  const LiveSnapshot now = live.snapshot();
  for (const LiveColumn& column : now.columns) EXPECT_EQ(column.records, lines) << column.column;
  EXPECT_EQ(now.sources[0].status.undelivered, 0U);
  EXPECT_EQ(now.sources[0].status.missed, 0U);
  EXPECT_TRUE(now.gaps.empty());
  const OperatingLog log = OperatingLog::read(folder / "log.csv");
  EXPECT_EQ(log.signal("n")->back(), lines - 1);
  EXPECT_LT(log.time_s().size(), 200U);
  EXPECT_EQ(*std::max_element(log.signal("b")->begin(), log.signal("b")->end()), 99.0);
  EXPECT_EQ(*std::min_element(log.signal("c")->begin(), log.signal("c")->end()), -99.0);
  for (const double d : *log.signal("d")) {
    if (!std::isfinite(d)) continue;
    EXPECT_NEAR(d, 3.0, 1e-9);
  }
}

TEST(Faults, ValuesOfTheWrongTypeAreRefusedAndTheNextGoodOneIsTaken) {
  const TempFolder folder;
  SmallAgent agent;
  Broker broker;
  Publisher publisher(broker);
  Logger logger;
  const Connections connections =
      connectionsOf({{{"name", "mill"}, {"kind", "mtconnect"}, {"url", agent.url()}, {"interval_s", 0.02}},
                     {{"name", "hall"}, {"kind", "mqtt"}, {"url", broker.url()}},
                     {{"name", "logger"}, {"kind", "text"}, {"url", logger.url()}, {"line", "T={t}"}}},
                    {{{"column", "T_1_degC"}, {"source", "mill"}, {"item", "T1"}, {"reduce", "last"}},
                     {{"column", "T_2_degC"}, {"source", "hall"}, {"item", "room#temperature"}, {"reduce", "last"}},
                     {{"column", "T_3_degC"}, {"source", "logger"}, {"item", "t"}, {"reduce", "last"}},
                     {{"column", "speed_rpm"}, {"source", "mill"}, {"item", "T1"}}});
  agent.observe("T1", "20", localUtc());
  LiveRecording live(connections, folder / "log.csv", localUtc(), quickWithFaults());
  logger.accept();
  const auto isLive = [&](std::size_t s) {
    return live.snapshot().sources[s].status.state == SourceStatus::State::Live;
  };
  ASSERT_TRUE(waitUntil([&] { return isLive(0) && isLive(1) && isLive(2); }));
  ASSERT_TRUE(waitUntil([&] {
    publisher.publish("room", R"({"temperature":20})");
    return live.snapshot().columns[1].known;
  }));
  const std::vector<std::string> nonsense{"",
                                          "warm",
                                          "1,5",
                                          "1e999",
                                          "nan",
                                          "0x20",
                                          "-",
                                          "20 21",
                                          "\xff\xfe",
                                          "\xc3",
                                          "true",
                                          "&lt;b&gt;",
                                          "99999999999999999999999x"};
  for (const std::string& each : nonsense) {
    if (each.find_first_of("\xff\xc3") == std::string::npos) agent.observe("T1", each, localUtc());
    publisher.publish("room", R"({"temperature":")" + each + "\"}");
    logger.print("T=" + each + "\n");
  }
  for (const char* each : {R"({"temperature":null})", R"({"temperature":[1,2]})", R"({"temperature":{"a":1}})", "[]",
                           "7", R"({"temperature":)", "", R"({"temperature":1e999})"})
    publisher.publish("room", each);
  logger.print(std::string("\0\x01\x02T=\x80\n", 8));
  agent.observe("T1", "31.5", localUtc());
  publisher.publish("room", R"({"temperature":32.5})");
  logger.print("T=33.5\n");
  ASSERT_TRUE(waitUntil([&] {
    const LiveSnapshot now = live.snapshot();
    return now.columns[0].newest.value == 31.5 && now.columns[1].newest.value == 32.5 &&
           now.columns[2].newest.value == 33.5;
  }));
  const LiveSnapshot now = live.snapshot();
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_TRUE(now.columns[c].known);
    EXPECT_GT(now.columns[c].refused, 3U) << c;
  }
  // A temperature is no speed: said, and the column stays empty.
  EXPECT_EQ(now.columns[3].records, 0U);
  ASSERT_FALSE(now.sentences.empty());
  for (const std::string& sentence : now.sentences)
    EXPECT_EQ(firstInvalidUtf8(sentence), std::string::npos) << sentence;
  EXPECT_THAT(now.sentences, ::testing::Contains(HasSubstr("cannot become rpm")));
  for (const LiveSource& source : now.sources) EXPECT_EQ(source.status.connections, 1U) << source.name;
  live.requestStop();
  ASSERT_TRUE(waitUntil([&] { return live.ended(); }));
  const OperatingLog log = OperatingLog::read(folder / "log.csv");
  EXPECT_EQ(log.signal("T_1_degC")->back(), 31.5);
  EXPECT_EQ(log.signal("T_2_degC")->back(), 32.5);
  EXPECT_EQ(log.signal("T_3_degC")->back(), 33.5);
}

}  // namespace
}  // namespace spindrift::testing
