// SPDX-License-Identifier: Apache-2.0
#include "core/machine/geometric_errors.h"

#include <fmt/format.h>

#include <cmath>

namespace spindrift {
namespace {

constexpr std::string_view letters = "XYZABC";

Component componentOf(char letter) {
  return static_cast<Component>(letters.find(letter));
}

/// 0, 1, 2 of a linear axis.
Eigen::Index directionOf(const LinearAxis& axis) {
  return static_cast<Eigen::Index>(letters.find(axis.name.front()));
}

}  // namespace

void GeometricErrors::add(std::string name, Parameter parameter) {
  names_.push_back(std::move(name));
  parameters_.push_back(std::move(parameter));
}

GeometricErrors::GeometricErrors(const MachineDescription& machine) : machine_(machine) {
  using Law = Parameter::Law;
  std::vector<std::size_t> linear;
  for (std::size_t i = 0; i < machine_.axes.size(); ++i) {
    const LinearAxis& axis = machine_.axes[i];
    const ChainAxis* in_chain = machine_.chain.find(axis.name);
    if (in_chain != nullptr && !in_chain->rotary && axis.travel_mm[1] > axis.travel_mm[0]) linear.push_back(i);
  }
  for (const std::size_t i : linear) {
    const LinearAxis& axis = machine_.axes[i];
    for (const char direction : letters) {
      const Component component = componentOf(direction);
      const bool along = direction == axis.name.front();
      const Law law = along ? Law::Slope : isRotation(component) ? Law::Turn : Law::Arc;
      const char* unit = along ? "um_per_m" : isRotation(component) ? "urad" : "um";
      add(fmt::format("E{}{}_{}", direction, axis.name, unit), {axis.name, i, component, law});
    }
  }
  for (const auto& [name, direction, moving, base] :
       {std::tuple{"EC0Y_urad", Component::EC, 'Y', 'X'}, std::tuple{"EA0Z_urad", Component::EA, 'Z', 'Y'},
        std::tuple{"EB0Z_urad", Component::EB, 'Z', 'X'}}) {
    for (const std::size_t i : linear) {
      const bool other = std::any_of(linear.begin(), linear.end(),
                                     [&, base = base](std::size_t j) { return machine_.axes[j].name.front() == base; });
      if (machine_.axes[i].name.front() == moving && other)
        add(name, {machine_.axes[i].name, i, direction, Law::Square});
    }
  }
  for (const ChainAxis& axis : machine_.chain.axes()) {
    if (!axis.rotary || axis.spindle || !axis.carries_workpiece || axis.name.front() != 'C') continue;
    for (const char direction : letters) {
      const Component component = componentOf(direction);
      add(fmt::format("E{}0{}_{}", direction, direction == 'Z' ? 'T' : 'C', unitOf(component)),
          {axis.name, 0, component, Law::Location});
    }
    break;
  }
}

SmallError GeometricErrors::unit(std::size_t parameter, const DeviationQuery& query) const {
  using Law = Parameter::Law;
  const Parameter& p = parameters_[parameter];
  AxisPositions positions;
  for (const LinearAxis& axis : machine_.axes) {
    const Eigen::Index i = directionOf(axis);
    positions[axis.name] = query.position_mm[i] - query.tool_offset_mm[i];
  }
  SmallError moved;
  const Eigen::Index index = axisIndex(p.direction);
  std::map<std::string, Eigen::Vector3d, std::less<>> centres;
  if (p.law == Law::Location) {
    (isRotation(p.direction) ? moved.rotation_rad : moved.translation_mm)[index] =
        isRotation(p.direction) ? 1e-6 : 1e-3;
    // The centre is stated where the tool meets it: relative to the table, whatever carries it.
    const RotaryAxis* rotary = machine_.findRotary(p.axis);
    SmallError turned;
    const Eigen::Vector3d lever = query.position_mm - (rotary != nullptr ? rotary->centre_mm : Eigen::Vector3d::Zero());
    turned -= moved.at(lever);
    return turned;
  }
  const LinearAxis& axis = machine_.axes[p.linear];
  const double middle_mm = 0.5 * (axis.travel_mm[0] + axis.travel_mm[1]);
  const double length_mm = axis.travel_mm[1] - axis.travel_mm[0];
  const double from_middle_mm = positions[axis.name] - middle_mm;
  switch (p.law) {
    case Law::Slope:
      moved.translation_mm[index] = 1e-6 * from_middle_mm;
      break;
    case Law::Arc: {
      const double part = 2.0 * from_middle_mm / length_mm;
      moved.translation_mm[index] = 1e-3 * (1.0 - part * part);
      break;
    }
    case Law::Turn:
      moved.rotation_rad[index] = 1e-6 * from_middle_mm / length_mm;
      break;
    case Law::Square: {
      // The axis points elsewhere, nothing on it turns.
      const Eigen::Vector3d way = from_middle_mm * Eigen::Vector3d::Unit(directionOf(axis));
      moved.translation_mm = 1e-6 * Eigen::Vector3d::Unit(index).cross(way);
      break;
    }
    case Law::Location:
      break;
  }
  if (machine_.chain.find(p.axis)->carries_workpiece) moved = -moved;
  return machine_.chain.toolDeviation(positions, {{p.axis, moved}}, query.tool_offset_mm);
}

}  // namespace spindrift
