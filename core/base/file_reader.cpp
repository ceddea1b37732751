// SPDX-License-Identifier: Apache-2.0
#include "core/base/file_reader.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/error.h"

namespace spindrift {
namespace {

[[noreturn]] void failReading(const std::filesystem::path& file, int error) {
  throw InputError({file, ""}, fmt::format("cannot be read: {}.", std::strerror(error)));
}

}  // namespace

FileReader::FileReader(const std::filesystem::path& file)
    : file_(file), handle_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (handle_ < 0) failReading(file_, errno);
}

FileReader::~FileReader() {
  ::close(handle_);
}

std::size_t FileReader::size() const {
  struct stat found {};
  if (::fstat(handle_, &found) != 0) failReading(file_, errno);
  return S_ISREG(found.st_mode) ? static_cast<std::size_t>(found.st_size) : 0;
}

std::size_t FileReader::read(std::span<char> into) {
  for (;;) {
    const ssize_t count = ::read(handle_, into.data(), into.size());
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno != EINTR) failReading(file_, errno);
  }
}

void FileReader::seek(std::uint64_t byte) {
  if (::lseek(handle_, static_cast<off_t>(byte), SEEK_SET) < 0) failReading(file_, errno);
}

std::pair<std::uint64_t, std::uint64_t> FileReader::identity() const {
  struct stat status {};
  if (::fstat(handle_, &status) != 0) failReading(file_, errno);
  return {status.st_dev, status.st_ino};
}

}  // namespace spindrift
