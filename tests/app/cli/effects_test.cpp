// SPDX-License-Identifier: GPL-3.0-or-later
// Effects of the user's, absolute campaigns and the list of effects, as a user calls them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <regex>

#include "core/base/random.h"
#include "tests/app/cli/child_process.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

const char* const terms = R"({"format":"spindrift-effects","version":1,"built_in":false,"effects":[
  {"id":"axis.zero","title":"zero of the axis","physics":"The zero is off.","shape":[{"gain_unit":"um","EX":"1"}]},
  {"id":"squareness","title":"squareness of Y to X","physics":"The axes are not square.",
   "shape":[{"gain_unit":"um/mm","EX":"-y"}]},
  {"id":"pitch","physics":"The pitch is off.","shape":[{"gain_unit":"um/mm","EX":"x"}]},
  {"id":"room","drivers":["T_room_degC"],"shape":[{"gain_unit":"um/K","EY":"1"}]}]})";

/// 150 points measured once each, absolute: squareness 0.04 um/mm is missing.
void writeCampaign(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "campaign.json")
      << R"({"format":"spindrift-campaign","version":1,"name":"grid","start_utc":"2026-01-31T08:00:00Z",)"
      << R"("simulation":"simulation.csv","simulation_gain_uncertainty":0,"reference":"absolute",)"
      << R"("effects":"effects.json"})";
  std::ofstream(folder / "machine.json")
      << R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-t]","axes":[)"
      << R"({"name":"X","travel_mm":[0,400]},{"name":"Y","travel_mm":[0,300]},{"name":"Z","travel_mm":[0,200]}]})";
  std::ofstream(folder / "effects.json") << terms;
  std::ofstream observations(folder / "observations.csv");
  std::ofstream simulation(folder / "simulation.csv");
  std::ofstream log(folder / "log.csv");
  observations << "time_s,state,point,x_mm,y_mm,z_mm,c_deg,component,value,sigma,instrument,use\n";
  simulation << "time_s,point,component,predicted\n";
  log << "time_s,T_room_degC\n";
  Random random(11);
  for (int i = 0; i < 150; ++i) {
    const double x = random.uniform(0.0, 400.0);
    const double y = random.uniform(0.0, 300.0);
    const double base = 5.0 + 0.01 * x;
    log << fmt::format("{},{:.3f}\n", 20 * i, 22.0 + std::sin(0.05 * i));
    for (const char* component : {"EX", "EY", "EZ"}) {
      const double truth = component[1] == 'X' ? base - 0.04 * y : 0.0;
      observations << fmt::format("{},P{},S{},{:.3f},{:.3f},0,0,{},{:.4f},1,tracker,{}\n", 20 * i, i, i, x, y,
                                  component, truth + random.normal(), i % 4 == 3 ? "holdout" : "fit");
      simulation << fmt::format("{},S{},{},{:.4f}\n", 20 * i, i, component, component[1] == 'X' ? base : 0.0);
    }
  }
}

class OwnEffectsCli : public ::testing::Test {
 protected:
  void SetUp() override { writeCampaign(folder_ / "campaign"); }
  [[nodiscard]] std::string campaign() const { return (folder_ / "campaign").string(); }
  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  TempFolder folder_;
};

TEST_F(OwnEffectsCli, AMissingTermOfAnAbsoluteCampaignIsNamed) {
  const nlohmann::json j = jsonOf({"discrepancy", campaign()});
  EXPECT_EQ(j["verdict"], "named") << j["message"];
  ASSERT_EQ(j["effects"].size(), 1U);
  EXPECT_EQ(j["effects"][0]["id"], "squareness");
  EXPECT_EQ(j["effects"][0]["title"], "squareness of Y to X");
  EXPECT_NEAR(j["effects"][0]["parameters"]["gain_um/mm"].get<double>(), 0.04, 0.004);
  EXPECT_EQ(j["gap"]["unit"], "um");
  // Values are what they are: no constant was taken out before the comparison.
  EXPECT_GT(j["gap"]["rms_before_um"].get<double>(), 3.0);
  EXPECT_LT(j["gap"]["heldout_rms_after_um"].get<double>(), 1.2);
  EXPECT_GT(j["gap"]["heldout_rms_before_um"].get<double>(), 3.0);
}

TEST_F(OwnEffectsCli, TheFlagWinsOverTheCampaign) {
  const std::string other =
      write("other.json", R"({"format":"spindrift-effects","version":1,"built_in":false,"effects":[
    {"id":"tilt","shape":[{"gain_unit":"um/mm","EX":"y"}]}]})");
  const nlohmann::json j = jsonOf({"discrepancy", campaign(), "--effects", other});
  ASSERT_EQ(j["effects"].size(), 1U);
  EXPECT_EQ(j["effects"][0]["id"], "tilt");
  EXPECT_NEAR(j["effects"][0]["parameters"]["gain_um/mm"].get<double>(), -0.04, 0.004);
}

TEST_F(OwnEffectsCli, BadFilesAreRefusedInOneSentence) {
  const auto refused = [&](const std::string& effects, const std::vector<std::string>& parts) {
    const std::string file =
        write("bad.json", R"({"format":"spindrift-effects","version":1,"built_in":false,"effects":[)" + effects + "]}");
    std::vector<std::string> all{"bad.json"};
    all.insert(all.end(), parts.begin(), parts.end());
    expectBadInput({"discrepancy", campaign(), "--effects", file}, all);
  };
  refused(R"({"id":"a","shape":[{"gain_unit":"um","EX":"x*("}]})", {"$.effects[0].shape[0].EX", "x*("});
  refused(R"({"id":"a","shape":[{"gain_unit":"um","EX":"q"}]})", {"$.effects[0].shape[0].EX", "\"q\""});
  refused(R"({"id":"a","drivers":["T_hall_degC"],"shape":[{"gain_unit":"um","EX":"1"}]})",
          {"$.effects[0].drivers[0]", "T_hall_degC", "T_room_degC"});
  refused(R"({"id":"a","shape":[{"gain_unit":"um","EX":"1"}]},{"id":"a","shape":[{"gain_unit":"um","EX":"1"}]})",
          {"$.effects[1].id"});
  refused(R"j({"id":"a","shape":[{"gain_unit":"um","EX":"1/(z-0)"}]})j",
          {"$.effects[0].shape[0].EX", "point S0", "EX"});
  expectBadInput({"discrepancy", campaign(), "--effects", (folder_ / "none.json").string()}, {"none.json"});
  std::ofstream(folder_ / "campaign" / "campaign.json")
      << R"({"format":"spindrift-campaign","version":1,"name":"g","start_utc":"2026-01-31T08:00:00Z","reference":"zero"})";
  expectBadInput({"discrepancy", campaign()}, {"campaign.json", "$.reference", "first_state", "absolute"});
}

TEST_F(OwnEffectsCli, TheNineParametersAreFittedToAbsoluteValuesOfAllPoints) {
  const nlohmann::json j = jsonOf({"fit", campaign()});
  EXPECT_EQ(j["state"], "all");
  EXPECT_TRUE(j["reference_state"].is_null());
  // ex = EX - EC0Y y + alpha x
  EXPECT_NEAR(j["parameters"]["EX_um"]["value"].get<double>(), 5.0, 1.2);
  EXPECT_NEAR(j["parameters"]["EC0Y_urad"]["value"].get<double>(), 40.0, 6.0);
  EXPECT_NEAR(j["parameters"]["alpha_X_um_per_m"]["value"].get<double>(), 10.0, 4.0);
  const std::string csv = (folder_ / "map.csv").string();
  EXPECT_EQ(runCli({"heatmap", campaign(), "--state", "all", "--component", "EX", "--csv", csv}).status, 0);
  EXPECT_TRUE(std::filesystem::exists(csv));
}

TEST_F(OwnEffectsCli, AReportIsWritten) {
  const std::string html = (folder_ / "report.html").string();
  EXPECT_EQ(runCli({"report", campaign(), "--out", html}).status, 0);
  EXPECT_NE(textOf(html).find("squareness of Y to X"), std::string::npos);
}

TEST_F(OwnEffectsCli, EffectsListsTheCatalogueAndOwnOnes) {
  const nlohmann::json all = jsonOf({"effects"});
  EXPECT_GT(all["effects"].size(), 40U);
  bool found = false;
  for (const auto& e : all["effects"]) {
    for (const char* key : {"id", "title", "physics", "drivers", "shape", "formula", "references", "contains"})
      EXPECT_TRUE(e.contains(key)) << key;
    found = found || e["id"] == "ball_screw.expansion.x";
  }
  EXPECT_TRUE(found);
  const nlohmann::json own = jsonOf({"effects", campaign()});
  ASSERT_EQ(own["effects"].size(), 4U);
  EXPECT_EQ(own["effects"][1]["shape"][0]["EX"], "-y");
  EXPECT_EQ(own["effects"][3]["drivers"], nlohmann::json::array({"T_room_degC"}));
  const std::string text = runCli({"effects"}).output;
  EXPECT_NE(text.find("thermal expansion of the X ball screw"), std::string::npos);
  // Drivers, dynamics, gains and formulas in the words and symbols of the field.
  EXPECT_NE(text.find("temperature difference front minus rear of the column"), std::string::npos);
  EXPECT_NE(text.find("EY = −g q (z − z₀)² / 2"), std::string::npos) << text;
  EXPECT_NE(text.find("µm/m²"), std::string::npos);
  static const std::regex of_files(
      R"((column_(side_)?difference|_rpm|_degC|_per_|feed_|pos_|speed_|instrument_on|\^\d|dynamics: (lag|asymmetric)\b).*)");
  std::smatch match;
  EXPECT_FALSE(std::regex_search(text, match, of_files)) << match.str();
}

}  // namespace
}  // namespace spindrift::testing
