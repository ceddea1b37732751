// SPDX-License-Identifier: GPL-3.0-or-later
// A PostgreSQL server of its own in a temporary folder: a unix socket only, or TLS on a port of loopback as well. As
// root it runs as the user postgres. One a test program, started at first use and stopped at the end.
#pragma once

#include <memory>
#include <string>

#include "tests/support/temp_folder.h"

namespace spindrift::testing {

class TemporaryPostgres {
 public:
  TemporaryPostgres();
  ~TemporaryPostgres();
  TemporaryPostgres(const TemporaryPostgres&) = delete;
  TemporaryPostgres& operator=(const TemporaryPostgres&) = delete;

  /// "" if the server is there, else why it is not: no server is installed.
  [[nodiscard]] static std::string missing();
  /// Address of a new, empty database; the role is "owner" (may make the store), "writer_one", "reader_one" or "admin".
  [[nodiscard]] std::string freshDatabase();
  [[nodiscard]] std::string address(const std::string& database, const std::string& role) const;
  /// Runs SQL as the administrator and returns what psql printed.
  std::string sql(const std::string& database, const std::string& statements) const;
  void stop() const;
  void start() const;
  void kill() const;  ///< -9, and waits until the children are gone
  /// Over the network with TLS, as role reader_one; call before start().
  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] std::string certificate() const { return (folder_ / "tls/server.crt").string(); }

  /// The one of this test program.
  [[nodiscard]] static TemporaryPostgres& shared();

 private:
  [[nodiscard]] std::string as() const;
  TempFolder folder_;
  int port_ = 0;
  int databases_ = 0;
};

/// What a command of the shell printed; throws if it failed.
std::string shell(const std::string& command);

}  // namespace spindrift::testing
