// SPDX-License-Identifier: Apache-2.0
// Which effects are missing: a posterior over sets of effects. Internal to core/discrepancy.
//
// A set is scored by its evidence, twice the logarithm of its probability up to a constant:
//
//   evidence = - chi-squared - ln det(I + kappa^2 M'PM) - sum over effects of
//              [gains ln n + ln(ways of the effect) + 2 ln(effects of the catalogue) + 2 ln(odds against one more)
//               + chi-squared of what the simulation, or the other effects, may be off by where it acts]
//
// chi-squared is what remains under the noise as found (estimated beside one set, it favours that one: the next noise
// is estimated beside the set that is likeliest with noise of its own), marginal over all nuisances and over M, by
// which every effect may differ from the machine's own behaviour: another size at every point and in every span of
// time, a part kappa of it; with some probability also a smaller part in a component in which its formula has nothing.
// Sets are found by a beam search with joint refits of all lags and onsets and by exchanging every effect for every
// other; the probabilities of all sets that were visited are compared. For every effect of the best set the
// alternatives in its place are its rivals, their share of the probability is the confidence. Sources: Schwarz 1978;
// Kennedy and O'Hagan 2001 (model discrepancy); Madigan and Raftery 1994 (Occam's window); Wang, Sarkar, Carbonetto and
// Stephens 2020 (credible sets of single effects).
#pragma once

#include <array>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "core/discrepancy/candidate_library.h"
#include "core/discrepancy/discrepancy.h"

namespace spindrift {

/// What is believed before any data are seen.
struct DiscrepancyPriors {
  /// kappa: how far an effect of the catalogue is from what a machine does, as a part of its amplitude.
  double model_error = 0.09;
  /// Probability that an effect also moves a component in which its formula has nothing, in the course that it has (a
  /// table that drifts also tilts a little), of each way: the same at all places, or along X, Y or Z; by which part of
  /// its amplitude; and the lever by which a translation counts as a rotation, m.
  double crosstalk = 0.05;
  double crosstalk_error = 0.04;
  double crosstalk_lever_m = 0.4;
  /// Probability that an effect is missing at all (readings are taken because something is suspected), and that beside
  /// those found there is one more.
  double one_missing = 0.7;
  double one_more = 0.05;
  /// Odds of an effect whose main driver is not in the log, beside one that shows what drives it.
  double without_driver = 0.5;
  /// How far the course of what stands in for a driver that is not in the log (another temperature) is from the
  /// driver's, as a part of its amplitude, at any time.
  double stand_in_error = 0.4;
  /// Standard deviation of the relative error of a part of the simulation that is not worth a name; the same of a
  /// simulation all of whose parts are rough, how probable such a one is, and by how many of these deviations a part is
  /// off at most that is no more than rough: what is further off is missing, and told.
  double simulation_error = 0.028;
  double rough_simulation_error = 0.08;
  double rough_simulation = 0.60;
  double rough_simulation_limit = 2.75;
  /// Standard deviation of the relative error of one part alone that is far off, and how probable that is.
  double far_part_error = 0.3;
  double far_part = 0.25;
  /// Evidence (2 ln of the odds) by which an effect that holds a simpler one must be the more probable one: up to odds
  /// of 3 the data do not tell the two apart, and the simpler one is named (EFFECTS.md).
  double wider_lead = 2.2;
  /// Odds of an effect that refines another without holding it (a screw that is warmer where the nut travels), beside
  /// that one.
  double refined = 0.2;
  /// Odds of an effect that holds a simpler one as a special case, beside that one; and the part of its amplitude by
  /// which the simpler one may be off in just the way that the wider one can follow.
  double wider = 0.1;
  double wider_error = 0.06;
  double refinement_error = 0.14;  ///< the same of a refinement that holds it (a screw without a known origin)
  /// The same of two effects: part of the amplitude of the others, where and when it acts, that a further effect may
  /// imitate, so that one smaller than this needs more; of one that chooses its own onset.
  double further_error = 0.07;
  double further_onset_error = 0.12;
  /// Evidence (2 ln of the odds) from which on effects are believed in place of noise that is common to a state or
  /// follows itself in time: "very strong" (Kass and Raftery 1995, above 10), for it is looked for a second time.
  double instead_of_common_noise = 12.0;
  /// The same from which on a set is the likelier one because it is so beside noise of its own: "strong" (above 6).
  double beside_own_noise = 6.0;
  /// Standard deviation of the offset between the clocks of log and observations, s.
  double clock_s = 120.0;
  /// Probability that they are far apart: summer time, a clock that was never set.
  double far_clock = 0.02;
  /// An unknown cause leaves of an effect that imitates it this part of its amplitude, or more. What bodies do that
  /// exchange heat leaves less of the effect that stands for it.
  double imitation = 0.45;
  /// Of all names, however clear, so many are wrong: causes that look exactly like others.
  double unforeseen = 0.02;
};

/// An effect in the place of another.
struct Alternative {
  std::string id;
  double evidence = 0.0;     ///< of the set that has it
  double probability = 0.0;  ///< among all alternatives for this place, itself included
  bool container = false;    ///< holds the effect that it would replace as a special case
  bool contained = false;    ///< is held by it
  bool rejected = false;     ///< the user does not want it
  bool undriven = false;     ///< nothing that drives it is in the log: it cannot be fitted, nor told apart
  JointFit joint;
};

/// One effect of the best set.
struct SlotEvidence {
  double delta_chi2 = 0.0;      ///< loss when it is taken out, the others refitted
  double delta_evidence = 0.0;  ///< the same in evidence
  double probability = 0.0;     ///< of this effect among the alternatives
  /// 2 ln of the odds that there is an effect here, not noise and a smooth remainder made as large as needed: one thing
  /// more in either case, so that what one more costs is not counted.
  double over_unknown = 0.0;
  /// The same against noise alone, which costs nothing.
  double over_noise = 0.0;
  Component main = Component::EX;   ///< in which it is largest beside the noise
  std::vector<Alternative> others;  ///< most probable first
};

struct EffectPosterior {
  JointFit fit;
  std::vector<SlotEvidence> slots;
  std::vector<bool> forced;
  /// 2 ln of the odds of slots that share their main component (ascending) and not one unknown cause in their place; of
  /// every choice among those that share one.
  std::map<std::vector<std::size_t>, double> choice_over_unknown;
  double evidence = 0.0;
  double evidence_of_nothing = 0.0;
  /// 2 ln of the odds that these effects are there, all that were not put in by hand or by the simulation, and not
  /// noise and a smooth remainder made as large as needed; 0 without any.
  double over_unknown = 0.0;
  double price = 0.0;  ///< of all its effects, in 2 ln: their gains and what each pays for its choice
  /// Probability that an effect is in the set, of all that were looked at, most probable first; what the user rejected
  /// is among them.
  std::vector<std::pair<std::string, double>> candidates;
  std::vector<DiscrepancyStep> steps;
  /// Other sets that were looked at and are hardly less probable, most probable first.
  std::vector<JointFit> close;
};

/// What the effects leave that is neither noise nor nothing: smooth courses in time, of all points together and
/// of each for itself.
struct Remainder {
  struct OfComponent {
    Component component = Component::EX;
    double rms_um = 0.0;    ///< um or urad
    double evidence = 0.0;  ///< 2 ln of how much more probable it is than no remainder
    double power = 0.0;     ///< whitened squared norm
  };
  std::vector<OfComponent> components;
  std::vector<double> series_evidence;  ///< the same of a course that one series has beside the others
  Eigen::VectorXd values;               ///< posterior mean over the units, um or urad
};

/// 2 ln of the odds that there is something smooth beside the noise where `named` leaves more than `fit` does; infinite
/// where too few readings could tell.
[[nodiscard]] double smoothBesideNoise(const ResidualProblem& problem, const JointFit& fit, const JointFit& named);

/// -2 ln of the probability of the data with the effects of `fit` and the `price` of these (EffectPosterior::price), up
/// to a constant: beside noise and a smooth remainder made as large as needed, with the nuisances and the weights of
/// readings as the noise of `problem` has them. Tells answers apart that were found beside different noise.
[[nodiscard]] double answerDeviance(const ResidualProblem& problem, const JointFit& fit, double price);

class PosteriorSearch {
 public:
  PosteriorSearch(const EffectSearch& search, const ResidualProblem& problem, const CandidateLibrary& library,
                  const DiscrepancyOptions& options, const DiscrepancyPriors& priors, double simulation_error);

  /// `off`: a part of the simulation whose size is taken to be wrong, as the simulation has it; it is in the set from
  /// the start, and pays neither for the choice of its dynamics nor for errors that the simulation may have. `known`:
  /// sets found beside other noise, which are looked at as well.
  [[nodiscard]] EffectPosterior run(const JobContext& job, const ModelTerm* off = nullptr,
                                    const std::vector<std::vector<ModelTerm>>& known = {});
  /// The set of `posterior`, or the one of those close to it that is more probable by
  /// DiscrepancyPriors::beside_own_noise where each has the noise that it needs. The noise of the problem was found
  /// beside something else.
  [[nodiscard]] const JointFit& likeliestBesideItsOwnNoise(const EffectPosterior& posterior) const;
  /// Fills what every effect and all together are beside noise and a smooth remainder made as large as needed; what
  /// noise alone explains in `remainder` is none.
  void weighAgainstUnknown(EffectPosterior& posterior, Remainder& remainder) const;
  /// As above.
  [[nodiscard]] double evidenceOf(const JointFit& fit) const;
  /// What a fit leaves, and the columns that it has, its model error included.
  [[nodiscard]] CandidateLibrary::Given given(const JointFit& fit) const;

 private:
  struct State {
    JointFit fit;
    double evidence = 0.0;
  };
  [[nodiscard]] State stateOf(const std::vector<ModelTerm>& terms, int rounds) const;
  /// The terms and a candidate in its best way; where that goes through two lags, or turns out to be impossible with
  /// all lags refined, in the best of its other ways as well.
  [[nodiscard]] State stateWith(const std::vector<ModelTerm>& terms, const CandidateFit& candidate, int rounds) const;
  /// An effect whose driver acts through two lags, through one that delays it as much.
  [[nodiscard]] ModelTerm throughOneLag(const JointFit& fit, std::size_t t) const;
  /// An effect whose driver acts through two lags, where one says as much: lags that stand between those of the grid
  /// look like two of them.
  [[nodiscard]] State withFewerLags(State state, int rounds) const;
  /// Other names of what is in: the same pattern, and nothing drives either.
  void appendOtherNames(const std::vector<ModelTerm>& terms, std::vector<std::string>& ids) const;
  /// `state` and one more effect, the `most` best; on the grid, where lags are not refined yet, they promise `least`.
  [[nodiscard]] std::vector<State> extend(const State& state, std::size_t most, const JobContext& job,
                                          double least = std::numeric_limits<double>::lowest()) const;
  [[nodiscard]] State exchanged(State best, const JobContext& job, std::vector<State>& visited) const;
  [[nodiscard]] Eigen::MatrixXd modelErrorColumns(const JointFit& fit) const;
  /// What each term may do in components in which it does not act, a column for each way.
  [[nodiscard]] Eigen::MatrixXd crosstalkColumns(const JointFit& fit) const;
  [[nodiscard]] double priceOf(const JointFit& fit) const;
  /// With that of its gains.
  [[nodiscard]] double wholePriceOf(const JointFit& fit) const;
  /// What others may be off by, in just the way that each effect follows: chi-squared that it must bring beyond.
  [[nodiscard]] double imitationPrice(const JointFit& fit) const;
  /// What noise and steps of the sensors that drive a term leave in its course, a column for each time that this
  /// follows itself.
  void appendSensorErrors(const JointFit& fit, std::size_t t, std::vector<Eigen::VectorXd>& columns) const;
  [[nodiscard]] SlotEvidence slotOf(const State& best, std::size_t t, const JobContext& job,
                                    std::vector<State>& visited) const;

  const EffectSearch* search_;
  const ResidualProblem* problem_;
  const CandidateLibrary* library_;
  const DiscrepancyOptions* options_;
  DiscrepancyPriors priors_;
  std::string off_;                           ///< effect of the part of the simulation that is off; empty: none
  Eigen::MatrixXd place_patterns_;            ///< over the units: 1 and the coordinates in which places differ
  std::array<double, 6> simulation_power_{};  ///< of its error as estimated, whitened, per component
};

/// True if `container` holds `simple` as a special case.
[[nodiscard]] bool holdsEffect(const Effect& container, const std::string& simple);

[[nodiscard]] Remainder remainderOf(const ResidualProblem& problem, const CandidateLibrary::Given& given);

}  // namespace spindrift
