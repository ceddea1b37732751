// SPDX-License-Identifier: Apache-2.0
#include "core/reporting/parameter_meanings.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace spindrift {
namespace {

using Entry = std::pair<std::string_view, std::string_view>;

// Hole artefact (FORMATS.md, conventions); the rotary axis is C.
constexpr std::array<Entry, 12> hole_artefact{{
    {"EXX", "positioning error of the X axis per metre, from the centre of the rotary axis"},
    {"EX0C", "displacement of the table along X"},
    {"EY0C", "displacement of the table along Y"},
    {"EZ0T", "displacement of the table along Z"},
    {"ER0T", "radial expansion of the table at the reference hole"},
    {"EA0C", "rotation of the table about X"},
    {"EB0C", "rotation of the table about Y"},
    {"EC0C", "rotation of the table about Z"},
    {"EC0Y", "squareness of Y to X"},
    {"EA0Z", "squareness of Z to Y"},
    {"EB0Z", "squareness of Z to X"},
    {"EME", "thermal expansion of the artefact per metre, from its reference hole"},
}};

// One letter and an axis: ball artefact and nine-parameter model.
constexpr std::array<Entry, 5> by_axis{{
    {"h", "head tilt about {}"},
    {"a", "column tilt about {}"},
    {"d", "thermal displacement of the spindle along {}"},
    {"g", "thermal expansion of the {} ball screw from its fixed bearing"},
    {"alpha_", "thermal expansion along {} over the table"},
}};

constexpr std::string_view axes = "XYZ";
constexpr std::string_view rotations = "ABC";

bool isAxis(char c) {
  return axes.find(c) != std::string_view::npos;
}

}  // namespace

std::string parameterMeaning(std::string_view name) {
  const bool rotates = name.ends_with("_urad");
  for (const std::string_view unit : {"_um_per_m", "_urad", "_um"}) {
    if (!name.ends_with(unit)) continue;
    const bool per_metre = unit == "_um_per_m";
    name.remove_suffix(unit.size());
    for (const auto& [id, meaning] : hole_artefact)
      if (name == id && (id != "EXX" || per_metre)) return std::string(meaning);
    for (const auto& [stem, meaning] : by_axis) {
      if (name.size() == stem.size() + 1 && name.starts_with(stem) && isAxis(name.back()))
        return fmt::format(fmt::runtime(meaning), name.back());
    }
    // ISO 230-1: E, direction of the error, moving axis.
    const auto direction = [&](char c) {
      const std::size_t turn = rotations.find(c);
      return rotates && turn != std::string_view::npos ? std::string(1, axes[turn])
             : !rotates && isAxis(c)                   ? std::string(1, c)
                                                       : std::string();
    };
    if (name.size() < 2 || name.size() > 3 || name[0] != 'E' || direction(name[1]).empty()) return {};
    if (name.size() == 2 && rotates)
      return fmt::format("rotation about {} at the origin of the table", direction(name[1]));
    if (name.size() == 2) return fmt::format("displacement along {} at the origin of the table", direction(name[1]));
    if (!isAxis(name[2])) return {};
    const bool along_itself = direction(name[1])[0] == name[2];
    if (rotates && along_itself) return fmt::format("roll error of the {} axis", name[2]);
    if (rotates) return fmt::format("angular error of the {} axis about {}", name[2], direction(name[1]));
    if (along_itself) return fmt::format("positioning error of the {} axis", name[2]);
    return fmt::format("straightness error of the {} axis in the direction of {}", name[2], direction(name[1]));
  }
  return {};
}

}  // namespace spindrift
