// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/operating_log.h"

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "tests/support/temp_folder.h"

namespace spindrift {
namespace {

using ::testing::ElementsAre;

TEST(OperatingLog, StatesHoldAndTemperaturesAreInterpolated) {
  const testing::TempFolder folder;
  const auto log = OperatingLog::read(folder.write(
      "log.csv", "time_s,spindle_rpm,T_room_degC,note,extra\n0,1000,20,idle,1\n100,3000,24,run,2\n200,0,22,idle,3\n"));
  EXPECT_DOUBLE_EQ(log.at("spindle_rpm", 99.9), 1000.0);
  EXPECT_DOUBLE_EQ(log.at("spindle_rpm", 100.0), 3000.0);
  EXPECT_DOUBLE_EQ(log.at("T_room_degC", 50.0), 22.0);
  EXPECT_DOUBLE_EQ(log.at("T_room_degC", -10.0), 20.0);
  EXPECT_DOUBLE_EQ(log.at("T_room_degC", 1e6), 22.0);
  EXPECT_THAT(log.names(), ElementsAre("spindle_rpm", "T_room_degC", "extra"));
  EXPECT_THAT(log.temperatureNames(), ElementsAre("T_room_degC"));
}

TEST(OperatingLog, GapsAreFilledByTheRuleOfTheSignal) {
  const testing::TempFolder folder;
  const auto log = OperatingLog::read(
      folder.write("log.csv", "time_s,spindle_rpm,T_room_degC\n0,,\n10,500,20\n20,,\n40,,26\n50,0,\n"));
  EXPECT_THAT(*log.signal("spindle_rpm"), ElementsAre(500, 500, 500, 500, 0));
  EXPECT_THAT(*log.signal("T_room_degC"), ElementsAre(20, 20, 22, 26, 26));
}

TEST(OperatingLog, ExtraColumnsOfAnyContentNeverMakeItUnreadable) {
  const testing::TempFolder folder;
  const auto log = OperatingLog::read(folder.write("log.csv",
                                                   "time_s,alarm,spindle_rpm,program,load\n0,0,1000,\"O1, a\",1\n"
                                                   "1,E-stop,2000,7,\n2,nan,0,inf,1e999\n3,,0,-,2\n"));
  EXPECT_THAT(log.names(), ElementsAre("spindle_rpm"));
  EXPECT_THAT(*log.signal("spindle_rpm"), ElementsAre(1000, 2000, 0, 0));
}

TEST(OperatingLog, BadInputIsNamed) {
  const testing::TempFolder folder;
  const auto complaint = [&](const char* text) -> std::string {
    try {
      (void)OperatingLog::read(folder.write("log.csv", text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(complaint("spindle_rpm\n1\n"), ::testing::HasSubstr("\"time_s\" is missing"));
  EXPECT_THAT(complaint("time_s,spindle_rpm\n0,1\n-1,1\n"), ::testing::HasSubstr("line 3, column time_s"));
  EXPECT_THAT(complaint("time_s,T_a_degC\n0,nan\n"), ::testing::HasSubstr("column T_a_degC"));
  EXPECT_THAT(complaint("time_s,spindle_rpm\n0,1\n1,oops\n"), ::testing::HasSubstr("\"oops\""));
  EXPECT_THAT(complaint("time_s\n"), ::testing::HasSubstr("no rows"));
}

}  // namespace
}  // namespace spindrift
