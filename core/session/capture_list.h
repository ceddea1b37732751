// SPDX-License-Identifier: Apache-2.0
// A list of captures (captures/<name>.csv, first column time_s) that grows row by row: what an arrival costs does not
// depend on how long the list is.
//
//   in order of time    the row is appended and flushed
//   earlier             the end of the list, from where the row belongs, is written anew
//   new list, or one    the list is written whole, atomically
//   of another program
//   (CR LF, no end of
//   the last line)
//
// Which rows are there is known by the first 16 bytes of their SHA-256; the SHA-256 of the list is continued from row
// to row. Both are made once, when the list is first needed, and again when another program has changed the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "core/base/sha256.h"

namespace spindrift {

/// The end of a list as it is to be: `text` from byte `from` on.
struct ListChange {
  std::uint64_t from = 0;
  std::string text;
  bool one_row = false;  ///< appends one row: if it is cut short, nothing but itself is lost
};

class CaptureList {
 public:
  explicit CaptureList(std::filesystem::path file);

  /// What puts these rows where their time belongs; nothing if all are there. Rows of one time stay in the order in
  /// which they came; no row moves before a comment. Throws InputError: the list has other columns, cannot be read.
  [[nodiscard]] std::optional<ListChange> changeFor(const std::string& header, const std::vector<std::string>& rows);
  /// Makes the change and flushes it. Throws InputError (disk full ...); the list is as it was then.
  void apply(const ListChange& change);
  /// SHA-256 of the file as it is now; empty if there is none.
  [[nodiscard]] std::string hash();

 private:
  struct Row128 {
    std::uint64_t first, second;
    bool operator==(const Row128&) const = default;
  };
  struct HashOfRow {
    std::size_t operator()(const Row128& row) const { return row.first; }
  };
  struct Identity {
    std::uint64_t device = 0, inode = 0, size = 0;
    std::int64_t written_ns = 0;
    bool there = false;
    bool operator==(const Identity&) const = default;
  };
  struct Mark {
    std::uint64_t at;
    Sha256 digest;  ///< of what stands before
  };
  [[nodiscard]] static Row128 nameOf(std::string_view row);
  [[nodiscard]] Identity look() const;
  void refresh();
  /// Takes in what stands in the file from `from` on.
  void takeIn(std::uint64_t from, std::string_view text);

  std::filesystem::path file_;
  Identity seen_;
  std::string header_;
  bool plain_ = true;  ///< every line ends with LF alone
  double last_time_ = 0.0;
  bool last_is_row_ = false;
  std::unordered_set<Row128, HashOfRow> rows_;
  Sha256 digest_;
  std::vector<Mark> marks_;  ///< of the last megabyte, in order
};

/// Takes the last line away if it has no end and the file without it is `content` (SHA-256): what a crash left of a row
/// that was being appended. True if it did.
bool cutTornRow(const std::filesystem::path& file, const std::string& content);

}  // namespace spindrift
