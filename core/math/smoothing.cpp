// SPDX-License-Identifier: Apache-2.0
#include "core/math/smoothing.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/error.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// A symmetric matrix with two diagonals beside its own: [i] holds (i, i), (i + 1, i) and (i + 2, i).
using FiveDiagonals = std::vector<std::array<double, 3>>;

/// Sum of squared second divided differences, each times the time it stands for: a quadratic form of the readings;
/// times in units of `step`.
FiveDiagonals roughness(std::span<const double> time_s, double step) {
  FiveDiagonals form(time_s.size(), {0.0, 0.0, 0.0});
  for (std::size_t i = 0; i + 2 < time_s.size(); ++i) {
    const double before = (time_s[i + 1] - time_s[i]) / step;
    const double after = (time_s[i + 2] - time_s[i + 1]) / step;
    const double weight = std::sqrt(0.5 * (before + after));
    const double whole = before + after;
    const double first = weight * 2.0 / (before * whole);
    const double middle = -weight * 2.0 / (before * after);
    const double last = weight * 2.0 / (after * whole);
    form[i][0] += first * first;
    form[i][1] += first * middle;
    form[i][2] += first * last;
    form[i + 1][0] += middle * middle;
    form[i + 1][1] += middle * last;
    form[i + 2][0] += last * last;
  }
  return form;
}

/// Solves (1 + weight * form) x = y by the decomposition L D L^T, which has the same diagonals: a week of seconds in
/// some milliseconds. Not finite where the matrix is singular in floating point.
Eigen::VectorXd smoothed(const FiveDiagonals& form, double weight, const Eigen::VectorXd& y, FiveDiagonals& lower) {
  const std::size_t n = form.size();
  lower.resize(n);  // D, L(i + 1, i), L(i + 2, i)
  Eigen::VectorXd x(y.size());
  std::array<double, 3> one{0.0, 0.0, 0.0};  // the row before, and that before it
  std::array<double, 3> two{0.0, 0.0, 0.0};
  double x_one = 0.0;
  double x_two = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double d = 1.0 + weight * form[i][0] - one[1] * one[1] * one[0] - two[2] * two[2] * two[0];
    const std::array<double, 3> row{d, (weight * form[i][1] - one[0] * one[1] * one[2]) / d, weight * form[i][2] / d};
    const double value = y[static_cast<Index>(i)] - one[1] * x_one - two[2] * x_two;
    x[static_cast<Index>(i)] = value;
    lower[i] = row;
    two = one;
    one = row;
    x_two = x_one;
    x_one = value;
  }
  x_one = x_two = 0.0;
  for (std::size_t i = n; i-- > 0;) {
    const double value = x[static_cast<Index>(i)] / lower[i][0] - lower[i][1] * x_one - lower[i][2] * x_two;
    x[static_cast<Index>(i)] = value;
    x_two = x_one;
    x_one = value;
  }
  return x;
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
  const FiveDiagonals form = roughness(time_s, step);
  const auto n = static_cast<Index>(readings.size());
  const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(readings.data(), n);
  FiveDiagonals lower;
  constexpr Index stretch = 24;
  for (double h = most_bandwidth_s / step; h >= 0.7; h /= std::sqrt(2.0)) {
    const Eigen::VectorXd smooth = smoothed(form, std::pow(h, 4), y, lower);
    if (!smooth.allFinite() || !isNoise(y - smooth, out.noise, stretch)) continue;
    out.values.assign(smooth.data(), smooth.data() + n);
    out.bandwidth_s = h * step;
    break;
  }
  return out;
}

}  // namespace spindrift
