// SPDX-License-Identifier: Apache-2.0
// The causes of deviation of the virtual machine, one function each; for virtual_machine.cpp only.
#pragma once

#include <string>

#include "core/simulation/virtual_machine.h"

namespace spindrift {

/// The deviation of a cause at size 1. The id must be possible on the machine.
[[nodiscard]] PlantEffectFunction makePlantEffect(const VirtualMachine& plant, const std::string& id,
                                                  const PlantEffectSetting& setting);

/// Causes with a mechanism of their own (slip, backlash, instrument, coolant, sun, position of the heat) and those
/// outside the catalogue; an empty function for every other id.
[[nodiscard]] PlantEffectFunction makeMechanismEffect(const VirtualMachine& plant, const std::string& id,
                                                      const PlantEffectSetting& setting);

/// Error of one linear axis (the moved part in MCF) as deviation of the tool, through the kinematic chain.
[[nodiscard]] SmallError throughChain(const MachineDescription& machine, int axis, const SmallError& moved_part,
                                      const PlantQuery& query);

/// A shift along X, Y or Z alone.
[[nodiscard]] inline SmallError translation(int axis, double value_mm) {
  SmallError e;
  e.translation_mm[axis] = value_mm;
  return e;
}

/// 0, 1, 2 for an id that ends in x, y, z or a, b, c.
[[nodiscard]] int lastAxis(const std::string& id);

}  // namespace spindrift
