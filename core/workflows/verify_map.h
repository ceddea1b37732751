// SPDX-License-Identifier: Apache-2.0
// What was left before and after compensating, over the table, for one thermal state and component. Between the points
// the values are interpolated with their uncertainty (core/machine/interpolated_field.h). um or urad, mm in MCF.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/machine/field.h"
#include "core/machine/machine_description.h"
#include "core/workflows/verify_compensation.h"

namespace spindrift {

/// The values of one state and component, before (0) and after (1), ready to be drawn.
struct VerifyMap {
  Component component = Component::EX;
  std::string state;
  std::array<std::vector<Field::Marker>, 2> points;
  std::array<std::optional<Field>, 2> fields;  ///< empty where the points span no plane
};
/// Any thread. `state` empty: the one with the largest value after compensating.
[[nodiscard]] VerifyMap verifyMap(const VerifyResult& result, const MachineDescription& machine, Component component,
                                  const std::string& state);

}  // namespace spindrift
