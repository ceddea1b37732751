// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/stated_role.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace spindrift {
namespace {

TEST(StatedRole, IsWrittenWhereTheSensorStandsOrAdded) {
  nlohmann::json machine = {{"temperature_sensors", {{{"name", "T_1_degC"}, {"place", "column"}}}}};
  stateSensorRole(machine, "T_1_degC", "room");
  stateSensorRole(machine, "T_2_degC", "table");
  const nlohmann::json wanted = {{{"name", "T_1_degC"}, {"place", "column"}, {"role", "room"}},
                                 {{"name", "T_2_degC"}, {"role", "table"}}};
  EXPECT_EQ(machine["temperature_sensors"], wanted);
  nlohmann::json without = nlohmann::json::object();
  stateSensorRole(without, "T_2_degC", "table");
  EXPECT_EQ(without["temperature_sensors"].size(), 1U);
}

}  // namespace
}  // namespace spindrift
