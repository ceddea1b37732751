// SPDX-License-Identifier: GPL-3.0-or-later
// plan and watch: capturing without a window, from images that the virtual microscope made.
#include <gtest/gtest.h>

#include "core/base/job_context.h"
#include "core/imaging/pattern.h"
#include "core/session/session.h"
#include "core/simulation/virtual_fiducials.h"
#include "tests/app/cli/child_process.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

TEST(Capture, APlannedCampaignIsTakenInFromAFolder) {
  const TempFolder folder;
  VirtualFiducialOptions options;
  options.width_px = 800;
  options.height_px = 600;
  options.cor_px = {402.0, 305.0};
  options.pixel_length_um = 1.6;
  options.rotations_deg = {0.0, 90.0, 180.0};  // as planned
  options.steps_mm = {-0.1016, 0.0, 0.1016};
  options.fiducials = {{"F1", {20.0, 15.0}, 0.02, {1400.0, 1400.0}}};
  options.states = {{"M0", 0.0, {{0, 0, 0}}}};
  JobContext job;
  writeVirtualFiducialCampaign(folder / "source", standardPattern(), options, 4, job);
  const std::string machine = (folder / "source/machine.json").string(), plan = (folder / "plan.json").string();

  const nlohmann::json planned = jsonOf({"plan", machine, "--kind", "image", "--states", "1", "--out", plan});
  EXPECT_EQ(planned["format"], "spindrift-plan");
  ASSERT_GT(planned["items"].size(), 10U);
  EXPECT_EQ(planned["items"][0]["id"], "M0_F1_rotation_0");

  // Two pictures named after items of the plan, one that is cut short, one that came twice.
  const auto lines = linesOf(folder / "source/captures/fiducials.csv");
  const auto image = [&](std::size_t line) {
    return folder / "source" / lines[line].substr(lines[line].rfind(',') + 1);
  };
  std::filesystem::create_directories(folder / "in");
  std::filesystem::copy_file(image(1), folder / ("in/M0_F1_rotation_0" + image(1).extension().string()));
  std::filesystem::copy_file(image(2), folder / ("in/M0_F1_rotation_1" + image(2).extension().string()));
  std::filesystem::copy_file(image(1), folder / ("in/zz" + image(1).extension().string()));
  const std::string whole = textOf(image(3));
  writeText(folder / ("in/M0_F1_rotation_2" + image(3).extension().string()), whole.substr(0, whole.size() / 2));

  const std::vector<std::string> command{
      "watch", (folder / "in").string(), "--session", (folder / "session").string(), "--plan", plan, "--settle",
      "0.1",   "--until-idle",           "1"};
  std::vector<std::string> first = command;
  first.insert(first.end(), {"--machine", machine});
  const nlohmann::json taken = jsonOf(first, 1);
  ASSERT_EQ(taken["items"].size(), 4U);
  std::map<std::string, std::string> states;
  for (const auto& item : taken["items"]) states[item["name"].get<std::string>().substr(0, 16)] = item["state"];
  EXPECT_EQ(states["M0_F1_rotation_0"], "accepted");
  EXPECT_EQ(states["M0_F1_rotation_1"], "accepted");
  EXPECT_EQ(states["M0_F1_rotation_2"], "take again");
  EXPECT_EQ(taken["plan"]["captured"], 2);
  ASSERT_EQ(taken["retakes"].size(), 1U);
  // The picture is taken again; what is there already is not taken twice.
  writeText(folder / ("in/M0_F1_rotation_2" + image(3).extension().string()), whole);
  const nlohmann::json again = jsonOf(command, 1);
  EXPECT_EQ(again["plan"]["captured"], 3);
  EXPECT_TRUE(again["retakes"].empty());
  // Rotation 3 is planned at 270 deg: another image of 180 deg contradicts it.
  const std::string wrong = "in/M0_F1_rotation_3" + image(3).extension().string();
  writeText(folder / wrong, textOf(image(3)) + " ");
  const nlohmann::json contradicted = jsonOf(command, 1);
  ASSERT_EQ(contradicted["retakes"].size(), 1U);
  EXPECT_NE(contradicted["retakes"][0].get<std::string>().find("turned by 180°, the plan says 270°"), std::string::npos)
      << contradicted["retakes"][0];
  const Session session = Session::open(folder / "session");
  ASSERT_EQ(session.campaigns().size(), 1U);
  EXPECT_EQ(linesOf(session.campaigns()[0].folder / "captures/fiducials.csv").size(), 4U);
}

TEST(Capture, ANameThatIsNoUtf8IsWrittenWithItsBytes) {
  const TempFolder folder;
  const std::string machine = folder
                                  .write("machine.json", R"({"format":"spindrift-machine","version":1,"name":"mill",
"chain":"V [w-X'-Y'-b-Z-t]","axes":[{"name":"X","travel_mm":[0,300]}]})")
                                  .string();
  folder.write(
      "in/Pr\xFC"
      "fling.docx",
      "no capture");
  const nlohmann::json taken = jsonOf({"watch", (folder / "in").string(), "--session", (folder / "s").string(),
                                       "--machine", machine, "--settle", "0.1", "--until-idle", "0.5"});
  ASSERT_EQ(taken["items"].size(), 1U);
  EXPECT_EQ(taken["items"][0]["name"],
            "Pr\\xFC"
            "fling.docx");
  EXPECT_EQ(taken["items"][0]["state"], "left aside");
}

TEST(Capture, WhatCannotBeWatchedIsOneSentence) {
  const TempFolder folder;
  std::filesystem::create_directories(folder / "in");
  expectBadInput({"watch", (folder / "none").string(), "--session", (folder / "s").string()}, {"is not a folder"});
  expectBadInput({"watch", (folder / "in").string(), "--session", (folder / "s").string()}, {"is not a session"});
  EXPECT_FALSE(std::filesystem::exists(folder / "s")) << "nothing is left behind";
  expectBadInput({"watch", (folder / "in").string(), "--session", (folder / "in").string(), "--machine",
                  (folder / "none.json").string()},
                 {"none.json"});
  expectBadInput({"plan", (folder / "none.json").string()}, {"none.json"});
}

}  // namespace
}  // namespace spindrift::testing
