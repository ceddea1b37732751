// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/folder_watch.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>

namespace spindrift {
namespace {

/// Settled files that one look takes.
constexpr std::size_t looked_at_once = 1000;

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

/// Where there is nothing to be read in a folder below the first one, others go on.
void FolderWatch::lookInto(const std::string& folder, double now_s, std::vector<WatchedFile>& changes,
                           std::error_code& error) {
  std::filesystem::directory_iterator at(folder, error);
  for (const std::filesystem::directory_iterator end; !error && at != end; at.increment(error)) {
    // What the folder itself says of an entry needs no look at the file.
    std::error_code unknown;
    if (at->is_directory(unknown) && !at->is_symlink(unknown)) {
      if (!options_.subfolders) continue;
      std::error_code of_its_own;
      lookInto(at->path().native(), now_s, changes, of_its_own);
      if (of_its_own && of_its_own != std::errc::permission_denied &&
          of_its_own != std::errc::no_such_file_or_directory)
        error = of_its_own;
    } else if (at->is_regular_file(unknown) && !isWorkingName(at->path())) {
      lookAt(at->path().native(), now_s, changes);
    }
  }
}

void FolderWatch::lookAt(const std::string& file, double now_s, std::vector<WatchedFile>& changes) {
  const auto [at, fresh] = known_.try_emplace(file);
  Known& known = at->second;
  if (fresh) known.number = files_++;
  known.seen = looks_;
  if (known.settled && known.number % groups_ != looks_ % groups_) return;
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) {
    // It vanished just now.
    if (fresh) known_.erase(at);
    return;
  }
  const auto size = static_cast<std::uintmax_t>(status.st_size);
  const std::int64_t written =
      static_cast<std::int64_t>(status.st_mtim.tv_sec) * 1'000'000'000 + status.st_mtim.tv_nsec;
  if (fresh || known.size != size || known.written_ns != written) {
    if (fresh || known.settled) ++unsettled_;
    known.size = size;
    known.written_ns = written;
    known.since_s = now_s;
    known.settled = false;
    changes.push_back({file, FileState::Growing, size, written});
  } else if (!known.settled && now_s - known.since_s >= options_.settle_s) {
    known.settled = true;
    --unsettled_;
    changes.push_back({file, size > 0 ? FileState::Settled : FileState::Empty, size, written});
  }
}

std::vector<WatchedFile> FolderWatch::look(double now_s) {
  std::vector<WatchedFile> changes;
  std::error_code error;
  ++looks_;
  groups_ = 1 + known_.size() / looked_at_once;
  lookInto(folder_.native(), now_s, changes, error);
  if (error) {
    problem_ = fmt::format("{} cannot be read: {}. Capturing continues when the folder is available again.",
                           folder_.string(), error.message());
    return changes;
  }
  problem_.clear();
  for (auto at = known_.begin(); at != known_.end();) {
    if (at->second.seen == looks_) {
      ++at;
      continue;
    }
    if (!at->second.settled) --unsettled_;
    if (!at->second.settled || at->second.size == 0) {
      changes.push_back({at->first, FileState::Vanished, at->second.size, at->second.written_ns});
    }
    at = known_.erase(at);
  }
  std::sort(changes.begin(), changes.end(), [](const WatchedFile& a, const WatchedFile& b) {
    return a.written_ns != b.written_ns ? a.written_ns < b.written_ns : a.file < b.file;
  });
  return changes;
}

}  // namespace spindrift
