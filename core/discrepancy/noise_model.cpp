// SPDX-License-Identifier: Apache-2.0
// What a noise model says: its shifts of states, its tails.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/discrepancy/residual_problem.h"
#include "core/math/distributions.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// Standard deviation of the own noise of readings of a component, um or urad; nothing where there are none.
std::optional<double> scatterOf(const ResidualProblem& problem, const NoiseModel& noise, Component c) {
  double own = 0.0;
  double count = 0.0;
  for (Index u = 0; u < problem.size(); ++u) {
    if (problem.component[static_cast<std::size_t>(u)] != c) continue;
    own += std::pow(problem.reading_sigma[u] * noise.of(c).scale, 2);
    count += 1.0;
  }
  if (!(count > 0.0)) return std::nullopt;
  return std::sqrt(noise.of(c).varianceOfTails() * own / count);
}

/// Components for which `is` is true of their noise and the standard deviation of the own noise of their readings.
template <typename Is>
std::vector<Component> componentsWhose(const ResidualProblem& problem, const NoiseModel& noise, const Is& is) {
  std::vector<Component> out;
  for (const Component c : all_components) {
    const std::optional<double> own = scatterOf(problem, noise, c);
    if (own && is(noise.of(c), *own)) out.push_back(c);
  }
  return out;
}

}  // namespace

Eigen::MatrixXd shiftFactor(const std::vector<double>& time_s, double drift_part, double drift_time_s) {
  const auto n = static_cast<Index>(time_s.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(n, n);
  if (!(drift_part > 0.0) || n < 2) return covariance;
  Eigen::MatrixXd drift(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const double dt_s = std::abs(time_s[static_cast<std::size_t>(i)] - time_s[static_cast<std::size_t>(j)]);
      drift(i, j) = std::exp(-dt_s / drift_time_s);
    }
  }
  // Independent shifts vary about the mean of n of them by 1 - 1 / n, these by less.
  const double about_mean = (1.0 - drift.mean()) / (1.0 - 1.0 / static_cast<double>(n));
  constexpr double rounding = 1e-9;  // states at one time
  if (!(about_mean > rounding)) return covariance;
  covariance *= 1.0 - drift_part + rounding;
  covariance += drift_part / about_mean * drift;
  return covariance.llt().matrixL();
}

double ComponentNoise::shiftsBeyond(double own) const noexcept {
  const double drift = drift_part * common * common - std::pow(largest_drift * own, 2);
  const double reference = (1.0 - drift_part) * common * common - std::pow(largest_reference_shift * own, 2);
  return std::max(0.0, drift) + std::max(0.0, reference);
}

bool driftsOfAll(const NoiseModel& noise) {
  return std::any_of(noise.component.begin(), noise.component.end(),
                     [](const ComponentNoise& n) { return n.largest_drift > largest_drift_shift; });
}

NoiseModel asInstrumentsDrift(const ResidualProblem& problem, NoiseModel noise) {
  for (const Component c : all_components) {
    ComponentNoise& n = noise.of(c);
    if (!(n.drift_part > 0.0)) continue;
    const std::optional<double> own = scatterOf(problem, noise, c);
    if (!own) continue;
    const double drift = std::min(n.drift_part * n.common * n.common, std::pow(n.largest_drift * *own, 2));
    const double reference = (1.0 - n.drift_part) * n.common * n.common;
    n.common = std::sqrt(drift + reference);
    n.drift_part = n.common > 0.0 ? drift / (n.common * n.common) : 0.0;
  }
  return noise;
}

double partFarOff(std::vector<double> deviations) {
  if (deviations.empty()) return 0.0;
  for (double& x : deviations) x = std::abs(x);
  std::sort(deviations.begin(), deviations.end());
  const double sigma = deviations[deviations.size() / 4] / normalQuantile(0.75);
  const auto beyond = deviations.end() - std::upper_bound(deviations.begin(), deviations.end(), far_off * sigma);
  return static_cast<double>(beyond) / static_cast<double>(deviations.size());
}

double ComponentNoise::varianceOfStudent() const noexcept {
  return tail_dof > 2.0 ? tail_dof / (tail_dof - 2.0) : 1.0;
}

double ComponentNoise::varianceOfTails() const noexcept {
  const double dof = std::max(4.0, tail_dof);
  return tail_dof > 0.0 ? dof / (dof - 2.0) : 1.0;
}

double NoiseModel::heaviestTails() const noexcept {
  double out = 0.0;
  for (const ComponentNoise& n : component) {
    if (n.tail_dof > 0.0 && (!(out > 0.0) || n.tail_dof < out)) out = n.tail_dof;
  }
  return out;
}

std::vector<Component> movedTogether(const ResidualProblem& problem, const NoiseModel& noise) {
  return componentsWhose(problem, noise, [](const ComponentNoise& n, double own) { return n.shiftsBeyond(own) > 0.0; });
}

std::vector<Component> doubtfulNoise(const ResidualProblem& problem, const NoiseModel& noise) {
  return componentsWhose(problem, noise, [](const ComponentNoise& n, double own) {
    return n.common * n.common + n.correlated_part * own * own > std::pow(doubtful_common * own, 2);
  });
}

}  // namespace spindrift
