// SPDX-License-Identifier: Apache-2.0
// The role of a temperature sensor as machine.json states it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace spindrift {

/// Writes `"role"` of the sensor `name` ("T_spindle_degC") into the text of a machine.json; a sensor that is not listed
/// there is added. `role` as sensorRoleNames() has it.
void stateSensorRole(nlohmann::json& machine, const std::string& name, const std::string& role);

}  // namespace spindrift
