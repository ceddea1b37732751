// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/run_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "core/simulator/simulator.h"

namespace spindrift {

namespace fs = std::filesystem;

namespace {

constexpr auto name_begin = "spindrift-simulator-";
/// In a folder that was kept: others belong to runs that may still be under way.
constexpr auto kept_mark = ".kept";
constexpr std::size_t most_kept = 20;

void dropOldest(const fs::path& parent) {
  std::error_code ignored;
  std::vector<std::pair<fs::file_time_type, fs::path>> kept;
  for (fs::directory_iterator it(parent, ignored), end; !ignored && it != end; it.increment(ignored)) {
    std::error_code failed;
    if (!it->path().filename().string().starts_with(name_begin) || it->is_symlink(failed)) continue;
    const auto written = fs::last_write_time(it->path() / kept_mark, failed);
    if (!failed) kept.emplace_back(written, it->path());
  }
  if (kept.size() <= most_kept) return;
  std::sort(kept.begin(), kept.end());
  for (std::size_t i = 0; i < kept.size() - most_kept; ++i) fs::remove_all(kept[i].second, ignored);
}

}  // namespace

RunFolder::RunFolder() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  std::string name = (parent / (std::string(name_begin) + "XXXXXX")).string();
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
    const bool link = it->is_symlink(failed);
    const bool wanted = !link && it->is_regular_file(failed) &&
                        relative.contains(it->path().lexically_relative(path_).generic_string());
    if (!wanted) others.push_back(it->path());
  }
  // What lies deeper goes first; a folder that still holds something stays.
  for (auto other = others.rbegin(); other != others.rend(); ++other) fs::remove(*other, ignored);
  std::ofstream(path_ / kept_mark) << "kept by Spindrift because a run of a simulator failed\n";
  dropOldest(path_.parent_path());
}

}  // namespace spindrift
