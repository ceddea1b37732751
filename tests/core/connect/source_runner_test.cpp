// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/connect/source_runner.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>

#include "core/connect/mtconnect_source.h"
#include "tests/core/connect/collected.h"
#include "tests/core/connect/small_agent.h"

namespace spindrift::testing {
namespace {

using ::testing::HasSubstr;

double secondsSince(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Counts up; what a test wants goes wrong.
struct Counting final : Source {
  std::shared_ptr<std::atomic<bool>> broken = std::make_shared<std::atomic<bool>>(false);
  std::shared_ptr<std::atomic<bool>> hanging = std::make_shared<std::atomic<bool>>(false);
  int next = 0;

  void connect(const std::stop_token&) override {
    if (*broken) throw ConnectionError("the peer is away.");
  }
  std::vector<DataItem> list(double, const std::stop_token&) override { return {}; }
  void subscribe(const std::vector<std::string>&, RecordSink& sink, const std::stop_token&) override {
    if (next > 0) sink.missed("what came meanwhile.");
  }
  void poll(double, RecordSink& sink) override {
    while (*hanging) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (*broken) throw std::runtime_error("it broke.");
    Record record;
    record.value = next++;
    sink.record(record);
  }
  void close() noexcept override {}
};

RunnerOptions quick() {
  RunnerOptions options;
  options.first_pause_s = 0.01;
  options.longest_pause_s = 0.05;
  options.stop_patience_s = 0.3;
  return options;
}

TEST(RecordQueue, IsBoundedAndKeepsTheOrder) {
  RecordQueue queue(4);
  std::stop_source stop;
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(queue.push({0, Record{.value = double(i)}}, stop.get_token()));
  std::thread waiting([&] { EXPECT_TRUE(queue.push({0, Record{.value = 4.0}}, stop.get_token())); });
  std::vector<Arrival> taken;
  std::vector<double> values;
  while (values.size() < 5) {
    queue.take(taken, 1.0);
    EXPECT_LE(taken.size(), 4U);
    for (const Arrival& each : taken) values.push_back(std::get<Record>(each.what).value);
  }
  waiting.join();
  EXPECT_EQ(values, (std::vector<double>{0, 1, 2, 3, 4}));
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(queue.push({0, Record{}}, stop.get_token()));
  std::thread refused([&] { EXPECT_FALSE(queue.push({0, Record{}}, stop.get_token())); });
  stop.request_stop();
  refused.join();
}

TEST(SourceRunner, ComesBackAfterEveryFaultAndLosesNothingDelivered) {
  auto source = std::make_unique<Counting>();
  const auto broken = source->broken;
  auto queue = std::make_shared<RecordQueue>(64);
  SourceRunner runner(3, std::move(source), {"n"}, queue, quick());
  std::vector<Arrival> taken;
  std::vector<double> values;
  int lost = 0, resumed = 0, missed = 0;
  const auto take = [&] {
    queue->take(taken, 0.05);
    for (const Arrival& each : taken) {
      EXPECT_EQ(each.source, 3U);
      if (const Record* record = std::get_if<Record>(&each.what)) {
        values.push_back(record->value);
        EXPECT_NEAR(record->time_s, localUtc(), 5.0);
      } else if (const Notice* notice = std::get_if<Notice>(&each.what)) {
        const Notice::Kind kind = notice->kind;
        lost += kind == Notice::Kind::Lost;
        resumed += kind == Notice::Kind::Resumed;
        missed += kind == Notice::Kind::Missed;
      }
    }
  };
  for (int round = 0; round < 3; ++round) {
    const std::size_t before = values.size();
    EXPECT_TRUE(waitUntil([&] { return take(), values.size() > before + 100; }));
    *broken = true;
    EXPECT_TRUE(waitUntil([&] { return take(), runner.status().state == SourceStatus::State::Lost; }));
    EXPECT_THAT(runner.status().sentence, ::testing::AnyOf("it broke.", "the peer is away."));
    *broken = false;
    EXPECT_TRUE(waitUntil([&] { return take(), runner.status().state == SourceStatus::State::Live; }));
  }
  runner.requestStop();
  EXPECT_TRUE(runner.stop());
  take();
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], static_cast<double>(i));
  EXPECT_EQ(lost, 3);
  EXPECT_EQ(resumed, 3);
  EXPECT_GE(missed, 2);
  EXPECT_EQ(runner.status().records, values.size());
}

TEST(SourceRunner, StopsInTimeWithAFullQueueAndWithASourceThatHangs) {
  auto full = std::make_shared<RecordQueue>(4);
  auto begin = std::chrono::steady_clock::now();
  {
    SourceRunner runner(0, std::make_unique<Counting>(), {"n"}, full, quick());
    EXPECT_TRUE(waitUntil([&] { return full->size() == 4; }));
    begin = std::chrono::steady_clock::now();
    EXPECT_TRUE(runner.stop());
  }
  EXPECT_LT(secondsSince(begin), 0.3);
  auto source = std::make_unique<Counting>();
  const auto hanging = source->hanging;
  *hanging = true;
  auto queue = std::make_shared<RecordQueue>();
  begin = std::chrono::steady_clock::now();
  {
    SourceRunner runner(0, std::move(source), {"n"}, queue, quick());
    EXPECT_TRUE(waitUntil([&] { return runner.status().state == SourceStatus::State::Live; }));
    EXPECT_FALSE(runner.stop());
  }
  EXPECT_LT(secondsSince(begin), 1.0);
  *hanging = false;  // the thread ends on its own
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

TEST(SourceRunner, AnAgentKilledAgainAndAgainLosesNothingItKeeps) {
  SmallAgent agent;
  MtconnectOptions options;
  options.url = agent.url();
  options.interval_s = 0.01;
  options.heartbeat_s = 0.2;
  auto queue = std::make_shared<RecordQueue>();
  SourceRunner runner(0, makeMtconnectSource(options), {"S1"}, queue, quick());
  EXPECT_TRUE(waitUntil([&] { return runner.status().state == SourceStatus::State::Live; }));
  EXPECT_TRUE(waitUntil([&] { return agent.requests("/sample") > 0; }));
  std::vector<double> values;
  std::vector<Arrival> taken;
  const auto take = [&] {
    queue->take(taken, 0.01);
    for (const Arrival& each : taken) {
      if (const Record* record = std::get_if<Record>(&each.what)) values.push_back(record->value);
    }
  };
  int sent = 0;
  for (int round = 0; round < 5; ++round) {
    for (int i = 0; i < 50; ++i) agent.observe("S1", std::to_string(++sent), localUtc());
    agent.stop();
    for (int i = 0; i < 50; ++i) agent.observe("S1", std::to_string(++sent), localUtc());
    take();
    agent.start();
    EXPECT_TRUE(waitUntil([&] { return take(), values.size() >= static_cast<std::size_t>(sent); }))
        << runner.status().sentence << values.size() << " of " << sent;
  }
  EXPECT_TRUE(runner.stop());
  ASSERT_EQ(values.size(), static_cast<std::size_t>(sent));
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], static_cast<double>(i + 1));
  EXPECT_GE(runner.status().connections, 5U);
  EXPECT_EQ(runner.status().missed, 0U);
}

TEST(SourceRunner, AClockThatIsSetAndANetworkThatIsPausedMoveNoValue) {
  SmallAgent agent;
  MtconnectOptions options;
  options.url = agent.url();
  options.interval_s = 0.01;
  options.heartbeat_s = 1.0;  // a pause of half of three is no loss
  auto queue = std::make_shared<RecordQueue>();
  SourceRunner runner(0, makeMtconnectSource(options), {"S1"}, queue, quick());
  EXPECT_TRUE(waitUntil([&] { return agent.requests("/sample") > 0; }));
  std::vector<double> made;
  const auto observe = [&](int count, double clock_s) {
    for (int i = 0; i < count; ++i) {
      made.push_back(localUtc());
      agent.observe("S1", std::to_string(made.size()), made.back() + clock_s);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  };
  observe(20, 0.0);
  agent.freeze(true);
  observe(75, 0.0);
  agent.freeze(false);
  observe(20, 0.0);
  observe(20, 3600.0);
  observe(20, 0.0);
  std::vector<Record> records;
  std::vector<Arrival> taken;
  EXPECT_TRUE(waitUntil([&] {
    queue->take(taken, 0.05);
    for (const Arrival& each : taken) {
      if (const Record* record = std::get_if<Record>(&each.what)) records.push_back(*record);
    }
    return records.size() >= made.size();
  }));
  ASSERT_EQ(records.size(), made.size());
  for (std::size_t i = 0; i < made.size(); ++i) {
    EXPECT_EQ(records[i].value, static_cast<double>(i + 1));
    EXPECT_NEAR(records[i].time_s, made[i], 0.8) << i;
  }
  EXPECT_EQ(runner.status().clock_steps, 2);
  EXPECT_EQ(runner.status().connections, 1U);
  EXPECT_TRUE(runner.stop());
}

}  // namespace
}  // namespace spindrift::testing
