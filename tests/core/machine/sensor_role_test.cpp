// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/sensor_role.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/machine/machine_description.h"

namespace spindrift {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string roleRead(const std::string& text) {
  const auto role = readSensorRole(text);
  return role ? std::string(toString(*role)) : "nothing";
}

TEST(SensorRole, ReadsEnglishNamesByWholeWords) {
  const std::pair<const char*, const char*> names[] = {{"T_room_degC", "room"},
                                                       {"T_ambient_degC", "room"},
                                                       {"T_ambient_2_degC", "room"},
                                                       {"T_air_degC", "room"},
                                                       {"T_spindle_degC", "spindle_bearing"},
                                                       {"T_spindle_bearing_front_degC", "spindle_bearing"},
                                                       {"T_front_bearing_degC", "spindle_bearing"},
                                                       {"T_spindle_housing_degC", "spindle_housing"},
                                                       {"T_housing_2_degC", "spindle_housing"},
                                                       {"T_head_1_degC", "spindle_housing"},
                                                       {"T_spindleHousing_degC", "spindle_housing"},
                                                       {"T_column_degC", "column"},
                                                       {"T_column_front_degC", "column_front"},
                                                       {"T_front_of_column_degC", "column_front"},
                                                       {"T_ColumnRear3_degC", "column_rear"},
                                                       {"T_column_left_degC", "column_left"},
                                                       {"T_column-right_degC", "column_right"},
                                                       {"T_column3_degC", "column"},
                                                       {"T_table_degC", "table"},
                                                       {"T_rotary_degC", "table"},
                                                       {"T_bed_motor_degC", "bed"},
                                                       {"T_cross_beam_degC", "crossbeam"},
                                                       {"T_screw_x_degC", "screw_x"},
                                                       {"T_screw_bearing_y_degC", "screw_y"},
                                                       {"T_nut_z_degC", "screw_z"},
                                                       {"T_ball_screw_degC", "screw"},
                                                       {"T_scale_y_degC", "scale_y"},
                                                       {"T_table_scale_x_degC", "scale_x"},
                                                       {"T_coolant_degC", "coolant"},
                                                       {"T_table_coolant_degC", "coolant"},
                                                       {"T_artefact_1_degC", "artefact"},
                                                       {"T_camera_degC", "instrument"}};
  for (const auto& [name, role] : names) EXPECT_EQ(roleRead(name), role) << name;
}

TEST(SensorRole, ReadsGermanNamesByWholeWords) {
  const std::pair<const char*, const char*> names[] = {{"T_Spindellager_degC", "spindle_bearing"},
                                                       {"T_Spindellager_vorne_degC", "spindle_bearing"},
                                                       {"T_Spindelgehäuse_degC", "spindle_housing"},
                                                       {"T_Spindelgehaeuse_degC", "spindle_housing"},
                                                       {"T_SPINDELGEHÄUSE_degC", "spindle_housing"},
                                                       {"T_Ständer_vorne_degC", "column_front"},
                                                       {"T_StänderHinten_degC", "column_rear"},
                                                       {"T_Staender_links_degC", "column_left"},
                                                       {"T_staender_rechts_2_degC", "column_right"},
                                                       {"T_Staendervorderseite_degC", "column_front"},
                                                       {"T_Säule_degC", "column"},
                                                       {"T_Tisch_degC", "table"},
                                                       {"T_Tischtemperatur_degC", "table"},
                                                       {"T_Bett_degC", "bed"},
                                                       {"T_Maschinenbett_degC", "bed"},
                                                       {"T_Querbalken_degC", "crossbeam"},
                                                       {"T_Kühlmittel_degC", "coolant"},
                                                       {"T_Kuehlschmierstoff_degC", "coolant"},
                                                       {"T_KSS_degC", "coolant"},
                                                       {"T_Raum_degC", "room"},
                                                       {"T_Umgebung_degC", "room"},
                                                       {"T_Umgebungstemperatur_degC", "room"},
                                                       {"T_Hallentemperatur_degC", "room"},
                                                       {"T_Maßstab_X_degC", "scale_x"},
                                                       {"T_Glasmassstab_y_degC", "scale_y"},
                                                       {"T_Kugelgewindetrieb_Z_degC", "screw_z"},
                                                       {"T_KGT_x1_degC", "screw_x"},
                                                       {"T_Prüfkörper_degC", "artefact"}};
  for (const auto& [name, role] : names) EXPECT_EQ(roleRead(name), role) << name;
  // An umlaut as letter and diaeresis, as some systems write it.
  EXPECT_EQ(roleRead("T_Sta\u0308nder_vorne_degC"), "column_front");
}

TEST(SensorRole, NeverGuessesFromPartOfAWord) {
  for (const char* name : {"T_broom_degC",
                           "T_tablet_degC",
                           "T_bedroom_degC",
                           "T_repair_degC",
                           "T_headquarter_degC",
                           "T_football_degC",
                           "T_standard_degC",
                           "T_peanut_degC",
                           "T_embedded_degC",
                           "T_roommate_degC",
                           "T_columnist_degC",
                           "T_challenge_degC",
                           "T_Lagerraum_degC",
                           "T_Tischler_degC",
                           "T_Traum_degC",
                           "T_Umsatzstaender_degC",
                           "T_upscale_degC",
                           "T_x_axis_degC",
                           "T_1_degC",
                           "T_flange1_degC",
                           "T_degC",
                           "T__degC",
                           "",
                           "T_ж_degC"}) {
    EXPECT_EQ(roleRead(name), "nothing") << name;
  }
}

TEST(SensorRole, WordsOfManyPartsCountOnlyAlone) {
  EXPECT_EQ(roleRead("T_motor_housing_degC"), "nothing");
  EXPECT_EQ(roleRead("T_compressed_air_degC"), "nothing");
  EXPECT_EQ(roleRead("T_bearing_x_degC"), "nothing");
  EXPECT_EQ(roleRead("T_gearbox_bearing_degC"), "nothing");
  EXPECT_EQ(roleRead("T_table_bearing_degC"), "table");
}

TEST(SensorRole, ContradictingWordsTellNothing) {
  EXPECT_EQ(roleRead("T_column_table_degC"), "nothing");
  EXPECT_EQ(roleRead("T_room_bed_degC"), "nothing");
  EXPECT_EQ(roleRead("T_column_front_rear_degC"), "column");
}

TEST(SensorRole, SplitsNames) {
  EXPECT_THAT(sensorWords("StänderVorne2_links-x"), ElementsAre("staender", "vorne", "links", "x"));
  EXPECT_THAT(sensorWords("TRoom"), ElementsAre("t", "room"));
  EXPECT_THAT(sensorWords("XAxis_KSS"), ElementsAre("x", "axis", "kss"));
}

TEST(SensorRole, NamesAreThoseOfTheFile) {
  for (const std::string& name : sensorRoleNames()) {
    const auto role = sensorRoleFromString(name);
    ASSERT_TRUE(role) << name;
    EXPECT_EQ(toString(*role), name);
    EXPECT_FALSE(describe(*role).empty());
  }
  EXPECT_FALSE(sensorRoleFromString("Room"));
  EXPECT_EQ(scaleRole(0), SensorRole::ScaleX);
  EXPECT_EQ(screwRole(2), SensorRole::ScrewZ);
}

MachineDescription machineWith(const std::string& sensors) {
  return MachineDescription::parse(
      JsonNode::parse(R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-X'-Y'-b-Z-t]",
        "axes":[{"name":"X","travel_mm":[0,480]},{"name":"Y","travel_mm":[0,480]},{"name":"Z","travel_mm":[0,480]}],
        "temperature_sensors":[)" +
                          sensors + "]}",
                      "machine.json"),
      "machine.json");
}

TEST(SensorRole, TheStatedRoleWins) {
  const auto machine = machineWith(R"({"name":"T_room_degC","role":"table"},{"name":"T_7_degC","role":"column_left"},
    {"name":"T_bed_degC","role":"other"},{"name":"T_table_degC","role":null})");
  const auto roleOf = [&](const std::string& column) { return readSensor(machine.temperature_sensors, column); };
  EXPECT_EQ(roleOf("T_room_degC").role, SensorRole::Table);
  EXPECT_EQ(roleOf("T_room_degC").from, "machine.json");
  EXPECT_EQ(roleOf("T_7_degC").role, SensorRole::ColumnLeft);
  EXPECT_EQ(roleOf("T_bed_degC").role, SensorRole::Other);
  EXPECT_EQ(roleOf("T_table_degC").role, SensorRole::Table);
  EXPECT_EQ(roleOf("T_table_degC").from, "name");
  // A column that machine.json does not know.
  EXPECT_EQ(roleOf("T_ambient_degC").role, SensorRole::Room);
  EXPECT_EQ(roleOf("T_broom_degC").role, SensorRole::Other);
  EXPECT_EQ(readFromNames({roleOf("T_room_degC"), roleOf("T_ambient_degC")}), "T_ambient_degC room");
}

TEST(SensorRole, ThePlaceFillsWhatTheNameLeavesOpen) {
  const auto machine = machineWith(R"({"name":"T_1_degC","place":"column rear"},
    {"name":"T_column_degC","place":"column front"},{"name":"T_screw_x_degC","place":"front bearing"},
    {"name":"T_spindle_degC","place":"spindle housing"},{"name":"T_ambient_degC","place":"repair bay"},
    {"name":"T_table_degC","place":"column front"})");
  const auto roleOf = [&](const std::string& column) { return readSensor(machine.temperature_sensors, column); };
  EXPECT_EQ(roleOf("T_1_degC").role, SensorRole::ColumnRear);
  EXPECT_EQ(roleOf("T_column_degC").role, SensorRole::ColumnFront);
  EXPECT_EQ(roleOf("T_screw_x_degC").role, SensorRole::ScrewX);
  EXPECT_EQ(roleOf("T_screw_x_degC").note, "");
  EXPECT_EQ(roleOf("T_spindle_degC").role, SensorRole::SpindleHousing);
  EXPECT_EQ(roleOf("T_ambient_degC").role, SensorRole::Room);
  EXPECT_EQ(roleOf("T_table_degC").role, SensorRole::Table);
  EXPECT_THAT(roleOf("T_table_degC").note, HasSubstr("column front"));
}

TEST(SensorRole, ARoleInOtherWordsIsRead) {
  const auto machine = machineWith(R"({"name":"T_1_degC","role":"spindle"},{"name":"T_2_degC","role":"Tisch"},
    {"name":"T_3_degC","role":"ball screw X"})");
  const auto roleOf = [&](const std::string& column) { return readSensor(machine.temperature_sensors, column); };
  EXPECT_EQ(roleOf("T_1_degC").role, SensorRole::SpindleBearing);
  EXPECT_EQ(roleOf("T_1_degC").from, "machine.json");
  EXPECT_EQ(roleOf("T_1_degC").note, "");
  EXPECT_EQ(roleOf("T_2_degC").role, SensorRole::Table);
  EXPECT_EQ(roleOf("T_3_degC").role, SensorRole::ScrewX);
}

TEST(SensorRole, AnUnknownRoleIsOneSentenceAndTheNameIsRead) {
  const auto machine = machineWith(R"({"name":"T_1_degC","role":"tabel"},{"name":"T_room_degC","role":"tabel"})");
  const auto roleOf = [&](const std::string& column) { return readSensor(machine.temperature_sensors, column); };
  EXPECT_EQ(roleOf("T_1_degC").role, SensorRole::Other);
  EXPECT_EQ(roleOf("T_room_degC").role, SensorRole::Room);
  EXPECT_EQ(roleOf("T_room_degC").from, "name");
  for (const char* said : {"machine.json", "\"tabel\"", "T_room_degC", "spindle_bearing", "taken for room by its name"})
    EXPECT_THAT(roleOf("T_room_degC").note, HasSubstr(said));
  EXPECT_THROW((void)machineWith(R"({"name":"T_1_degC","role":3})"), InputError);
  EXPECT_THROW((void)machineWith(R"({"name":"T_1_degC","role":""})"), InputError);
}

}  // namespace
}  // namespace spindrift
