// SPDX-License-Identifier: Apache-2.0
// The steps of findDiscrepancy: forward search with refinement, rivals, leftovers. Internal to core/discrepancy.
#pragma once

#include <string>
#include <vector>

#include "core/discrepancy/discrepancy.h"
#include "core/discrepancy/effect_search.h"

namespace spindrift {

/// Limits of the search. Parts are of power (chi-squared) unless they say "amplitude".
struct SearchLimits {
  double model_error = 0.08;       ///< amplitude: how far an accepted effect may be from the machine's own behaviour
  double container_margin = 0.01;  ///< part of an effect's power by which a container must be better to be named
  double rival_margin = 0.01;      ///< part of an effect's power within which another effect is a rival
  double smallest_part = 0.01;     ///< part of the power explained so far that a further effect must have
  double least_explained = 0.95;   ///< part of the structured power below which nothing is named
};

struct RivalFit {
  std::string id;
  double score = 0.0;
  bool container = false;
  JointFit joint;
};

struct TermEvidence {
  double delta_chi2 = 0.0;  ///< loss when it is taken out (others refitted)
  double delta_bic = 0.0;
  std::vector<RivalFit> rivals;  ///< containers included
  double margin = 1e9;           ///< score ahead of the best other effect that is no container
  EffectSearch::CrossValidation crossvalidation;
};

struct SearchOutcome {
  JointFit fit;
  std::vector<TermEvidence> evidence;
  std::vector<bool> forced;
  std::vector<DiscrepancyStep> steps;
  double chi2_before = 0.0;
  double chi2_after = 0.0;
  int dof_before = 0;
  double structured_power = 0.0;  ///< chi2_before beyond the noise
  double leftover_power = 0.0;
  double explained_fraction = 0.0;
  double leftover_p_value = 1.0;  ///< of the most structured part of what is left
  std::string leftover;           ///< sentence, if significant
  bool significant_before = false;
  std::vector<RivalFit> undriven;  ///< effects whose driver is not logged and whose shape fits what is left
};

[[nodiscard]] SearchOutcome searchEffects(EffectSearch& search, ResidualProblem& problem,
                                          const std::vector<NuisanceColumn>& base, const DiscrepancyOptions& options,
                                          const SearchLimits& limits, const JobContext& job);

/// The most significant structure in a whitened residual: common courses in time, gradients, single points.
struct StructureTest {
  double p_value = 1.0;  ///< for all tests together
  std::string description;
  Component component = Component::EX;
};
[[nodiscard]] StructureTest testStructure(const ResidualProblem& problem, const Eigen::VectorXd& residual);

/// Where the residual is larger than noise allows.
[[nodiscard]] std::vector<DisagreementPlace> findPlaces(const ResidualProblem& problem, const DriverTable& drivers,
                                                        const Eigen::VectorXd& residual);

/// What to measure to tell two fits apart, from the observations' points and times.
[[nodiscard]] std::optional<MeasurementSuggestion> suggestMeasurement(const DiscrepancyInput& input,
                                                                      const DriverTable& drivers,
                                                                      const ResidualProblem& problem,
                                                                      const JointFit& first, const JointFit& second,
                                                                      const std::string& separates, double log_n);

}  // namespace spindrift
