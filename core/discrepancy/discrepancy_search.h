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
  double leftover_error = 0.10;    ///< the same, where it is decided whether what is left speaks for an unknown cause
  double container_margin = 0.01;  ///< part of an effect's power by which a container must be better to be named
  double contained_part = 0.05;    ///< part of the power that an effect beside one that contains it must bring
  double equal_margin = 0.0015;    ///< the same, within which all rivals count, however many
  double shape_part = 0.05;        ///< part of a wide effect's power that its wider shape must bring
  double undecided_margin = 2.0;   ///< in BIC: "not worth more than a bare mention" (Kass and Raftery 1995)
  double rival_margin = 0.01;      ///< part of an effect's power within which another effect is a rival
  double smallest_part = 0.01;     ///< part of the power explained so far that a further effect must have
  double smallest_in_component = 0.03;  ///< the same, of the power in the component in which it mainly acts
  double smallest_with_onset = 0.075;   ///< the same, where a free onset can follow what another effect misses
  double least_explained = 0.985;  ///< part of the structured power below which nothing is named that leaves structure
  double unknown_advantage = 0.0;  ///< in BIC, by which an unknown course may be better than the effects named
  double leftover_p = 1e-3;        ///< p-value below which what is left is structured, not chance
  double least_over_leftover = 0.8;  ///< an effect's power beside what is left in its component
  double start_part = 0.2;           ///< of the best effect's power that another start must have
  double start_margin = 0.004;       ///< part of the power that each name more must add when starts are compared
  std::size_t most_starts = 6;       ///< other starts that are followed
  int most_in_one_component = 2;     ///< effects; more of them imitate any course
};

struct RivalFit {
  std::string id;
  double score = 0.0;
  bool container = false;
  JointFit joint;
  bool undriven = false;   ///< its driver is not logged: it cannot be fitted, nor told apart
  bool undecided = false;  ///< a container that fits as well, its further parameters paid: a rival all the same
  double ahead = 0.0;      ///< in score, of the effect it would replace
};

struct TermEvidence {
  double delta_chi2 = 0.0;  ///< loss when it is taken out (others refitted)
  double delta_bic = 0.0;
  std::vector<RivalFit> rivals;  ///< containers included
  double margin = 1e9;           ///< score ahead of the best other effect that is no container
  /// Of every other effect that was tried in its place, in score; and whether one of the two holds the other.
  std::vector<std::pair<double, bool>> behind;
  EffectSearch::CrossValidation crossvalidation;
};

/// What an accepted effect explains, whitened, over the units.
struct NamedPart {
  Eigen::VectorXd explained;
  int parameter_count = 0;
};

/// The rival of all names: a pattern in space and a course in time that nothing in the catalogue has.
struct UnknownCourse {
  double advantage = 0.0;      ///< in BIC over the accepted effects of a component; positive: nothing should be named
  double smallest_part = 1e9;  ///< of an accepted effect's power beside what is left in its component
  bool cancelling = false;     ///< an effect is much larger than all effects of its component together
  Component component = Component::EX;
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
  double explained_fraction = 0.0;
  double leftover_p_value = 1.0;  ///< of the most structured part of what is left
  std::string leftover;           ///< sentence, if significant
  bool significant_before = false;
  UnknownCourse unknown_course;
  bool onset_imitates = false;  ///< effects that begin at times that nothing shows imitate another course
  bool crowded = false;         ///< more effects in one component than can be told from an unknown course
  std::string composite;        ///< sentence: two of the effects together look like one whose driver is not logged
};

[[nodiscard]] SearchOutcome searchEffects(EffectSearch& search, ResidualProblem& problem,
                                          const std::vector<NuisanceColumn>& base, const DiscrepancyOptions& options,
                                          const SearchLimits& limits, const JobContext& job);

/// Probability that the largest gain over all onsets (and lengths and lags) of this effect is as large by chance. BIC
/// is not valid where an onset is searched; the distribution of the maximum comes from a parametric bootstrap: 120
/// draws of the noise as it was estimated (white once whitened, so correlation in time is in it; seeded), the same
/// search over all onsets on each, and a Gumbel tail fitted to the maxima. Sources: Davies 1987; Gumbel 1958.
[[nodiscard]] double onsetPValue(const EffectSearch& search, const ResidualProblem& problem,
                                 const CandidateFit& candidate);

/// Another effect of the fit moves the same readings as effect `t`.
[[nodiscard]] bool overlaps(const JointFit& fit, std::size_t t);

/// The most significant structure in a whitened residual: common courses in time, gradients, single points.
struct StructureTest {
  double p_value = 1.0;  ///< for all tests together
  std::string description;
  Component component = Component::EX;
};
[[nodiscard]] StructureTest testStructure(const ResidualProblem& problem, const Eigen::VectorXd& residual);

/// Compares the accepted effects, component by component, with an unknown cause: one free course in time common to all
/// points, or one free pattern over the points times a free course, E + P - 2 parameters. Of the leftover, what the
/// effects may be wrong by (`model_error` of their amplitude) does not count.
[[nodiscard]] UnknownCourse testUnknownCourse(const ResidualProblem& problem, const Eigen::VectorXd& residual,
                                              const std::vector<NamedPart>& parts, double model_error, double log_n);

/// Probability that the name is right: posterior of the effect over all that were tried in its place, over its being no
/// effect at all, and over a cause that is not in the catalogue, from their scores (BIC).
///
///   p = 1 / (1 + sum exp(-T_i behind_i / 2) + w sum exp(-T_j behind_j / 2) + u + exp(-gain / 2) + o B(leftover))
///
/// Scores take the model for true; it is off by a part of what it explains, and evidence is tempered by T, the margin
/// in score of the noise alone over the one that the search keeps for such errors (SearchLimits). Names weigh alike
/// before the evidence; effects j that hold the named one as a special case, or are held by it, weigh w, the part of
/// such campaigns in which the wider one is the cause. u counts effects of the same shape whose driver the log lacks,
/// so that nothing tells them apart. A cause outside the catalogue has the odds o, times the largest odds B that what
/// is left allows where several effects move the same readings. w and o were found on virtual campaigns; that
/// confidence is right as often as it says is shown on others (hidden_effect_study).
[[nodiscard]] double confidenceOf(const SearchOutcome& outcome, const TermEvidence& evidence, const JointFit& named,
                                  std::size_t t, const SearchLimits& limits);

/// Where the residual is larger than noise allows.
[[nodiscard]] std::vector<DisagreementPlace> findPlaces(const ResidualProblem& problem, const DriverTable& drivers,
                                                        const Eigen::VectorXd& residual);

/// What to measure to tell two fits apart: the places (points measured, corners of the travel) and times of the log at
/// which they differ most beyond what the second could take up by fitting it again.
[[nodiscard]] std::optional<MeasurementSuggestion> suggestMeasurement(const DiscrepancyInput& input,
                                                                      const DriverTable& drivers,
                                                                      const EffectSearch& search,
                                                                      const ResidualProblem& problem,
                                                                      const JointFit& first, const JointFit& second,
                                                                      const std::string& separates, double log_n);

}  // namespace spindrift
