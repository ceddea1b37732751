// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/compensation_sizes.h"

#include <array>
#include <cmath>
#include <optional>

namespace spindrift {
namespace {

double lengthOf(const std::array<std::optional<double>, 3>& components) {
  double squares = 0.0;
  bool any = false;
  for (const std::optional<double>& one : components) {
    if (!one) continue;
    squares += *one * *one;
    any = true;
  }
  return any ? std::sqrt(squares) : std::nan("");
}

}  // namespace

double measuredLength_um(const CompensationPoint& point) {
  return lengthOf(point.measured_um);
}

double remainingLength_um(const CompensationPoint& point) {
  return lengthOf(point.remains_um);
}

double remainingSigma_um(const CompensationPoint& point, int axis) {
  return std::hypot(point.measured_sigma_um[static_cast<std::size_t>(axis)], point.sigma_um[axis]);
}

}  // namespace spindrift
