// SPDX-License-Identifier: Apache-2.0
#include "core/math/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/error.h"

namespace spindrift {

double mean(std::span<const double> values) {
  if (values.empty()) return 0.0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double standardDeviation(std::span<const double> values) {
  if (values.size() < 2) return 0.0;
  const double centre = mean(values);
  double sum = 0.0;
  for (const double v : values) sum += (v - centre) * (v - centre);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

double rootMeanSquare(std::span<const double> values) {
  if (values.empty()) return 0.0;
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double median(std::vector<double> values) {
  return quantile(std::move(values), 0.5);
}

double quantile(std::vector<double> values, double p) {
  SPINDRIFT_ASSERT(!values.empty() && p >= 0.0 && p <= 1.0, "quantile of nothing or outside 0..1");
  const double position = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(below), values.end());
  const double low = values[below];
  if (below + 1 >= values.size()) return low;
  const double high = *std::min_element(values.begin() + static_cast<std::ptrdiff_t>(below) + 1, values.end());
  return low + (position - static_cast<double>(below)) * (high - low);
}

double robustSigma(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const double centre = median(values);
  std::vector<double> deviation(values.size());
  std::transform(values.begin(), values.end(), deviation.begin(), [&](double v) { return std::abs(v - centre); });
  return 1.4826022185056018 * median(std::move(deviation));
}

double peakToPeak(std::span<const double> difference) {
  if (difference.empty()) return 0.0;
  const auto [low, high] = std::minmax_element(difference.begin(), difference.end());
  return std::abs(*high) + std::abs(*low);
}

double fitPercent(std::span<const double> measured, std::span<const double> simulated) {
  SPINDRIFT_ASSERT(measured.size() == simulated.size(), "measured and simulated differ in length");
  const double centre = mean(measured);
  double error = 0.0;
  double spread = 0.0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    error += (measured[i] - simulated[i]) * (measured[i] - simulated[i]);
    spread += (measured[i] - centre) * (measured[i] - centre);
  }
  if (spread == 0.0) return error == 0.0 ? 100.0 : -std::numeric_limits<double>::infinity();
  return (1.0 - std::sqrt(error / spread)) * 100.0;
}

RateInterval wilsonInterval(std::size_t k, std::size_t n, double z) {
  if (n == 0) return {};
  const auto count = static_cast<double>(n);
  const double rate = static_cast<double>(k) / count;
  const double denominator = 1.0 + z * z / count;
  const double centre = (rate + z * z / (2.0 * count)) / denominator;
  const double half = z * std::sqrt(rate * (1.0 - rate) / count + z * z / (4.0 * count * count)) / denominator;
  return {std::max(0.0, centre - half), std::min(1.0, centre + half)};
}

}  // namespace spindrift
