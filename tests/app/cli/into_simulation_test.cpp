// SPDX-License-Identifier: GPL-3.0-or-later
// The missing effect goes into a simulation that can be run, as another program would have it done.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/atomic_file.h"
#include "tests/app/cli/child_process.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// A campaign of the shipped machine whose column bends, and its scenario without that as the simulator.
class IntoSimulationCli : public ::testing::Test {
 protected:
  void SetUp() override {
    nlohmann::json scenario =
        nlohmann::json::parse(readFile(sourceFolder() / "resources/scenarios/discrepancy_vertical.json"));
    scenario["effects"]["column.bending.a"] = {{"size", 1.0}};
    scenario["effects"]["spindle.drift.y"] = {{"size", 0.8}};
    scenario["simulation"]["effects"] = {"ball_screw.expansion.x", "ball_screw.expansion.z", "spindle.drift.y"};
    const auto truth = folder.write("truth.json", scenario.dump(1));
    campaign = folder / "campaign";
    ASSERT_EQ(runCli({"simulate", truth.string(), "--out", campaign.string(), "--seed", "5"}).status, 0);
    scenario.erase("simulation");
    scenario["seed"] = 5;
    scenario["effects"]["column.bending.a"] = {{"size", 0.0}};
    folder.write("sim/scenario.json", scenario.dump(1));
    const auto parameter = [](const char* name, double value, double uncertainty, std::vector<std::string> effects) {
      return nlohmann::json{{"name", name}, {"value", value}, {"unit", "1"},  {"standard_uncertainty", uncertainty},
                            {"min", 0.0},   {"max", 20.0},    {"what", name}, {"effects", effects}};
    };
    simulator = {
        {"format", "spindrift-simulator"},
        {"version", 1},
        {"kind", "scenario"},
        {"scenario", "scenario.json"},
        {"parameters",
         {parameter("effects.column.bending.a.size", 0.0, 0.5, {"column.bending.a"}),
          parameter("effects.spindle.drift.y.size", 0.8, 0.05, {}), parameter("physics.friction", 1.0, 0.05, {})}}};
    file = folder.write("sim/simulator.json", simulator.dump(1)).string();
  }

  TempFolder folder;
  std::filesystem::path campaign;
  nlohmann::json simulator;
  std::string file;
};

TEST_F(IntoSimulationCli, NamesPutsInAndWritesTheNewVersion) {
  const std::string before = readFile(file);
  const auto out = folder / "new";
  const auto html = folder / "story.html";
  const nlohmann::json json = jsonOf({"discrepancy", campaign.string(), "--simulator", file, "--into-simulation",
                                      out.string(), "--html", html.string()});
  EXPECT_EQ(json["verdict"], "named");
  EXPECT_EQ(json["effects"][0]["id"], "simulation.effects.column.bending.a.size");
  const nlohmann::json& update = json["into_simulation"];
  EXPECT_EQ(update["status"], "converged");
  EXPECT_THAT(update["mechanisms"], Contains("effects.column.bending.a.size"));
  const nlohmann::json& fitted = update["parameters"]["effects.column.bending.a.size"];
  EXPECT_NEAR(fitted["value"].get<double>(), 1.0, 4.0 * fitted["standard_uncertainty"].get<double>());
  EXPECT_EQ(fitted["put_in"], true);
  EXPECT_LT(update["heldout_rms_after_um"].get<double>(), 1.1 * update["noise_um"].get<double>());
  // The new version holds the value and its history, and is a simulator itself; the old one is as it was.
  EXPECT_EQ(readFile(file), before);
  const nlohmann::json written = nlohmann::json::parse(readFile(out / "simulator.json"));
  EXPECT_NEAR(written["parameters"][0]["value"].get<double>(), fitted["value"].get<double>(), 1e-9);
  EXPECT_EQ(written["history"].size(), 1U);
  EXPECT_TRUE(std::filesystem::exists(out / "simulation.csv"));
  EXPECT_THAT(readFile(html), HasSubstr("Put into the simulation"));
  const nlohmann::json again =
      jsonOf({"discrepancy", campaign.string(), "--simulator", (out / "simulator.json").string()});
  EXPECT_EQ(again["verdict"], "none") << again["effects"].dump();
  // A second time there is no place for it.
  const Outcome occupied =
      runCli({"discrepancy", campaign.string(), "--simulator", file, "--into-simulation", out.string()});
  EXPECT_EQ(occupied.status, 2);
  EXPECT_THAT(occupied.error, HasSubstr("is not empty"));
}

TEST_F(IntoSimulationCli, SaysWhatIsWrongInOneSentence) {
  const auto refused = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"discrepancy", campaign.string()};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome run = runCli(words);
    EXPECT_EQ(run.status, 2) << run.output;
    return run.error;
  };
  EXPECT_THAT(refused({"--into-simulation", (folder / "x").string()}), HasSubstr("names no simulator"));
  EXPECT_THAT(refused({"--simulator", (folder / "none.json").string()}), HasSubstr("none.json"));
  EXPECT_THAT(refused({"--simulator", file, "--into-simulation", (campaign / "x").string()}),
              HasSubstr("never written to"));
  EXPECT_THAT(refused({"--simulator", file, "--into-simulation", (folder / "x").string(), "--mechanism", "moon"}),
              HasSubstr("has no parameter \"moon\""));
  EXPECT_FALSE(std::filesystem::exists(folder / "x"));
  // A campaign that names a simulator does not run it by being looked at.
  nlohmann::json named = nlohmann::json::parse(readFile(campaign / "campaign.json"));
  named["simulator"] = "simulator.json";
  writeFileAtomically(campaign / "campaign.json", named.dump(1));
  simulator["kind"] = "command";
  writeText(campaign / "deck.in", "friction {{physics.friction}}\n");
  simulator["templates"] = {"deck.in"};
  simulator["run"] = {{"false"}};
  simulator["result"] = "simulation.csv";
  simulator["time_limit_s"] = 5;
  writeFileAtomically(campaign / "simulator.json", simulator.dump(1));
  const Outcome looked = runCli({"discrepancy", campaign.string()});
  EXPECT_NE(looked.status, 2);
  EXPECT_THAT(looked.output + looked.error, HasSubstr("which was not run"));
  EXPECT_THAT(refused({"--into-simulation", (folder / "y").string()}), HasSubstr("false"));
}

}  // namespace
}  // namespace spindrift::testing
