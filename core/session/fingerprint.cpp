// SPDX-License-Identifier: Apache-2.0
#include "core/session/fingerprint.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/sha256.h"

namespace spindrift {

Fingerprint& Fingerprint::add(std::string_view part) {
  // A long part by its own name: what is kept stays short.
  parts_ += part.size() > 64 ? sha256(part) : std::string(part);
  parts_ += fmt::format("|{}|", part.size());
  return *this;
}

Fingerprint& Fingerprint::addFile(const std::filesystem::path& file) {
  return add(readFile(file));
}

std::string Fingerprint::text() const {
  return sha256(parts_);
}

FileFingerprints fingerprintsOfFiles(const std::filesystem::path& folder, const JobContext& job) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(folder)) return {};
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  FileFingerprints found;
  for (std::size_t i = 0; i < files.size(); ++i) {
    job.report(static_cast<double>(i) / static_cast<double>(files.size()), "reading the files");
    job.throwIfCancelled();
    found[files[i].lexically_relative(folder).generic_string()] = sha256OfFile(files[i]);
  }
  return found;
}

std::string fingerprintOf(const FileFingerprints& files) {
  Fingerprint all;
  for (const auto& [name, content] : files) all.add(name).add(content);
  return all.text();
}

std::string fingerprintOfFolder(const std::filesystem::path& folder) {
  return fingerprintOf(fingerprintsOfFiles(folder, {}));
}

}  // namespace spindrift
