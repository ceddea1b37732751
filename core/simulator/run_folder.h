// SPDX-License-Identifier: Apache-2.0
// A folder among the temporary files for one run of a program.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace spindrift {

/// Gone with all its content at the end, unless something of it is kept.
class RunFolder {
 public:
  /// Throws SimulatorFailed if no folder can be made.
  RunFolder();
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// Only these files stay, for the user to look at; no link and no empty folder does. Of folders that were kept the
  /// newest 20 stay.
  void keep(const std::set<std::string>& relative);

 private:
  std::filesystem::path path_;
  bool kept_ = false;
};

}  // namespace spindrift
