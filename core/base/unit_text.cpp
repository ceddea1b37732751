// SPDX-License-Identifier: Apache-2.0
#include "core/base/unit_text.h"

#include <algorithm>
#include <array>
#include <utility>

namespace spindrift {

std::string printedUnit(std::string_view unit) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> signs{
      {{"um", "µm"}, {"urad", "µrad"}, {"degC", "°C"}, {"um2", "µm²"}, {"urad2", "µrad²"}}};
  constexpr std::string_view between = " ,/()";
  std::string out;
  for (std::size_t i = 0; i < unit.size();) {
    const std::size_t end = std::min(unit.find_first_of(between, i), unit.size());
    const std::string_view word = unit.substr(i, end - i);
    const auto sign = std::find_if(signs.begin(), signs.end(), [&](const auto& s) { return s.first == word; });
    out += sign == signs.end() ? word : sign->second;
    if (end < unit.size()) out += unit[end];
    i = end + 1;
  }
  return out;
}

std::string unitOfSignal(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> units{
      {{"_um_per_m", "um/m"}, {"_um_m", "um/m"}, {"_um", "um"}, {"_urad", "urad"}, {"_nm", "nm"}, {"_mrad", "mrad"}}};
  for (const auto& [ending, unit] : units)
    if (name.ends_with(ending)) return std::string(unit);
  return {};
}

}  // namespace spindrift
