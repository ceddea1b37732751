// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/kinematic_chain.h"

#include <gmock/gmock.h>

namespace spindrift {
namespace {

TEST(KinematicChain, ReadsTheNotation) {
  const KinematicChain chain = KinematicChain::parse("V [w-C2'-A'-X'-b-Y-Z-C1-t]");
  ASSERT_EQ(chain.axes().size(), 6U);
  EXPECT_TRUE(chain.verticalSpindle());
  EXPECT_FALSE(chain.movesTool("X"));
  EXPECT_TRUE(chain.movesTool("Z"));
  EXPECT_TRUE(chain.find("C2")->rotary);
  EXPECT_TRUE(chain.find("C2")->carries_workpiece);
  EXPECT_EQ(chain.find("A")->direction, Eigen::Vector3d::UnitX());
  EXPECT_EQ(chain.find("B"), nullptr);
  EXPECT_TRUE(KinematicChain::parse("V [w-b-X-Y-Z-(C)-t]").find("C")->spindle);
  EXPECT_FALSE(KinematicChain::parse("H [w-Z'-b-X-Y-(C)-t]").verticalSpindle());
}

TEST(KinematicChain, RefusesWhatIsNoChain) {
  for (const char* text : {"", "V w-b-t", "V [w-X'-Y'-Z-t]", "V [w-X'-b-X-t]", "V [w-b-X'-t]", "V [w-b-Q-t]",
                           "V [b-X-t]", "V [w-b-b-X-t]", "V [w-b-X2b-t]"}) {
    EXPECT_THROW((void)KinematicChain::parse(text), InputError) << text;
  }
}

// Worked by hand: C-frame machine, X' and Y' under the table, Z in the head. The tool is commanded to (100, 50, 30)
// relative to the table, so the table stands at (-100, -50, 0) and the tool at (0, 0, 30) in the frame of the bed.
TEST(KinematicChain, LeversOfAWorkpieceAxisAndAToolAxis) {
  const KinematicChain chain = KinematicChain::parse("V [w-X'-Y'-b-Z-(C)-t]");
  const AxisPositions at{{"X", 100.0}, {"Y", 50.0}, {"Z", 30.0}};
  const Eigen::Vector3d tool = Eigen::Vector3d::Zero();
  // Yaw of the X carriage of 1e-5 rad: its origin is at (-100, -50, 0), lever (100, 50, 30). The table turns, so the
  // tool moves the other way: ex = +1e-5 * 50, ey = -1e-5 * 100.
  const SmallError yaw =
      chain.toolDeviation(at, {{"X", {Eigen::Vector3d::Zero(), Eigen::Vector3d(0.0, 0.0, 1e-5)}}}, tool);
  EXPECT_NEAR(yaw.translation_mm.x(), 50e-5, 1e-15);
  EXPECT_NEAR(yaw.translation_mm.y(), -100e-5, 1e-15);
  EXPECT_NEAR(yaw.translation_mm.z(), 0.0, 1e-15);
  EXPECT_NEAR(yaw.rotation_rad.z(), -1e-5, 1e-20);
  // Pitch of the head about X: the carriage's origin is the tool point itself (tool point (0,0,0) at Z = 0): no lever.
  const SmallError pitch =
      chain.toolDeviation(at, {{"Z", {Eigen::Vector3d::Zero(), Eigen::Vector3d(1e-5, 0.0, 0.0)}}}, tool);
  EXPECT_NEAR(pitch.translation_mm.norm(), 0.0, 1e-15);
  // With a tool 120 mm below the carriage: ey = -EA * rz = +1e-5 * 120.
  const SmallError lever = chain.toolDeviation(at, {{"Z", {Eigen::Vector3d::Zero(), Eigen::Vector3d(1e-5, 0.0, 0.0)}}},
                                               Eigen::Vector3d(0.0, 0.0, -120.0));
  EXPECT_NEAR(lever.translation_mm.y(), 120e-5, 1e-15);
  // Positioning errors: the table that moves too far in +X carries the tool to -X relative to it.
  const SmallError exx =
      chain.toolDeviation(at, {{"X", {Eigen::Vector3d(0.01, 0.0, 0.0), Eigen::Vector3d::Zero()}}}, tool);
  EXPECT_NEAR(exx.translation_mm.x(), -0.01, 1e-15);
}

TEST(KinematicChain, RotaryTableTurnsAboutItsCentre) {
  const KinematicChain chain = KinematicChain::parse("V [w-C'-b-X-Y-Z-t]");
  const SmallError error = chain.toolDeviation({{"X", 10.0}}, {{"C", {Eigen::Vector3d::Zero(), {0.0, 0.0, 1e-4}}}},
                                               Eigen::Vector3d(200.0, 100.0, 0.0), {{"C", {150.0, 100.0, 0.0}}});
  // Tool at (210, 100, 0), centre (150, 100, 0): lever 60 mm in x; the table turns by +1e-4, the tool relative by
  // minus.
  EXPECT_NEAR(error.translation_mm.y(), -60e-4, 1e-15);
}

}  // namespace
}  // namespace spindrift
