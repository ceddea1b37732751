// SPDX-License-Identifier: Apache-2.0
#include "core/machine/parameter_meanings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/base/unit_text.h"

namespace spindrift {
namespace {

constexpr std::array<char, 3> axes{'X', 'Y', 'Z'};
constexpr std::array<char, 3> rotations{'A', 'B', 'C'};

std::vector<ErrorParameter> table() {
  std::vector<ErrorParameter> all;
  const auto add = [&](const std::string& symbol, const std::string& iso, const std::string& unit,
                       const std::string& meaning) {
    const std::string ending = unit == "um/m" ? "um_per_m" : unit;
    all.push_back({fmt::format("{}_{}", symbol, ending), symbol, iso, unit, meaning});
  };
  const auto same = [&](const std::string& symbol, const std::string& unit, const std::string& meaning) {
    add(symbol, symbol, unit, meaning);
  };
  // Small error of FORMATS.md, as the nine-parameter model has it.
  for (const char axis : axes)
    add(fmt::format("E{}", axis), "", "um", fmt::format("displacement along {} at the origin of the table", axis));
  for (std::size_t i = 0; i < axes.size(); ++i)
    add(fmt::format("E{}", rotations[i]), "", "urad",
        fmt::format("rotation about {} at the origin of the table", axes[i]));
  // Component errors of a linear axis (ISO 230-1): E, direction of the error, axis that moves.
  for (const char axis : axes) {
    for (const char direction : axes) {
      same(fmt::format("E{}{}", direction, axis), "um",
           direction == axis
               ? fmt::format("positioning error of the {} axis", axis)
               : fmt::format("straightness error of the {} axis in the direction of {}", axis, direction));
    }
    for (std::size_t i = 0; i < axes.size(); ++i) {
      same(fmt::format("E{}{}", rotations[i], axis), "urad",
           axes[i] == axis ? fmt::format("roll error of the {} axis", axis)
                           : fmt::format("angular error of the {} axis about {}", axis, axes[i]));
    }
  }
  same("EC0Y", "urad", "squareness of Y to X");
  same("EA0Z", "urad", "squareness of Z to Y");
  same("EB0Z", "urad", "squareness of Z to X");
  for (const char axis : {'X', 'Y'})
    all.push_back({fmt::format("alpha_{}_um_per_m", axis), fmt::format("α{}", axis), fmt::format("E{0}{0}", axis),
                   "um/m", fmt::format("thermal expansion along {} over the table", axis)});
  // Hole artefact; the rotary axis is C. EXX has the unit of a slope there.
  same("EXX", "um/m", "positioning error of the X axis per metre, from the centre of the rotary axis");
  for (const char axis : {'Y', 'Z'})
    same(fmt::format("E{0}{0}", axis), "um/m", fmt::format("positioning error of the {} axis per metre", axis));
  same("EX0C", "um", "displacement of the table along X");
  same("EY0C", "um", "displacement of the table along Y");
  add("EZ0T", "", "um", "displacement of the table along Z");
  add("ER0T", "", "um", "radial expansion of the table at the reference hole");
  same("EA0C", "urad", "rotation of the table about X");
  same("EB0C", "urad", "rotation of the table about Y");
  same("EC0C", "urad", "rotation of the table about Z");
  add("EME", "", "um/m", "thermal expansion of the artefact per metre, from its reference hole");
  // Ball artefact: deviation of the tip = d + a x tip + h x offset + g (reference - fixed bearing). The spindle S is
  // displaced by d and turned by h; a turns the column, which the standard has no symbol for: EA0Z and EB0Z are the
  // squareness of the Z axis.
  for (std::size_t i = 0; i < axes.size(); ++i)
    add(fmt::format("h{}", axes[i]), fmt::format("E{}0S", rotations[i]), "urad",
        fmt::format("head tilt about {}", axes[i]));
  for (std::size_t i = 0; i < axes.size(); ++i)
    add(fmt::format("a{}", axes[i]), "", "urad", fmt::format("column tilt about {}", axes[i]));
  for (const char axis : axes)
    add(fmt::format("d{}", axis), fmt::format("E{}0S", axis), "um",
        fmt::format("thermal displacement of the spindle along {}", axis));
  for (const char axis : axes)
    add(fmt::format("g{}", axis), fmt::format("E{0}{0}", axis), "um/m",
        fmt::format("thermal expansion of the {} ball screw from its fixed bearing", axis));
  return all;
}

}  // namespace

std::string ErrorParameter::symbolWithIso() const {
  return iso_symbol.empty() || iso_symbol == symbol ? symbol : fmt::format("{} ({})", symbol, iso_symbol);
}

std::span<const ErrorParameter> errorParameters() {
  static const std::vector<ErrorParameter> all = table();
  return all;
}

const ErrorParameter* errorParameter(std::string_view name) {
  const auto all = errorParameters();
  const auto found = std::find_if(all.begin(), all.end(), [&](const ErrorParameter& p) { return p.name == name; });
  return found == all.end() ? nullptr : &*found;
}

ErrorParameter describedParameter(std::string_view name) {
  if (const ErrorParameter* found = errorParameter(name)) return *found;
  ErrorParameter parameter;
  parameter.name = name;
  parameter.symbol = name.substr(0, name.find('_'));
  parameter.unit = unitOfSignal(name);
  return parameter;
}

std::string parameterMeaning(std::string_view name) {
  return describedParameter(name).meaning;
}

}  // namespace spindrift
