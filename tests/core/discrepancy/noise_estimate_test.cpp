// SPDX-License-Identifier: GPL-3.0-or-later
// Noise recovered from readings that nothing but noise has made: shifts that all points of a state have in common.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/discrepancy/residual_problem.h"

namespace spindrift {
namespace {

constexpr std::size_t points = 8;
constexpr std::size_t states = 24;
constexpr double own_um = 0.6;
constexpr std::array<Component, 3> axes = {Component::EX, Component::EY, Component::EZ};

/// Found shifts of X, Y, Z, um, for those of the truth.
std::array<double, 3> foundShifts(std::uint64_t seed, const std::array<double, 3>& truth_um) {
  Random random(seed);
  DiscrepancyInput in;
  for (std::size_t k = 0; k < states; ++k) {
    std::array<double, 3> shift{};
    for (std::size_t c = 0; c < 3; ++c) shift[c] = truth_um[c] * random.normal();
    for (std::size_t p = 0; p < points; ++p) {
      for (std::size_t c = 0; c < 3; ++c) {
        Observation o;
        o.time_s = 1200.0 * static_cast<double>(k) + 8.0 * static_cast<double>(p);
        o.state = "M" + std::to_string(k);
        o.point = "P" + std::to_string(p);
        o.position_mm = {40.0 * static_cast<double>(p % 4), 60.0 * static_cast<double>(p / 4), 0.0};
        o.component = axes[c];
        o.sigma = 0.5;
        o.value = shift[c] + own_um * random.normal();
        in.observations.rows.push_back(o);
      }
    }
  }
  in.predicted.assign(in.observations.rows.size(), 0.0);
  std::vector<std::size_t> rows(in.observations.rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  const ResidualProblem problem(in, rows, 3000);
  const NoiseModel noise = estimateNoise(problem, problem.y, true);
  return {noise.of(axes[0]).common, noise.of(axes[1]).common, noise.of(axes[2]).common};
}

struct Recovered {
  std::array<double, 3> rms_um{};        ///< of what was found
  std::array<double, 3> part_without{};  ///< part of the campaigns in which none was found
};

Recovered recovered(const std::array<double, 3>& truth_um) {
  constexpr int campaigns = 60;
  Recovered out;
  for (int seed = 0; seed < campaigns; ++seed) {
    const std::array<double, 3> found = foundShifts(700 + static_cast<std::uint64_t>(seed), truth_um);
    for (std::size_t c = 0; c < 3; ++c) {
      out.rms_um[c] += found[c] * found[c] / campaigns;
      out.part_without[c] += found[c] > 0.0 ? 0.0 : 1.0 / campaigns;
    }
  }
  for (double& r : out.rms_um) r = std::sqrt(r);
  return out;
}

TEST(NoiseEstimate, ShiftsThatAllAxesHaveAreFoundInEach) {
  // As large as the scatter of a state's mean.
  constexpr double shift_um = 0.25;
  const Recovered found = recovered({shift_um, shift_um, shift_um});
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(found.rms_um[c] / shift_um, 1.0, 0.15) << c;
    EXPECT_LT(found.part_without[c], 0.05) << c;
  }
}

TEST(NoiseEstimate, ShiftsOfOneAxisAreNoneOfTheOthers) {
  constexpr double shift_um = 0.5;
  const Recovered found = recovered({0.0, 0.0, shift_um});
  EXPECT_NEAR(found.rms_um[2] / shift_um, 1.0, 0.15);
  // A quarter of the scatter of a state's mean adds a sixteenth to its variance.
  const double little_um = 0.4 * own_um / std::sqrt(static_cast<double>(points));
  EXPECT_LT(found.rms_um[0], little_um);
  EXPECT_LT(found.rms_um[1], little_um);
}

TEST(NoiseEstimate, NothingIsSharedWhereNothingShifts) {
  const Recovered found = recovered({0.0, 0.0, 0.0});
  for (std::size_t c = 0; c < 3; ++c) EXPECT_GT(found.part_without[c], 0.85) << c << ": " << found.rms_um[c] << " um";
}

}  // namespace
}  // namespace spindrift
