// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/told_noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/base/text.h"
#include "core/base/unit_text.h"

namespace spindrift {
namespace {

using Eigen::Index;

std::size_t at(Index unit) {
  return static_cast<std::size_t>(unit);
}

/// Components of which so many readings lie far from the others that they are no tail of the noise: gross errors, each
/// for itself, or something that they have in common.
void warnAboutOutliers(const ResidualProblem& problem, const Eigen::VectorXd& left,
                       std::vector<std::string>& warnings) {
  constexpr double too_many = 0.15;
  struct Share {
    std::vector<std::string> components;
    double readings = 0.0;
    double far = 0.0;
    [[nodiscard]] double percent() const { return 100.0 * far / readings; }
  };
  Share apart;
  Share in_common;
  for (const Component c : all_components) {
    std::vector<double> deviations;
    for (Index u = 0; u < problem.size(); ++u) {
      if (problem.component[static_cast<std::size_t>(u)] == c) deviations.push_back(left[u] / problem.sigma[u]);
    }
    if (deviations.size() < 20) continue;
    const auto count = static_cast<double>(deviations.size());
    const double part = partFarOff(std::move(deviations));
    if (part < too_many) continue;
    Share& share = problem.noise.of(c).gross_part > 0.0 ? apart : in_common;
    share.components.emplace_back(toString(c));
    share.readings += count;
    share.far += part * count;
  }
  if (!apart.components.empty())
    warnings.push_back(
        fmt::format("{:.0f} % of the readings of {} lie more than {:.0f} times as far off as the others and have "
                    "hardly any weight: check how they were taken before you rely on a named effect.",
                    apart.percent(), joinedList(apart.components), far_off));
  if (!in_common.components.empty())
    warnings.push_back(
        fmt::format("{:.0f} % of the readings of {} lie more than {:.0f} times as far off as the others: too many to "
                    "be down-weighted; check how they were taken before you rely on a named effect.",
                    in_common.percent(), joinedList(in_common.components), far_off));
}

double driftOf(const ComponentNoise& n) {
  return std::sqrt(n.drift_part) * n.common;
}

/// What is taken for a drift of the instrument, for the machine might have moved so. More than an instrument drifts is
/// told with what remains.
void tellDrift(Component c, const ComponentNoise& n, std::vector<std::string>& warnings) {
  constexpr double s_per_min = 60.0;
  if (!(n.drift_part > 0.0)) return;
  warnings.push_back(
      fmt::format("{} of all points drifts together by {:.2f} {} rms, with a correlation time of {:.0f} "
                  "min: it is taken for a drift of the instrument.",
                  toString(c), driftOf(n), printedUnit(unitOf(c)), n.drift_time_s / s_per_min));
}

void tellScales(const ResidualProblem& problem, DiscrepancyResult& result) {
  const std::vector<Component> beyond = movedTogether(problem, problem.noise);
  result.tail_dof = problem.noise.heaviestTails();
  for (const Component c : std::set<Component>(problem.component.begin(), problem.component.end())) {
    const ComponentNoise& n = problem.noise.of(c);
    const double tails = std::sqrt(n.varianceOfStudent());
    const double scale = n.scale * tails;
    result.noise.push_back({c, scale, n.scale_uncertainty * tails, n.common, n.correlated_part, n.correlation_time_s,
                            driftOf(n), n.drift_time_s});
    if (std::find(beyond.begin(), beyond.end(), c) == beyond.end()) tellDrift(c, n, result.warnings);
    if (scale >= 0.8 && scale <= 1.25) continue;
    const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(scale))), 0, 9);  // two digits count
    result.warnings.push_back(fmt::format("{} scatters {:.{}f} times as much as its stated σ; it is used as found.",
                                          toString(c), scale, decimals));
  }
}

/// Takes the constant of every series off `left`: weighted means.
void takeConstants(const ResidualProblem& problem, const Eigen::VectorXd& weight, Eigen::VectorXd& left) {
  if (!problem.free_constants) return;
  for (int s = 0; s < problem.seriesCount(); ++s) {
    const Index from = problem.series_begin[static_cast<std::size_t>(s)];
    const Index count = problem.series_begin[static_cast<std::size_t>(s) + 1] - from;
    const auto w = weight.segment(from, count);
    left.segment(from, count).array() -= w.dot(left.segment(from, count)) / w.sum();
  }
}

struct Shift {
  double value = 0.0;
  double precision = 0.0;
};
using Shifts = std::map<std::pair<Component, int>, Shift>;

/// Takes the shift of every state off `left`: weighted means, shrunk to their prior; adds them to `shifts`.
void takeShifts(const ResidualProblem& problem, const Eigen::VectorXd& weight, Eigen::VectorXd& left, Shifts& shifts) {
  std::map<std::pair<Component, int>, std::array<double, 2>> sums;
  for (Index u = 0; u < problem.size(); ++u) {
    const Component c = problem.component[at(u)];
    if (!(problem.noise.of(c).common > 0.0)) continue;
    auto& [sum, total] = sums[{c, problem.epoch[at(u)]}];
    sum += weight[u] * left[u];
    total += weight[u];
  }
  std::map<std::pair<Component, int>, double> taken;
  for (const auto& [key, sum] : sums) {
    const double precision = sum[1] + 1.0 / std::pow(problem.noise.of(key.first).common, 2);
    taken[key] = sum[0] / precision;
    Shift& shift = shifts[key];
    shift.value += taken[key];
    shift.precision = precision;
  }
  for (Index u = 0; u < problem.size(); ++u) {
    const auto found = taken.find({problem.component[at(u)], problem.epoch[at(u)]});
    if (found != taken.end()) left[u] -= found->second;
  }
}

void tellOutliers(const ResidualProblem& problem, const Eigen::VectorXd& left, DiscrepancyResult& result) {
  for (Index u = 0; u < problem.size(); ++u) {
    const double z = left[u] / problem.ownSigma(u);
    if (std::abs(z) >= far_off && problem.unit_rows[at(u)].size() == 1)
      result.outliers.push_back({problem.unit_rows[at(u)].front(), z});
  }
  if (result.outliers.empty()) return;
  std::sort(result.outliers.begin(), result.outliers.end(),
            [](const OutlyingReading& a, const OutlyingReading& b) { return a.row < b.row; });
  std::vector<std::string> names;
  for (const OutlyingReading& o : result.outliers) names.push_back(fmt::format("row {}", o.row + 1));
  const bool one = names.size() == 1;
  result.warnings.push_back(fmt::format("{} {} far from all others and {} little weight: {}.",
                                        one ? "1 reading" : fmt::format("{} readings", names.size()),
                                        one ? "lies" : "lie", one ? "has" : "have", shortenedList(names, 6, 5)));
}

}  // namespace

void tellNoise(const ResidualProblem& problem, const JointFit& fit, const Remainder& remainder,
               const std::vector<Observation>& rows, DiscrepancyResult& result) {
  tellScales(problem, result);
  Eigen::VectorXd left = problem.without(fit.contribution) - remainder.values;
  left -= problem.nuisancePart(left).values;
  Eigen::VectorXd weight(problem.size());
  for (Index u = 0; u < problem.size(); ++u)
    weight[u] = (problem.noise.weight.size() == 0 ? 1.0 : problem.noise.weight[u]) / std::pow(problem.ownSigma(u), 2);
  Shifts shifts;
  // Constants and shifts share what is common to all: a few passes settle it.
  for (int pass = 0; pass < 3; ++pass) {
    takeConstants(problem, weight, left);
    takeShifts(problem, weight, left, shifts);
  }
  std::vector<std::string> state(static_cast<std::size_t>(problem.epoch_count));
  for (Index u = problem.size() - 1; u >= 0; --u)
    state[static_cast<std::size_t>(problem.epoch[at(u)])] = rows[problem.unit_rows[at(u)].front()].state;
  for (const auto& [key, shift] : shifts) {
    const auto epoch = static_cast<std::size_t>(key.second);
    result.shifts.push_back(
        {state[epoch], key.first, problem.epoch_time_s[epoch], shift.value, 1.0 / std::sqrt(shift.precision)});
  }
  warnAboutOutliers(problem, left, result.warnings);
  tellOutliers(problem, left, result);
  result.remaining.assign(rows.size(), 0.0);
  for (Index u = 0; u < problem.size(); ++u) {
    for (const std::size_t row : problem.unit_rows[at(u)]) result.remaining[row] = remainder.values[u];
  }
  for (const Remainder::OfComponent& r : remainder.components)
    result.remainder.push_back({r.component, r.rms_um, r.evidence});
}

}  // namespace spindrift
