// SPDX-License-Identifier: Apache-2.0
// Watches a folder into which another program writes: which files are still being written, which have settled.
//
// Works by looking (polling): network folders and removable media tell nobody when they change. A file is settled when
// its size and time of writing have stood still for `settle_s`, measured on the caller's clock, so that a wrong clock
// of a camera does no harm. Names that programs use while they write (".part", ".tmp", ".crdownload", leading dot,
// trailing ~) are left alone until they are renamed. Names are looked at every time; of many settled files a thousand
// are looked at more closely each time, in turn, so one that is written again is noticed after as many looks as there
// are thousands. Deterministic: files are told in order of their time of writing, then of their name. No threads.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <unordered_map>
#include <vector>

namespace spindrift {

enum class FileState {
  Growing,   ///< new, or changed since the last look
  Settled,   ///< has stood still for long enough; told once per content
  Empty,     ///< nothing was written into it for as long; nobody waits for it
  Vanished,  ///< gone or renamed before it settled
};

struct WatchedFile {
  std::filesystem::path file;
  FileState state = FileState::Growing;
  std::uintmax_t size = 0;
  std::int64_t written_ns = 0;  ///< time of writing, ns since 1970 (UTC)
};

struct FolderWatchOptions {
  double settle_s = 1.0;
  bool subfolders = true;  ///< cameras make one per day
};

class FolderWatch {
 public:
  explicit FolderWatch(std::filesystem::path folder, const FolderWatchOptions& options = {});

  /// Looks once. `now_s`: any clock that never runs backwards. Returns what changed since the last look.
  [[nodiscard]] std::vector<WatchedFile> look(double now_s);
  /// One sentence if the folder could not be read at the last look (gone, no permission), else empty. Looking again
  /// goes on where it stopped: what was told is not told twice.
  [[nodiscard]] const std::string& problem() const { return problem_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Files seen that have not settled yet.
  [[nodiscard]] std::size_t unsettled() const { return unsettled_; }
  /// True for names that programs use for files they are still writing.
  [[nodiscard]] static bool isWorkingName(const std::filesystem::path& file);

 private:
  struct Known {
    std::uintmax_t size = 0;
    std::int64_t written_ns = 0;
    double since_s = 0.0;
    bool settled = false;
    std::uint64_t number = 0;  ///< of the file, in order of arrival
    std::uint64_t seen = 0;    ///< number of the last look that found it
  };
  void lookAt(const std::string& file, double now_s, std::vector<WatchedFile>& changes);
  void lookInto(const std::string& folder, double now_s, std::vector<WatchedFile>& changes, std::error_code& error);

  std::filesystem::path folder_;
  FolderWatchOptions options_;
  std::unordered_map<std::string, Known> known_;  ///< by path
  std::size_t unsettled_ = 0;
  std::uint64_t looks_ = 0;
  std::uint64_t groups_ = 1;  ///< of settled files, of which each look takes one
  std::uint64_t files_ = 0;   ///< found so far
  std::string problem_;
};

}  // namespace spindrift
