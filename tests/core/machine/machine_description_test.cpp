// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/machine_description.h"

#include <gmock/gmock.h>

namespace spindrift {
namespace {

using ::testing::HasSubstr;

nlohmann::json example() {
  return nlohmann::json::parse(R"({
    "format":"spindrift-machine","version":1,"name":"five-axis","chain":"V [w-C2'-A'-X'-b-Y-Z-C1-t]",
    "axes":[{"name":"X","travel_mm":[0,500],"resolution_um":0.1,"drive":{"type":"ball_screw","pitch_mm":10,
             "fixed_bearing_mm":500},"scale":"linear_scale","datum_mm":0},
            {"name":"Y","travel_mm":[0,450]},{"name":"Z","travel_mm":[0,400]}],
    "spindle":{"axis":"Z","max_rpm":12000,"nose_offset_mm":[0,0,-80]},
    "rotary":[{"name":"C2","centre_mm":[250,200,0]}],
    "temperature_sensors":[{"name":"T_column_degC","place":"column front"}],
    "points":[{"id":"F1","kind":"fiducial","x_mm":20,"y_mm":15,"z_mm":0}],
    "artefacts":[{"id":"bar","kind":"hole_bar","nominal_positions_mm":[0,42,97],"reference_in_table_mm":[-140,12,0],
                  "direction_at_c0":[1,0,0],"hole_diameter_mm":10,"certificate_uncertainty_um":0.5},
                 {"id":"balls","kind":"balls","balls":[{"id":"B1","diameter_mm":25.4,"certified_mm":[0,0,0]}]}],
    "styli":[{"id":"p0","radius_mm":2,"offset_mm":[0,0,-50]}],
    "profiler":{"scan_model":"push_broom","axis":"Y","lift_mm":178.152,"lever_mm":[-900,0,-2051],"profile_points":3200,
                "profile_interval_mm":0.0125,"calibration_cloud":"c.pcd","calibration_circle":[0,0,0,12.5]},
    "table":{"centre_mm":[250,225]},"column":{"base_mm":-100},"crossbeam":{"axis":"Y","from_mm":0,"to_mm":450},
    "reference_temperature_degC":21,"serial_number":"4711"})");
}

MachineDescription parse(const nlohmann::json& json) {
  return MachineDescription::parse(JsonNode::parse(json.dump(), "machine.json"), "machine.json");
}

TEST(MachineDescription, ReadsEveryKeyOfTheFormat) {
  const MachineDescription machine = parse(example());
  EXPECT_EQ(machine.findAxis("X")->fixed_bearing_mm, 500.0);
  EXPECT_EQ(machine.findAxis("X")->scale, "linear_scale");
  EXPECT_FALSE(machine.findAxis("Y")->pitch_mm.has_value());
  EXPECT_EQ(machine.spindle->nose_offset_mm.z(), -80.0);
  EXPECT_EQ(machine.findRotary("C2")->centre_mm.x(), 250.0);
  EXPECT_EQ(machine.findPoint("F1")->position_mm.y(), 15.0);
  EXPECT_EQ(machine.findArtefact("bar")->nominal_positions_mm.size(), 3U);
  EXPECT_EQ(machine.findArtefact("balls")->balls.at(0).diameter_mm, 25.4);
  EXPECT_EQ(machine.findStylus("p0")->offset_mm.z(), -50.0);
  EXPECT_EQ(machine.profiler->scan_model, "push_broom");
  EXPECT_EQ(machine.profiler->calibration_circle_mm->at(3), 12.5);
  EXPECT_EQ(machine.table_centre_mm->y(), 225.0);
  EXPECT_EQ(machine.column_base_mm, -100.0);
  EXPECT_EQ(machine.crossbeam->to_mm, 450.0);
  EXPECT_EQ(machine.reference_temperature_degC, 21.0);
  EXPECT_EQ(machine.source.at("serial_number"), "4711");
  EXPECT_EQ(machine.findPoint("F9"), nullptr);
}

TEST(MachineDescription, NamesThePathOfWhatIsWrong) {
  struct Case {
    const char* pointer;
    nlohmann::json value;
    const char* expected;
  };
  const std::vector<Case> cases{
      {"/chain", "nonsense", "$.chain"},
      {"/axes/0/travel_mm", {500, 0}, "$.axes[0].travel_mm"},
      {"/axes/1/name", "X", "$.axes[1].name"},
      {"/axes/0/scale", "ruler", "rotary_encoder or linear_scale"},
      {"/points/0/x_mm", "20", "$.points[0].x_mm"},
      {"/artefacts/0/direction_at_c0", {1, 1, 0}, "length 1"},
      {"/artefacts/0/reference_hole", "H9", "H1 to H3"},
      {"/artefacts/0/expansion_um_per_m_K", 11500.0, "from -5 to 100"},
      {"/artefacts/0/expansion_um_per_m_K", 1.15e-5, "where steel has 11.5, not 1/K"},
      {"/artefacts/0/temperature_degC", 293.15, "from -20 to 80"},
      {"/reference_temperature_degC", 293.15, "from 0 to 40"},
      {"/reference_temperature_degC", 68, "from 0 to 40"},
      {"/styli/0/radius_mm", 0, "greater than zero"},
      {"/profiler/calibration_circle", {0, 0, 0, -1}, "r > 0"},
      {"/format", "other", "spindrift-machine"},
      {"/version", 2, "newer program"},
  };
  for (const Case& c : cases) {
    nlohmann::json json = example();
    json[nlohmann::json::json_pointer(c.pointer)] = c.value;
    try {
      (void)parse(json);
      FAIL() << c.pointer << " was accepted";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(c.expected)) << c.pointer;
    }
  }
}

TEST(MachineDescription, RequiresOnlyWhatTheFormatRequires) {
  const MachineDescription machine = parse(nlohmann::json::parse(
      R"({"format":"spindrift-machine","version":1,"name":"m","chain":"V [w-b-X-t]","axes":[{"name":"X","travel_mm":[0,1]}]})"));
  EXPECT_FALSE(machine.spindle);
  EXPECT_EQ(machine.reference_temperature_degC, 20.0);
  for (const char* key : {"format", "version", "name", "chain", "axes"}) {
    nlohmann::json json = example();
    json.erase(key);
    EXPECT_THROW((void)parse(json), InputError) << key;
  }
}

}  // namespace
}  // namespace spindrift
