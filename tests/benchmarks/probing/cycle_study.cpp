// SPDX-License-Identifier: GPL-3.0-or-later
// Virtual cycles of the hole bar and of the ball artefact: how often the truth lies inside the stated 95 % interval,
// and the rms error over what the noise allows (Cramer-Rao), for every parameter; then the time to evaluate 48 cycles.
// `cycle_study [CYCLES OF EACH KIND]`, default 2000.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/math/least_squares.h"
#include "core/math/statistics.h"
#include "tests/core/probing/probing_machines.h"

namespace {

using namespace spindrift;
using namespace spindrift::probing_test;

constexpr int cycles = 6;  // a campaign: one cold cycle, five warm ones

const char* kindName(bool holes) {
  return holes ? "hole bar" : "balls";
}

VirtualProbeOptions probeOptions(bool holes) {
  VirtualProbeOptions o;
  o.noise_um = holes ? 0.2 : 0.7;
  o.surface_noise_um = 0.15;
  o.form_error_um = 1.0;
  o.pre_travel_um = 4.0;
  return o;
}

CycleEvaluation evaluated(const MachineDescription& m, const TouchList& list) {
  Campaign campaign;
  campaign.machine = m;
  JobContext job;
  const TouchEvaluation all = evaluateTouchList(campaign, list, {}, {}, job);
  if (!all.hole_cycles.empty()) return all.hole_cycles.front();
  return all.ball_cycles.front();
}

/// Differences of two cycles with the true noise, solved independently of the evaluation.
Eigen::VectorXd bound(const CycleEvaluation& e, const VirtualProbeOptions& o, bool holes) {
  std::vector<Eigen::Index> rows;
  for (std::size_t r = 0; r < e.problem.rows.size(); ++r)
    if (e.problem.rows[r].cycle == 1) rows.push_back(static_cast<Eigen::Index>(r));
  Eigen::MatrixXd a(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(e.names.size()));
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const Eigen::Index r = rows[static_cast<std::size_t>(i)];
    const bool surface = holes && e.problem.rows[static_cast<std::size_t>(r)].group == 1;
    const double sigma_mm = std::sqrt(2.0) * (surface ? o.surface_noise_um : o.noise_um) * 1e-3;
    for (Eigen::Index p = 0; p < a.cols(); ++p)
      a(i, p) = e.problem.jacobian(r, p) / e.unit[static_cast<std::size_t>(p)] / sigma_mm;
  }
  return (a.transpose() * a).inverse().diagonal().cwiseSqrt();
}

void study(bool holes, int wanted) {
  const MachineDescription m = machineFrom(holes ? holeMachineText() : ballMachineText());
  const VirtualProbeOptions options = probeOptions(holes);
  const int campaigns = std::max(1, wanted / (cycles - 1));
  Eigen::VectorXd squares;
  Eigen::VectorXd inside;
  Eigen::VectorXd allowed;
  std::vector<std::string> names;
  for (int c = 0; c < campaigns; ++c) {
    const VirtualRun run = runCycles(m, cycles, options, 5000 + static_cast<std::uint64_t>(c));
    const CycleEvaluation e = evaluated(m, run.list);
    if (c == 0) {
      names = e.names;
      squares = inside = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(names.size()));
      allowed = bound(e, options, holes);
    }
    for (std::size_t k = 1; k < run.truth.size(); ++k) {
      for (std::size_t p = 0; p < names.size(); ++p) {
        const double error = e.parameters[k][p].value - run.truth[k][p];
        squares[static_cast<Eigen::Index>(p)] += error * error;
        if (std::abs(error) < 1.959964 * e.parameters[k][p].standard_uncertainty)
          ++inside[static_cast<Eigen::Index>(p)];
      }
    }
  }
  const double n = static_cast<double>(campaigns) * (cycles - 1);
  std::printf("%s, %.0f cycles: inside the 95 %% interval, rms error, rms / Cramer-Rao\n", kindName(holes), n);
  const Eigen::VectorXd ratio = (squares / n).cwiseSqrt().cwiseQuotient(allowed);
  for (Eigen::Index p = 0; p < squares.size(); ++p)
    std::printf("  %-14s %6.2f %%  %8.4f  %6.3f\n", names[static_cast<std::size_t>(p)].c_str(), 100.0 * inside[p] / n,
                std::sqrt(squares[p] / n), ratio[p]);
  const RateInterval rate = wilsonInterval(static_cast<std::size_t>(inside.sum()),
                                           static_cast<std::size_t>(n * static_cast<double>(squares.size())));
  std::printf("  all            %6.2f %%  (parameters of a cycle share their noise; rate to about +-%.2f %%)  %6.3f\n",
              100.0 * inside.sum() / (n * static_cast<double>(squares.size())), 50.0 * (rate.high - rate.low),
              std::sqrt(ratio.squaredNorm() / static_cast<double>(ratio.size())));
}

void timing(bool holes) {
  const MachineDescription m = machineFrom(holes ? holeMachineText() : ballMachineText());
  const VirtualRun run = runCycles(m, 48, probeOptions(holes), 3);
  double best = 1e9;
  for (int k = 0; k < 5; ++k) {
    const auto start = std::chrono::steady_clock::now();
    const CycleEvaluation e = evaluated(m, run.list);
    if (e.status != FitStatus::Converged) std::printf("not converged: %s\n", e.message.c_str());
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::printf("%s: 48 cycles, %zu touches evaluated in %.3f s\n", kindName(holes), run.list.touches.size(), best);
}

}  // namespace

int main(int argc, char** argv) {
  const int wanted = argc > 1 ? std::stoi(argv[1]) : 2000;
  for (const bool holes : {true, false}) study(holes, wanted);
  for (const bool holes : {true, false}) timing(holes);
  return 0;
}
