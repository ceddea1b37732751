// SPDX-License-Identifier: Apache-2.0
// The runs of a simulator as observations see them: what each changes in whitened units, free of constants and of the
// gain of the simulation. Internal to core/discrepancy.
#pragma once

#include <Eigen/Core>
#include <set>
#include <vector>

#include "core/discrepancy/residual_problem.h"
#include "core/simulator/simulator.h"

namespace spindrift {

class SimulationClosure {
 public:
  /// All of these outlive it. `rows`: the observations that are fitted; the noise is that of `result`.
  SimulationClosure(const DiscrepancyInput& input, const DiscrepancyResult& result, const Simulator& simulator,
                    const std::vector<std::size_t>& rows, const JobContext& job);

  [[nodiscard]] const ResidualProblem& problem() const noexcept { return problem_; }
  /// What the present simulation leaves.
  [[nodiscard]] const Eigen::VectorXd& residual() const noexcept { return problem_.projectedResidual(); }
  /// Values of observations (um or urad), projected.
  [[nodiscard]] Eigen::VectorXd projected(const std::vector<double>& values) const;
  /// What a run changes against the present simulation, projected. Throws SimulatorFailed where it has no value and the
  /// present simulation has one.
  [[nodiscard]] Eigen::VectorXd projectedChange(const SimulatorRun& run) const;

  /// Runs at the same time; each set of values counts once.
  [[nodiscard]] SimulatorRuns run(const std::vector<ParameterValues>& sets);
  [[nodiscard]] std::size_t runs() const noexcept { return asked_.size(); }

 private:
  const DiscrepancyInput* input_;
  const Simulator* simulator_;
  const JobContext* job_;
  ResidualProblem problem_;
  std::set<ParameterValues> asked_;
};

}  // namespace spindrift
