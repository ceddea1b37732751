// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/run_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <vector>

#include "core/simulator/simulator.h"

namespace spindrift {

namespace fs = std::filesystem;

RunFolder::RunFolder() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  std::string name = (parent / "spindrift-simulator-XXXXXX").string();
  if (error || ::mkdtemp(name.data()) == nullptr) {
    throw SimulatorFailed(fmt::format("No folder for a run can be made in {}: {}.", parent.string(),
                                      error ? error.message() : std::strerror(errno)));
  }
  path_ = name;
}

RunFolder::~RunFolder() {
  std::error_code ignored;
  if (!kept_) fs::remove_all(path_, ignored);
}

void RunFolder::keep(const std::set<std::string>& relative) {
  kept_ = true;
  std::error_code ignored;
  std::vector<fs::path> others;
  for (fs::recursive_directory_iterator it(path_, ignored), end; !ignored && it != end; it.increment(ignored)) {
    std::error_code failed;
    if (it->is_directory(failed) && !it->is_symlink(failed)) continue;
    if (!relative.contains(it->path().lexically_relative(path_).generic_string())) others.push_back(it->path());
  }
  for (const fs::path& other : others) fs::remove(other, ignored);
}

}  // namespace spindrift
