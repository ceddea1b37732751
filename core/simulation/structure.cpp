// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/structure.h"

#include <algorithm>

namespace spindrift {
namespace {

/// Integral from the beginning of the row to `at_mm`, extended by the end cells.
double fromBeginning(const RodIndex& rod, const std::vector<double>& rise_K, double at_mm) {
  const double cell = rod.cell_mm();
  const double length = at_mm - rod.from_mm;
  if (length <= 0.0) return length * rise_K.front();
  double sum = 0.0;
  double left = length;
  for (const double rise : rise_K) {
    const double part = std::min(left, cell);
    sum += part * rise;
    left -= part;
    if (left <= 0.0) return sum;
  }
  return sum + left * rise_K.back();
}

}  // namespace

std::vector<double> rises(const TemperatureHistory& history, const RodIndex& rod, double time_s) {
  std::vector<double> values(static_cast<std::size_t>(rod.count));
  for (int i = 0; i < rod.count; ++i) values[static_cast<std::size_t>(i)] = history.rise(rod.first + i, time_s);
  return values;
}

double strainIntegral_mm(const RodIndex& rod, const std::vector<double>& rise_K, double alpha_per_K, double from_mm,
                         double to_mm) {
  return alpha_per_K * (fromBeginning(rod, rise_K, to_mm) - fromBeginning(rod, rise_K, from_mm));
}

Bending cantilever(const RodIndex& rod, const std::vector<double>& hot_K, const std::vector<double>& cold_K,
                   double alpha_per_K, double depth_mm, double at_mm) {
  Bending b;
  const double cell = rod.cell_mm();
  double left = at_mm - rod.from_mm;
  for (std::size_t i = 0; i < hot_K.size() && left > 0.0; ++i) {
    // The last cell goes on beyond the end.
    const double part = i + 1 == hot_K.size() ? left : std::min(left, cell);
    const double curvature = alpha_per_K * (hot_K[i] - cold_K[i]) / depth_mm;
    b.deflection_mm += b.slope_rad * part + 0.5 * curvature * part * part;
    b.slope_rad += curvature * part;
    left -= part;
  }
  return b;
}

Bending simplySupported(const RodIndex& rod, const std::vector<double>& hot_K, const std::vector<double>& cold_K,
                        double alpha_per_K, double depth_mm, double at_mm) {
  // A clamped beam that bends towards its cold side, turned so that the far end comes back to zero.
  const double length = rod.to_mm - rod.from_mm;
  const Bending whole = cantilever(rod, hot_K, cold_K, alpha_per_K, depth_mm, rod.to_mm);
  const Bending here = cantilever(rod, hot_K, cold_K, alpha_per_K, depth_mm, at_mm);
  const double turn = whole.deflection_mm / length;
  return {turn - here.slope_rad, turn * (at_mm - rod.from_mm) - here.deflection_mm};
}

}  // namespace spindrift
