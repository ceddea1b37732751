// SPDX-License-Identifier: Apache-2.0
// From temperatures along a body to its displacement: strain integrated along the cells, bending from the difference of
// two walls. Lengths mm, temperatures K above the start, angles rad.
#pragma once

#include <vector>

#include "core/simulation/machine_bodies.h"

namespace spindrift {

/// Expansion coefficient of the steel of screws, spindles and racks.
inline constexpr double steel_per_K = 11.5e-6;

/// Rise of each cell of a row at a time.
[[nodiscard]] std::vector<double> rises(const TemperatureHistory& history, const RodIndex& rod, double time_s);

/// Integral of alpha * rise from `from_mm` to `to_mm` (negative if to < from). Beyond its ends the rod goes on with the
/// temperature of its last cell.
[[nodiscard]] double strainIntegral_mm(const RodIndex& rod, const std::vector<double>& rise_K, double alpha_per_K,
                                       double from_mm, double to_mm);

/// Slope and deflection of a cantilever whose curvature in each cell is alpha (hot - cold) / depth, clamped at the
/// beginning of the row: theta(z) = integral of the curvature, w(z) = integral of theta.
struct Bending {
  double slope_rad = 0.0;
  double deflection_mm = 0.0;
};
[[nodiscard]] Bending cantilever(const RodIndex& rod, const std::vector<double>& hot_K,
                                 const std::vector<double>& cold_K, double alpha_per_K, double depth_mm, double at_mm);

/// The same for a beam on two supports at the ends of the row: deflection 0 at both ends, positive towards the hot
/// side.
[[nodiscard]] Bending simplySupported(const RodIndex& rod, const std::vector<double>& hot_K,
                                      const std::vector<double>& cold_K, double alpha_per_K, double depth_mm,
                                      double at_mm);

}  // namespace spindrift
