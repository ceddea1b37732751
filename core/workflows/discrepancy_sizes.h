// SPDX-License-Identifier: Apache-2.0
// How large the parts of a discrepancy are: of one component, and of one series with the table at one angle.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/workflows/discrepancy_story.h"

namespace spindrift {

/// rms over the fitted rows of all series of a component, um or urad.
struct DiscrepancySizes {
  std::size_t rows = 0;
  double residual = 0.0;  ///< value - simulated - constant_before
  double effects = 0.0;   ///< what the effects found explain of it; NaN if there are none
  double noise = 0.0;
};
[[nodiscard]] DiscrepancySizes sizesOf(const std::vector<DiscrepancySeries>& series, Component component);

/// What lies beyond the noise, um or urad: excess^2 = max(0, rms^2 - noise^2); NaN without an rms.
[[nodiscard]] double beyondNoise(double rms, double noise) noexcept;

/// rms over the fitted rows of one series that were measured with the table at one angle; NaN without such rows.
struct SeriesSizes {
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();  ///< mean there, MCF
  double before = 0.0;                                    ///< value - simulated - constant_before
  double after = 0.0;                                     ///< value - completed - constant_after
  double excess = 0.0;                                    ///< of `before` beyond the noise of the series
};
[[nodiscard]] SeriesSizes sizesAt(const DiscrepancySeries& series, double c_deg);

/// True if some reading of the series was taken with the table at this angle, deg.
[[nodiscard]] bool measuredAt(const DiscrepancySeries& series, double c_deg);
/// Angles of the table at which a component was measured, deg, increasing. Stories of earlier versions know only 0.
[[nodiscard]] std::vector<double> anglesOf(const DiscrepancyStory& story, Component component);

}  // namespace spindrift
