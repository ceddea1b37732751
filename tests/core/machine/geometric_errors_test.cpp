// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/geometric_errors.h"

#include <gmock/gmock.h>

#include "core/base/json_reader.h"

namespace spindrift {
namespace {

using ::testing::Contains;
using ::testing::Not;

MachineDescription machineOf(const std::string& chain, bool rotary = false) {
  nlohmann::json json{{"format", "spindrift-machine"},
                      {"version", 1},
                      {"name", "m"},
                      {"chain", chain},
                      {"axes",
                       {{{"name", "X"}, {"travel_mm", {0, 500}}},
                        {{"name", "Y"}, {"travel_mm", {0, 400}}},
                        {{"name", "Z"}, {"travel_mm", {0, 300}}}}}};
  if (rotary) json["rotary"] = {{{"name", "C"}, {"centre_mm", {250, 200, 0}}}};
  return MachineDescription::parse(JsonNode::parse(json.dump(), "machine.json"), "machine.json");
}

SmallError deviation(const GeometricErrors& errors, const std::string& name, const Eigen::Vector3d& at,
                     const Eigen::Vector3d& tool = Eigen::Vector3d::Zero()) {
  const auto found = std::find(errors.names().begin(), errors.names().end(), name);
  EXPECT_NE(found, errors.names().end()) << name;
  DeviationQuery query;
  query.position_mm = at;
  query.tool_offset_mm = tool;
  return errors.unit(static_cast<std::size_t>(found - errors.names().begin()), query);
}

TEST(GeometricErrors, TwentyOneOfThreeAxesAndSixOfTheTable) {
  EXPECT_EQ(GeometricErrors(machineOf("V [w-X'-Y'-b-Z-t]")).names().size(), 21U);
  const GeometricErrors five(machineOf("V [w-C'-X'-Y'-b-Z-t]", true));
  EXPECT_EQ(five.names().size(), 27U);
  EXPECT_THAT(five.names(), Contains("EZ0T_um"));
  EXPECT_THAT(five.names(), Contains("EB0Z_urad"));
  EXPECT_THAT(GeometricErrors(machineOf("V [w-X'-Y'-b-Z-(C)-t]")).names(), Not(Contains("EX0C_um")));
}

TEST(GeometricErrors, MeanTheSameWhicheverPartAnAxisMoves) {
  const Eigen::Vector3d at(400, 300, 120);
  for (const char* chain : {"V [w-X'-Y'-b-Z-t]", "V [w-b-X-Y-Z-t]", "V [w-X'-b-Y-Z-t]"}) {
    const GeometricErrors errors(machineOf(chain));
    // 150 mm from the middle: 0.15 um for 1 um/m.
    EXPECT_NEAR(deviation(errors, "EXX_um_per_m", at).translation_mm.x(), 0.15e-3, 1e-12) << chain;
    // FORMATS.md: ex = -EC0Y y, from the middle of Y.
    const SmallError square = deviation(errors, "EC0Y_urad", at);
    EXPECT_NEAR(square.translation_mm.x(), -100e-6, 1e-12) << chain;
    EXPECT_EQ(square.rotation_rad.norm(), 0.0);
    EXPECT_NEAR(deviation(errors, "EA0Z_urad", at).translation_mm.y(), 30e-6, 1e-12) << chain;
    EXPECT_NEAR(deviation(errors, "EB0Z_urad", at).translation_mm.x(), -30e-6, 1e-12) << chain;
    // An arc: its height in the middle, nothing at the ends.
    EXPECT_NEAR(deviation(errors, "EYX_um", {250, 10, 10}).translation_mm.y(), 1e-3, 1e-12) << chain;
    EXPECT_NEAR(deviation(errors, "EYX_um", {500, 10, 10}).translation_mm.y(), 0.0, 1e-12) << chain;
    EXPECT_NEAR(deviation(errors, "EBX_urad", {500, 10, 10}).rotation_rad.y(), 0.5e-6, 1e-15) << chain;
  }
}

TEST(GeometricErrors, AnAngularErrorActsByItsLever) {
  // Pitch of X about Y, 1 urad from end to end, tool 200 mm below the spindle reference: ex = EB * lever in z.
  const GeometricErrors errors(machineOf("V [w-b-X-Y-Z-t]"));
  const SmallError e = deviation(errors, "EBX_urad", {500, 0, 100}, {0, 0, -200});
  EXPECT_NEAR(e.translation_mm.x(), 0.5e-6 * 100.0, 1e-12);
  const SmallError longer = deviation(errors, "EBX_urad", {500, 0, 300}, {0, 0, -200});
  EXPECT_NEAR(longer.translation_mm.x(), 0.5e-6 * 300.0, 1e-12);
}

TEST(GeometricErrors, ATableThatMovesIsADeviationTheOtherWay) {
  const GeometricErrors errors(machineOf("V [w-C'-X'-Y'-b-Z-t]", true));
  EXPECT_NEAR(deviation(errors, "EX0C_um", {10, 20, 30}).translation_mm.x(), -1e-3, 1e-12);
  const SmallError turn = deviation(errors, "EC0C_urad", {350, 200, 0});
  EXPECT_NEAR(turn.translation_mm.y(), -100e-6, 1e-12);
  EXPECT_NEAR(turn.rotation_rad.z(), -1e-6, 1e-15);
}

}  // namespace
}  // namespace spindrift
