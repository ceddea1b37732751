// SPDX-License-Identifier: Apache-2.0
#include "core/session/capture_list.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/file_end.h"

namespace spindrift {
namespace {

constexpr std::uint64_t mark_distance = std::uint64_t{1} << 16;
constexpr std::size_t most_marks = 16;

/// First number of a row: its time.
double timeOf(const std::string& row) {
  return std::strtod(row.c_str(), nullptr);
}

bool isComment(const std::string& line) {
  return line.starts_with('#');
}

std::vector<std::string> linesOf(std::string_view text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.emplace_back(text.substr(begin, end - begin));
    if (lines.back().ends_with('\r')) lines.back().pop_back();
    begin = end + 1;
  }
  return lines;
}

/// Puts rows where their time belongs, behind the first `fixed` lines. Returns the first line that is another one now.
std::size_t insertRows(std::vector<std::string>& lines, std::size_t fixed, const std::vector<std::string>& rows) {
  std::size_t changed = lines.size();
  for (const std::string& row : rows) {
    std::size_t at = lines.size();
    while (at > fixed && !isComment(lines[at - 1]) && timeOf(lines[at - 1]) > timeOf(row)) --at;
    lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), row);
    changed = std::min(changed, at);
  }
  return changed;
}

std::string joined(const std::vector<std::string>& lines, std::size_t from) {
  std::string text;
  for (std::size_t i = from; i < lines.size(); ++i) text += lines[i] + "\n";
  return text;
}

}  // namespace

bool cutTornRow(const std::filesystem::path& file, const std::string& content) {
  const std::string text = readFile(file);
  if (text.empty() || text.ends_with('\n')) return false;
  const std::size_t end = text.rfind('\n');
  const std::size_t whole = end == std::string::npos ? 0 : end + 1;
  if (sha256(std::string_view(text).substr(0, whole)) != content) return false;
  replaceEnd(file, whole, {});
  return true;
}

CaptureList::CaptureList(std::filesystem::path file) : file_(std::move(file)) {}

CaptureList::Row128 CaptureList::nameOf(std::string_view row) {
  Sha256 digest;
  digest.add(row);
  const std::string bytes = digest.bytes();
  Row128 name{};
  std::memcpy(&name.first, bytes.data(), sizeof name.first);
  std::memcpy(&name.second, bytes.data() + sizeof name.first, sizeof name.second);
  return name;
}

CaptureList::Identity CaptureList::look() const {
  struct stat status {};
  if (::stat(file_.c_str(), &status) != 0) return {};
  return {status.st_dev, status.st_ino, static_cast<std::uint64_t>(status.st_size),
          static_cast<std::int64_t>(status.st_mtim.tv_sec) * 1'000'000'000 + status.st_mtim.tv_nsec, true};
}

void CaptureList::refresh() {
  const Identity now = look();
  if (now == seen_) return;
  *this = CaptureList(file_);
  if (!now.there) return;
  const std::string text = readFile(file_);
  header_ = text.substr(0, text.find_first_of("\r\n"));
  plain_ = text.find('\r') == std::string::npos && text.ends_with('\n');
  takeIn(0, text);
  seen_ = now;
}

void CaptureList::takeIn(std::uint64_t from, std::string_view text) {
  if (marks_.empty()) marks_.push_back({0, Sha256()});
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size() - 1);
    std::string line(rest.substr(0, end + 1));
    digest_.add(line);
    from += line.size();
    rest.remove_prefix(end + 1);
    while (line.ends_with('\n') || line.ends_with('\r')) line.pop_back();
    last_is_row_ = !rows_.empty() && !isComment(line);  // the first line is the header
    last_time_ = timeOf(line);
    rows_.insert(nameOf(line));
    if (from - marks_.back().at < mark_distance) continue;
    marks_.push_back({from, digest_});
    if (marks_.size() > most_marks) marks_.erase(marks_.begin());
  }
}

std::optional<ListChange> CaptureList::changeFor(const std::string& header, const std::vector<std::string>& rows) {
  refresh();
  if (seen_.there && seen_.size > 0 && header_ != header) {
    throw InputError(SourcePlace::atLine(file_, 1),
                     fmt::format("has the columns \"{}\"; allowed for capturing into it: \"{}\".", header_, header));
  }
  std::vector<std::string> fresh;
  std::unordered_set<Row128, HashOfRow> among;
  for (const std::string& row : rows) {
    const Row128 name = nameOf(row);
    if (!rows_.contains(name) && among.insert(name).second) fresh.push_back(row);
  }
  if (fresh.empty()) return std::nullopt;
  double earliest = timeOf(fresh.front());
  for (const std::string& row : fresh) earliest = std::min(earliest, timeOf(row));
  ListChange change;
  std::vector<std::string> lines;
  if (!seen_.there || seen_.size == 0) {
    lines.push_back(header);
  } else if (!plain_) {
    lines = linesOf(readFile(file_));
  } else {
    change.from = seen_.size;
    if (last_is_row_ && last_time_ > earliest) {
      // Back to a line that no row goes before.
      for (std::uint64_t length = std::uint64_t{1} << 16;; length *= 4) {
        change.from = seen_.size > length ? seen_.size - length : 0;
        std::string end = readPart(file_, change.from, seen_.size);
        if (change.from > 0) {
          const std::size_t line = end.find('\n');
          if (line == std::string::npos) continue;
          change.from += line + 1;
          end.erase(0, line + 1);
        }
        lines = linesOf(end);
        if (change.from == 0 || (!lines.empty() && timeOf(lines.front()) <= earliest) ||
            std::any_of(lines.begin(), lines.end(), isComment))
          break;
      }
    }
  }
  const bool whole = change.from == 0;
  const std::size_t changed = insertRows(lines, whole ? 1 : 0, fresh);
  // What stays where it is need not be written; a list that is not plain becomes it.
  const std::size_t keep = whole && (!seen_.there || seen_.size == 0 || !plain_) ? 0 : changed;
  for (std::size_t i = 0; i < keep; ++i) change.from += lines[i].size() + 1;
  change.text = joined(lines, keep);
  change.one_row = fresh.size() == 1 && change.from == seen_.size;
  return change;
}

void CaptureList::apply(const ListChange& change) {
  if (change.from == 0) {
    writeFileAtomically(file_, change.text);
  } else {
    replaceEnd(file_, change.from, change.text);
  }
  if (change.from == 0 || marks_.empty() || marks_.front().at > change.from) {
    refresh();  // reads it all
    return;
  }
  // The rows that were there are known; the digest goes on from the last mark before the change.
  if (change.from < seen_.size) {
    while (marks_.back().at > change.from) marks_.pop_back();
    digest_ = marks_.back().digest;
    takeIn(marks_.back().at, readPart(file_, marks_.back().at, change.from));
  }
  takeIn(change.from, change.text);
  seen_ = look();
}

std::string CaptureList::hash() {
  refresh();
  return seen_.there ? digest_.text() : std::string();
}

}  // namespace spindrift
