// SPDX-License-Identifier: Apache-2.0
// The one place where SOCI is opened for a plant store; SOCI itself stays in the .cpp files of this folder.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>

#include "core/base/error.h"
#include "core/plant/plant_address.h"

namespace soci {
class session;
class soci_error;
}  // namespace soci

namespace spindrift {

/// The store cannot be reached now; the same may well succeed later. What is published waits in the session.
class PlantUnreachable : public InputError {
 public:
  using InputError::InputError;
};

class PlantConnection {
 public:
  /// Opens what is there. Throws PlantUnreachable, InputError. `make`: a file of SQLite that is not there is made.
  PlantConnection(PlantAddress address, bool make, bool read_only);
  PlantConnection(const PlantConnection&) = delete;
  PlantConnection& operator=(const PlantConnection&) = delete;
  ~PlantConnection();

  [[nodiscard]] bool postgres() const { return address_.kind == PlantAddress::Kind::Postgres; }
  [[nodiscard]] const PlantAddress& address() const { return address_; }
  [[nodiscard]] soci::session& sql() { return *sql_; }
  /// One statement without an answer.
  void execute(const std::string& statement);
  /// Again after the server was away; what was prepared is gone.
  void reconnect();

  /// Runs `body` and turns what SOCI throws into the sentence a user gets.
  template <typename Body>
  auto guarded(Body body) -> decltype(body()) {
    return answered([this](const std::function<void()>& work) { runGuarded(work); }, std::move(body));
  }
  /// One transaction, taken back whole if `body` throws. On SQLite it takes the write lock at its begin, so that what
  /// is read in it still holds when it is written.
  template <typename Body>
  auto writing(Body body) -> decltype(body()) {
    return answered([this](const std::function<void()>& work) { runInTransaction(work); }, std::move(body));
  }
  /// The clock that all clients share where there is one: the server's; else this computer's.
  [[nodiscard]] double now();

 private:
  template <typename Run, typename Body>
  static auto answered(Run run, Body body) -> decltype(body()) {
    if constexpr (std::is_void_v<decltype(body())>) {
      run([&] { body(); });
    } else {
      std::optional<decltype(body())> answer;
      run([&] { answer.emplace(body()); });
      return std::move(*answer);
    }
  }
  void runGuarded(const std::function<void()>& work);
  void runInTransaction(const std::function<void()>& work);
  void open();
  void prepareSession();
  [[noreturn]] void translate(const soci::soci_error& error) const;

  PlantAddress address_;
  bool make_;
  bool read_only_;
  std::unique_ptr<soci::session> sql_;
};

/// This computer's clock, UTC seconds since 1970.
[[nodiscard]] double systemNow();

}  // namespace spindrift
