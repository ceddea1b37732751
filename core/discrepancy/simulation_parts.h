// SPDX-License-Identifier: Apache-2.0
// What a simulation is made of, as far as it is of effects of the catalogue: how wrong each part is, and how all move
// if the clock of the log is not that of the observations. Internal to core/discrepancy.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/effect_posterior.h"
#include "core/discrepancy/residual_problem.h"

namespace spindrift {

/// An effect of the catalogue that the simulation contains.
struct SimulationPart {
  std::string id;
  ModelTerm term;          ///< as the simulation has it
  Eigen::VectorXd gains;   ///< of its columns
  Eigen::VectorXd values;  ///< what it contributes to the simulation over the units, um or urad
  Eigen::VectorXd rate;    ///< what it gains per second that the clock of the log is ahead; empty: nothing logged
  ModelEffect model;       ///< the same for any observation
};

/// Found as missing effects are, in the simulation in place of the residual, to within the noise of the observations.
[[nodiscard]] std::vector<SimulationPart> partsOfSimulation(const ResidualProblem& problem, const DriverTable& drivers,
                                                            const std::vector<Effect>& catalogue,
                                                            const DiscrepancyPriors& priors, const JobContext& job);

/// What the residual gains over the units per second that the clock of the log is ahead of that of the observations, um
/// or urad per s: the simulation was computed from the log and asked at times of the observations. Its parts move as
/// their drivers say, between the states as well; the rest as it goes from state to state.
[[nodiscard]] Eigen::VectorXd clockRate(const ResidualProblem& problem, const std::vector<SimulationPart>& parts);

/// Clock of the log minus clock of the observations at which least is left of the residual, to within minutes: its
/// parts are moved as their drivers say. 0 where it is not clearly less. `prior_s`: standard deviation of such an
/// offset.
[[nodiscard]] double simulationClock(const ResidualProblem& problem, const DriverTable& drivers,
                                     const std::vector<Effect>& catalogue, const std::vector<SimulationPart>& parts,
                                     double prior_s);

/// `predicted` of `input` as the simulation has it for a time of the log `later_s` later: its parts as their drivers
/// say, the rest linear in time between the observations of its series and as it is beyond them.
[[nodiscard]] std::vector<double> predictedLater(const DiscrepancyInput& input, const DriverTable& drivers,
                                                 const std::vector<SimulationPart>& parts, double later_s);

/// By how much a part of the simulation is too large, relative to what it ought to be.
struct PartError {
  std::string id;
  double relative = 0.0;
  double uncertainty = 0.0;
};

/// By how much a part is off if `missing` (um or urad over the units, a named effect of the same id) is what it lacks;
/// `relative_uncertainty`: standard uncertainty of the size of `missing` over that size. Nothing: it has another course
/// or pattern than the part, or would turn it round.
[[nodiscard]] std::optional<PartError> partError(const ResidualProblem& problem, const SimulationPart& part,
                                                 const Eigen::VectorXd& missing, double relative_uncertainty);

/// Errors of those parts that account for most of what the nuisances take of `values`. `first`: the nuisance that
/// stands for the first part.
[[nodiscard]] std::vector<PartError> partErrors(const ResidualProblem& problem,
                                                const std::vector<SimulationPart>& parts, std::size_t first,
                                                const Eigen::VectorXd& values);

}  // namespace spindrift
