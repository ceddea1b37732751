// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/virtual_machine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/simulation/scenario.h"
#include "tests/support/source_folder.h"

namespace spindrift {
namespace {

constexpr double duration_s = 28800.0;

MachineDescription shippedMachine(const std::string& scenario) {
  return Scenario::read(spindrift::testing::sourceFolder() / "resources/scenarios" / scenario).machine;
}

EnvironmentOptions quietRoom() {
  EnvironmentOptions o;
  o.day_amplitude_K = 0.0;
  o.weather_K = 0.0;
  return o;
}

/// A machine that idles for half an hour and then does one thing.
VirtualMachine running(const MachineDescription& machine, const std::function<void(ProgrammeSegment&)>& work,
                       const EnvironmentOptions& room = quietRoom()) {
  ProgrammeSegment idle;
  idle.position_mm = {250.0, 225.0, 200.0};
  ProgrammeSegment busy = idle;
  busy.from_s = 1800.0;
  work(busy);
  return {machine, Programme({idle, busy}), Environment(room, duration_s, 7), PlantParameters{}, duration_s, 7};
}

Eigen::Vector3d moved_um(const VirtualMachine& plant, const std::string& id, const Eigen::Vector3d& at,
                         double time_s = duration_s, const Eigen::Vector3d& approach = Eigen::Vector3d::Ones()) {
  PlantQuery q;
  q.time_s = time_s;
  q.position_mm = at;
  q.approach = approach;
  q.point = "F1";
  return um_per_mm * plant.effect(id, {})(q).translation_mm;
}

TEST(VirtualMachine, NothingMovesAMachineThatStandsStillInAQuietRoom) {
  for (const char* file : {"discrepancy_vertical.json", "discrepancy_gantry.json", "discrepancy_five_axis.json"}) {
    const MachineDescription machine = shippedMachine(file);
    const VirtualMachine plant = running(machine, [](ProgrammeSegment& s) { s.instrument_on = false; });
    for (const std::string& id : catalogueOf(machine)) {
      if (id.starts_with("backlash") || id.starts_with("external") || id.starts_with("fixture") ||
          id.starts_with("instrument")) {
        continue;  // their causes are neither heat nor room
      }
      EXPECT_LT(moved_um(plant, id, {120.0, 300.0, 310.0}).norm(), 1e-6) << id;
    }
  }
}

TEST(VirtualMachine, EveryEffectOfTheCatalogueCanBeProduced) {
  for (const char* file : {"discrepancy_vertical.json", "discrepancy_gantry.json", "discrepancy_five_axis.json",
                           "discrepancy_horizontal.json", "hole_bar.json", "ball_artefact.json"}) {
    const MachineDescription machine = shippedMachine(file);
    const VirtualMachine plant = running(
        machine,
        [](ProgrammeSegment& s) {
          s.spindle_rpm = 4500.0;
          s.feed_mm_min = {9000.0, 9000.0, 9000.0};
          s.position_mm = {430.0, 350.0, 330.0};
          s.c_rpm = 30.0;
          s.coolant = true;
        },
        EnvironmentOptions{});
    std::vector<std::string> ids = catalogueOf(machine);
    for (const std::string& id : causesOutsideCatalogue()) ids.push_back(id);
    for (const std::string& id : ids) {
      const double size = moved_um(plant, id, {361.0, 133.0, 341.0}, 0.5 * duration_s).norm();
      if (id.starts_with("fixture.slip.") && id != "fixture.slip.F1") {
        EXPECT_EQ(size, 0.0) << id;
      } else {
        EXPECT_GT(size, 0.02) << id << " on " << machine.name;
        EXPECT_LT(size, 200.0) << id << " on " << machine.name;
      }
    }
  }
}

TEST(VirtualMachine, AWarmTableGrowsOutward) {
  const VirtualMachine plant = running(shippedMachine("discrepancy_vertical.json"), [](ProgrammeSegment& s) {
    s.feed_mm_min = {15000.0, 15000.0, 0.0};
  });
  const Eigen::Vector3d right = moved_um(plant, "table.expansion.xy", {450.0, 225.0, 0.0});
  const Eigen::Vector3d left = moved_um(plant, "table.expansion.xy", {50.0, 225.0, 0.0});
  const Eigen::Vector3d back = moved_um(plant, "table.expansion.xy", {250.0, 425.0, 0.0});
  EXPECT_LT(right.x(), -0.3) << "the table point moves to +X, so the tool falls behind";
  EXPECT_GT(left.x(), 0.3);
  EXPECT_LT(back.y(), -0.3);
  EXPECT_NEAR(right.x(), -left.x(), 0.05 * std::abs(right.x()));
  EXPECT_NEAR(moved_um(plant, "table.expansion.xy", {250.0, 225.0, 0.0}).norm(), 0.0, 1e-9) << "the centre stays";
}

TEST(VirtualMachine, AScrewGrowsAwayFromItsFixedBearing) {
  MachineDescription machine = shippedMachine("discrepancy_vertical.json");
  for (const double bearing : {0.0, 500.0}) {
    machine.axes[0].fixed_bearing_mm = bearing;
    const VirtualMachine plant = running(machine, [](ProgrammeSegment& s) { s.feed_mm_min = {15000.0, 0.0, 0.0}; });
    const double near_um = moved_um(plant, "ball_screw.expansion.x", {bearing, 100.0, 100.0}).x();
    const double far_um = moved_um(plant, "ball_screw.expansion.x", {500.0 - bearing, 100.0, 100.0}).x();
    EXPECT_NEAR(near_um, 0.0, 1e-9);
    EXPECT_GT(far_um * (bearing == 0.0 ? 1.0 : -1.0), 5.0);
    EXPECT_LT(std::abs(moved_um(plant, "ball_screw.expansion.y", {250.0, 400.0, 100.0}).y()), 0.01) << "stood still";
  }
}

TEST(VirtualMachine, ASpindleGrowsTowardsTheTableAndSettles) {
  const VirtualMachine plant =
      running(shippedMachine("discrepancy_vertical.json"), [](ProgrammeSegment& s) { s.spindle_rpm = 6000.0; });
  const double early = moved_um(plant, "spindle.growth.z", {0, 0, 0}, 2700.0).z();
  const double later = moved_um(plant, "spindle.growth.z", {0, 0, 0}, 9000.0).z();
  const double last = moved_um(plant, "spindle.growth.z", {0, 0, 0}).z();
  EXPECT_LT(early, -2.0);
  EXPECT_LT(later, early);
  EXPECT_LT(std::abs(last - later), std::abs(later - early)) << "it settles";
  EXPECT_GT(moved_um(plant, "spindle.centrifugal.z", {0, 0, 0}).z(), 0.0) << "centrifugal force draws the shaft back";
  EXPECT_NEAR(moved_um(plant, "spindle.centrifugal.z", {0, 0, 0}, 1799.0).z(), 0.0, 1e-12) << "without any lag";
}

TEST(VirtualMachine, AWarmColumnFrontLeansTheColumnBack) {
  const MachineDescription machine = shippedMachine("discrepancy_vertical.json");
  const VirtualMachine plant = running(machine, [](ProgrammeSegment& s) { s.spindle_rpm = 6000.0; });
  PlantQuery q;
  q.time_s = duration_s;
  q.position_mm = {250.0, 225.0, 400.0};
  const SmallError high = plant.effect("column.bending.a", {})(q);
  q.position_mm.z() = 0.0;
  const SmallError low = plant.effect("column.bending.a", {})(q);
  EXPECT_GT(high.translation_mm.y(), low.translation_mm.y());
  EXPECT_GT(low.translation_mm.y(), 0.0);
  EXPECT_LT(high.rotation_rad.x(), 0.0);
  // EA is minus the slope of ey along z.
  q.position_mm.z() = 201.0;
  const double above = plant.effect("column.bending.a", {})(q).translation_mm.y();
  q.position_mm.z() = 199.0;
  const double below = plant.effect("column.bending.a", {})(q).translation_mm.y();
  q.position_mm.z() = 200.0;
  EXPECT_NEAR((above - below) / 2.0, -plant.effect("column.bending.a", {})(q).rotation_rad.x(), 1e-9);
  EXPECT_NEAR(high.translation_mm.x(), 0.0, 1e-12);
}

TEST(VirtualMachine, AWarmBeamBowsUpBetweenItsEnds) {
  const MachineDescription machine = shippedMachine("discrepancy_gantry.json");
  const VirtualMachine plant = running(machine, [](ProgrammeSegment& s) { s.feed_mm_min = {0.0, 15000.0, 0.0}; });
  const double middle = moved_um(plant, "crossbeam.sag.z", {400.0, 300.0, 100.0}).z();
  EXPECT_GT(middle, 0.1);
  EXPECT_NEAR(moved_um(plant, "crossbeam.sag.z", {400.0, -60.0, 100.0}).z(), 0.0, 1e-9);
  EXPECT_NEAR(moved_um(plant, "crossbeam.sag.z", {400.0, 660.0, 100.0}).z(), 0.0, 1e-9);
}

TEST(VirtualMachine, ATurningTableCarriesItsMovement) {
  const MachineDescription machine = shippedMachine("discrepancy_five_axis.json");
  const VirtualMachine plant = running(machine, [](ProgrammeSegment& s) { s.c_rpm = 60.0; });
  EXPECT_LT(moved_um(plant, "rotary.drift.x0c", {100.0, 100.0, 0.0}).x(), -1.0) << "minus the table's movement";
  const Eigen::Vector3d out = moved_um(plant, "rotary.expansion.r0t", {450.0, 200.0, 0.0});
  EXPECT_LT(out.x(), -0.3);
  EXPECT_NEAR(out.y(), 0.0, 1e-9);
}

TEST(VirtualMachine, SwitchesAndSizesAct) {
  const MachineDescription machine = shippedMachine("discrepancy_vertical.json");
  const VirtualMachine plant = running(machine, [](ProgrammeSegment& s) { s.spindle_rpm = 3000.0; });
  std::vector<PlantQuery> queries(1);
  queries[0].time_s = 20000.0;
  queries[0].position_mm = {100.0, 200.0, 300.0};
  const SmallError one = plant.deviations({{"spindle.growth.z", {}}}, queries)[0];
  PlantEffectSetting twice;
  twice.size = 2.0;
  EXPECT_NEAR(plant.deviations({{"spindle.growth.z", twice}}, queries)[0].translation_mm.z(),
              2.0 * one.translation_mm.z(), 1e-15);
  PlantEffectSetting off;
  off.on = false;
  EXPECT_EQ(plant.deviations({{"spindle.growth.z", off}}, queries)[0].translation_mm.norm(), 0.0);
  EXPECT_EQ(one.translation_mm.x(), 0.0);
  EXPECT_EQ(one.translation_mm.y(), 0.0);
}

TEST(VirtualMachine, AnEffectThatTheMachineCannotHaveIsRefusedWithItsReason) {
  const MachineDescription machine = shippedMachine("discrepancy_gantry.json");
  EXPECT_THAT(whyNotPossible("column.bending.a", machine), ::testing::Ne(""));
  EXPECT_NE(whyNotPossible("ball_screw.expansion.x", machine), "") << "it has a linear scale";
  EXPECT_EQ(whyNotPossible("scale.expansion.x", machine), "");
  EXPECT_NE(whyNotPossible("rotary.drift.x0c", machine), "");
  EXPECT_NE(whyNotPossible("fixture.slip.F99", machine), "");
  EXPECT_NE(whyNotPossible("spindle.growht.z", machine), "");
  const VirtualMachine plant = running(machine, [](ProgrammeSegment&) {});
  EXPECT_THROW((void)plant.effect("column.bending.a", {}), InputError);
}

TEST(VirtualMachine, ConvectionGrowsWithMotionOnlyIfItIsSwitchedOn) {
  const MachineDescription machine = shippedMachine("discrepancy_vertical.json");
  ProgrammeSegment busy;
  busy.spindle_rpm = 6000.0;
  const Programme programme({busy});
  const Environment room(quietRoom(), duration_s, 1);
  PlantParameters still;
  still.convection_speed = 0.0;
  const ThermalRun with = runThermal(machine, programme, room, {}, duration_s);
  const ThermalRun without = runThermal(machine, programme, room, still, duration_s);
  EXPECT_LT(with.heated.at(with.bodies.shaft.first, duration_s),
            without.heated.at(with.bodies.shaft.first, duration_s));
}

TEST(VirtualMachine, RoomAndDoorsReachTheBodies) {
  EnvironmentOptions door = quietRoom();
  door.doors = {{7200.0, 4.0, 3600.0}};
  const VirtualMachine plant = running(
      shippedMachine("discrepancy_vertical.json"), [](ProgrammeSegment&) {}, door);
  const auto room = volumesAt(plant.thermal().bodies, "room", {});
  const auto column = volumesAt(plant.thermal().bodies, "column front", {});
  EXPECT_NEAR(plant.temperature_degC(room, 7100.0), 20.0, 0.01);
  EXPECT_NEAR(plant.temperature_degC(room, 7230.0), 16.0, 0.2);
  EXPECT_LT(plant.temperature_degC(column, 12000.0), 19.9);
  EXPECT_GT(plant.temperature_degC(column, 12000.0), 18.5);
  EXPECT_THROW((void)volumesAt(plant.thermal().bodies, "attic", {}), InputError);
  EXPECT_THROW((void)volumesAt(plant.thermal().bodies, "column front@2", {}), InputError);
}

}  // namespace
}  // namespace spindrift
