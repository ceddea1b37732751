// SPDX-License-Identifier: GPL-3.0-or-later
// decode, and evaluate of fiducial images that the virtual microscope made.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "core/base/job_context.h"
#include "core/imaging/pattern.h"
#include "core/machine/observation.h"
#include "core/simulation/virtual_fiducials.h"
#include "tests/app/cli/child_process.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

class Images : public ::testing::Test {
 public:
  static void SetUpTestSuite() {
    folder() = std::make_unique<TempFolder>();
    VirtualFiducialOptions options;
    options.width_px = 800;
    options.height_px = 600;
    options.cor_px = {402.0, 305.0};
    options.pixel_length_um = 1.6;
    options.steps_mm = {-0.1016, 0.0, 0.1016};
    options.fiducials = {{"F1", {20.0, 15.0}, 0.02, {1400.0, 1400.0}}};
    options.states = {{"M0", 0.0, {{0, 0, 0}}}, {"M1", 600.0, {{5.0, -3.0, 4.0}}}};
    JobContext job;
    writeVirtualFiducialCampaign(*folder() / "campaign", standardPattern(), options, 4, job);
  }
  static void TearDownTestSuite() { folder().reset(); }

 protected:
  static std::unique_ptr<TempFolder>& folder() {
    static std::unique_ptr<TempFolder> kept;
    return kept;
  }
  static std::filesystem::path campaign() { return *folder() / "campaign"; }
  static std::filesystem::path copy() {
    copyCampaign(campaign(), *folder() / "copy");
    return *folder() / "copy";
  }
  static std::filesystem::path firstImage(const std::filesystem::path& from) {
    const std::string line = linesOf(from / "captures/fiducials.csv")[1];
    return from / line.substr(line.rfind(',') + 1);
  }
};

TEST_F(Images, DecodeGivesTheKeysOfTheContract) {
  const nlohmann::json j = jsonOf({"decode", firstImage(campaign()).string()});
  EXPECT_NEAR(j["pixel_length_um"].get<double>(), 1.6, 0.01);
  EXPECT_TRUE(j["elapsed_ms"].is_number());
  ASSERT_FALSE(j["subpatterns"].empty());
  for (const auto& s : j["subpatterns"]) {
    EXPECT_TRUE(s["row"].get<int>() >= 11 && s["row"].get<int>() <= 19);
    EXPECT_TRUE(s["column"].get<int>() >= 11 && s["column"].get<int>() <= 19);
    for (const char* key : {"x_px", "y_px", "sigma_px", "tilt_rad", "score"}) EXPECT_TRUE(s[key].is_number()) << key;
  }
}

TEST_F(Images, WhatShowsNoPatternEndsWithOne) {
  std::string black = "P5\n640 480\n255\n";
  black.append(640U * 480U, '\0');
  const auto image = folder()->write("black.pgm", black);
  const nlohmann::json j = jsonOf({"decode", image.string()}, 1);
  EXPECT_TRUE(j["subpatterns"].empty());
  EXPECT_NE(j.dump().find("reason"), std::string::npos) << j.dump();
  const auto text = folder()->write("text.jpg", "this is not an image");
  expectBadInput({"decode", text.string()}, {"text.jpg", "JPEG"});
  expectBadInput({"decode", image.string(), "--pattern", text.string()}, {"text.jpg"});
}

TEST_F(Images, EvaluateListsBadImagesAndEvaluatesTheRest) {
  const auto c = copy();
  const std::string jpeg = textOf(firstImage(c));
  const std::string line = linesOf(c / "captures/fiducials.csv").back();
  const std::filesystem::path last = c / line.substr(line.rfind(',') + 1);
  writeText(last, "not an image");
  const auto before = contentOf(c);
  const std::string out = (*folder() / "o.csv").string();
  const nlohmann::json j = jsonOf({"evaluate", c.string(), "--out", out});
  ASSERT_FALSE(j["rejected"].empty());
  EXPECT_NE(j["rejected"].dump().find(last.filename().string()), std::string::npos) << j["rejected"].dump();
  for (const auto& r : j["rejected"]) EXPECT_FALSE(r["reason"].get<std::string>().empty());
  EXPECT_GT(linesOf(out).size(), 1U);
  EXPECT_EQ(contentOf(c), before);
}

TEST_F(Images, CheckFindsWhatContradictsTheList) {
  EXPECT_EQ(jsonOf({"check", campaign().string()})["to_take_again"], 0);
  const auto c = copy();
  // The spindle did not turn between the first two images.
  const std::vector<std::string> lines = linesOf(c / "captures/fiducials.csv");
  const auto image = [&](std::size_t line) { return lines[line].substr(lines[line].rfind(',') + 1); };
  writeText(c / image(2), textOf(c / image(1)));
  const nlohmann::json j = jsonOf({"check", c.string()}, 1);
  EXPECT_EQ(j["to_take_again"], 1);
  for (const auto& capture : j["captures"]) EXPECT_EQ(capture["good"], capture["image"] != image(2)) << capture;
  const Outcome outcome = runCli({"check", c.string()});
  EXPECT_NE(outcome.output.find("turned by 0°, the list says 8°"), std::string::npos) << outcome.output;
  EXPECT_EQ(jsonOf({"check", c.string(), "--exclude", image(2)})["to_take_again"], 0);
}

TEST_F(Images, ObservationsOfAnotherMachineAreSaid) {
  const std::string out = (*folder() / "own.csv").string();
  ASSERT_EQ(runCli({"evaluate", campaign().string(), "--out", out}).status, 0);
  const auto fit = [&](const std::string& file) {
    return runCli({"fit", campaign().string(), "--observations", file, "--state", "M1"}).output;
  };
  EXPECT_EQ(fit(out).find("travel of this machine"), std::string::npos);
  auto lines = linesOf(out);
  for (std::size_t i = 2; i <= lines.size(); ++i) setField(out, i, "x_mm", "2000");
  const std::string answer = fit(out);
  EXPECT_NE(answer.find("far outside the travel of this machine (x of point F1 is 2000 mm"), std::string::npos)
      << answer;
}

/// From the scenario to the deviations: the campaign carries its own artwork, and nothing else decodes its images.
TEST(OwnPattern, IsSimulatedDecodedCheckedAndEvaluated) {
  const TempFolder folder;
  nlohmann::json scenario =
      nlohmann::json::parse(textOf(sourceFolder().string() + "/resources/scenarios/own_pattern.json"));
  scenario["microscope"]["fiducials"] = {"F1", "F3"};
  scenario["microscope"]["steps_mm"] = {-0.1016, 0.0, 0.1016};
  const std::string file = folder.write("scenario.json", scenario.dump()).string();
  const std::filesystem::path campaign = folder / "campaign";
  const std::string truth = (folder / "truth.json").string();
  ASSERT_EQ(runCli({"simulate", file, "--out", campaign.string(), "--truth", truth}).status, 0);
  const FiducialPattern pattern = readPattern(campaign / "pattern.json");
  EXPECT_EQ(pattern.pitch_um, 455.0);
  EXPECT_EQ(pattern.first_row, 31);
  EXPECT_EQ(pattern.rowCount(), 7);

  const std::string line = linesOf(campaign / "captures/fiducials.csv")[1];
  const std::string image = (campaign / line.substr(line.rfind(',') + 1)).string();
  const nlohmann::json decoded = jsonOf({"decode", image, "--pattern", (campaign / "pattern.json").string()});
  ASSERT_FALSE(decoded["subpatterns"].empty());
  EXPECT_GE(decoded["subpatterns"][0]["row"].get<int>(), 31);
  EXPECT_NEAR(decoded["pixel_length_um"].get<double>(), 2.2, 0.02);
  EXPECT_EQ(jsonOf({"check", campaign.string()})["to_take_again"], 0);

  const std::string out = (folder / "observations.csv").string();
  const nlohmann::json evaluated = jsonOf({"evaluate", campaign.string(), "--out", out});
  EXPECT_TRUE(evaluated["rejected"].empty()) << evaluated["rejected"].dump();
  std::map<std::string, double> expected;
  const nlohmann::json captures = nlohmann::json::parse(textOf(truth)).at("captures");
  for (const auto& c : captures) {
    expected[c["state"].get<std::string>() + c["point"].get<std::string>() + c["component"].get<std::string>()] =
        c["value"];
  }
  int compared = 0;
  for (const Observation& o : ObservationSet::read(out).rows) {
    if (o.state == "M0") continue;
    ++compared;
    EXPECT_LT(std::abs(o.value - expected.at(o.state + o.point + std::string(toString(o.component)))),
              5.0 * o.sigma + 0.3)
        << o.point << toString(o.component);
    EXPECT_LT(o.sigma, 3.0);
  }
  EXPECT_EQ(compared, 6);

  std::filesystem::remove(campaign / "pattern.json");
  const Outcome standard = runCli({"evaluate", campaign.string(), "--out", out});
  EXPECT_NE(standard.output.find("this is another pattern"), std::string::npos) << standard.output;

  scenario["microscope"]["pattern"]["first_row"] = 98;
  const std::string wrong = folder.write("wrong.json", scenario.dump()).string();
  expectBadInput({"simulate", wrong, "--out", (folder / "nothing").string()},
                 {"wrong.json", "$.microscope.pattern", "99"});
}

TEST_F(Images, WrongListsAreRefusedInOneSentence) {
  const std::string out = (*folder() / "refused.csv").string();
  const auto wrong = [&](std::size_t line, const std::string& column, const std::string& value,
                         std::vector<std::string> parts) {
    const auto c = copy();
    setField(c / "captures/fiducials.csv", line, column, value);
    parts.insert(parts.end(), {"fiducials.csv", "line " + std::to_string(line), "allowed"});
    expectBadInput({"evaluate", c.string(), "--out", out}, parts);
    EXPECT_FALSE(std::filesystem::exists(out));
  };
  wrong(3, "role", "sideways", {"sideways", "rotation", "focus"});
  wrong(4, "spindle_deg", "NaN", {"NaN"});
  wrong(5, "time_s", "-10", {"backwards"});
  wrong(6, "x_mm", "20,5", {"decimal comma"});
  const auto c = copy();
  edit(c / "captures/fiducials.csv", "spindle_deg", "angle");
  expectBadInput({"evaluate", c.string(), "--out", out}, {"fiducials.csv", "spindle_deg", "missing"});
}

}  // namespace
}  // namespace spindrift::testing
