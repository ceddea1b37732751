// SPDX-License-Identifier: Apache-2.0
// Files that a list or a document names stay inside the folder of that list: nothing that came from elsewhere makes the
// program read, write, move or delete anything outside, be it by an absolute path, by ".." or by a link.
#pragma once

#include <filesystem>
#include <map>
#include <string_view>

#include "core/base/error.h"

namespace spindrift {

class InsideFolder {
 public:
  explicit InsideFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// folder / relative. Throws InputError at `place` if that leaves the folder. What does not exist is no fault here.
  [[nodiscard]] std::filesystem::path path(std::string_view relative, const SourcePlace& place);

 private:
  std::filesystem::path folder_;
  std::filesystem::path real_;
  std::map<std::filesystem::path, bool> parents_;  ///< whether a folder, links followed, lies inside
};

}  // namespace spindrift
