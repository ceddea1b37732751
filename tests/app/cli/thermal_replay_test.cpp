// SPDX-License-Identifier: GPL-3.0-or-later
// thermal replay on a log made here and on a short campaign of the virtual machine; thermal clusters.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/base/random.h"
#include "tests/app/cli/child_process.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

class ThermalReplay : public ::testing::Test {
 protected:
  /// 40 h; the error is measured every 30 min (empty between), its gain grows by half after 22 h.
  void SetUp() override {
    Random random(5);
    std::string text = "time_s,spindle_rpm,T_nose_degC,T_body_degC,growth_um\n";
    double nose = 0.0;
    double body = 0.0;
    double rpm = 0.0;
    for (int k = 0; k < 800; ++k) {
      if (k % 25 == 0) rpm = 500.0 * static_cast<double>(random.index(12));
      nose += 180.0 / 900.0 * (rpm / 300.0 - nose);
      body += 180.0 / 5400.0 * (rpm / 300.0 - body);
      const double growth = (k < 440 ? 1.0 : 1.5) * 2.5 * body;
      text += std::to_string(180 * k) + ',' + std::to_string(rpm) + ',' +
              std::to_string(20.0 + nose + random.normal(0.0, 0.03)) + ',' +
              std::to_string(20.0 + body + random.normal(0.0, 0.03)) + ',' +
              (k % 10 == 0 ? std::to_string(growth + random.normal(0.0, 0.3)) : "") + '\n';
    }
    log = folder.write("log.csv", text);
  }
  [[nodiscard]] std::vector<std::string> replay(const std::string& outputs = "growth_um") const {
    return {"thermal", "replay", log.string(), "--outputs", outputs, "--setup", "16"};
  }

  TempFolder folder;
  std::filesystem::path log;
};

TEST_F(ThermalReplay, AdaptiveStaysTrueWhereStaticDoesNot) {
  auto words = replay();
  const std::string svg = (folder / "r.svg").string();
  words.insert(words.end(), {"--svg", svg, "--limit", "growth_um=3", "--sigma", "0.3"});
  const nlohmann::json j = jsonOf(words);
  const auto& output = j["outputs"][0];
  EXPECT_EQ(output["action_limit"], 3.0);
  EXPECT_EQ(output["measurement_sigma"], 0.3);
  EXPECT_GT(output["adaptive_reduction_percent"].get<double>(), 85.0);
  EXPECT_LT(output["rms_adaptive"].get<double>(), 0.6 * output["rms_static"].get<double>());
  EXPECT_EQ(j["setup_measurements"], 32);
  const int spent = j["measurements"];
  EXPECT_GT(spent, 3);
  EXPECT_LE(spent, 48);
  std::set<std::string> kinds;
  for (const auto& event : j["events"]) kinds.insert(event["kind"].get<std::string>());
  for (const char* kind : {"setup", "measurement", "limit exceeded", "re-identified"}) EXPECT_TRUE(kinds.count(kind));
  ASSERT_GE(j["curve"].size(), 4U);
  EXPECT_EQ(j["curve"][0]["measurements"], 0);
  EXPECT_DOUBLE_EQ(j["curve"][0]["reduction_percent"]["growth_um"].get<double>(),
                   output["static_reduction_percent"].get<double>());
  EXPECT_TRUE(textOf(svg).starts_with("<svg"));
  // One sign everywhere: a reduction is positive where the rms became smaller.
  EXPECT_NE(j["sign_convention"].get<std::string>().find("positive where the rms became smaller"), std::string::npos);
  words.resize(words.size() - 6);
  const std::string summary = runCli(words).output;
  EXPECT_EQ(summary.find("(-"), std::string::npos) << summary;
  EXPECT_NE(summary.find("positive where the rms became smaller"), std::string::npos) << summary;
}

TEST_F(ThermalReplay, ReadsTheErrorsOfACampaignFromItsTouches) {
  const std::filesystem::path scenario = folder / "scenario.json";
  std::filesystem::copy_file(sourceFolder() / "resources/scenarios/talc_105h.json", scenario);
  edit(scenario, "\"duration_s\": 378000", "\"duration_s\": 72000");
  edit(scenario, "\"cycles\": 209", "\"cycles\": 40");
  const std::string campaign = (folder / "campaign").string();
  ASSERT_EQ(runCli({"simulate", scenario.string(), "--out", campaign}).status, 0);
  const auto before = contentOf(campaign);
  const nlohmann::json j =
      jsonOf({"thermal", "replay", campaign, "--outputs", "EXX,EZ0T_um", "--inputs",
              "T_table_2_degC,T_rotary_degC,speed_c_rpm,T_nut_x_degC,feed_x_mm_min", "--setup", "12"});
  EXPECT_EQ(j["outputs"][0]["name"], "EXX_um_per_m");
  EXPECT_EQ(j["outputs"][1]["name"], "EZ0T_um");
  EXPECT_EQ(j["setup_measurements"], 24);
  EXPECT_LT(j["measurements"].get<int>(), 17);
  for (const auto& output : j["outputs"]) EXPECT_GT(output["adaptive_reduction_percent"].get<double>(), 50.0);
  EXPECT_EQ(contentOf(campaign), before);
  expectBadInput({"thermal", "replay", campaign, "--outputs", "EXX", "--svg", campaign + "/r.svg"}, {"campaign"});
  expectBadInput({"thermal", "replay", campaign, "--outputs", "EYY"}, {"EYY", "EXX_um_per_m"});
}

TEST_F(ThermalReplay, BadRequestsAreRefusedInOneSentence) {
  expectBadInput(replay("no_such"), {"no_such", "growth_um"});
  auto words = replay();
  words.back() = "39.9";
  expectBadInput(words, {"growth_um", "setup"});
  words = replay();
  words.insert(words.end(), {"--limit", "growth=soft"});
  expectBadInput(words, {"soft", "allowed"});
  words.back() = "other_um=3";
  expectBadInput(words, {"other_um", "--outputs"});
  words[words.size() - 2] = "--inputs";
  words.back() = "growth_um,T_nose_degC";
  expectBadInput(words, {"growth_um", "itself"});
}

TEST_F(ThermalReplay, SensorsThatTellTheSameAreGrouped) {
  Random random(2);
  std::string text = "time_s,T_a_degC,T_b_degC,T_c_degC,T_d_degC,T_e_degC,T_f_degC\n";
  for (int k = 0; k < 300; ++k) {
    const double heat = 1.0 - std::exp(-k / 60.0);
    const double slow = 1.0 - std::exp(-k / 200.0);
    const double day = std::sin(k / 40.0);
    text += std::to_string(60 * k);
    for (const double change : {20.0 * heat, 19.0 * heat, 8.0 * slow, 8.5 * slow, 1.5 * day, 1.4 * day})
      text += ',' + std::to_string(20.0 + change + random.normal(0.0, 0.02));
    text += '\n';
  }
  const std::string file = folder.write("sensors.csv", text).string();
  for (const char* count : {"0", "3"}) {
    const nlohmann::json j = jsonOf({"thermal", "clusters", file, "--groups", count});
    ASSERT_EQ(j["groups"].size(), 3U) << count;
    EXPECT_EQ(j["groups"][0]["sensors"], nlohmann::json::array({"T_a_degC", "T_b_degC"}));
    EXPECT_EQ(j["groups"][1]["sensors"], nlohmann::json::array({"T_c_degC", "T_d_degC"}));
    EXPECT_EQ(j["groups"][2]["sensors"], nlohmann::json::array({"T_e_degC", "T_f_degC"}));
    EXPECT_NEAR(j["groups"][0]["mean_change_K"].get<double>(), 19.4, 0.5);
  }
  expectBadInput({"thermal", "clusters", file, "--groups", "7"}, {"7", "6"});
  expectBadInput({"thermal", "clusters", file, "--sensors", "T_a_degC,T_z_degC"}, {"T_z_degC"});
}

}  // namespace
}  // namespace spindrift::testing
