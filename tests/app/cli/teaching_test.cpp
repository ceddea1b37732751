// SPDX-License-Identifier: GPL-3.0-or-later
// What if and the exercise, as a user calls them.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/app/cli/child_process.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

TEST(Teaching, WhatIfAnswersAndRefuses) {
  const TempFolder folder;
  const std::string picture = (folder / "part.png").string();
  const Outcome done =
      runCli({"what-if", "--set", "EC0Y_urad=20", "--set", "EXX_um_per_m=50", "--png", picture, "--json", "-"});
  ASSERT_EQ(done.status, 0) << done.error;
  const nlohmann::json json = nlohmann::json::parse(done.output);
  EXPECT_EQ(json.at("parameters").size(), 2U);
  double squareness = 0.0, size_x = 0.0;
  for (const nlohmann::json& c : json.at("part").at("characteristics")) {
    if (c.at("characteristic") == "squareness") squareness = c.at("value");
    if (c.at("characteristic") == "size_x") size_x = c.at("value");
  }
  EXPECT_NEAR(squareness, 20.0, 1e-6);
  EXPECT_NEAR(size_x, 16.0, 1e-6);
  EXPECT_GT(std::filesystem::file_size(picture), 5000U);
  EXPECT_NE(runCli({"what-if", "--list"}).output.find("EC0Y_urad"), std::string::npos);
  const Outcome wrong = runCli({"what-if", "--set", "EC0Y=20"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.error.find("EC0Y_urad"), std::string::npos) << wrong.error;
}

TEST(Teaching, AnExerciseIsWrittenListedAndMarked) {
  const TempFolder folder;
  const std::string campaign = (folder / "E").string();
  ASSERT_EQ(runCli({"exercise", "--seed", "5", "--level", "easy", "--out", campaign}).status, 0);
  const Outcome again = runCli({"exercise", "--seed", "5", "--level", "easy", "--out", campaign});
  EXPECT_EQ(again.status, 2);
  const Outcome list = runCli({"exercise", campaign, "--json", "-"});
  ASSERT_EQ(list.status, 0) << list.error;
  const nlohmann::json choices = nlohmann::json::parse(list.output).at("choices");
  EXPECT_GT(choices.size(), 20U);
  // Nobody knows the answer here: whoever names all effects one by one finds it, and each wrong name is told.
  const Outcome marked = runCli({"exercise", campaign, "--answer", "ambient.drift.x", "--hints", "1", "--json", "-"});
  ASSERT_TRUE(marked.status == 0 || marked.status == 1) << marked.error;
  const nlohmann::json score = nlohmann::json::parse(marked.output);
  const std::string hidden = score.at("effects")[0].at("id");
  EXPECT_EQ(score.at("hints").size(), 1U);
  const nlohmann::json drivers = score.at("effects")[0].at("drivers");
  const std::string number = hidden + ":" + (drivers.empty() ? "" : drivers[0].get<std::string>()) + ":" +
                             std::to_string(score.at("effects")[0].at("size").get<double>());
  ASSERT_EQ(score.at("effects")[0].at("unit"), "um");
  const std::string right = number + "um";
  const Outcome other_unit = runCli({"exercise", campaign, "--answer", number + "urad"});
  EXPECT_EQ(other_unit.status, 2);
  EXPECT_NE(other_unit.error.find("µm"), std::string::npos) << other_unit.error;
  EXPECT_EQ(runCli({"exercise", campaign, "--answer", number}).status, 2);
  const Outcome perfect = runCli({"exercise", campaign, "--answer", right, "--json", "-"});
  EXPECT_EQ(perfect.status, 0);
  EXPECT_EQ(nlohmann::json::parse(perfect.output).at("score"), 100);
  EXPECT_EQ(runCli({"exercise", "--answer", right}).status, 2);
  EXPECT_EQ(runCli({"exercise", folder.path().string()}).status, 2);
  EXPECT_EQ(runCli({"exercise"}).status, 2);
}

}  // namespace
}  // namespace spindrift::testing
