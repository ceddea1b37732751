// SPDX-License-Identifier: GPL-3.0-or-later
// What the commands print for people is written as people write it: true minus, no signed zero, powers of ten, arrows
// and units as signs, no names of files' columns. (JSON and files have their own form.)
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <memory>
#include <regex>
#include <set>

#include "tests/app/cli/child_process.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

/// What of a text is written as files write it, each with what stands around it.
std::vector<std::string> misspelt(const std::string& text) {
  static const std::array<std::regex, 7> wrong{std::regex(R"((^|[\s(\[])[-+]?-\d)"),          // hyphen as minus
                                               std::regex(R"([-+−]0(\.0+)?(?![.\d]))"),       // signed zero
                                               std::regex(R"(->|<-|>=|<=)"),                  // signs made of two
                                               std::regex(R"(\d[eE][-+]?\d)"),                // powers of ten
                                               std::regex(R"(\d ?deg\b)"),                    // degrees
                                               std::regex(R"((^|[\s(/])(um|urad|degC)\b)"),   // units of files
                                               std::regex(R"(\b\w+_(um_per_m|um|urad)\b)")};  // columns
  std::vector<std::string> found;
  for (const std::regex& pattern : wrong) {
    for (std::sregex_iterator i(text.begin(), text.end(), pattern), none; i != none; ++i) {
      const auto from = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, i->position() - 30));
      found.push_back(text.substr(from, 70));
    }
  }
  return found;
}

TEST(PrintedTextCheck, WhatIsMisspeltIsFound) {
  for (const char* bad : {"x -0.25 µm", "(-3 µm)", "by +0.000", "by -0.0", "0.3 -> 0.2", "p < 1e-12", "2.5e+06 points",
                          "-14.2 deg", "3 um", "(urad)", "EXX_um_per_m by 3"})
    EXPECT_FALSE(misspelt(bad).empty()) << bad;
  for (const char* good : {"x −0.25 µm", "M0-M3", "ISO 230-1", "+0.5 µm", "0.3 → 0.2", "p < 10⁻¹²", "−14.2°", "3 µm",
                           "EXX −1.000 µm/m", "LinuxCNC 1:2-3", "−0.05"})
    EXPECT_TRUE(misspelt(good).empty()) << good;
}

class PrintedText : public ::testing::Test {
 protected:
  std::string demo(const std::string& scenario) {
    const std::string made = (folder / scenario).string();
    const Outcome outcome =
        runCli({"simulate", sourceFolder().string() + "/resources/scenarios/" + scenario + ".json", "--out", made});
    EXPECT_EQ(outcome.status, 0) << outcome.error;
    expectWellSpelt({"simulate", scenario}, outcome);
    return made;
  }
  /// Status 0 or 1: a result that does not meet its criterion is printed too.
  void expectWellPrinted(const std::vector<std::string>& arguments) {
    const Outcome outcome = runCli(arguments);
    EXPECT_TRUE(outcome.status == 0 || outcome.status == 1) << arguments.front() << ": " << outcome.error;
    EXPECT_FALSE(outcome.output.empty()) << arguments.front();
    expectWellSpelt(arguments, outcome);
  }
  void expectWellRefused(const std::vector<std::string>& arguments) {
    const Outcome outcome = runCli(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments.front();
    EXPECT_TRUE(outcome.error.ends_with(".\n")) << outcome.error;
    EXPECT_EQ(outcome.error.find('{'), std::string::npos) << outcome.error;
    expectWellSpelt(arguments, outcome);
  }
  TempFolder folder;

 private:
  void expectWellSpelt(const std::vector<std::string>& arguments, const Outcome& outcome) {
    std::string text = outcome.output + outcome.error;
    for (std::size_t at = text.find(folder.path().string()); at != std::string::npos;
         at = text.find(folder.path().string()))
      text.erase(at, folder.path().string().size());
    for (const std::string& words : misspelt(text)) ADD_FAILURE() << arguments.front() << ": " << words;
  }
};

TEST_F(PrintedText, OfProbingCommands) {
  const std::string bar = demo("hole_bar");
  const std::string observed = (folder / "observed.csv").string();
  expectWellPrinted({"evaluate", bar, "--out", observed});
  expectWellPrinted({"second-axis", bar});
  expectWellPrinted({"second-axis", bar, "--stable-growth", "0"});
  expectWellPrinted({"repeatability-study", bar});
  expectWellPrinted({"cycle", bar + "/machine.json"});
  expectWellPrinted({"sensor-groups", bar + "/log.csv"});
  expectWellPrinted({"thermal", "clusters", bar + "/log.csv"});
  const std::string record = folder.write("grid.csv", "time_s,value\n0,-1\n20000,5\n200000,9\n").string();
  expectWellPrinted({"compare-reference", bar, "--reference", record, "--parameter", "EXX_um_per_m"});
  expectWellPrinted({"evaluate", demo("ball_artefact")});
}

TEST_F(PrintedText, OfFiducialAndScanCommands) {
  const std::string fiducials = demo("fiducials_small");
  expectWellPrinted({"evaluate", fiducials});
  expectWellPrinted({"check", fiducials});
  const std::set<std::string> images{".jpg", ".png", ".pgm", ".tif", ".tiff"};
  std::string image;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(fiducials))
    if (images.contains(entry.path().extension().string()) && (image.empty() || entry.path().string() < image))
      image = entry.path().string();
  expectWellPrinted({"decode", image});
  const std::string scans = demo("scans");
  expectWellPrinted({"evaluate", scans});
  expectWellPrinted({"study-calibration", scans, "--trials", "20"});
  expectWellPrinted({"design-artefact"});
}

TEST_F(PrintedText, OfModelsAndDiscrepancy) {
  const std::string campaign = demo("discrepancy_vertical");
  expectWellPrinted({"fit", campaign});
  expectWellPrinted({"heatmap", campaign});
  expectWellPrinted({"compare", campaign, "--with", "F1,F2,F4"});
  expectWellPrinted({"placement", campaign});
  expectWellPrinted({"compensate", campaign});
  expectWellPrinted({"warm-up", campaign});
  expectWellPrinted({"discrepancy", campaign});
  expectWellPrinted({"effects", campaign});
  // The unit of a model of a temperature is that of a temperature.
  const std::vector<std::string> identify = {"thermal",  "identify",       campaign + "/log.csv",
                                             "--output", "T_spindle_degC", "--train",
                                             "0:18000",  "--test",         "18000:28000"};
  expectWellPrinted(identify);
  const std::string said = runCli(identify).output;
  EXPECT_NE(said.find(" °C"), std::string::npos) << said;
  EXPECT_EQ(said.find("µm"), std::string::npos) << said;
  expectWellPrinted({"plan", campaign});
}

TEST_F(PrintedText, OfTeaching) {
  expectWellPrinted({"what-if", "--set", "EC0Y_urad=20", "--set", "EZY_um=-3", "--set", "spindle.growth.z=-2"});
  const std::string campaign = (folder / "exercise").string();
  expectWellPrinted({"exercise", "--seed", "5", "--out", campaign});
  expectWellPrinted({"exercise", campaign});
  expectWellPrinted({"exercise", campaign, "--hints", "3"});
}

TEST_F(PrintedText, OfWrongUse) {
  expectWellRefused({"fit"});
  expectWellRefused({"verify", "a"});
  expectWellRefused({"thermal"});
  expectWellRefused({"heatmap", "a", "--component", "EQ"});
  expectWellRefused({"fit", "a", "--unknown"});
  expectWellRefused({"placement", "a", "--count", "abc"});
  expectWellRefused({"cycle", "a", "--program-number", "0"});
  expectWellRefused({"thermal", "track", "a", "--model", "b", "--interval", "0"});
  expectWellRefused({"design-artefact", "--noise", "0"});
  expectWellRefused({"design-artefact", "--points", "1e15"});
}

TEST_F(PrintedText, OfWrongUseSaysWhatIsAllowed) {
  expectBadInput({"heatmap", "a", "--component", "EQ"}, {"--component: EQ is not allowed; allowed: EX, EY or EZ."});
  expectBadInput({"verify", "a"}, {"AFTER is missing"});
  expectBadInput({"cycle", "a", "--program-number", "0"}, {"--program-number: 0", "allowed: 1 to 9999."});
  expectBadInput({"placement", "a", "--count", "abc"}, {"--count: abc", "a whole number"});
  expectBadInput({"design-artefact", "--noise", "0"}, {"allowed: 10⁻⁶ to 10⁶."});
}

}  // namespace
}  // namespace spindrift::testing
