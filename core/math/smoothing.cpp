// SPDX-License-Identifier: Apache-2.0
#include "core/math/smoothing.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/error.h"
#include "core/base/random.h"
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

/// What is taken away is noise: in all, up to `allowed` standard deviations of its sum of squares, and over every
/// stretch of `stretch` readings, but for chance.
bool isNoise(const Eigen::VectorXd& taken, double noise, double allowed, Index stretch) {
  const auto n = taken.size();
  const double variance = noise * noise;
  const auto all = static_cast<double>(n);
  if (taken.squaredNorm() > variance * (all + allowed * std::sqrt(2.0 * all))) return false;
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

/// The smallest step between neighbours; 0 where none differ.
double resolutionOf(std::span<const double> readings) {
  double resolution = 0.0;
  for (std::size_t i = 0; i + 1 < readings.size(); ++i) {
    const double difference = std::abs(readings[i + 1] - readings[i]);
    if (difference > 1e-9 && (resolution == 0.0 || difference < resolution)) resolution = difference;
  }
  return resolution;
}

/// Time over which the correlation of `errors` (about zero) falls to 1/e, in steps.
double correlationSteps(const Eigen::VectorXd& errors) {
  const double power = errors.squaredNorm();
  const Index n = errors.size();
  const double least = std::exp(-1.0);
  double before = 1.0;
  for (Index lag = 1, last = 0; lag < n / 2; last = lag, lag = std::max(lag + 1, lag * 5 / 4)) {
    const double here = errors.head(n - lag).dot(errors.tail(n - lag)) / power;
    if (here < least)
      return static_cast<double>(last) + static_cast<double>(lag - last) * (before - least) / (before - here);
    before = here;
  }
  return 0.5 * static_cast<double>(n);
}

/// The error of what is smooth: of copies of it with the same noise, rounded and smoothed in the same way. Of long
/// signals a part in the middle stands for all.
void findError(std::span<const double> time_s, std::span<const double> readings, SmoothedSignal& signal, double step) {
  constexpr std::size_t most_rows = 8192;
  const std::size_t rows = std::min(most_rows, readings.size());
  const std::size_t first = (readings.size() - rows) / 2;
  const FiveDiagonals form = roughness(time_s.subspan(first, rows), step);
  const auto n = static_cast<Index>(rows);
  const Eigen::VectorXd smooth = Eigen::Map<const Eigen::VectorXd>(signal.values.data() + first, n);
  const double resolution = resolutionOf(readings);
  const double white = std::sqrt(std::max(0.0, signal.noise * signal.noise - resolution * resolution / 12.0));
  const double weight = std::pow(signal.bandwidth_s / step, 4);
  constexpr int copies = 4;
  double power = 0.0;
  double steps_alike = 0.0;
  FiveDiagonals lower;
  Random random(0x5eed);
  for (int copy = 0; copy < copies; ++copy) {
    // The steps of the copies lie elsewhere: the smooth signal has found a way along those of the readings.
    const double phase = (static_cast<double>(copy) + random.uniform()) / copies * resolution;
    Eigen::VectorXd read(n);
    for (Index i = 0; i < n; ++i) {
      const double value = smooth[i] + white * random.normal();
      read[i] = resolution > 0.0 ? std::round((value - phase) / resolution) * resolution + phase : value;
    }
    const Eigen::VectorXd errors = (weight > 0.0 ? smoothed(form, weight, read, lower) : read) - smooth;
    if (!errors.allFinite() || !(errors.squaredNorm() > 0.0)) continue;
    power += errors.squaredNorm() / static_cast<double>(n * copies);
    steps_alike += correlationSteps(errors) / copies;
  }
  signal.error = std::sqrt(power);
  signal.error_time_s = steps_alike * step;
}

}  // namespace

double noiseOfReadings(std::span<const double> readings) {
  if (readings.size() < 8) return 0.0;
  const std::size_t n = readings.size();
  std::vector<double> third;
  for (std::size_t i = 0; i + 3 < n; ++i)
    third.push_back(std::abs(readings[i + 3] - 3.0 * readings[i + 2] + 3.0 * readings[i + 1] - readings[i]));
  const double middle = median(third);
  const double resolution = resolutionOf(readings);
  if (middle > 2.0 * resolution) return 1.4826 * middle / std::sqrt(20.0);
  if (middle > 0.5 * resolution) {
    // A few multiples of the resolution: their mean, without the farthest, is finer than their median.
    double sum = 0.0;
    for (const double difference : third) sum += std::min(difference, 5.0 * middle);
    return sum / static_cast<double>(third.size()) * std::sqrt(std::numbers::pi / 2.0) / std::sqrt(20.0);
  }
  // Rounded so coarsely that most neighbours are the same. They differ, in the mean, by as much as before they were
  // rounded; what of that leads anywhere over two dozen readings is the signal's.
  const std::size_t far = std::min<std::size_t>(24, n / 2);
  double near = 0.0;
  for (std::size_t i = 0; i + 1 < n; ++i)
    near += std::min(4.0 * resolution, std::abs(readings[i + 1] - readings[i])) / static_cast<double>(n - 1);
  double led = 0.0;
  for (std::size_t i = 0; i + far < n; ++i)
    led += std::abs(readings[i + far] - readings[i]) / static_cast<double>(far * (n - far));
  const double apart = std::max(0.0, near - led) / (1.0 - 1.0 / static_cast<double>(far));
  const double white = apart * std::sqrt(std::numbers::pi) / 2.0;
  return std::hypot(white, resolution / std::sqrt(12.0));
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
  // The noise of coarsely rounded readings is not known well enough to stop the smoother at a hair's breadth.
  const double allowed = resolutionOf(readings) > 0.5 * out.noise ? 3.0 : 0.0;
  for (double h = most_bandwidth_s / step; h >= 0.7; h /= std::sqrt(2.0)) {
    const Eigen::VectorXd smooth = smoothed(form, std::pow(h, 4), y, lower);
    if (!smooth.allFinite() || !isNoise(y - smooth, out.noise, allowed, stretch)) continue;
    out.values.assign(smooth.data(), smooth.data() + n);
    out.bandwidth_s = h * step;
    break;
  }
  findError(time_s, readings, out, step);
  return out;
}

}  // namespace spindrift
