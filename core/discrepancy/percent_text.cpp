// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/percent_text.h"

#include <fmt/format.h>

#include <cmath>

namespace spindrift {

std::string percentText(double probability) {
  if (!std::isfinite(probability)) return "\u2013";
  if (probability < 0.005) return "< 1 %";
  if (probability > 0.995) return "> 99 %";
  return fmt::format("{:.0f} %", 100.0 * probability);
}

}  // namespace spindrift
