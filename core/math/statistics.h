// SPDX-License-Identifier: Apache-2.0
// Descriptive statistics of samples.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace spindrift {

[[nodiscard]] double mean(std::span<const double> values);
/// Sample standard deviation (n - 1). 0 for fewer than two values.
[[nodiscard]] double standardDeviation(std::span<const double> values);
[[nodiscard]] double rootMeanSquare(std::span<const double> values);
[[nodiscard]] double median(std::vector<double> values);
/// Quantile by linear interpolation of the order statistics, p in [0, 1].
[[nodiscard]] double quantile(std::vector<double> values, double p);
/// Robust standard deviation: 1.4826 times the median absolute deviation from the median.
[[nodiscard]] double robustSigma(const std::vector<double>& values);
/// P2 (4): |max(d)| + |min(d)| of a difference.
[[nodiscard]] double peakToPeak(std::span<const double> difference);
/// P2 (5): (1 - |m - s| / |m - mean m|) * 100 %. -infinity if m is constant and differs from s.
[[nodiscard]] double fitPercent(std::span<const double> measured, std::span<const double> simulated);
/// Wilson's interval of a rate, k of n, two-sided with normal quantile z.
struct RateInterval {
  double low = 0.0;
  double high = 1.0;
};
[[nodiscard]] RateInterval wilsonInterval(std::size_t k, std::size_t n, double z = 1.959963984540054);

}  // namespace spindrift
