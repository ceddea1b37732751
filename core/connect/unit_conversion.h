// SPDX-License-Identifier: Apache-2.0
// From the unit that a source says to the unit that the name of a column carries.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace spindrift {

/// value in the column = scale * value of the source + offset.
struct UnitConversion {
  double scale = 1.0;
  double offset = 0.0;
};

/// "degC", "mm_min", "rpm", ...: the unit at the end of a column's name, empty if none is known.
[[nodiscard]] std::string unitOfColumn(std::string_view column);
/// True for a unit that can be converted: "CELSIUS", "degF", "MILLIMETER/SECOND", "mm_min", ...
[[nodiscard]] bool isKnownUnit(std::string_view unit);
/// Nothing if the two measure different things. An unknown or empty unit is taken as that of the column.
[[nodiscard]] std::optional<UnitConversion> conversionInto(std::string_view column, std::string_view unit);

}  // namespace spindrift
