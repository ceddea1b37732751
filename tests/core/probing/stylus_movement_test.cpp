// SPDX-License-Identifier: GPL-3.0-or-later
// A loose stylus against a machine that warms up: told apart where the passes allow it, and not where they do not.
#include "core/probing/stylus_movement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/probing/probe_health.h"
#include "tests/core/probing/probing_machines.h"

namespace spindrift {
namespace {

using namespace probing_test;

constexpr double noise_um = 0.3;
constexpr double limit_um = 8.0;

struct Record {
  std::vector<double> time_s;
  std::vector<Eigen::Vector3d> centre_um;
};

Record recordOf(int passes, std::uint64_t seed, const std::function<Eigen::Vector3d(double)>& course) {
  Random random(seed);
  Record record;
  for (int k = 0; k < passes; ++k) {
    record.time_s.push_back(600.0 * k);
    record.centre_um.emplace_back(course(600.0 * k) + Eigen::Vector3d(random.normal(0.0, noise_um),
                                                                      random.normal(0.0, noise_um),
                                                                      random.normal(0.0, noise_um)));
  }
  return record;
}

Eigen::Vector3d warming(double t, double tau_s) {
  return Eigen::Vector3d(12.0, -20.0, 40.0) * (1.0 - std::exp(-t / tau_s));
}

Eigen::Vector3d jump(double t) {
  return t > 2700.0 ? Eigen::Vector3d(0.0, 15.0, -6.0) : Eigen::Vector3d::Zero();
}

MovementKind kindOf(const Record& r) {
  return judgeMovement(r.time_s, r.centre_um, noise_um, limit_um).kind;
}

TEST(StylusMovement, WarmingIsNoLooseStylus) {
  int loose = 0;
  int warm = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    for (const double tau : {900.0, 3000.0, 9000.0}) {
      const MovementKind kind =
          kindOf(recordOf(10, seed, [tau](double t) -> Eigen::Vector3d { return warming(t, tau); }));
      if (kind == MovementKind::Jump || kind == MovementKind::Scatter) ++loose;
      if (kind == MovementKind::Warming) ++warm;
    }
  }
  EXPECT_EQ(loose, 0);
  EXPECT_GE(warm, 280);
}

TEST(StylusMovement, AJumpIsFoundAloneAndOnTopOfWarming) {
  int alone = 0;
  int on_top = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Record r = recordOf(10, seed, jump);
    const StylusMovement m = judgeMovement(r.time_s, r.centre_um, noise_um, limit_um);
    if (m.kind == MovementKind::Jump && m.jump_after == 4) ++alone;
    EXPECT_NEAR(m.jump_um, std::hypot(15.0, 6.0), 1.5);
    if (kindOf(recordOf(10, seed, [](double t) -> Eigen::Vector3d { return warming(t, 3000.0) + jump(t); })) ==
        MovementKind::Jump)
      ++on_top;
  }
  EXPECT_EQ(alone, 100);
  EXPECT_GE(on_top, 98);
}

TEST(StylusMovement, ScatterFromPassToPassIsNoWarming) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Random random(1000 + seed);
    const Record r = recordOf(10, seed, [&random](double) {
      return Eigen::Vector3d(random.normal(0.0, 10.0), random.normal(0.0, 10.0), 0.0);
    });
    if (kindOf(r) == MovementKind::Scatter || kindOf(r) == MovementKind::Jump) ++found;
  }
  EXPECT_GE(found, 97);
}

TEST(StylusMovement, TooFewPassesAreNotDecided) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(kindOf(recordOf(2, seed, [](double t) -> Eigen::Vector3d { return warming(t, 3000.0) * 2.0; })),
              MovementKind::Undecided);
    EXPECT_EQ(kindOf(recordOf(3, seed, [](double t) -> Eigen::Vector3d { return warming(t, 3000.0) * 2.0; })),
              MovementKind::Undecided);
    // A jump in the first interval and a fast warming look the same.
    const MovementKind first = kindOf(recordOf(
        6, seed, [](double t) { return t > 0.0 ? Eigen::Vector3d(15.0, 0.0, 0.0) : Eigen::Vector3d::Zero(); }));
    EXPECT_NE(first, MovementKind::Warming);
  }
  EXPECT_EQ(kindOf(recordOf(8, 1, [](double) { return Eigen::Vector3d::Zero(); })), MovementKind::Still);
  EXPECT_EQ(kindOf({}), MovementKind::Still);
}

TEST(ProbeHealth, AWarmMachineIsNotCalledALooseStylusAndTheLooseOneIsNamed) {
  const MachineDescription m = machineFrom(ballMachineText());
  VirtualProbeOptions options;
  options.noise_um = 0.3;
  const auto warm = [](int k, Random&) {
    std::vector<double> p(12, 0.0);
    const double rise = 1.0 - std::exp(-k / 5.0);
    for (int i = 0; i < 12; ++i) p[static_cast<std::size_t>(i)] = rise * (i % 2 == 0 ? 40.0 : -30.0);
    return p;
  };
  VirtualRun run = runCycles(m, 10, options, 21, warm);
  for (const StylusHealth& h : checkProbeHealth(run.list, m)) {
    EXPECT_FALSE(h.loose) << h.message;
    EXPECT_TRUE(h.healthy) << h.message;
    EXPECT_GT(h.largest_step_um, 5.0);
  }
  for (Touch& t : run.list.touches) {
    if (t.stylus == "p2" && t.time_s > 3300.0) t.position_mm += Eigen::Vector3d(0.0, 0.018, 0.0);
  }
  for (const StylusHealth& h : checkProbeHealth(run.list, m)) {
    EXPECT_EQ(h.loose, h.stylus == "p2") << h.message;
    if (h.stylus == "p2") {
      EXPECT_EQ(h.movement.kind, MovementKind::Jump) << h.message;
      EXPECT_NE(h.message.find("jumped"), std::string::npos) << h.message;
    }
  }
  removeTouches(run.list, [](const Touch& t) { return t.time_s > 1500.0 || t.stylus != "p0"; });
  for (const StylusHealth& h : checkProbeHealth(run.list, m)) {
    if (h.movement.largest_um < 9.0) continue;
    EXPECT_FALSE(h.loose) << h.message;
    EXPECT_NE(h.message.find("do not distinguish"), std::string::npos) << h.message;
  }
}

}  // namespace
}  // namespace spindrift
