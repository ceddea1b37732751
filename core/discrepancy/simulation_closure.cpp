// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/simulation_closure.h"

#include <fmt/format.h>

#include <cmath>

namespace spindrift {
namespace {

using Eigen::Index;

}  // namespace

SimulationClosure::SimulationClosure(const DiscrepancyInput& input, const DiscrepancyResult& result,
                                     const Simulator& simulator, const std::vector<std::size_t>& rows,
                                     const JobContext& job)
    : input_(&input), simulator_(&simulator), job_(&job), problem_(input, rows, most_units) {
  problem_.setNuisances(problem_.simulationNuisances(input.simulation_gain_uncertainty));
  if (result.noise_model) problem_.setNoise(*result.noise_model);
}

Eigen::VectorXd SimulationClosure::projected(const std::vector<double>& values) const {
  // Mean over the units.
  Eigen::VectorXd at_units(problem_.size());
  for (Index u = 0; u < problem_.size(); ++u) {
    const std::vector<std::size_t>& rows = problem_.unit_rows[static_cast<std::size_t>(u)];
    double sum = 0.0;
    for (const std::size_t row : rows) sum += values[row];
    at_units[u] = sum / static_cast<double>(rows.size());
  }
  return problem_.projected(at_units).col(0);
}

Eigen::VectorXd SimulationClosure::projectedChange(const SimulatorRun& run) const {
  std::vector<double> change(run.predicted.size());
  std::size_t missing = 0;
  for (std::size_t i = 0; i < change.size(); ++i) {
    change[i] = run.predicted[i] - input_->predicted[i];
    if (!std::isfinite(input_->predicted[i])) change[i] = 0.0;
    missing += std::isfinite(change[i]) ? 0 : 1;
  }
  if (missing > 0) {
    throw SimulatorFailed(fmt::format(
        "the simulation gives no value for {} observations that it predicts with its own parameters.", missing));
  }
  return projected(change);
}

SimulatorRuns SimulationClosure::run(const std::vector<ParameterValues>& sets) {
  asked_.insert(sets.begin(), sets.end());
  return runAll(*simulator_, sets, input_->observations, *job_, "running the simulation");
}

}  // namespace spindrift
