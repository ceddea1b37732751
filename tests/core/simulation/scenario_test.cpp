// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/base/error.h"
#include "tests/support/source_folder.h"

namespace spindrift {
namespace {

using ::testing::HasSubstr;

nlohmann::json good() {
  std::ifstream in(spindrift::testing::sourceFolder() / "resources/scenarios/discrepancy_vertical.json");
  return nlohmann::json::parse(in);
}

Scenario parsed(const nlohmann::json& json) {
  return Scenario::parse(JsonNode::parse(json.dump(), "scenario.json"), "scenario.json");
}

std::string complaint(const nlohmann::json& json) {
  try {
    (void)parsed(json);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Scenario, EveryShippedScenarioIsRead) {
  int count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(spindrift::testing::sourceFolder() / "resources/scenarios")) {
    if (entry.path().extension() != ".json") continue;
    EXPECT_NO_THROW((void)Scenario::read(entry.path())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 9);
}

TEST(Scenario, ComplaintsNameThePlaceAndWhatIsAllowed) {
  nlohmann::json json = good();
  json["format"] = "something-else";
  EXPECT_THAT(complaint(json), HasSubstr("scenario.json"));

  json = good();
  json["duration_s"] = -1;
  EXPECT_THAT(complaint(json), HasSubstr("$.duration_s"));

  json = good();
  json["effects"]["spindle.growht.z"] = {{"size", 1}};
  EXPECT_THAT(complaint(json), HasSubstr("spindle.growht.z"));

  json = good();
  json["effects"]["rotary.drift.x0c"] = {{"size", 1}};
  EXPECT_THAT(complaint(json), HasSubstr("rotary axis"));

  json = good();
  json["simulation"]["effects"].push_back("backlash.x");
  EXPECT_THAT(complaint(json), HasSubstr("an effect of this scenario"));

  json = good();
  json["instrument"]["sigma_um"] = 0;
  EXPECT_THAT(complaint(json), HasSubstr("$.instrument.sigma_um"));

  json = good();
  json["instrument"]["ar1"] = 1.0;
  EXPECT_THAT(complaint(json), HasSubstr("$.instrument.ar1"));

  json = good();
  json["sensors"][0]["place"] = "attic";
  EXPECT_THAT(complaint(json), HasSubstr("column front"));

  json = good();
  json["sensors"][1]["name"] = json["sensors"][0]["name"];
  EXPECT_THAT(complaint(json), HasSubstr("no other sensor"));

  json = good();
  json["measurement"]["points"] = {"F1", "F77"};
  EXPECT_THAT(complaint(json), HasSubstr("F77"));

  json = good();
  json["measurement"]["components"] = {"EQ"};
  EXPECT_THAT(complaint(json), HasSubstr("EX, EY, EZ"));

  json = good();
  json["programme"] = {{"segments", {{{"from_s", 0}}, {{"from_s", 0}}}}};
  EXPECT_THAT(complaint(json), HasSubstr("$.programme.segments[1].from_s"));

  json = good();
  json["effects"]["column.bending.a"] = {{"strength", 4}, {"size", 1}};
  EXPECT_THAT(complaint(json), HasSubstr("either size or strength"));

  json = good();
  json.erase("measurement");
  EXPECT_THAT(complaint(json), HasSubstr("measurement"));
}

TEST(Scenario, ProgrammeSegmentsKeepWhatIsNotSaid) {
  nlohmann::json json = good();
  json["programme"] = {{"segments", {{{"from_s", 0}, {"pos_x_mm", 111}}, {{"from_s", 60}, {"spindle_rpm", 3000}}}}};
  const Scenario scenario = parsed(json);
  ASSERT_TRUE(scenario.programme.has_value());
  EXPECT_EQ(scenario.programme->at(59.0).spindle_rpm, 0.0);
  EXPECT_EQ(scenario.programme->at(61.0).spindle_rpm, 3000.0);
  EXPECT_EQ(scenario.programme->at(61.0).position_mm[0], 111.0);
}

}  // namespace
}  // namespace spindrift
