// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/discrepancy_sizes.h"

#include <algorithm>
#include <cmath>

#include "core/math/statistics.h"

namespace spindrift {

DiscrepancySizes sizesOf(const std::vector<DiscrepancySeries>& series, Component component) {
  std::vector<double> residual, effects, noise;
  for (const DiscrepancySeries& s : series) {
    if (s.component != component) continue;
    for (std::size_t i = 0; i < s.value.size(); ++i) {
      if (s.held_out[i]) continue;
      residual.push_back(s.value[i] - s.simulated[i] - s.constant_before);
      effects.push_back(s.explained.empty() ? 0.0 : s.explained[i]);
      noise.push_back(s.noise);
    }
  }
  const bool explained = std::any_of(series.begin(), series.end(), [component](const DiscrepancySeries& s) {
    return s.component == component && !s.explained.empty();
  });
  return {residual.size(), rootMeanSquare(residual), explained ? rootMeanSquare(effects) : std::nan(""),
          rootMeanSquare(noise)};
}

}  // namespace spindrift
