// SPDX-License-Identifier: Apache-2.0
#include "core/session/fingerprint.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/base/atomic_file.h"

namespace spindrift {

void Fingerprint::mix(std::string_view bytes) {
  for (const char c : bytes) {
    state_ ^= static_cast<unsigned char>(c);
    state_ *= 0x100000001b3ULL;
  }
}

Fingerprint& Fingerprint::add(std::string_view part) {
  mix(part);
  mix(fmt::format("|{}|", part.size()));
  return *this;
}

Fingerprint& Fingerprint::addFile(const std::filesystem::path& file) {
  return add(readFile(file));
}

std::string Fingerprint::text() const {
  return fmt::format("{:016x}", state_);
}

std::string fingerprintOfFolder(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  Fingerprint fingerprint;
  for (const auto& file : files)
    fingerprint.add(std::filesystem::relative(file, folder).generic_string()).addFile(file);
  return fingerprint.text();
}

}  // namespace spindrift
