// SPDX-License-Identifier: Apache-2.0
#include "core/math/known_values.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "core/base/error.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

std::vector<double> known(std::span<const double> values) {
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite), [](double v) { return std::isfinite(v); });
  return finite;
}

}  // namespace

double meanOfKnown(std::span<const double> values) {
  const std::vector<double> finite = known(values);
  return finite.empty() ? std::nan("") : mean(finite);
}

double rootMeanSquareOfKnown(std::span<const double> values) {
  const std::vector<double> finite = known(values);
  return finite.empty() ? std::nan("") : rootMeanSquare(finite);
}

WeightedMean weightedMean(std::span<const double> values, std::span<const double> sigmas) {
  SPINDRIFT_ASSERT(values.size() == sigmas.size(), "a sigma for each value");
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double weight = 1.0 / (sigmas[i] * sigmas[i]);
    sum += weight * values[i];
    weights += weight;
  }
  if (values.empty()) return {std::nan(""), std::nan("")};
  return {sum / weights, 1.0 / std::sqrt(weights)};
}

}  // namespace spindrift
