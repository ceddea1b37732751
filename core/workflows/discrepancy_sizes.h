// SPDX-License-Identifier: Apache-2.0
// How large the parts of a discrepancy are, of one component.
#pragma once

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

}  // namespace spindrift
