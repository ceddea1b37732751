// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/connect/column_suggestion.h"

#include <gmock/gmock.h>

namespace spindrift::testing {
namespace {

nlohmann::json suggested(DataItem item, const std::set<std::string>& taken = {}) {
  return suggestColumn(item, "mill", taken);
}

TEST(ColumnSuggestion, UnitsTypesAndNamesTellTheColumn) {
  const nlohmann::json spindle =
      suggested({"T1", "Tspindle", "mill / axes / spindle", "sample", "TEMPERATURE", "CELSIUS", "31.5"});
  EXPECT_EQ(spindle["column"], "T_spindle_degC");
  EXPECT_EQ(spindle["item"], "T1");
  EXPECT_EQ(spindle["source"], "mill");
  EXPECT_EQ(suggested({"T2", "", "", "sample", "TEMPERATURE", "FAHRENHEIT", ""})["column"], "T_2_degC");
  EXPECT_EQ(suggested({"hall/room/temperature#value", "room temperature", "", "", "number", "", "20.1"})["column"],
            "T_room_temperature_degC");
  EXPECT_EQ(suggested({"hall/room/temperature#value", "room temperature", "", "", "number", "", "20.1"})["role"],
            "room");
  EXPECT_EQ(suggested({"S1", "", "", "sample", "SPINDLE_SPEED", "REVOLUTION/MINUTE", "0"})["column"], "spindle_rpm");
  EXPECT_EQ(suggested({"xp", "Xpos", "mill / axes / X", "sample", "POSITION", "MILLIMETER", "0"})["column"],
            "pos_x_mm");
  EXPECT_EQ(suggested({"xf", "Xfrt", "mill / axes / X", "sample", "AXIS_FEEDRATE", "MILLIMETER/SECOND", "0"})["column"],
            "feed_x_mm_min");
  EXPECT_EQ(suggested({"p", "power", "", "sample", "WATTAGE", "WATT", "0"})["column"], "power_W");
  EXPECT_EQ(suggested({"a b,c\"", "", "", "", "", "", ""})["column"], "a_b_c");
}

TEST(ColumnSuggestion, ANameIsTakenOnceOnly) {
  const DataItem item{"T1", "Tspindle", "", "sample", "TEMPERATURE", "CELSIUS", ""};
  EXPECT_EQ(suggested(item, {"T_spindle_degC"})["column"], "T_spindle_2_degC");
  EXPECT_EQ(suggested(item, {"T_spindle_degC", "T_spindle_2_degC"})["column"], "T_spindle_3_degC");
  EXPECT_EQ(suggested({"time_s", "", "", "", "", "", ""})["column"], "time_s_2");
}

TEST(ColumnSuggestion, WordsGetNumbers) {
  const nlohmann::json execution = suggested({"EXEC", "", "", "event", "EXECUTION", "", "READY"});
  EXPECT_EQ(execution["values"]["ACTIVE"], 1);
  EXPECT_EQ(execution["otherwise"], 0);
  EXPECT_EQ(suggested({"cool", "", "", "event", "COOLANT", "", "OFF"})["values"]["ON"], 1);
  EXPECT_FALSE(suggested({"S1", "", "", "sample", "SPINDLE_SPEED", "REVOLUTION/MINUTE", "0"}).contains("values"));
}

}  // namespace
}  // namespace spindrift::testing
