// SPDX-License-Identifier: Apache-2.0
// What may be said of the outcome of a search: which effects are named, and what is left. Internal to core/discrepancy.
#pragma once

#include <string>
#include <vector>

#include "core/discrepancy/discrepancy_search.h"

namespace spindrift {

struct JudgedOutcome {
  DiscrepancyVerdict verdict = DiscrepancyVerdict::None;
  std::string leftover;  ///< sentence; empty: nothing is left
  /// The effects that may be named: all that were accepted, or, where the verdict is `unknown`, those of the user
  /// alone.
  JointFit named;
  std::vector<TermEvidence> evidence;  ///< of each
  std::vector<bool> forced;
};

/// A name beside something that nothing explains is worse than none: the verdict is `unknown` where what is left is
/// structured and too large for the model error of the effects, where an unknown course does better than they, where
/// effects on top of each other imitate one, and where more than three effects fit alike.
[[nodiscard]] JudgedOutcome judgeOutcome(const EffectSearch& search, ResidualProblem& problem,
                                         const std::vector<NuisanceColumn>& base, const SearchOutcome& outcome,
                                         const SearchLimits& limits);

}  // namespace spindrift
