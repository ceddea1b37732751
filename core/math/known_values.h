// SPDX-License-Identifier: Apache-2.0
// Statistics of values some of which are not known (NaN), and of values that are known differently well.
#pragma once

#include <span>

namespace spindrift {

/// Mean, and rms about zero, of the values that are finite; NaN if none is.
[[nodiscard]] double meanOfKnown(std::span<const double> values);
[[nodiscard]] double rootMeanSquareOfKnown(std::span<const double> values);

struct WeightedMean {
  double value = 0.0;
  double sigma = 0.0;
};
/// Mean of values weighted with 1 / sigma^2 and its standard uncertainty, 1 / sqrt(sum of weights); NaN without values.
/// As many sigmas as values, each > 0.
[[nodiscard]] WeightedMean weightedMean(std::span<const double> values, std::span<const double> sigmas);

}  // namespace spindrift
