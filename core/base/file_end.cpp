// SPDX-License-Identifier: Apache-2.0
#include "core/base/file_end.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <span>

#include "core/base/error.h"
#include "core/base/file_reader.h"

namespace spindrift {
namespace {

[[noreturn]] void failWritingEnd(const std::filesystem::path& file, int error) {
  throw InputError({file, ""}, fmt::format("cannot be written: {}.", std::strerror(error)));
}

/// Writes `text` at `from`, ends the file behind it and flushes it. 0, or the error.
int writeEnd(int handle, std::uint64_t from, std::string_view text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::pwrite(handle, text.data() + done, text.size() - done, static_cast<off_t>(from + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return count < 0 ? errno : ENOSPC;
    done += static_cast<std::size_t>(count);
  }
  const bool ended = ::ftruncate(handle, static_cast<off_t>(from + text.size())) == 0 && ::fsync(handle) == 0;
  return ended ? 0 : errno;
}

}  // namespace

std::string readPart(const std::filesystem::path& file, std::uint64_t from, std::uint64_t to) {
  FileReader reader(file);
  reader.seek(from);
  std::string text(to - from, '\0');
  for (std::size_t done = 0; done < text.size();) {
    const std::size_t count = reader.read(std::span(text).subspan(done));
    if (count == 0) text.resize(done);
    done += count;
  }
  return text;
}

void replaceEnd(const std::filesystem::path& file, std::uint64_t from, std::string_view text) {
  std::error_code unknown;
  const std::uint64_t size = std::filesystem::file_size(file, unknown);
  const std::string before = !unknown && from < size ? readPart(file, from, size) : std::string();
  const int handle = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  if (handle < 0) failWritingEnd(file, errno);
  const int error = writeEnd(handle, from, text);
  // What stood there had its room before, so it has it now.
  if (error != 0) (void)writeEnd(handle, from, before);
  ::close(handle);
  if (error != 0) failWritingEnd(file, error);
}

}  // namespace spindrift
