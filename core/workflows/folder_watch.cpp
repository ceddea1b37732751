// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/folder_watch.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>

namespace spindrift {
namespace {

/// Regular files of a folder. A file that vanishes while it is looked at is left out.
std::vector<std::filesystem::path> filesIn(const std::filesystem::path& folder, bool subfolders,
                                           std::error_code& error) {
  std::vector<std::filesystem::path> files;
  const auto take = [&](const std::filesystem::directory_entry& entry) {
    std::error_code ignored;
    if (entry.is_regular_file(ignored) && !FolderWatch::isWorkingName(entry.path())) files.push_back(entry.path());
  };
  if (subfolders) {
    std::filesystem::recursive_directory_iterator at(folder, std::filesystem::directory_options::skip_permission_denied,
                                                     error);
    for (const std::filesystem::recursive_directory_iterator end; !error && at != end; at.increment(error)) take(*at);
  } else {
    std::filesystem::directory_iterator at(folder, error);
    for (const std::filesystem::directory_iterator end; !error && at != end; at.increment(error)) take(*at);
  }
  return files;
}

}  // namespace

FolderWatch::FolderWatch(std::filesystem::path folder, const FolderWatchOptions& options)
    : folder_(std::move(folder)), options_(options) {}

bool FolderWatch::isWorkingName(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  if (name.empty() || name.front() == '.' || name.back() == '~') return true;
  for (const char* ending : {".part", ".partial", ".tmp", ".temp", ".crdownload", ".filepart"}) {
    if (name.ends_with(ending)) return true;
  }
  return false;
}

std::size_t FolderWatch::unsettled() const {
  return static_cast<std::size_t>(
      std::count_if(known_.begin(), known_.end(), [](const auto& k) { return !k.second.settled; }));
}

std::vector<WatchedFile> FolderWatch::look(double now_s) {
  std::vector<WatchedFile> changes;
  std::error_code error;
  const std::vector<std::filesystem::path> files = filesIn(folder_, options_.subfolders, error);
  if (error) {
    problem_ =
        fmt::format("{} cannot be read: {}. Capturing goes on when it is back.", folder_.string(), error.message());
    return changes;
  }
  problem_.clear();
  for (auto& [file, known] : known_) known.seen = false;
  for (const std::filesystem::path& file : files) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) continue;
    const auto size = static_cast<std::uintmax_t>(status.st_size);
    const std::int64_t written =
        static_cast<std::int64_t>(status.st_mtim.tv_sec) * 1'000'000'000 + status.st_mtim.tv_nsec;
    const auto [at, fresh] = known_.try_emplace(file);
    Known& known = at->second;
    known.seen = true;
    if (fresh || known.size != size || known.written_ns != written) {
      known = {size, written, now_s, false, true};
      changes.push_back({file, FileState::Growing, size, written});
    } else if (!known.settled && size > 0 && now_s - known.since_s >= options_.settle_s) {
      known.settled = true;
      changes.push_back({file, FileState::Settled, size, written});
    }
  }
  for (auto at = known_.begin(); at != known_.end();) {
    if (at->second.seen) {
      ++at;
      continue;
    }
    if (!at->second.settled)
      changes.push_back({at->first, FileState::Vanished, at->second.size, at->second.written_ns});
    at = known_.erase(at);
  }
  std::sort(changes.begin(), changes.end(), [](const WatchedFile& a, const WatchedFile& b) {
    return a.written_ns != b.written_ns ? a.written_ns < b.written_ns : a.file < b.file;
  });
  return changes;
}

}  // namespace spindrift
