// SPDX-License-Identifier: Apache-2.0
#include "core/machine/component.h"

#include "core/base/units.h"

namespace spindrift {
namespace {

constexpr std::array<std::string_view, 6> names{"EX", "EY", "EZ", "EA", "EB", "EC"};

}  // namespace

std::string_view toString(Component component) noexcept {
  return names[static_cast<std::size_t>(component)];
}

std::optional<Component> componentFromString(std::string_view name) noexcept {
  for (const Component component : all_components) {
    if (toString(component) == name) return component;
  }
  return std::nullopt;
}

std::string_view unitOf(Component component) noexcept {
  return isRotation(component) ? "urad" : "um";
}

double valueOf(const SmallError& error, Component component) noexcept {
  return isRotation(component) ? error.rotation_rad[axisIndex(component)] * urad_per_rad
                               : error.translation_mm[axisIndex(component)] * um_per_mm;
}

}  // namespace spindrift
