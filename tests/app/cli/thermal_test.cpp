// SPDX-License-Identifier: GPL-3.0-or-later
// thermal identify and thermal track on a log made here: a spindle that heats up, a first-order growth.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/app/cli/child_process.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

class Thermal : public ::testing::Test {
 protected:
  void SetUp() override {
    std::mt19937 random(3);
    const auto noise = [&] { return static_cast<double>(random() % 2001) / 1000.0 - 1.0; };
    std::string text = "time_s,spindle_rpm,T_nose_degC,growth_um\n";
    double heat = 0.0;
    double growth = 0.0;
    double rpm = 0.0;
    for (int k = 0; k < 600; ++k) {
      if (k % 40 == 0) rpm = 1000.0 * static_cast<double>(random() % 7);
      heat += 30.0 / 600.0 * (rpm / 300.0 - heat);
      growth += 30.0 / 900.0 * (rpm / 150.0 - growth);
      text += std::to_string(30 * k) + ',' + std::to_string(rpm) + ',' + std::to_string(20.0 + heat + 0.03 * noise()) +
              ',' + std::to_string(growth + 0.1 * noise()) + '\n';
    }
    log = folder.write("log.csv", text);
  }
  [[nodiscard]] std::vector<std::string> identify(const std::string& inputs = "spindle_rpm") const {
    return {"thermal", "identify", log.string(), "--output", "growth_um",  "--inputs",
            inputs,    "--train",  "0:12000",    "--test",   "12000:18000"};
  }
  void expectRefused(std::vector<std::string> words, const std::vector<std::string>& parts) {
    words.insert(words.end(), {"--json", (folder / "j.json").string(), "--prediction", (folder / "p.csv").string()});
    expectBadInput(words, parts);
    EXPECT_FALSE(std::filesystem::exists(folder / "j.json") || std::filesystem::exists(folder / "p.csv"));
  }

  TempFolder folder;
  std::filesystem::path log;
};

TEST_F(Thermal, IdentifyAndTrackGiveTheKeysOfTheContract) {
  auto words = identify();
  const std::string model = (folder / "model.json").string();
  const std::string prediction = (folder / "prediction.csv").string();
  words.insert(words.end(), {"--model-out", model, "--prediction", prediction});
  const nlohmann::json j = jsonOf(words);
  EXPECT_EQ(j["inputs"], nlohmann::json::array({"spindle_rpm"}));
  for (const char* range : {"train", "test"}) {
    for (const char* key : {"fit_percent", "p2p", "rmse"}) EXPECT_TRUE(j[range][key].is_number()) << range << key;
  }
  EXPECT_GT(j["test"]["fit_percent"].get<double>(), 80.0);
  for (const char* key : {"model", "step_response", "elapsed_ms"}) EXPECT_TRUE(j.contains(key)) << key;
  const auto lines = linesOf(prediction);
  EXPECT_TRUE(lines.front().starts_with("time_s,measured,predicted")) << lines.front();
  EXPECT_EQ(lines.size(), 601U);
  for (const char* update : {"gain", "arx"}) {
    const Outcome tracked = runCli(
        {"thermal", "track", log.string(), "--model", model, "--update", update, "--interval", "3600", "--json", "-"});
    EXPECT_TRUE(tracked.status == 0 || tracked.status == 1) << tracked.error;
    EXPECT_NE(tracked.output.find("fit_percent"), std::string::npos);
    EXPECT_NE(tracked.output.find("p2p"), std::string::npos);
  }
}

TEST_F(Thermal, TrackDrawsAndTakesAContext) {
  auto words = identify();
  const std::string model = (folder / "model.json").string();
  words.insert(words.end(), {"--model-out", model});
  ASSERT_EQ(runCli(words).status, 0);
  const std::string svg = (folder / "track.svg").string();
  const std::vector<std::string> track = {"thermal", "track", log.string(), "--model", model, "--interval", "1800"};
  words = track;
  words.insert(words.end(), {"--context", "T_nose_degC", "--svg", svg});
  EXPECT_EQ(jsonOf(words)["sweep"].size(), 7U);
  EXPECT_TRUE(textOf(svg).starts_with("<svg"));
  words = track;
  words.insert(words.end(), {"--context", "T_nose_degC", "--update", "gain"});
  expectBadInput(words, {"--context", "kalman"});
  words = track;
  words.insert(words.end(), {"--context", "growth_um"});
  expectBadInput(words, {"growth_um", "--context"});
  words.back() = "pos_z_mm";
  expectBadInput(words, {"pos_z_mm"});
}

TEST_F(Thermal, NothingMeasuredInTheTestRangeIsUsed) {
  const nlohmann::json honest = jsonOf(identify());
  const std::string prediction = (folder / "a.csv").string();
  auto words = identify();
  words.insert(words.end(), {"--prediction", prediction});
  ASSERT_NE(runCli(words).status, 2);
  std::vector<std::string> lines = linesOf(log);
  for (std::size_t k = 401; k < lines.size(); ++k) lines[k] = lines[k].substr(0, lines[k].rfind(',') + 1) + "1000";
  writeLines(log, lines);
  words.back() = (folder / "b.csv").string();
  ASSERT_NE(runCli(words).status, 2);
  const auto a = linesOf(folder / "a.csv");
  const auto b = linesOf(folder / "b.csv");
  ASSERT_EQ(a.size(), b.size());
  const auto predicted = [](const std::string& line) {
    const std::size_t second = line.find(',', line.find(',') + 1);
    return line.substr(second, line.find(',', second + 1) - second);
  };
  for (std::size_t k = 1; k < a.size(); ++k) ASSERT_EQ(predicted(a[k]), predicted(b[k])) << k;
}

TEST_F(Thermal, BadLogsAreRefusedInOneSentence) {
  expectRefused(identify("no_such_column"), {"log.csv", "no_such_column"});
  expectRefused(identify("growth_um"), {"growth_um"});
  auto words = identify();
  words[8] = "0:1";
  expectRefused(words, {"log.csv", "allowed"});
  words[8] = "zero:12000";
  expectRefused(words, {"zero"});
  words[8] = "12000:0";
  expectRefused(words, {"12000"});
  const std::string good = textOf(log);
  setField(log, 50, "time_s", "3");
  expectRefused(identify(), {"log.csv", "line 50", "jumps back"});
  writeText(log, good);
  setField(log, 60, "spindle_rpm", "fast");
  expectRefused(identify(), {"log.csv", "line 60", "fast"});
  writeText(log, good);
  edit(log, "time_s", "t");
  expectRefused(identify(), {"log.csv", "time_s", "allowed"});
}

TEST_F(Thermal, ConstantInputAndFewRowsAreSaid) {
  const std::string good = textOf(log);
  auto lines = linesOf(log);
  lines.resize(51);
  writeLines(log, lines);
  auto words = identify();
  words[8] = "0:900";
  words[10] = "900:1500";
  const Outcome few = runCli(words);
  EXPECT_TRUE(few.status == 1 || few.status == 2) << few.output << few.error;
  EXPECT_NE(few.output + few.error, "");
}

}  // namespace
}  // namespace spindrift::testing
