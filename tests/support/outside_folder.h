// SPDX-License-Identifier: GPL-3.0-or-later
// A file that lies outside of a folder and can be read, and the ways by which a name in that folder may lead to it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temp_folder.h"

namespace spindrift::testing {

class OutsideFolder {
 public:
  /// `content` of the file outside, `name` with its ending.
  OutsideFolder(const std::string& name, std::string_view content) : name_(name) {
    temp_.write("outside/" + name, content);
    std::filesystem::create_directories(folder());
    std::filesystem::create_symlink(temp_ / ("outside/" + name), folder() / ("link_" + name));
    std::filesystem::create_directory_symlink(temp_ / "outside", folder() / "linked");
  }
  [[nodiscard]] std::filesystem::path folder() const { return temp_ / "inside"; }
  [[nodiscard]] std::filesystem::path write(const std::string& name, std::string_view content) const {
    return temp_.write("inside/" + name, content);
  }
  /// By an absolute path, by "..", by a link to the file and by one to its folder.
  [[nodiscard]] std::vector<std::string> names() const {
    return {(temp_ / ("outside/" + name_)).string(), "../outside/" + name_, "link_" + name_, "linked/" + name_};
  }

 private:
  TempFolder temp_;
  std::string name_;
};

}  // namespace spindrift::testing
