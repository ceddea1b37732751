// SPDX-License-Identifier: Apache-2.0
// From the posterior over sets of effects to the answer: which are named, with which rivals, how sure, what remains.
// Internal to core/discrepancy.
//
// Probability that a name is right =
//   share of the effect among all that could stand in its place, and 1 / (1 + n) for the n that the log cannot show
//   x probability that there is an effect in this place at all, and neither noise alone, made as large as it needs,
//     nor noise and something smooth that nobody knows
//   x probability that it does not merely imitate a cause outside the catalogue, from what it leaves in the components
//     in which it acts: with r = rms of the remainder / rms of the effect, 1 / (1 + (r / imitation)^4).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/discrepancy/effect_posterior.h"
#include "core/discrepancy/simulation_parts.h"

namespace spindrift {

/// One effect that is named.
struct NamedEffect {
  std::string id;
  std::vector<std::string> rivals;
  std::vector<std::string> containers;
  double confidence = 0.0;
  double delta_chi2 = 0.0;
  double delta_evidence = 0.0;
  double margin = 1e9;  ///< in evidence ahead of the most probable other
  bool forced = false;
  std::optional<JointFit> closest;  ///< the set with the closest rival that can be fitted, in the place of this one
};

struct Judgement {
  DiscrepancyVerdict verdict = DiscrepancyVerdict::None;
  JointFit named;  ///< the named effects, fitted together
  std::vector<NamedEffect> names;
  std::string leftover;
  std::vector<DiscrepancyStep> steps;
  std::vector<std::string> warnings;
  double explained_fraction = 0.0;
  /// Where nothing is named because noise alone explains what an effect was found for: that noise.
  std::optional<NoiseModel> noise;
};

/// What a fit leaves of the readings that were held out; readings far out count as some standard deviations.
struct HeldOutErrors {
  double rms_um = 0.0;       ///< NaN where there are too few
  std::vector<double> left;  ///< per row of the observations, um or urad; NaN where a row does not count
};
struct HeldOutCheck {
  std::function<HeldOutErrors(const JointFit&)> errors;
  /// How sure it is that the first leaves more than the second (probabilityOfLeavingMore).
  std::function<double(const HeldOutErrors&, const HeldOutErrors&)> leaves_more;
};

/// A name that makes the prediction of what was held out worse, beyond what chance does, is taken back: `held_out` may
/// only refuse. `parts`: of the simulation, as far as it may be rough; a weak name that one of them explains as well is
/// taken for its error.
[[nodiscard]] Judgement judge(const ResidualProblem& problem, const EffectSearch& search,
                              const EffectPosterior& posterior, const Remainder& remainder,
                              const std::vector<SimulationPart>& parts, const DiscrepancyPriors& priors,
                              const DiscrepancyOptions& options, const HeldOutCheck& held_out);

}  // namespace spindrift
