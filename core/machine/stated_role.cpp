// SPDX-License-Identifier: Apache-2.0
#include "core/machine/stated_role.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

namespace spindrift {

void stateSensorRole(nlohmann::json& machine, const std::string& name, const std::string& role) {
  nlohmann::json& list = machine["temperature_sensors"];
  if (!list.is_array()) list = nlohmann::json::array();
  auto sensor = std::find_if(list.begin(), list.end(),
                             [&](const nlohmann::json& one) { return one.value("name", std::string()) == name; });
  if (sensor == list.end()) {
    list.push_back({{"name", name}});
    sensor = std::prev(list.end());
  }
  (*sensor)["role"] = role;
}

}  // namespace spindrift
