// SPDX-License-Identifier: Apache-2.0
// The six components of a deviation and their units in files and on screen.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/geometry/small_error.h"

namespace spindrift {

/// Deviation of the tool relative to the table in MCF: displacement along X, Y, Z (um), rotation about X, Y, Z (urad).
enum class Component { EX, EY, EZ, EA, EB, EC };

inline constexpr std::array<Component, 6> all_components{Component::EX, Component::EY, Component::EZ,
                                                         Component::EA, Component::EB, Component::EC};

[[nodiscard]] std::string_view toString(Component component) noexcept;
[[nodiscard]] std::optional<Component> componentFromString(std::string_view name) noexcept;
/// 0, 1, 2 for X, Y, Z resp. A, B, C.
[[nodiscard]] constexpr int axisIndex(Component component) noexcept {
  return static_cast<int>(component) % 3;
}
[[nodiscard]] constexpr bool isRotation(Component component) noexcept {
  return static_cast<int>(component) >= 3;
}
/// "um" or "urad".
[[nodiscard]] std::string_view unitOf(Component component) noexcept;
/// The component's value in um or urad.
[[nodiscard]] double valueOf(const SmallError& error, Component component) noexcept;

}  // namespace spindrift
