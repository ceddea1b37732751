// SPDX-License-Identifier: Apache-2.0
// Noise, clock, simulation and missing effects of a campaign estimated together, and judged: what is told is made of
// this. Internal to core/discrepancy. Times in s, displacements in um, rotations in urad.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/discrepancy/comparable_rows.h"
#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/effect_posterior.h"
#include "core/discrepancy/judgement.h"
#include "core/discrepancy/simulation_parts.h"
#include "core/discrepancy/simulator_hypotheses.h"

namespace spindrift {

/// Everything that is estimated together: noise, clock and effects. It stays where it is: its search looks at its
/// catalogue.
struct Analysis {
  Analysis(std::shared_ptr<DriverTable> its_drivers, std::vector<Effect> effects, SimulatorHypotheses parameters)
      : drivers(std::move(its_drivers)), catalogue(std::move(effects)), hypotheses(std::move(parameters)) {}
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;

  std::shared_ptr<DriverTable> drivers;
  std::vector<Effect> catalogue;
  SimulatorHypotheses hypotheses;  ///< those of the catalogue that are parameters of a simulator
  std::unique_ptr<EffectSearch> search;
  EffectPosterior posterior;
  Remainder remainder;
  double clock_offset_s = 0.0;  ///< beyond that by which the drivers came
  double clock_uncertainty_s = 0.0;
  /// Of the nuisances that which moves with the clock of the simulation, which is that of the log; nothing: none.
  std::optional<std::size_t> clock_column;
  /// Where no effect shows the clock: as the simulation shows it, clock of the log minus that of the observations.
  double simulation_clock_s = 0.0;
  double simulation_clock_uncertainty_s = 0.0;
  double simulation_error = 0.0;            ///< of its parts, as estimated
  std::vector<SimulationPart> parts;        ///< of the simulation
  std::vector<SimulationPart> rough_parts;  ///< parts of the simulation that may be off by more than is stated
  std::vector<std::string> notes;
};

/// An analysis with what it was made of and what it came to.
struct JudgedAnalysis {
  /// What was looked at; its simulation is the one asked for the time of its own clock.
  std::shared_ptr<const DiscrepancyInput> input;
  double log_clock_s = 0.0;  ///< clock of the log minus clock of the observations, before it is estimated
  double log_clock_uncertainty_s = 0.0;
  std::vector<std::string> warnings;
  ComparableRows rows;
  std::unique_ptr<ResidualProblem> problem;
  std::unique_ptr<Analysis> analysis;
  DiscrepancyOptions options;  ///< as far as the data admit them
  bool enough = false;
  Judgement judged;
};

/// The analysis of a campaign. Where its answer leaves something or leaves a doubt, the log is tried with its clock up
/// to four hours earlier and later as well; such an answer is taken if it explains all and is worth the odds against
/// it. Throws InputError (comparableRows; an id of the options that this machine cannot have) and Cancelled.
[[nodiscard]] JudgedAnalysis judgedAnalysis(const DiscrepancyInput& input, const DiscrepancyOptions& options,
                                            const DiscrepancyPriors& priors, JobContext& job);

/// A fit as it predicts: over all dynamics that the data allow.
[[nodiscard]] std::vector<ModelEffect> predictingEffects(const EffectSearch& search, const ResidualProblem& problem,
                                                         const DriverTable& drivers, const JointFit& fit);

}  // namespace spindrift
