// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/machine/stated_role.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

namespace spindrift::gui {

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

}  // namespace spindrift::gui
