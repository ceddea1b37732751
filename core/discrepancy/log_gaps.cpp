// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/log_gaps.h"

#include <algorithm>

#include "core/math/statistics.h"

namespace spindrift {

std::vector<LogGap> logGaps(std::span<const double> time_s) {
  std::vector<LogGap> gaps;
  if (time_s.size() < 4) return gaps;
  std::vector<double> steps;
  for (std::size_t i = 1; i < time_s.size(); ++i) steps.push_back(time_s[i] - time_s[i - 1]);
  const double least = std::max(1800.0, 20.0 * median(steps));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!(steps[i] > least)) continue;
    gaps.push_back({time_s[i], time_s[i + 1], time_s[i + 1] + std::min(2.0 * steps[i], 7200.0), i});
  }
  return gaps;
}

bool inGap(std::span<const LogGap> gaps, double time_s) {
  return std::any_of(gaps.begin(), gaps.end(),
                     [&](const LogGap& gap) { return time_s > gap.from_s && time_s < gap.known_from_s; });
}

}  // namespace spindrift
