// SPDX-License-Identifier: Apache-2.0
// One process at a time works on a session.
#pragma once

#include <filesystem>
#include <string>

namespace spindrift {

/// Advisory lock on `<folder>/lock`, held as long as the object lives and released by the system if the process dies.
class SessionLock {
 public:
  /// Throws InputError naming the process and computer that hold it.
  explicit SessionLock(const std::filesystem::path& folder);
  /// Takes the owner's name out of the file: what remains there tells of a process that died.
  ~SessionLock();
  SessionLock(const SessionLock&) = delete;
  SessionLock& operator=(const SessionLock&) = delete;

  /// "process 123 on host" if the last owner ended without letting go, else empty.
  [[nodiscard]] const std::string& diedBefore() const noexcept { return died_before_; }
  /// True if the last owner of the folder died and nobody works on it now. Changes nothing.
  [[nodiscard]] static bool abandoned(const std::filesystem::path& folder);

 private:
  std::string died_before_;
  int handle_ = -1;
};

}  // namespace spindrift
