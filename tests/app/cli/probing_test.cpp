// SPDX-License-Identifier: GPL-3.0-or-later
// evaluate of touches, cycle and import-touches, on campaigns of the virtual machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "tests/app/cli/child_process.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

class Touches : public ::testing::Test {
 protected:
  void make(const std::string& name) {
    const Outcome made =
        runCli({"simulate", sourceFolder().string() + "/resources/scenarios/" + name + ".json", "--out", campaign});
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

TEST_F(Touches, SwappedColumnsAreNotGoodEnough) {
  make("hole_bar");
  auto lines = linesOf(list);
  std::string header = lines.front();
  const auto at = header.find("x_mm,y_mm");
  ASSERT_NE(at, std::string::npos);
  lines.front() = header.replace(at, 9, "y_mm,x_mm");
  writeLines(list, lines);
  const Outcome outcome = runCli({"evaluate", campaign, "--out", out});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.output.find("x_mm and y_mm swapped"), std::string::npos) << outcome.output;
  EXPECT_LT(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 80) << "one line for every reject";
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
  expectRefused({"touches.csv", "line 5", time, "duplicate"});
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
  for (const char* control : {"siemens", "heidenhain"}) {
    const std::string file = (folder / control / "cycle.nc").string();
    std::filesystem::create_directories(folder / control);
    const nlohmann::json other = jsonOf({"cycle", machine, "--control", control, "--nc", file});
    EXPECT_TRUE(other["good"].get<bool>()) << control;
    EXPECT_EQ(other["touches"], j["touches"]) << control;
    EXPECT_EQ(other["moves"], j["moves"]) << control;
    EXPECT_EQ(std::filesystem::exists(folder / control / "TOUCH.A"), std::string(control) == "heidenhain");
  }
  const std::string printed = folder.write("printed.txt", "nothing that a probe would print\n").string();
  const std::string touches = (folder / "touches.csv").string();
  expectBadInput({"import-touches", printed, "--machine", machine, "--template", pattern, "--out", touches},
                 {"printed.txt"});
  EXPECT_FALSE(std::filesystem::exists(touches));
  expectBadInput({"cycle", machine, "--artefact", "none", "--nc", (folder / "n.nc").string()},
                 {"machine.json", "none"});
  EXPECT_FALSE(std::filesystem::exists(folder / "n.nc"));
}

/// The control prints what the virtual probe measured; what is read back must evaluate to the same parameters.
TEST_F(Touches, WhatAControlPrintsIsImportedAndEvaluatesToTheSame) {
  make("hole_bar");
  const std::string machine = campaign + "/machine.json";
  const std::string pattern = (folder / "template.json").string();
  ASSERT_EQ(runCli({"cycle", machine, "--nc", (folder / "cycle.nc").string(), "--template", pattern}).status, 0);
  const nlohmann::json direct = jsonOf({"evaluate", campaign, "--out", out});
  const std::vector<std::string> rows = linesOf(list);
  std::vector<std::string> printed;
  std::string last_cycle;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    std::vector<std::string> f;
    for (std::size_t from = 0; from <= rows[k].size();) {
      const std::size_t comma = std::min(rows[k].find(',', from), rows[k].size());
      f.push_back(rows[k].substr(from, comma - from));
      from = comma + 1;
    }
    ASSERT_EQ(f.size(), 13U) << rows[k];
    if (f[1] != last_cycle) {
      printed.push_back("CYCLE " + f[1].substr(1));
      printed.push_back("PROBE BATTERY OK");
    }
    last_cycle = f[1];
    // Spindle reference = stylus centre minus the offset of the stylus (0, 0, -50).
    char z[32];
    std::snprintf(z, sizeof z, "%.6f", std::stod(f[9]) + 50.0);
    char milliseconds[32];
    std::snprintf(milliseconds, sizeof milliseconds, "%.0f", 1000.0 * std::stod(f[0]));
    printed.push_back("T A" + f[3].substr(1) + " B1 C" + f[5] + " D" + f[6] + " X" + f[7] + " Y" + f[8] + " Z" + z +
                      " I" + f[10] + " J" + f[11] + " K" + f[12] + " S" + milliseconds);
  }
  const auto text = folder / "printed.txt";
  writeLines(text, printed);
  const std::string touches = (folder / "touches.csv").string();
  const std::vector<std::string> import = {"import-touches", text.string(), "--machine", machine,
                                           "--template",     pattern,       "--out",     touches};
  const nlohmann::json imported = jsonOf(import);
  EXPECT_EQ(imported["touches"], rows.size() - 1);
  EXPECT_EQ(imported["cycles"].size(), direct["cycles"].size());
  EXPECT_EQ(imported["ignored_lines"], direct["cycles"].size());
  std::filesystem::copy_file(touches, list, std::filesystem::copy_options::overwrite_existing);
  const nlohmann::json again = jsonOf({"evaluate", campaign, "--out", out});
  for (std::size_t k = 0; k < direct["cycles"].size(); ++k) {
    for (const auto& [name, value] : direct["cycles"][k]["parameters"].items())
      EXPECT_NEAR(again["cycles"][k]["parameters"][name]["value"].get<double>(), value["value"].get<double>(), 1e-3)
          << name;
  }
  // A line with a word where a number belongs, and a feature that the template does not know.
  std::filesystem::remove(touches);
  const std::string good = textOf(text);
  edit(text, " X1", " Xq");
  expectBadInput(import, {"printed.txt", "line"});
  writeText(text, good);
  edit(text, "T A1 ", "T A9 ");
  expectBadInput(import, {"printed.txt", "9"});
  EXPECT_FALSE(std::filesystem::exists(touches));
}

TEST_F(Touches, CyclesAreComparedWithAReferenceInstrument) {
  make("hole_bar");
  const nlohmann::json cycles = jsonOf({"evaluate", campaign, "--out", out})["cycles"];
  // The reference sees the same course, 40 um/m higher (another zero), and 5 um/m more in the last cycle.
  const auto reference = folder / "grid.csv";
  std::map<std::string, double> time;
  for (const std::string& row : linesOf(list)) {
    if (row.starts_with("time_s")) continue;
    const std::size_t comma = row.find(',');
    const std::string cycle = row.substr(comma + 1, row.find(',', comma + 1) - comma - 1);
    time.emplace(cycle, std::stod(row.substr(0, comma)));
  }
  const auto write = [&](double last) {
    std::vector<std::string> lines = {"time_s,value,sigma"};
    for (std::size_t k = 0; k < cycles.size(); ++k) {
      const double value =
          cycles[k]["parameters"]["EXX_um_per_m"]["value"].get<double>() + 40.0 + (k + 1 == cycles.size() ? last : 0.0);
      const double start = time.at(cycles[k]["cycle"]);
      lines.push_back(std::to_string(start) + ',' + std::to_string(value) + ",0.1");
      lines.push_back(std::to_string(start + 200.0) + ',' + std::to_string(value) + ",0.1");
    }
    writeLines(reference, lines);
  };
  const std::vector<std::string> compare = {"compare-reference", campaign,      "--reference",
                                            reference.string(),  "--parameter", "EXX_um_per_m"};
  write(0.0);
  const nlohmann::json same = jsonOf(compare);
  EXPECT_EQ(same["points"].size(), cycles.size());
  EXPECT_NEAR(same["offset"].get<double>(), -40.0, 1e-3);
  EXPECT_LT(same["rms"].get<double>(), 1e-3);
  EXPECT_EQ(same["within_two_sigma"], 1.0);
  EXPECT_NEAR(same["slope"].get<double>(), 1.0, 1e-3);
  write(25.0);
  const nlohmann::json other = jsonOf(compare, 1);
  EXPECT_EQ(other["agrees"], false);
  EXPECT_LT(other["within_two_sigma"].get<double>(), 1.0);
  EXPECT_GT(other["largest"].get<double>(), 15.0);
  auto words = compare;
  words.back() = "EYY";
  expectBadInput(words, {"EYY", "EXX_um_per_m"});
  setField(reference, 4, "time_s", "-5");
  expectBadInput(compare, {"grid.csv", "line 4", "backwards"});
  writeText(reference, "time_s,value\n1e7,1\n2e7,1\n");
  EXPECT_EQ(jsonOf(compare, 1)["status"], "degenerate");
}

}  // namespace
}  // namespace spindrift::testing
