// SPDX-License-Identifier: Apache-2.0
#include "core/connect/append_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/base/error.h"

namespace spindrift {

AppendFile::AppendFile(std::filesystem::path file) : file_(std::move(file)) {
  std::error_code ignored;
  if (file_.has_parent_path()) std::filesystem::create_directories(file_.parent_path(), ignored);
  handle_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  struct stat state {};
  if (handle_ < 0 || ::fstat(handle_, &state) != 0) {
    const int error = errno;
    if (handle_ >= 0) ::close(handle_);
    throw InputError({file_, ""}, fmt::format("cannot be written: {}.", std::strerror(error)));
  }
  if (!S_ISREG(state.st_mode)) {
    ::close(handle_);
    throw InputError({file_, ""}, "is not a file; allowed: a file that can be appended to.");
  }
  if (::flock(handle_, LOCK_EX | LOCK_NB) != 0) {
    ::close(handle_);
    throw InputError({file_, ""}, "is being written by another program; allowed: one at a time.");
  }
  ::fstat(handle_, &state);
  size_ = static_cast<std::uintmax_t>(state.st_size);
  std::uintmax_t good = size_;
  char bytes[4096];
  while (good > 0) {
    const std::uintmax_t from = good > sizeof bytes ? good - sizeof bytes : 0;
    const ssize_t count = ::pread(handle_, bytes, static_cast<std::size_t>(good - from), static_cast<off_t>(from));
    if (count <= 0) break;
    const char* end = bytes + count;
    const char* found = end;
    while (found != bytes && found[-1] != '\n') --found;
    good = from + static_cast<std::uintmax_t>(found - bytes);
    if (found != bytes) break;
  }
  repaired_ = static_cast<std::size_t>(size_ - good);
  if (repaired_ > 0 && ::ftruncate(handle_, static_cast<off_t>(good)) == 0) size_ = good;
}

AppendFile::~AppendFile() {
  sync();
  ::close(handle_);
}

bool AppendFile::append(std::string_view lines) {
  std::size_t done = 0;
  while (done < lines.size()) {
    const ssize_t count = ::pwrite(handle_, lines.data() + done, lines.size() - done, static_cast<off_t>(size_ + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      failure_ = fmt::format("{} cannot be written: {}.", file_.string(), std::strerror(count < 0 ? errno : ENOSPC));
      // Half a line would be read as data.
      if (done > 0 && ::ftruncate(handle_, static_cast<off_t>(size_)) != 0) failure_ += " Its last line is not whole.";
      return false;
    }
    done += static_cast<std::size_t>(count);
  }
  size_ += lines.size();
  failure_.clear();
  return true;
}

void AppendFile::sync() {
  ::fdatasync(handle_);
}

std::string AppendFile::tail(std::size_t most) const {
  const std::uintmax_t from = size_ > most ? size_ - most : 0;
  std::string text(static_cast<std::size_t>(size_ - from), '\0');
  const ssize_t count = ::pread(handle_, text.data(), text.size(), static_cast<off_t>(from));
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, count)));
  if (from > 0) text.erase(0, text.find('\n') + 1);
  return text;
}

}  // namespace spindrift
