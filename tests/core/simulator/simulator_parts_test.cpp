// SPDX-License-Identifier: GPL-3.0-or-later
// Tables from the log, errors of sensors, changes in JSON texts, contents by their SHA-256.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "core/base/sha256.h"
#include "core/simulator/json_edit.h"
#include "core/simulator/log_tables.h"
#include "core/simulator/program_simulator.h"
#include "tests/core/simulator/small_simulator.h"

namespace spindrift {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::parameter;
using ::testing::Pointwise;
using testing::refusal;

TEST(Sha256, OfThePublishedExamples) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(JsonEdit, ChangesOneValueAndNothingElse) {
  const std::string text = "{\n  \"a\" : [ 1.50, {\"b\":\"x, \\\"]}\" , \"c\": 2e0}],\n  \"d\":{ }\n}\n";
  EXPECT_EQ(editedJson(text, {{{"a", "1", "c"}, 2.5}}),
            "{\n  \"a\" : [ 1.50, {\"b\":\"x, \\\"]}\" , \"c\": 2.5}],\n  \"d\":{ }\n}\n");
  EXPECT_EQ(editedJson(text, {{{"a", "0"}, 3}}),
            "{\n  \"a\" : [ 3, {\"b\":\"x, \\\"]}\" , \"c\": 2e0}],\n  \"d\":{ }\n}\n");
  const auto value = [&](const JsonEdit& edit) { return nlohmann::json::parse(editedJson(text, {edit})); };
  EXPECT_EQ(value({{"d", "e", "f"}, 1})["d"]["e"]["f"], 1);
  EXPECT_EQ(value({{"a", "1", "z"}, true})["a"][1]["z"], true);
  EXPECT_FALSE(value({{"d"}, std::nullopt}).contains("d"));
  EXPECT_FALSE(value({{"a", "1", "b"}, std::nullopt})["a"][1].contains("b"));
  EXPECT_EQ(value({{"no", "such"}, std::nullopt}), nlohmann::json::parse(text));
  EXPECT_EQ(editedJson("{\"x\": {\"only\": 1}}", {{{"x", "only"}, std::nullopt}}), "{\"x\": {}}");
  EXPECT_EQ(appendedJson("{\"h\": [ 1 ]}", "h", 2), "{\"h\": [ 1, 2 ]}");
  EXPECT_EQ(appendedJson("{}", "h", 2), "{\"h\": [2]}");
}

class LogTablesTest : public ::testing::Test {
 protected:
  LogTablesTest() : log(std::vector<double>{0, 60, 120, 180, 240}) {
    log->setSignal("spindle_rpm", {0, 1000, 4000, 4000, 0});
    log->setSignal("T_room_degC", {20, 21, 23, 23, 22});
  }
  [[nodiscard]] std::vector<double> values(const std::string& table, const ParameterValues& at = {},
                                           const TableTimes& times = {0, 120, 240}) const {
    const JsonNode node = JsonNode::parse("{\"X\": " + table + "}", "simulator.json");
    std::vector<SimulatorParameter> own(2);
    own[0].name = "on_s";
    own[1].name = "off_s";
    const std::string text = LogTables(node, log, own).text(times, at).at("X");
    std::vector<double> out;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) out.push_back(std::stod(line.substr(line.find(',') + 1)));
    return out;
  }
  std::optional<OperatingLog> log;
};

TEST_F(LogTablesTest, LinearHeldAndAsMeanOverTheIncrement) {
  EXPECT_THAT(values(R"({"column": "T_room_degC", "minus_first": true})"), ElementsAre(0, 3, 2));
  EXPECT_THAT(values(R"({"column": "T_room_degC"})", {}, {30, 60, 180}), ElementsAre(20.5, 22, 23, 22.5));
  EXPECT_THAT(values(R"({"column": "T_room_degC", "between_rows": "hold"})", {}, {30, 60, 180}),
              ElementsAre(20, 21, 23, 23));
  EXPECT_THAT(values(R"({"column": "spindle_rpm", "divide_by": 1000, "mean_over_increment": true})"),
              ElementsAre(0, 0.5, 4));
  EXPECT_THAT(values(R"({"column": "spindle_rpm", "divide_by": 1000, "power": 1.5, "mean_over_increment": true})"),
              ElementsAre(0, 0.5, 8));
  EXPECT_THAT(values(R"({"column": "T_room_degC", "mean_over_increment": true, "between_rows": "linear"})"),
              Pointwise(DoubleNear(1e-9), {20.0, 21.25, 22.75}));
  EXPECT_THAT(values(R"({"column": "T_room_degC"})", {}, {0, 120, 480}), ElementsAre(20, 23, 22, 22, 22))
      << "after the log its last row holds";
}

TEST_F(LogTablesTest, AWindowCountsByThePartOfTheIncrementThatItCovers) {
  const std::string window = R"({"window": ["on_s", "off_s"], "mean_over_increment": true})";
  const TableTimes times{0, 100, 400};
  EXPECT_THAT(values(window, {{"on_s", 100}, {"off_s", 300}}, times), ElementsAre(0, 0, 1, 1, 0));
  EXPECT_THAT(values(window, {{"on_s", 150}, {"off_s", 325}}, times), ElementsAre(0, 0, 0.5, 1, 0.25));
  EXPECT_THAT(values(window, {{"on_s", 0}, {"off_s", 50}}, times), ElementsAre(1, 0.5, 0, 0, 0));
  EXPECT_THAT(values(window, {{"on_s", 300}, {"off_s", 100}}, times), ElementsAre(0, 0, 0, 0, 0));
  EXPECT_THAT(values(R"({"window": ["on_s", "off_s"]})", {{"on_s", 100}, {"off_s", 300}}, times),
              ElementsAre(0, 1, 1, 0, 0));
}

TEST_F(LogTablesTest, EveryTemperatureHasItsSensor) {
  const JsonNode node = JsonNode::parse(R"({"A": {"column": "T_room_degC", "minus_first": true},
      "B": {"column": "spindle_rpm"}, "C": {"window": ["on_s", "off_s"]}, "D": {"window": ["on_s", "off_s"]}})",
                                        "simulator.json");
  std::vector<SimulatorParameter> own(2);
  own[0].name = "on_s";
  own[1].name = "off_s";
  const LogTables tables(node, log, own);
  const auto sensors = tables.sensors();
  ASSERT_EQ(sensors.size(), 2u) << "an offset has no influence on changes";
  EXPECT_EQ(sensors[0].id(), "sensor.T_room_degC.gain");
  EXPECT_EQ(sensors[1].id(), "sensor.T_room_degC.lag");
  EXPECT_TRUE(sensors[0].of_sensor);
  EXPECT_EQ(tables.windows().size(), 1u);
  EXPECT_EQ(values(R"({"column": "T_room_degC", "minus_first": true})", {{"sensor.T_room_degC.gain", 0.25}}),
            (std::vector<double>{0, 2.4, 1.6}));
  EXPECT_EQ(values(R"({"column": "T_room_degC"})", {{"sensor.T_room_degC.offset", 0.5}}),
            (std::vector<double>{19.5, 22.5, 21.5}));
}

TEST(TrueReadings, UndoesASensorThatFollowsLate) {
  std::vector<double> time_s;
  std::vector<double> reading;
  std::vector<double> truth;
  const double lag_s = 300.0;
  for (double t = 0.0; t <= 7200.0; t += 20.0) {
    // A ramp from rest, and what a first-order sensor reads of it.
    time_s.push_back(t);
    truth.push_back(20.0 + 1e-3 * t);
    reading.push_back(20.0 + 1e-3 * (t - lag_s * (1.0 - std::exp(-t / lag_s))));
  }
  const std::vector<double> found = trueReadings(time_s, reading, 0.0, 0.0, lag_s);
  double largest = 0.0;
  double before = 0.0;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (time_s[i] < lag_s || time_s[i] > 6900.0) continue;
    largest = std::max(largest, std::abs(found[i] - truth[i]));
    before = std::max(before, std::abs(reading[i] - truth[i]));
  }
  EXPECT_GT(before, 0.29);
  EXPECT_LT(largest, 0.01);
  EXPECT_EQ(trueReadings(time_s, reading, 0.0, 0.0, 0.0), reading);
  // The tangent in the lag is the rate of the reading.
  const double rate = (trueReadings(time_s, reading, 0.0, 0.0, 1e-3)[100] - reading[100]) / 1e-3;
  EXPECT_NEAR(rate, (reading[101] - reading[99]) / 40.0, 1e-9);
}

TEST_F(LogTablesTest, RefusesWhatTheLogCannotGive) {
  const auto said = [&](const std::string& table) { return refusal([&] { (void)values(table); }); };
  EXPECT_THAT(said(R"({"column": "T_bed_degC"})"), HasSubstr("spindle_rpm or T_room_degC"));
  EXPECT_THAT(said(R"({"column": "spindle_rpm", "window": ["on_s", "off_s"]})"), HasSubstr("either \"column\""));
  EXPECT_THAT(said(R"({"window": ["on_s"]})"), HasSubstr("two names"));
  EXPECT_THAT(said(R"({"window": ["on_s", "end_s"]})"), HasSubstr("the name of a parameter"));
  EXPECT_THAT(said(R"({"column": "spindle_rpm", "between_rows": "cubic"})"), HasSubstr("linear or hold"));
  EXPECT_THAT(said(R"({"column": "spindle_rpm", "divide_by": 0})"), HasSubstr("other than zero"));
  EXPECT_THAT(testing::failure([&] { (void)values(R"({"column": "spindle_rpm", "power": -1})"); }),
              HasSubstr("The table X has no value at 0 s"));
}

}  // namespace
}  // namespace spindrift
