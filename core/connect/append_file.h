// SPDX-License-Identifier: Apache-2.0
// A text file of lines that only grows and always ends with a whole line, also after kill -9 and on a full disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace spindrift {

class AppendFile {
 public:
  /// Opens or makes the file; a last line without its end (the program or the power failed) is taken off. Throws
  /// InputError, also while another program writes it.
  explicit AppendFile(std::filesystem::path file);
  ~AppendFile();
  AppendFile(const AppendFile&) = delete;
  AppendFile& operator=(const AppendFile&) = delete;

  /// All of `lines` or nothing; false: `failure()` says why (disk full, ...), and it may be tried again.
  [[nodiscard]] bool append(std::string_view lines);
  /// Brings what was appended onto the disk.
  void sync();
  [[nodiscard]] std::uintmax_t size() const noexcept { return size_; }
  [[nodiscard]] std::size_t repaired() const noexcept { return repaired_; }  ///< bytes taken off when opening
  [[nodiscard]] const std::string& failure() const noexcept { return failure_; }
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  /// The last `most` bytes, from the start of a line.
  [[nodiscard]] std::string tail(std::size_t most) const;

 private:
  std::filesystem::path file_;
  int handle_ = -1;
  std::uintmax_t size_ = 0;
  std::size_t repaired_ = 0;
  std::string failure_;
};

}  // namespace spindrift
