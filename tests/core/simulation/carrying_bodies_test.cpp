// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/carrying_bodies.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/simulation/scenario.h"
#include "tests/support/source_folder.h"

namespace spindrift {
namespace {

constexpr double shift_s = 28800.0;

/// A machine that works with everything it has for a long time, in a room that warms up.
VirtualMachine working(const std::string& scenario, std::uint64_t seed) {
  const MachineDescription machine =
      Scenario::read(spindrift::testing::sourceFolder() / "resources/scenarios" / scenario).machine;
  ProgrammeSegment busy;
  busy.spindle_rpm = 6000.0;
  busy.feed_mm_min = {9000.0, 9000.0, 9000.0};
  busy.c_rpm = 60.0;
  return {machine, Programme({busy}), Environment({}, shift_s, seed), PlantParameters{}, shift_s, seed};
}

/// What of the displacement over the volume the named shape leaves over, rms over rms, when its gain and its origin are
/// free: columns of `shape` for a place, one per parameter.
double leftOver(const VirtualMachine& plant, const std::string& id,
                const std::function<Eigen::MatrixXd(const Eigen::Vector3d&)>& shape) {
  const PlantEffectFunction effect = plant.effect(id, {});
  std::vector<Eigen::MatrixXd> blocks;
  std::vector<Eigen::Vector3d> values;
  for (int i = 0; i < 64; ++i) {
    const Eigen::Vector3d place(40.0 + 140.0 * (i % 4), 40.0 + 110.0 * (i / 4 % 4), 100.0 * (i / 16));
    PlantQuery q;
    q.time_s = shift_s;
    q.position_mm = place;
    blocks.push_back(shape(place));
    values.push_back(effect(q).translation_mm);
  }
  Eigen::MatrixXd x(3 * 64, blocks.front().cols());
  Eigen::VectorXd y(3 * 64);
  for (Eigen::Index i = 0; i < 64; ++i) {
    x.middleRows(3 * i, 3) = blocks[static_cast<std::size_t>(i)];
    y.segment(3 * i, 3) = values[static_cast<std::size_t>(i)];
  }
  const Eigen::VectorXd fit = x * x.colPivHouseholderQr().solve(y).eval();
  return (y - fit).norm() / y.norm();
}

Eigen::MatrixXd turnAbout(int axis, const Eigen::Vector3d& p) {
  Eigen::MatrixXd columns(3, 4);
  columns << Eigen::Vector3d::Unit(axis).cross(p), Eigen::Matrix3d::Identity();
  return columns;
}

TEST(CarryingBodies, AreCloseToTheirNamesAndNotQuiteThem) {
  std::map<std::string, double> largest;
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const VirtualMachine vertical = working("discrepancy_vertical.json", seed);
    const VirtualMachine five_axis = working("discrepancy_five_axis.json", seed);
    const auto expectNear = [&](const VirtualMachine& plant, const std::string& id, const auto& shape) {
      const double part = leftOver(plant, id, shape);
      largest[id] = std::max(largest[id], part);
      EXPECT_LT(part, 0.12) << id << " seed " << seed;
    };
    for (int axis = 0; axis < 3; ++axis) {
      const std::string letter(1, static_cast<char>('a' + axis));
      expectNear(vertical, "frame.rotation." + letter, [&](const Eigen::Vector3d& p) { return turnAbout(axis, p); });
      expectNear(five_axis, "rotary.tilt." + letter + "0c",
                 [&](const Eigen::Vector3d& p) { return turnAbout(axis, p); });
    }
    expectNear(vertical, "squareness.drift.c0y", [](const Eigen::Vector3d& p) {
      Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(3, 2);
      columns.row(0) << p.y(), 1.0;
      return columns;
    });
    for (int axis = 0; axis < 3; ++axis) {
      const char* ids[] = {"rotary.drift.x0c", "rotary.drift.y0c", "rotary.drift.z0t"};
      expectNear(five_axis, ids[axis],
                 [&](const Eigen::Vector3d&) { return Eigen::MatrixXd(Eigen::Vector3d::Unit(axis)); });
    }
    expectNear(vertical, "external_heat.a", [&](const Eigen::Vector3d& p) {
      const double z = p.z() - *vertical.machine().column_base_mm;
      Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(3, 1);
      columns(1, 0) = z * z;
      return columns;
    });
  }
  for (const auto& [id, part] : largest) EXPECT_GT(part, 0.01) << id;
}

TEST(CarryingBodies, AFollowerLagsBehindItsDrive) {
  const auto signals = followers([](double) { return 2.0; }, {{1.0, 600.0}, {0.5, 300.0}}, 3000.0);
  EXPECT_NEAR(signals[0].at(600.0), 2.0 * (1.0 - std::exp(-1.0)), 1e-9);
  EXPECT_NEAR(signals[1].at(3000.0), 1.0, 1e-4);
}

TEST(CarryingBodies, AColumnThatLeansBackLiftsTheHeadThatOverhangsIt) {
  const VirtualMachine plant = working("discrepancy_vertical.json", 1);
  PlantEffectSetting overhanging;
  overhanging.parameters["overhang_y_mm"] = -400.0;
  PlantQuery q;
  q.time_s = shift_s;
  q.position_mm = {200.0, 200.0, 300.0};
  const SmallError straight = plant.effect("column.bending.a", {})(q);
  const SmallError lifted = plant.effect("column.bending.a", overhanging)(q);
  EXPECT_EQ(straight.translation_mm.z(), 0.0);
  EXPECT_NEAR(lifted.translation_mm.z(), -400.0 * lifted.rotation_rad.x(), 1e-12);
  EXPECT_GT(lifted.translation_mm.z(), 0.0) << "a warm front leans the column back";
  EXPECT_EQ(lifted.translation_mm.y(), straight.translation_mm.y());
}

}  // namespace
}  // namespace spindrift
