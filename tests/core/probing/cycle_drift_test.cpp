// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/core/probing/probing_machines.h"

namespace spindrift {
namespace {

using namespace probing_test;

constexpr double spacing_s = 1800.0;

/// Parameters of a machine whose spindle starts at `start_s`: `amplitude` (1 - exp(-t / time constant)).
using Warming = std::vector<double>;

std::vector<double> parametersAt(const Warming& amplitude, double start_s, double constant_s, double time_s) {
  std::vector<double> p = amplitude;
  const double part = time_s > start_s ? 1.0 - std::exp(-(time_s - start_s) / constant_s) : 0.0;
  for (double& value : p) value *= part;
  return p;
}

struct DriftingRun {
  TouchList list;
  std::vector<std::vector<double>> truth;  ///< per cycle, at the mean time of its touches, since the first
};

/// The machine begins to warm when cycle `from` begins.
DriftingRun probeDrifting(const MachineDescription& machine, int cycles, int from, const Warming& amplitude,
                          double constant_s, std::uint64_t seed) {
  const Artefact& artefact = machine.artefacts.front();
  const bool holes = artefact.kind == "hole_bar";
  Random random(seed);
  DriftingRun run;
  const VirtualProbeOptions options;
  for (int k = 0; k < cycles; ++k) {
    const TipDeviation deviation = [&](const ProbeTouchQuery& q) {
      const std::vector<double> p = parametersAt(amplitude, spacing_s * from, constant_s, q.time_s);
      return holes ? holeBarDeviation(machine, artefact, p)(q) : ballDeviation(machine, p)(q);
    };
    const std::string name = "M" + std::to_string(k);
    const std::vector<Touch> touches =
        holes ? probeHoleBar(machine, artefact, name, spacing_s * k, deviation, options, random)
              : probeBalls(machine, artefact, name, spacing_s * k, deviation, options, random);
    double mean_s = 0.0;
    for (const Touch& t : touches) mean_s += t.time_s / static_cast<double>(touches.size());
    run.list.touches.insert(run.list.touches.end(), touches.begin(), touches.end());
    run.truth.push_back(parametersAt(amplitude, spacing_s * from, constant_s, mean_s));
    for (std::size_t p = 0; p < amplitude.size(); ++p) {
      if (k > 0) run.truth.back()[p] -= run.truth.front()[p];
    }
  }
  return run;
}

CycleEvaluation evaluateDrifting(const MachineDescription& machine, const TouchList& list) {
  const Artefact& artefact = machine.artefacts.front();
  if (artefact.kind == "hole_bar") return evaluateHoleCycles(list, machine, artefact);
  return evaluateBallCycles(list, machine, artefact, nullptr);
}

struct Case {
  bool holes = true;
  int from = 1;
};

class DriftInsideTheCycle : public ::testing::TestWithParam<Case> {
 protected:
  static constexpr int cycles = 6;
  static constexpr int seeds = 16;
  static constexpr double constant_s = 300.0;

  [[nodiscard]] MachineDescription machine() const {
    return machineFrom(GetParam().holes ? holeMachineText() : ballMachineText());
  }
  /// The spindle grows by 5 um along Z within the cycle, the touch noise is 0.2 um.
  [[nodiscard]] Warming amplitude() const {
    if (GetParam().holes) return {-15, -3, 2, 12, 1, 2, -2, 3, 20};
    return {5, -4, 3, 2, 3, -2, 3, -2, 12, 10, 10, 5};
  }
  [[nodiscard]] DriftingRun run(int seed) const {
    return probeDrifting(machine(), cycles, GetParam().from, amplitude(), constant_s,
                         static_cast<std::uint64_t>(100 + seed));
  }
};

/// Sums of (error / standard uncertainty)^2.
struct Score {
  double sum = 0.0;
  int count = 0;

  void add(const CycleEvaluation& evaluation, const DriftingRun& run, std::size_t cycle) {
    for (std::size_t p = 0; p < evaluation.names.size(); ++p) {
      const CycleParameter& q = evaluation.parameters[cycle][p];
      const double z = (q.value - run.truth[cycle][p]) / q.standard_uncertainty;
      sum += z * z;
      ++count;
    }
  }
  [[nodiscard]] double rms() const { return std::sqrt(sum / count); }
};

TEST_P(DriftInsideTheCycle, LeavesNoGoodTouchOutAndTheUncertaintyHolds) {
  const auto drifting = static_cast<std::size_t>(std::max(1, GetParam().from));
  Score in_drift;
  Score all;
  for (int seed = 0; seed < seeds; ++seed) {
    const DriftingRun r = run(seed);
    const CycleEvaluation evaluation = evaluateDrifting(machine(), r.list);
    ASSERT_EQ(evaluation.status, FitStatus::Converged) << evaluation.message;
    EXPECT_TRUE(evaluation.rejected.empty()) << "seed " << seed << ": " << evaluation.rejected.front().reason;
    ASSERT_EQ(evaluation.fit.cycles.size(), static_cast<std::size_t>(cycles));
    EXPECT_TRUE(evaluation.fit.cycles.front().theta.isZero());
    in_drift.add(evaluation, r, drifting);
    for (std::size_t k = 1; k < r.truth.size(); ++k) all.add(evaluation, r, k);
    for (const double sigma : evaluation.fit.group_sigma_mm) EXPECT_NEAR(sigma, 0.2e-3, 0.06e-3) << "seed " << seed;
  }
  std::printf("error / uncertainty %.2f in the drifting cycle, %.2f in all\n", in_drift.rms(), all.rms());
  EXPECT_GT(in_drift.rms(), 0.75);
  EXPECT_LT(in_drift.rms(), 1.25);
  EXPECT_GT(all.rms(), 0.8);
  EXPECT_LT(all.rms(), 1.2);
}

TEST_P(DriftInsideTheCycle, DoesNotHideABadTouch) {
  const auto drifting = static_cast<std::size_t>(std::max(1, GetParam().from));
  for (const double error_mm : {0.1, 0.02, -0.02}) {
    Score score;
    for (int seed = 0; seed < seeds; ++seed) {
      DriftingRun r = run(seed);
      const std::size_t per_cycle = r.list.touches.size() / cycles;
      // Another touch for every seed: surface touches, of which few tell the tilt, and touches of a wall.
      const auto back = static_cast<std::size_t>(5 * seed + 2 * (seed % 2)) % per_cycle;
      const std::size_t bad = (drifting + 1) * per_cycle - 1 - back;
      r.list.touches[bad].position_mm += error_mm * r.list.touches[bad].approach;
      const CycleEvaluation evaluation = evaluateDrifting(machine(), r.list);
      std::string named;
      for (const RejectedTouch& t : evaluation.rejected)
        named += r.list.touches[t.touch].label() + ": " + t.reason + "\n";
      EXPECT_EQ(evaluation.rejected.size(), 1U) << "seed " << seed << ", " << r.list.touches[bad].label() << "\n"
                                                << named;
      if (evaluation.rejected.empty()) continue;
      EXPECT_EQ(evaluation.rejected.front().touch, bad) << "seed " << seed;
      score.add(evaluation, r, drifting);
    }
    EXPECT_LT(score.rms(), 1.3) << error_mm;
  }
}

INSTANTIATE_TEST_SUITE_P(Probing, DriftInsideTheCycle,
                         ::testing::Values(Case{true, 0}, Case{true, 1}, Case{true, 3}, Case{false, 0}, Case{false, 1}),
                         [](const ::testing::TestParamInfo<Case>& param) {
                           return std::string(param.param.holes ? "holes" : "balls") + "_from_M" +
                                  std::to_string(param.param.from);
                         });

TEST(DriftInsideTheCycles, AMachineThatJumpsBetweenCyclesIsEvaluatedAsBefore) {
  // The parameters change by much from cycle to cycle, but not inside: the uncertainty stays that of the touch noise.
  const MachineDescription m = machineFrom(holeMachineText());
  const CycleEvaluation evaluation = evaluateDrifting(m, runCycles(m, 5, {}, 3).list);
  const CycleFitResult still = fitCycles(evaluation.problem);
  for (std::size_t k = 1; k < still.cycles.size(); ++k) {
    EXPECT_TRUE(evaluation.fit.cycles[k].theta.isApprox(still.cycles[k].theta, 1e-12));
    EXPECT_TRUE(evaluation.fit.cycles[k].covariance.isApprox(still.cycles[k].covariance, 1e-12));
  }
}

}  // namespace
}  // namespace spindrift
