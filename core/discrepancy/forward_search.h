// SPDX-License-Identifier: Apache-2.0
// Which effects enter a model: one after the other, from several starts. Internal to core/discrepancy.
//
// An effect enters when its gain in chi-squared passes a union bound over everything tried, beyond the model error of
// what is already in, and when it predicts states that were left out. One wide effect (a rotation with a free origin)
// can imitate two narrow ones, and then no second effect seems to be missing; so the search also starts from the other
// effects that explain much, and the best model at the end counts, an additional name having to earn its place.
#pragma once

#include <string>
#include <vector>

#include "core/discrepancy/discrepancy_search.h"

namespace spindrift {

/// Both act through one and the same shape over the units.
[[nodiscard]] bool sameShape(const EffectSearch& search, const Effect& a, const Effect& b);
/// One shape and a driver in common: the same thing by two names, as the expansion of a table that turns.
[[nodiscard]] bool twoNamesOfOne(const EffectSearch& search, const Effect& a, const Effect& b);

/// True if `container` holds the effect `simple` (an id) as a special case.
[[nodiscard]] bool contains(const Effect& container, const std::string& simple);
[[nodiscard]] std::vector<std::string> idsOf(const std::vector<ModelTerm>& terms);

/// Nuisances of the simulation, and those of all terms of `fit` but `without`.
[[nodiscard]] std::vector<NuisanceColumn> nuisancesOf(const EffectSearch& search,
                                                      const std::vector<NuisanceColumn>& base, const JointFit& fit,
                                                      std::size_t without, double model_error);
/// Refines the dynamics of the terms from `from` on.
[[nodiscard]] JointFit refineDynamics(const EffectSearch& search, JointFit fit, std::size_t from,
                                      const std::vector<NuisanceColumn>& base);

/// Begins at a time that nothing in the log shows.
[[nodiscard]] bool hasOnset(const ModelTerm& term);

/// The least that one effect more must gain in chi-squared beside what the others of `fit` explain, of which they may
/// be wrong by a part: in all, and more so in the component in which it mainly acts. `further`: its contribution over
/// the units; `onset`: it begins at a time that nothing shows.
[[nodiscard]] double smallestGain(const EffectSearch& search, const ResidualProblem& problem, const JointFit& fit,
                                  const Eigen::VectorXd& further, bool onset, std::size_t without,
                                  const SearchLimits& limits);

/// Drivers of a term beyond those of the variant in the catalogue that comes closest.
[[nodiscard]] int foreignDrivers(const ModelTerm& term);

/// By how much in score a model must be ahead of one with fewer names. A further driver of an effect is as much of a
/// hypothesis as a further effect: a name that takes its place costs little.
[[nodiscard]] double priceOfNames(const JointFit& larger, const JointFit& smaller, const SearchLimits& limits);

/// The component in which an effect has its main part, by its contribution over the units.
[[nodiscard]] Component mainComponent(const ResidualProblem& problem, const Eigen::VectorXd& contribution);
/// How many effects have their main part in one and the same component, at most.
[[nodiscard]] int mostInOneComponent(const ResidualProblem& problem, const JointFit& fit);

class ForwardSearch {
 public:
  ForwardSearch(EffectSearch& search, ResidualProblem& problem, const std::vector<NuisanceColumn>& base,
                const DiscrepancyOptions& options, const SearchLimits& limits, const JobContext& job)
      : search_(&search), problem_(&problem), base_(&base), options_(&options), limits_(&limits), job_(&job) {}

  /// Extends `forced` (the effects that the user put in) to the best model.
  [[nodiscard]] JointFit run(JointFit forced, std::vector<DiscrepancyStep>& steps);

 private:
  /// Adds effects as long as one earns its place; the dynamics of those that are in are `refined` each time, or stay as
  /// the catalogue has them.
  [[nodiscard]] JointFit extend(JointFit current, bool refined, std::vector<DiscrepancyStep>& steps);
  /// One more effect; false: none earned its place.
  bool addBest(JointFit& current, bool refined, std::vector<DiscrepancyStep>& steps);
  /// Every effect on top of `current`, refinements of what is in left out, best first.
  [[nodiscard]] std::vector<CandidateFit> candidatesFor(const JointFit& current, bool refined);
  /// May another start find more than this model? It holds a wide effect, or something is left.
  [[nodiscard]] bool worthOtherStarts(const JointFit& fit) const;
  [[nodiscard]] bool better(const JointFit& challenger, const JointFit& champion) const;

  EffectSearch* search_;
  ResidualProblem* problem_;
  const std::vector<NuisanceColumn>* base_;
  const DiscrepancyOptions* options_;
  const SearchLimits* limits_;
  const JobContext* job_;
  std::size_t forced_count_ = 0;
  std::vector<CandidateFit> first_;  ///< candidates beside the effects of the user alone
};

}  // namespace spindrift
