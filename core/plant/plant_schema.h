// SPDX-License-Identifier: Apache-2.0
// The tables of a plant store and its numbered migrations: the same on SQLite and PostgreSQL.
#pragma once

#include "core/plant/plant_connection.h"

namespace spindrift {

inline constexpr int newest_plant_schema = 3;

/// Version of the store's schema; 0: there is none yet.
[[nodiscard]] int plantSchemaVersion(PlantConnection& connection);
/// Brings the store to `newest_plant_schema`, all of it or nothing, and gives the roles plant_reader and plant_writer
/// of a PostgreSQL server their rights (the roles are made where this user may). Two owners may do it at once.
void migratePlant(PlantConnection& connection);

}  // namespace spindrift
