// SPDX-License-Identifier: Apache-2.0
#include "core/math/smoothing.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// Sum of squared second divided differences, each times the time it stands for: a quadratic form of the readings;
/// times in units of `step`.
Eigen::SparseMatrix<double> roughness(std::span<const double> time_s, double step) {
  const auto n = static_cast<Index>(time_s.size());
  Eigen::SparseMatrix<double> d(n - 2, n);
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i + 2 < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double before = (time_s[at + 1] - time_s[at]) / step;
    const double after = (time_s[at + 2] - time_s[at + 1]) / step;
    const double weight = std::sqrt(0.5 * (before + after));
    const double whole = before + after;
    entries.emplace_back(i, i, weight * 2.0 / (before * whole));
    entries.emplace_back(i, i + 1, -weight * 2.0 / (before * after));
    entries.emplace_back(i, i + 2, weight * 2.0 / (after * whole));
  }
  d.setFromTriplets(entries.begin(), entries.end());
  return d.transpose() * d;
}

/// What is taken away is noise: in all, and over every stretch of `stretch` readings, but for chance.
bool isNoise(const Eigen::VectorXd& taken, double noise, Index stretch) {
  const auto n = taken.size();
  const double variance = noise * noise;
  if (taken.squaredNorm() > variance * static_cast<double>(n)) return false;
  const auto count = static_cast<double>(std::min(stretch, n));
  const double most = variance * (count + 5.0 * std::sqrt(2.0 * count));
  double sum = 0.0;
  for (Index i = 0; i < n; ++i) {
    sum += taken[i] * taken[i];
    if (i >= stretch) sum -= taken[i - stretch] * taken[i - stretch];
    if (sum > most) return false;
  }
  return true;
}

}  // namespace

double noiseOfReadings(std::span<const double> readings) {
  if (readings.size() < 8) return 0.0;
  std::vector<double> third;
  double resolution = 0.0;
  for (std::size_t i = 0; i + 1 < readings.size(); ++i) {
    const double difference = std::abs(readings[i + 1] - readings[i]);
    if (difference > 1e-9 && (resolution == 0.0 || difference < resolution)) resolution = difference;
    if (i + 3 < readings.size()) {
      third.push_back(std::abs(readings[i + 3] - 3.0 * readings[i + 2] + 3.0 * readings[i + 1] - readings[i]));
    }
  }
  // Of readings that mostly stand still the differences are zero: they scatter less than they are rounded.
  const double scatter = 1.4826 * median(third) / std::sqrt(20.0);
  return scatter > 1e-9 ? scatter : resolution / std::sqrt(12.0);
}

SmoothedSignal smoothWithinNoise(std::span<const double> time_s, std::span<const double> readings,
                                 double most_bandwidth_s) {
  SPINDRIFT_ASSERT(time_s.size() == readings.size(), "a time for every reading");
  SmoothedSignal out;
  out.values.assign(readings.begin(), readings.end());
  out.noise = noiseOfReadings(readings);
  if (!(out.noise > 0.0)) return out;
  std::vector<double> steps;
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    if (!(time_s[i] > time_s[i - 1])) return out;
    steps.push_back(time_s[i] - time_s[i - 1]);
  }
  const double step = median(steps);
  const Eigen::SparseMatrix<double> penalty = roughness(time_s, step);
  const auto n = static_cast<Index>(readings.size());
  const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(readings.data(), n);
  Eigen::SparseMatrix<double> unit(n, n);
  unit.setIdentity();
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> ldlt;
  ldlt.analyzePattern(penalty + unit);
  constexpr Index stretch = 24;
  for (double h = most_bandwidth_s / step; h >= 0.7; h /= std::sqrt(2.0)) {
    ldlt.factorize(unit + std::pow(h, 4) * penalty);
    if (ldlt.info() != Eigen::Success) continue;
    const Eigen::VectorXd smooth = ldlt.solve(y);
    if (!smooth.allFinite() || !isNoise(y - smooth, out.noise, stretch)) continue;
    out.values.assign(smooth.data(), smooth.data() + n);
    out.bandwidth_s = h * step;
    break;
  }
  return out;
}

}  // namespace spindrift
