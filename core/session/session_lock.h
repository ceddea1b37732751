// SPDX-License-Identifier: Apache-2.0
// One process at a time works on a session.
#pragma once

#include <filesystem>

namespace spindrift {

/// Advisory lock on `<folder>/lock`, held as long as the object lives and released by the system if the process dies.
class SessionLock {
 public:
  /// Throws InputError naming the process and computer that hold it.
  explicit SessionLock(const std::filesystem::path& folder);
  ~SessionLock();
  SessionLock(const SessionLock&) = delete;
  SessionLock& operator=(const SessionLock&) = delete;

 private:
  int handle_ = -1;
};

}  // namespace spindrift
