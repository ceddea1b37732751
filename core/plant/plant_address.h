// SPDX-License-Identifier: Apache-2.0
// Where a plant store is: a file of SQLite for one department, or a PostgreSQL server for a plant.
#pragma once

#include <filesystem>
#include <string>

namespace spindrift {

struct PlantAddress {
  enum class Kind { Sqlite, Postgres };
  Kind kind = Kind::Sqlite;
  std::filesystem::path file;  ///< SQLite
  std::string connect;         ///< PostgreSQL: keywords of libpq

  /// "plant.sqlite", "sqlite:/path/plant.sqlite", or "postgresql:host=NAME dbname=plant user=NAME ...".
  /// Over the network the server is always checked: `sslmode=verify-full` is put in where nothing is said, and what is
  /// weaker is refused; sockets and the computer's own address need none. Throws InputError: a password (it belongs
  /// into the file that PGPASSFILE names, mode 0600, which is nobody else's), a weaker sslmode, an empty address.
  [[nodiscard]] static PlantAddress parse(const std::string& text);
  /// As it was given; holds no secret.
  [[nodiscard]] std::string text() const;
};

}  // namespace spindrift
