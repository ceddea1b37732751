// SPDX-License-Identifier: Apache-2.0
#include "core/session/session_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/error.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

std::string ownerIn(int handle) {
  char text[256] = {};
  const ssize_t count = ::pread(handle, text, sizeof text - 1, 0);
  return std::string(trimmed(std::string_view(text, count > 0 ? static_cast<std::size_t>(count) : 0)));
}

}  // namespace

bool SessionLock::abandoned(const std::filesystem::path& folder) {
  const int handle = ::open((folder / "lock").c_str(), O_RDONLY | O_CLOEXEC);
  if (handle < 0) return false;
  const bool free = ::flock(handle, LOCK_SH | LOCK_NB) == 0;
  const bool named = !ownerIn(handle).empty();
  ::close(handle);
  return free && named;
}

SessionLock::SessionLock(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "lock";
  handle_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (handle_ < 0) {
    throw InputError({folder, ""}, fmt::format("cannot be opened for work: {}; allowed: a folder you may write to.",
                                               std::strerror(errno)));
  }
  if (::flock(handle_, LOCK_EX | LOCK_NB) != 0) {
    const std::string owner = ownerIn(handle_);
    ::close(handle_);
    handle_ = -1;
    throw InputError({folder, ""}, fmt::format("is open in another window ({}). Close it there first; nothing was "
                                               "changed here.",
                                               owner.empty() ? "unknown process" : owner));
  }
  died_before_ = ownerIn(handle_);
  char host[128] = {};
  ::gethostname(host, sizeof host - 1);
  const std::string owner = fmt::format("process {} on {}\n", ::getpid(), host);
  // The text only serves the message above; a failure to write it changes nothing.
  if (::ftruncate(handle_, 0) != 0 || ::pwrite(handle_, owner.data(), owner.size(), 0) < 0) return;
}

SessionLock::~SessionLock() {
  if (handle_ < 0) return;
  // If this fails, the next start wrongly speaks of a crash; nothing else depends on it.
  [[maybe_unused]] const int emptied = ::ftruncate(handle_, 0);
  ::close(handle_);
}

}  // namespace spindrift
