// SPDX-License-Identifier: Apache-2.0
// A short name for the content of files and settings, so that a result knows from what it was made.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace spindrift {

/// 64-bit FNV-1a over everything that is added; not for cryptography. Each part is closed by its length, so that
/// ("ab", "c") and ("a", "bc") differ.
class Fingerprint {
 public:
  Fingerprint& add(std::string_view part);
  /// Content of a file. Throws InputError if it cannot be read.
  Fingerprint& addFile(const std::filesystem::path& file);
  /// 16 hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  void mix(std::string_view bytes);
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

/// Fingerprint of a campaign folder: relative names and contents of all its files, in order of their names.
[[nodiscard]] std::string fingerprintOfFolder(const std::filesystem::path& folder);

}  // namespace spindrift
