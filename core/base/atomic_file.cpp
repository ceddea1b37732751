// SPDX-License-Identifier: Apache-2.0
#include "core/base/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <limits>

#include "core/base/error.h"
#include "core/base/file_reader.h"

namespace spindrift {
namespace {

[[noreturn]] void failWriting(const std::filesystem::path& file, int error) {
  throw InputError({file, ""}, fmt::format("cannot be written: {}.", std::strerror(error)));
}

}  // namespace

std::string readFile(const std::filesystem::path& file) {
  return readFile(file, std::numeric_limits<std::size_t>::max());
}

std::string readFile(const std::filesystem::path& file, std::size_t at_most) {
  FileReader reader(file);
  const std::size_t stated = reader.size();
  if (stated > at_most)
    throw InputError({file, ""}, fmt::format("the file has {} bytes; at most {} are allowed.", stated, at_most));
  std::string content;
  content.reserve(stated);
  char buffer[1 << 16];
  while (const std::size_t count = reader.read(buffer)) {
    if (count > at_most - content.size())
      throw InputError({file, ""}, fmt::format("gives more bytes than are allowed; allowed: at most {}.", at_most));
    content.append(buffer, count);
  }
  return content;
}

void writeFileAtomically(const std::filesystem::path& file, std::string_view content) {
  static std::atomic<unsigned> counter{0};
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  std::error_code ignored;
  std::filesystem::create_directories(folder, ignored);
  // A device or pipe (/dev/stdout) cannot be replaced by a rename: write to it directly.
  const bool special = std::filesystem::exists(file, ignored) && !std::filesystem::is_regular_file(file, ignored);
  const std::filesystem::path target =
      special ? file
              : folder / fmt::format(".{}.{}.{}.part", file.filename().string(), ::getpid(), counter.fetch_add(1));
  const int handle = ::open(target.c_str(), O_WRONLY | O_CREAT | (special ? 0 : O_EXCL) | O_CLOEXEC, 0644);
  if (handle < 0) failWriting(file, errno);
  const auto give_up = [&](int error) {
    ::close(handle);
    if (!special) ::unlink(target.c_str());
    failWriting(file, error);
  };
  std::size_t done = 0;
  while (done < content.size()) {
    const ssize_t count = ::write(handle, content.data() + done, content.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) give_up(count < 0 ? errno : ENOSPC);
    done += static_cast<std::size_t>(count);
  }
  if (special) {
    ::close(handle);
    return;
  }
  if (::fsync(handle) != 0) give_up(errno);
  if (::close(handle) != 0) {
    const int error = errno;
    ::unlink(target.c_str());
    failWriting(file, error);
  }
  if (::rename(target.c_str(), file.c_str()) != 0) {
    const int error = errno;
    ::unlink(target.c_str());
    failWriting(file, error);
  }
  if (const int directory = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); directory >= 0) {
    ::fsync(directory);
    ::close(directory);
  }
}

}  // namespace spindrift
