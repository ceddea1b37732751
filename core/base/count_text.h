// SPDX-License-Identifier: Apache-2.0
// "1 touch", "2 touches": counts as people read them.
#pragma once

#include <fmt/format.h>

#include <concepts>
#include <string>
#include <string_view>

namespace spindrift {

/// "1 file", "3 files", "0 files"; `many` where the plural is not `one` with an s.
[[nodiscard]] std::string countOf(std::integral auto count, std::string_view one, std::string_view many = {}) {
  if (count == 1) return fmt::format("1 {}", one);
  return many.empty() ? fmt::format("{} {}s", count, one) : fmt::format("{} {}", count, many);
}

}  // namespace spindrift
