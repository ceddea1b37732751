// SPDX-License-Identifier: Apache-2.0
// Reading a file that is too long to be held at once.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

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
  /// Back to the beginning; for regular files.
  void rewind();

 private:
  std::filesystem::path file_;
  int handle_ = -1;
};

}  // namespace spindrift
