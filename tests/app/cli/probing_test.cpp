// SPDX-License-Identifier: GPL-3.0-or-later
// evaluate of touches, cycle and import-touches, on campaigns of the virtual machine.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/app/cli/child_process.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

class Touches : public ::testing::Test {
 protected:
  void make(const std::string& name) {
    const Outcome made =
        runCli({"simulate", SPINDRIFT_SOURCE_DIR "/resources/scenarios/" + name + ".json", "--out", campaign});
    ASSERT_EQ(made.status, 0) << made.error;
  }
  void expectRefused(const std::vector<std::string>& parts) {
    const auto before = contentOf(campaign);
    expectBadInput({"evaluate", campaign, "--out", out, "--json", json}, parts);
    EXPECT_FALSE(std::filesystem::exists(out) || std::filesystem::exists(json));
    EXPECT_EQ(contentOf(campaign), before);
  }

  TempFolder folder;
  std::string campaign = (folder / "campaign").string();
  std::string out = (folder / "o.csv").string();
  std::string json = (folder / "o.json").string();
  std::filesystem::path list = folder / "campaign/captures/touches.csv";
};

TEST_F(Touches, HoleBarGivesTheParametersOfTheContract) {
  make("hole_bar");
  const auto before = contentOf(campaign);
  const nlohmann::json j = jsonOf({"evaluate", campaign, "--out", out});
  ASSERT_GE(j["cycles"].size(), 2U);
  for (const auto& cycle : j["cycles"]) {
    EXPECT_TRUE(cycle["cycle"].is_string());
    expectEstimates(cycle["parameters"], {"EXX_um_per_m", "EX0C_um", "EY0C_um", "EZ0T_um", "ER0T_um", "EA0C_urad",
                                          "EB0C_urad", "EC0C_urad", "EME_um_per_m"});
  }
  EXPECT_TRUE(j["rejected"].is_array());
  EXPECT_TRUE(linesOf(out).front().starts_with("time_s,state,point,x_mm,y_mm,z_mm,c_deg,component,value,sigma"));
  EXPECT_EQ(contentOf(campaign), before);
  // What evaluate writes is what the other commands read.
  EXPECT_EQ(runCli({"report", campaign, "--observations", out, "--out", (folder / "r.html").string()}).status, 0);
}

TEST_F(Touches, BallArtefactGivesTheParametersOfTheContract) {
  make("ball_artefact");
  const nlohmann::json j = jsonOf({"evaluate", campaign, "--out", out});
  ASSERT_GE(j["cycles"].size(), 2U);
  for (const auto& cycle : j["cycles"]) {
    expectEstimates(cycle["parameters"], {"hX_urad", "hY_urad", "hZ_urad", "aX_urad", "aY_urad", "aZ_urad", "dX_um",
                                          "dY_um", "dZ_um", "gX_um_per_m", "gY_um_per_m", "gZ_um_per_m"});
  }
}

TEST_F(Touches, WrongListsAreRefusedInOneSentence) {
  make("hole_bar");
  const std::string good = textOf(list);
  const auto wrong = [&](std::size_t line, const std::string& column, const std::string& value,
                         std::vector<std::string> parts) {
    writeText(list, good);
    setField(list, line, column, value);
    parts.insert(parts.end(), {"touches.csv", "line " + std::to_string(line), "allowed"});
    expectRefused(parts);
  };
  wrong(6, "artefact", "bar_of_gold", {"bar_of_gold", "hole_bar"});
  wrong(7, "feature", "H99", {"H99", "H1"});
  wrong(8, "stylus", "p9", {"p9", "p0"});
  wrong(9, "time_s", "-5", {"backwards"});
  wrong(10, "x_mm", "nan", {"nan"});
  wrong(11, "touch", "1.5", {"1.5"});
  wrong(12, "cycle", "", {"cycle"});
  writeText(list, good);
  setField(list, 5, "nx", "0");
  setField(list, 5, "ny", "0");
  setField(list, 5, "nz", "0");
  expectRefused({"touches.csv", "line 5", "(0, 0, 0)", "unit vector"});
  writeText(list, good);
  auto lines = linesOf(list);
  const std::string time = lines[3].substr(0, lines[3].find(','));
  setField(list, 5, "time_s", time);
  expectRefused({"touches.csv", "line 5", time, "twice"});
  writeText(list, good);
  setField(list, 5, "y_mm", "1,5");
  expectRefused({"touches.csv", "line 5", "decimal comma"});
  writeText(list, good);
  edit(list, "stylus", "tool");
  expectRefused({"touches.csv", "stylus", "missing"});
  writeText(list, lines.front() + "\n");
  expectRefused({"touches.csv", "no touches"});
}

TEST_F(Touches, InchesAreDetected) {
  make("hole_bar");
  const auto lines = linesOf(list);
  std::vector<std::string> inches = {lines.front()};
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::vector<std::string> f(1);
    for (const char c : lines[i]) {
      if (c == ',') {
        f.emplace_back();
      } else {
        f.back() += c;
      }
    }
    for (std::size_t k = 7; k < 10; ++k) f[k] = std::to_string(std::stod(f[k]) / 25.4);
    std::string line;
    for (std::size_t k = 0; k < f.size(); ++k) line += (k > 0 ? "," : "") + f[k];
    inches.push_back(line);
  }
  writeLines(list, inches);
  expectRefused({"touches.csv", "inches", "millimetres"});
}

TEST_F(Touches, MissingAndStrayTouchesAreListedAndTheRestIsEvaluated) {
  make("hole_bar");
  auto lines = linesOf(list);
  lines.erase(lines.begin() + 100, lines.begin() + 104);
  writeLines(list, lines);
  setField(list, 60, "x_mm", "12.5");
  const nlohmann::json j = jsonOf({"evaluate", campaign, "--out", out});
  EXPECT_GE(j["cycles"].size(), 2U);
  ASSERT_FALSE(j["rejected"].empty());
  const auto named = [](const nlohmann::json& r) {
    return r["capture"].get<std::string>().find("line 60") != std::string::npos &&
           !r["reason"].get<std::string>().empty();
  };
  EXPECT_TRUE(std::any_of(j["rejected"].begin(), j["rejected"].end(), named)) << j["rejected"].dump();
}

TEST_F(Touches, AWrongListEndsTheEvaluationBeforeAnotherInstrumentIsLookedAt) {
  make("hole_bar");
  writeText(folder / "campaign/captures/scans.csv", "time_s,cycle,artefact,y_mm\n0,C0,A1,350\n");
  expectRefused({"scans.csv", "cloud", "missing"});
  writeText(folder / "campaign/captures/scans.csv", "");
  expectRefused({"scans.csv", "empty"});
}

TEST_F(Touches, CycleIsWrittenAndItsPrintedTextIsImported) {
  make("hole_bar");
  const std::string machine = campaign + "/machine.json";
  const std::string nc = (folder / "cycle.nc").string();
  const std::string pattern = (folder / "template.json").string();
  const nlohmann::json j = jsonOf({"cycle", machine, "--nc", nc, "--template", pattern});
  EXPECT_TRUE(j["good"].get<bool>());
  EXPECT_GT(j["touches"].get<int>(), 20);
  EXPECT_NE(textOf(nc), "");
  const std::string printed = folder.write("printed.txt", "nothing that a probe would print\n").string();
  const std::string touches = (folder / "touches.csv").string();
  expectBadInput({"import-touches", printed, "--machine", machine, "--template", pattern, "--out", touches},
                 {"printed.txt"});
  EXPECT_FALSE(std::filesystem::exists(touches));
  expectBadInput({"cycle", machine, "--artefact", "none", "--nc", (folder / "n.nc").string()},
                 {"machine.json", "none"});
  EXPECT_FALSE(std::filesystem::exists(folder / "n.nc"));
}

}  // namespace
}  // namespace spindrift::testing
