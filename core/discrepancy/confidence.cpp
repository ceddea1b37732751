// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/discrepancy/discrepancy_search.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// Whitened power that all effects explain together where effect `t` acts, with and without its own part.
std::pair<double, double> powerBeside(const ResidualProblem& problem, const JointFit& fit, std::size_t t) {
  const Eigen::ArrayXd weight = (problem.sigma * problem.noise.scale).array().inverse();
  const Eigen::ArrayXd own = (fit.contribution[t].array() * weight).square();
  const double largest = own.maxCoeff();
  double all = 0.0;
  double others = 0.0;
  Eigen::ArrayXd beside = Eigen::ArrayXd::Zero(own.size());
  for (std::size_t k = 0; k < fit.terms.size(); ++k) {
    if (k != t) beside += fit.contribution[k].array() * weight;
  }
  for (Index u = 0; u < own.size(); ++u) {
    if (own[u] < 1e-6 * largest) continue;
    all += own[u];
    others += beside[u] * beside[u];
  }
  return {all + others, others};
}

}  // namespace

double confidenceOf(const ResidualProblem& problem, const SearchOutcome& outcome, const TermEvidence& evidence,
                    const JointFit& named, std::size_t t) {
  const double dof = std::max(1.0, static_cast<double>(outcome.dof_before - outcome.fit.parameter_count));
  const double left = outcome.chi2_after - dof - std::sqrt(2.0 * dof);
  const double error = std::max(0.05 * 0.05, left / std::max(1.0, outcome.chi2_before - outcome.chi2_after));
  const auto [all, others] = powerBeside(problem, named, t);
  const double among = 1.0 / (1.0 + 0.25 * error * all);
  const double beside = 1.0 / (1.0 + 0.25 * error * others);
  double odds = 0.0;
  for (const auto& [behind, nested] : evidence.behind) {
    odds += std::exp(-0.5 * (nested ? 1.0 : among) * std::max(0.0, behind));
  }
  for (const RivalFit& r : evidence.rivals) odds += r.undriven ? 0.6 : 0.0;
  odds += std::exp(-0.5 * beside * evidence.delta_bic);
  odds += std::exp(0.5 * among * std::min(0.0, outcome.unknown_course.advantage));
  constexpr double prior_of_alternatives = 0.3;
  return std::clamp(1.0 / (1.0 + prior_of_alternatives * odds), 0.02, 0.995);
}

}  // namespace spindrift
