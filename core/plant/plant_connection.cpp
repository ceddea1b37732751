// SPDX-License-Identifier: Apache-2.0
#include "core/plant/plant_connection.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string_view>

#include <soci/postgresql/soci-postgresql.h>
#include <soci/soci.h>
#include <soci/sqlite3/soci-sqlite3.h>

namespace spindrift {
namespace {

/// What the library said, without its preamble and without the statement that SOCI adds.
std::string firstLine(std::string text) {
  for (const char* before : {"Cannot establish connection to the database.", "ERROR:", "FATAL:"}) {
    if (const auto at = text.find(before); at != std::string::npos) text.erase(0, at + std::string_view(before).size());
  }
  text.erase(0, std::min(text.size(), text.find_first_not_of(" \n")));
  for (const char* cut : {"\n", " while executing", " while preparing"}) {
    if (const auto at = text.find(cut); at != std::string::npos) text.resize(at);
  }
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  return text;
}

}  // namespace

double systemNow() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

PlantConnection::PlantConnection(PlantAddress address, bool make, bool read_only)
    : address_(std::move(address)), make_(make), read_only_(read_only), sql_(std::make_unique<soci::session>()) {
  open();
}

PlantConnection::~PlantConnection() = default;

void PlantConnection::open() {
  if (postgres()) {
    try {
      sql_->open(soci::postgresql, address_.connect);
    } catch (const soci::soci_error& error) {
      throw PlantUnreachable({address_.text(), ""}, fmt::format("the plant store cannot be reached: {}.",
                                                                firstLine(error.get_error_message())));
    }
  } else {
    std::error_code none;
    if (!make_ && !std::filesystem::exists(address_.file, none))
      throw PlantUnreachable({address_.file, ""},
                             "is not there; allowed: a plant store (a new one is made with plant init).");
    try {
      sql_->open(soci::sqlite3,
                 fmt::format("db=\"{}\" timeout=60{}", address_.file.string(), read_only_ ? " readonly=true" : ""));
    } catch (const soci::soci_error& error) {
      throw PlantUnreachable({address_.file, ""}, fmt::format("the plant store cannot be opened: {}.",
                                                              firstLine(error.get_error_message())));
    }
  }
  guarded([&] { prepareSession(); });
}

void PlantConnection::prepareSession() {
  if (postgres()) {
    *sql_ << "set search_path = plant, pg_temp";
    *sql_ << "set client_min_messages = warning";
    // Compiling a list of campaigns takes longer than running it.
    *sql_ << "set jit = off";
    if (read_only_) *sql_ << "set default_transaction_read_only = on";
  } else {
    *sql_ << "pragma foreign_keys = on";
    *sql_ << "pragma synchronous = full";
    if (read_only_) *sql_ << "pragma query_only = on";
  }
}

void PlantConnection::execute(const std::string& statement) {
  *sql_ << statement;
}

void PlantConnection::reconnect() {
  sql_->close();
  open();
}

double PlantConnection::now() {
  if (!postgres()) return systemNow();
  return guarded([&] {
    double now_s = 0.0;
    *sql_ << "select extract(epoch from clock_timestamp())::float8", soci::into(now_s);
    return now_s;
  });
}

void PlantConnection::translate(const soci::soci_error& error) const {
  const SourcePlace place{address_.text(), ""};
  const std::string said = firstLine(error.get_error_message());
  if (const auto* postgres_error = dynamic_cast<const soci::postgresql_soci_error*>(&error)) {
    const std::string state = postgres_error->sqlstate();
    if (state == "42501")
      throw InputError(place, fmt::format("this role may not do that in the plant store ({}); ask its owner for the "
                                          "role of a writer.",
                                          said));
    if (state == "25006") throw InputError(place, "the plant store can only be read here; nothing was stored.");
    if (state.starts_with("08") || state.starts_with("57P") || state.starts_with("40"))
      throw PlantUnreachable(place, fmt::format("the plant store cannot be reached: {}.", said));
  }
  if (error.get_error_category() == soci::soci_error::connection_error)
    throw PlantUnreachable(place, fmt::format("the plant store cannot be reached: {}.", said));
  if (const auto* sqlite_error = dynamic_cast<const soci::sqlite3_soci_error*>(&error)) {
    switch (sqlite_error->result() & 0xff) {
      case SQLITE_READONLY:
        throw InputError(place, "the plant store can only be read here; nothing was stored.");
      case SQLITE_BUSY:
      case SQLITE_LOCKED:
        throw PlantUnreachable(place, "the plant store has been in use by others for a minute; try again.");
      case SQLITE_NOTADB:
        throw InputError(place, "is not a plant store.");
      default:
        break;
    }
  }
  throw InputError(place, fmt::format("the plant store cannot be used: {}.", said));
}

void PlantConnection::runGuarded(const std::function<void()>& work) {
  try {
    work();
  } catch (const soci::soci_error& error) {
    translate(error);
  } catch (const std::bad_cast&) {
    throw InputError({address_.text(), ""}, "the plant store holds a value of another kind than its column.");
  }
}

void PlantConnection::runInTransaction(const std::function<void()>& work) {
  runGuarded([&] {
    *sql_ << (postgres() ? "begin" : "begin immediate");
    try {
      work();
      *sql_ << "commit";
    } catch (...) {
      try {
        *sql_ << "rollback";
      } catch (const soci::soci_error&) {  // NOLINT(bugprone-empty-catch): the connection is gone, and with it all
      }
      throw;
    }
  });
}

}  // namespace spindrift
