// SPDX-License-Identifier: Apache-2.0
// Reading a file that is too long to be held at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>

namespace spindrift {

/// An open file, read from its beginning on. Every function throws InputError with the reason if it cannot be read.
class FileReader {
 public:
  explicit FileReader(const std::filesystem::path& file);
  ~FileReader();
  FileReader(const FileReader&) = delete;
  FileReader& operator=(const FileReader&) = delete;

  /// Bytes of a regular file, as it says now; 0 of anything else.
  [[nodiscard]] std::size_t size() const;
  /// The next bytes, at most as many as `into` takes; their count, 0 at the end of the file.
  [[nodiscard]] std::size_t read(std::span<char> into);
  /// To a byte from the beginning; for regular files.
  void seek(std::uint64_t byte);
  /// Which file it is (device and number on it), whatever its name.
  [[nodiscard]] std::pair<std::uint64_t, std::uint64_t> identity() const;

 private:
  std::filesystem::path file_;
  int handle_ = -1;
};

}  // namespace spindrift
