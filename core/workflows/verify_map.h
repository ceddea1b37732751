// SPDX-License-Identifier: Apache-2.0
// What was left before and after compensating, over the table, for one thermal state, angle of the table and component.
// Between the points the values are interpolated with their uncertainty (core/machine/interpolated_field.h). um or
// urad, mm in MCF.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/machine/field.h"
#include "core/machine/machine_description.h"
#include "core/workflows/verify_compensation.h"

namespace spindrift {

/// A thermal state with the table at one angle, deg: points at another angle are elsewhere on it and make another map.
struct VerifyPose {
  std::string state;
  double c_deg = 0.0;
  [[nodiscard]] bool operator==(const VerifyPose&) const = default;
};

/// Of a comparison, in order of the states, then of the angles.
[[nodiscard]] std::vector<VerifyPose> posesOf(const VerifyResult& result);

/// Angles of the table in a comparison, deg, increasing.
[[nodiscard]] std::vector<double> anglesOf(const VerifyResult& result);
/// The pose with the largest value of a component after compensating; the first one if there is none.
[[nodiscard]] VerifyPose worstPose(const VerifyResult& result, Component component);

/// The values of one pose and component, before (0) and after (1), ready to be drawn.
struct VerifyMap {
  Component component = Component::EX;
  VerifyPose pose;
  std::array<std::vector<Field::Marker>, 2> points;
  std::array<std::optional<Field>, 2> fields;  ///< empty where the points span no plane
};
/// Any thread. Without a pose: worstPose().
[[nodiscard]] VerifyMap verifyMap(const VerifyResult& result, const MachineDescription& machine, Component component,
                                  const std::optional<VerifyPose>& pose);

}  // namespace spindrift
