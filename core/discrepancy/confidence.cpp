// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/discrepancy/discrepancy_search.h"

namespace spindrift {
namespace {

/// Of causes that look like a special case of a wider effect as well as like it, how many are the wider one: found on
/// virtual campaigns (hidden_effect_study, seeds 51 and 52).
constexpr double prior_of_wider = 0.05;
/// Of names given, how many hide a cause outside the catalogue: from the same campaigns.
constexpr double prior_of_outside = 0.005;

/// Largest odds against a hypothesis that a p-value allows (Sellke, Bayarri and Berger 2001).
double largestOdds(double p) {
  const double value = std::max(p, 1e-12);
  return value < std::exp(-1.0) ? 1.0 / (-std::exp(1.0) * value * std::log(value)) : 1.0;
}

}  // namespace

double confidenceOf(const SearchOutcome& outcome, const TermEvidence& evidence, const JointFit& named, std::size_t t,
                    const SearchLimits& limits) {
  const double wider = 20.0 / std::max(20.0, limits.container_margin * evidence.delta_chi2);
  const double other = 12.0 / std::max(12.0, limits.rival_margin * evidence.delta_chi2);
  double odds = 0.0;
  for (const auto& [behind, nested] : evidence.behind) {
    odds += nested ? prior_of_wider * std::exp(-0.5 * wider * std::max(behind, -24.0 / wider))
                   : std::exp(-0.5 * other * std::max(0.0, behind));
  }
  for (const RivalFit& r : evidence.rivals) odds += r.undriven ? 1.0 : 0.0;
  odds += std::exp(-0.5 * std::max(0.0, evidence.delta_bic));
  // What one effect leaves is the error of its dynamics; what two leave that move the same readings may as well be
  // what they cannot imitate of a third cause.
  const double outside = prior_of_outside * (overlaps(named, t) ? largestOdds(outcome.leftover_p_value) : 1.0) +
                         std::exp(0.5 * std::min(0.0, outcome.unknown_course.advantage));
  return std::clamp(1.0 / (1.0 + odds + outside), 0.02, 0.995);
}

}  // namespace spindrift
