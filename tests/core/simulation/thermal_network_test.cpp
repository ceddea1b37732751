// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/thermal_network.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "core/simulation/heat_sources.h"

namespace spindrift {
namespace {

TEST(ThermalNetwork, OneBodyFollowsTheExponentialLag) {
  ThermalNetwork net;
  const int room = net.addBoundary(20.0);
  const int body = net.addNode(6000.0, 20.0);
  net.addLink(body, room, 5.0);  // time constant 1200 s
  net.setHeat(body, 50.0);       // steady rise 10 K
  double time = 0.0;
  for (int i = 0; i < 240; ++i) {
    net.advance(30.0);
    time += 30.0;
    EXPECT_NEAR(net.temperature(body), 20.0 + 10.0 * (1.0 - std::exp(-time / 1200.0)), 0.002);
  }
}

TEST(ThermalNetwork, RodHeatedAtOneEndReachesTheLinearProfile) {
  // 40 cells of 10 mm, 8 W in at the first, the last tied to the room: T(x) = T0 + Q x / (k A).
  constexpr double between = 46.0 * 8e-4 / 0.01;
  ThermalNetwork net;
  const int room = net.addBoundary(15.0);
  const int first = net.addRod(40, 30.0, between, 15.0);
  net.addLink(first + 39, room, between);
  net.setHeat(first, 8.0);
  net.advance(90000.0);
  for (int i = 0; i < 40; ++i) {
    EXPECT_NEAR(net.temperature(first + i), 15.0 + 8.0 / between * (40 - i), 1e-3) << i;
  }
}

TEST(ThermalNetwork, FinReachesItsHyperbolicProfile) {
  // A rod that convects along its length and is held at one end: theta = cosh(m (L - x)) / cosh(m L).
  constexpr int count = 80;
  constexpr double length = 0.8;
  constexpr double cell = length / count;
  constexpr double k_area = 46.0 * 8e-4;
  constexpr double h_perimeter = 12.0 * 0.1;
  ThermalNetwork net;
  const int room = net.addBoundary(0.0);
  const int held = net.addBoundary(10.0);
  const int first = net.addRod(count, 28.0, k_area / cell, 0.0);
  net.addLink(held, first, 2.0 * k_area / cell);  // half a cell to its centre
  for (int i = 0; i < count; ++i) net.addLink(first + i, room, h_perimeter * cell);
  net.advance(40000.0);
  const double m = std::sqrt(h_perimeter / k_area);
  for (int i = 0; i < count; ++i) {
    const double x = (i + 0.5) * cell;
    EXPECT_NEAR(net.temperature(first + i), 10.0 * std::cosh(m * (length - x)) / std::cosh(m * length), 0.005);
  }
}

TEST(ThermalNetwork, DecayOfAnInsulatedRodMatchesItsFirstMode) {
  constexpr int count = 50;
  ThermalNetwork net;
  const int first = net.addRod(count, 20.0, 10.0, 0.0);
  for (int i = 0; i < count; ++i) {
    net.setTemperature(first + i, std::cos(std::numbers::pi * (i + 0.5) / count));
  }
  net.advance(1000.0);
  const double rate = 10.0 / 20.0 * 2.0 * (1.0 - std::cos(std::numbers::pi / count));
  for (int i = 0; i < count; ++i) {
    EXPECT_NEAR(net.temperature(first + i), std::exp(-rate * 1000.0) * std::cos(std::numbers::pi * (i + 0.5) / count),
                1e-4);
  }
}

TEST(ThermalNetwork, EnergyBalanceClosesWhileConductancesAndSourcesChange) {
  ThermalNetwork net;
  const int room = net.addBoundary(20.0);
  const int first = net.addRod(12, 400.0, 3.0, 20.0);
  std::vector<int> links;
  for (int i = 0; i < 12; ++i) links.push_back(net.addLink(first + i, room, 0.2));
  for (int step = 0; step < 500; ++step) {
    net.setTemperature(room, 20.0 + std::sin(0.05 * step));
    net.setConductance(links[static_cast<std::size_t>(step % 12)], 0.2 + 0.001 * (step % 7));
    net.clearHeat();
    net.addHeat(first + step % 12, 30.0);
    net.addHeat(first, 5.0);
    net.advance(30.0);
  }
  EXPECT_NEAR(net.sourceEnergy_J(), 500 * 30.0 * 35.0, 1e-6);
  EXPECT_NEAR(net.storedEnergy_J(), net.sourceEnergy_J() + net.boundaryEnergy_J(), 1e-6 * net.sourceEnergy_J());
}

TEST(ThermalNetwork, MisuseIsAProgramError) {
  ThermalNetwork net;
  const int a = net.addNode(1.0, 0.0);
  EXPECT_THROW(net.addNode(0.0, 0.0), InternalError);
  EXPECT_THROW(net.addLink(a, 7, 1.0), InternalError);
  EXPECT_THROW(net.addLink(a, a, 1.0), InternalError);
}

TEST(HeatSources, FrictionIsNotLinearInSpeed) {
  const BearingFriction friction;
  const double slow = bearingPower_W(friction, 3000.0, 0.0);
  const double fast = bearingPower_W(friction, 6000.0, 0.0);
  EXPECT_EQ(bearingPower_W(friction, 0.0, 0.0), 0.0);
  EXPECT_GT(fast, 2.3 * slow);
  EXPECT_LT(fast, 3.2 * slow);
  EXPECT_GT(bearingPower_W(friction, 6000.0, 10.0), fast) << "preload grows with the difference in temperature";
  EXPECT_GT(convection_W_per_m2_K(9.0, 5.0, 10000.0, 10000.0), 13.9);
  EXPECT_DOUBLE_EQ(convection_W_per_m2_K(9.0, 5.0, 0.0, 10000.0), 9.0);
}

}  // namespace
}  // namespace spindrift
