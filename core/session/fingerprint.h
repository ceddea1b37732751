// SPDX-License-Identifier: Apache-2.0
// A short name for the content of files and settings, so that a result knows from what it was made.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "core/base/job_context.h"

namespace spindrift {

/// SHA-256 (FIPS 180-4) over everything that is added. Each part is closed by its length, so that ("ab", "c") and
/// ("a", "bc") differ.
class Fingerprint {
 public:
  Fingerprint& add(std::string_view part);
  /// Content of a file. Throws InputError if it cannot be read.
  Fingerprint& addFile(const std::filesystem::path& file);
  /// 64 hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  std::string parts_;
};

/// Fingerprint of the content of each file, by its name relative to the campaign folder ("captures/images/a.jpg").
using FileFingerprints = std::map<std::string, std::string>;

/// Of all files in a folder; nothing where there is no folder. Throws InputError (a file cannot be read),
/// filesystem_error, Cancelled.
[[nodiscard]] FileFingerprints fingerprintsOfFiles(const std::filesystem::path& folder, const JobContext& job);
/// One for all of them together.
[[nodiscard]] std::string fingerprintOf(const FileFingerprints& files);
/// Fingerprint of a campaign folder: relative names and contents of all its files, in order of their names.
[[nodiscard]] std::string fingerprintOfFolder(const std::filesystem::path& folder);

}  // namespace spindrift
