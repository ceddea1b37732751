// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/verdict.h"

#include <algorithm>

#include "core/base/text.h"

namespace spindrift {
namespace {

/// What is left speaks for a cause that is not among the effects.
bool unexplained(const SearchOutcome& outcome, const SearchLimits& limits) {
  // A noise model a little off makes everything scatter more than it should: that alone takes no name away.
  const bool left = outcome.leftover_p_value < limits.leftover_p;
  const bool part_left = outcome.explained_fraction < limits.least_explained;
  // Two effects on top of each other follow many courses nearly: then what they leave counts sooner.
  bool stacked = false;
  for (std::size_t t = 0; t < outcome.fit.terms.size(); ++t) stacked = stacked || overlaps(outcome.fit, t);
  const bool stacked_left = stacked && (left || (outcome.leftover_p_value < 0.01 && part_left));
  return stacked_left || (left && part_left) ||
         (left && (outcome.unknown_course.advantage > limits.unknown_advantage ||
                   outcome.unknown_course.smallest_part < limits.least_over_leftover)) ||
         outcome.onset_imitates || outcome.crowded || !outcome.composite.empty();
}

struct Alikes {
  bool any = false;              ///< an effect has a rival
  std::vector<std::string> ids;  ///< the first set of more than three effects that fit alike; empty: none
};

Alikes alikesOf(const SearchOutcome& outcome) {
  Alikes out;
  for (std::size_t t = 0; t < outcome.evidence.size(); ++t) {
    std::vector<std::string> set{outcome.fit.terms[t].effect->id};
    for (const RivalFit& r : outcome.evidence[t].rivals) {
      if (!r.container) set.push_back(r.id);
      out.any = out.any || !r.container || r.undecided;
    }
    if (set.size() > 3 && out.ids.empty()) out.ids = std::move(set);
  }
  return out;
}

/// The effects of the user alone, fitted again.
void keepForced(const EffectSearch& search, ResidualProblem& problem, const std::vector<NuisanceColumn>& base,
                JudgedOutcome& out) {
  JudgedOutcome kept;
  std::vector<ModelTerm> terms;
  for (std::size_t t = 0; t < out.named.terms.size(); ++t) {
    if (!out.forced[t]) continue;
    terms.push_back(out.named.terms[t]);
    kept.evidence.push_back(out.evidence[t]);
    kept.forced.push_back(true);
  }
  problem.setNuisances(base);
  out.named = terms.empty() ? JointFit{} : search.refine(terms, 1);
  out.evidence = std::move(kept.evidence);
  out.forced = std::move(kept.forced);
}

}  // namespace

JudgedOutcome judgeOutcome(const EffectSearch& search, ResidualProblem& problem,
                           const std::vector<NuisanceColumn>& base, const SearchOutcome& outcome,
                           const SearchLimits& limits) {
  JudgedOutcome out;
  out.named = outcome.fit;
  out.evidence = outcome.evidence;
  out.forced = outcome.forced;
  const bool nothing_fits = outcome.fit.terms.empty();
  const bool something_left = unexplained(outcome, limits);
  const Alikes alikes = alikesOf(outcome);
  if (something_left || nothing_fits || outcome.explained_fraction < 0.98) {
    out.leftover = outcome.leftover.empty() ? outcome.composite : outcome.leftover;
  }
  if (nothing_fits) {
    const bool structured = outcome.leftover_p_value < limits.leftover_p;
    out.verdict = structured ? DiscrepancyVerdict::Unknown : DiscrepancyVerdict::None;
    if (!structured) out.leftover.clear();
  } else if (something_left || !alikes.ids.empty()) {
    out.verdict = DiscrepancyVerdict::Unknown;
  } else {
    out.verdict = alikes.any ? DiscrepancyVerdict::Ambiguous : DiscrepancyVerdict::Named;
  }
  if (out.verdict == DiscrepancyVerdict::Unknown) {
    if (out.leftover.empty()) {
      out.leftover = !alikes.ids.empty()
                         ? "more effects fit equally well than could be named: " + joinedList(alikes.ids, "or")
                     : outcome.crowded || outcome.onset_imitates
                         ? "several effects together imitate what is left, none of them alone"
                         : "a part that no effect explains";
    }
    keepForced(search, problem, base, out);
  }
  return out;
}

}  // namespace spindrift
