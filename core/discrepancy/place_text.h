// SPDX-License-Identifier: Apache-2.0
// A place where measured and simulated disagree, in words.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "core/base/text.h"
#include "core/discrepancy/discrepancy.h"

namespace spindrift {

/// "F1, F2 and F7"; of many points the first few and how many more: "S1, S2, S3, S4, S5 and 320 more".
[[nodiscard]] inline std::string pointsText(const DisagreementPlace& place) {
  constexpr std::size_t all_up_to = 12;
  constexpr std::size_t shown = 5;
  if (place.points.size() <= all_up_to) return joinedList(place.points);
  std::vector<std::string> some(place.points.begin(), place.points.begin() + shown);
  some.push_back(fmt::format("{} more", place.points.size() - shown));
  return joinedList(some);
}

}  // namespace spindrift
