// SPDX-License-Identifier: Apache-2.0
#include "core/probing/touch_stream.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/probing/printed_text.h"

namespace spindrift {
namespace {

/// Overwrites a line (from 1) with blanks; false if there is none.
bool blankLine(std::string& text, std::size_t line) {
  std::size_t begin = 0;
  for (std::size_t i = 1; i < line; ++i) {
    begin = text.find('\n', begin);
    if (begin == std::string::npos) return false;
    ++begin;
  }
  const std::size_t end = std::min(text.find('\n', begin), text.size());
  std::fill(text.begin() + static_cast<std::ptrdiff_t>(begin), text.begin() + static_cast<std::ptrdiff_t>(end), ' ');
  return end > begin;
}

}  // namespace

TouchStream::TouchStream(std::filesystem::path name, const MachineDescription& machine, std::optional<JsonNode> pattern)
    : name_(std::move(name)), machine_(machine), pattern_(std::move(pattern)) {}

std::vector<Touch> TouchStream::update(std::string_view text) {
  const std::size_t end = text.rfind('\n');
  const std::string_view complete = end == std::string_view::npos ? std::string_view() : text.substr(0, end + 1);
  waiting_ = complete.size() < text.size();
  if (!complete.starts_with(done_)) {
    done_.clear();
    header_.clear();
    lines_ = 0;
    printed_ = 0;
    problems_.clear();
  }
  if (complete.size() == done_.size()) return {};
  std::vector<Touch> fresh = pattern_ ? readPrinted(complete) : readCsv(complete);
  done_ = complete;
  return fresh;
}

std::vector<Touch> TouchStream::readCsv(std::string_view complete) {
  std::vector<Touch> fresh;
  std::size_t begin = done_.size();
  while (begin < complete.size()) {
    const std::size_t end = complete.find('\n', begin);
    const std::string line(trimmed(complete.substr(begin, end - begin)));
    begin = end + 1;
    ++lines_;
    if (line.empty() || line.front() == '#') continue;
    if (header_.empty()) {
      // An unusable header is told now, not with the first touch: a row that is good by itself shows it.
      header_ = line;
      continue;
    }
    try {
      TouchList list = TouchList::parse(header_ + "\n" + line + "\n", name_);
      Touch& touch = list.touches.front();
      touch.line = lines_;
      fresh.push_back(std::move(touch));
    } catch (const InputError& e) {
      SourcePlace where = e.where();
      if (where.line == 2) where.line = lines_;  // the row was read by itself, as the second line of a text
      problems_.push_back({lines_, InputError(where, e.sentence()).what()});
    }
  }
  return fresh;
}

std::vector<Touch> TouchStream::readPrinted(std::string_view complete) {
  // Cycles and times count up from the first line, so everything is read again; bad lines are taken out.
  std::string text(complete);
  std::vector<StreamProblem> problems;
  for (int bad = 0; bad < 100; ++bad) {
    try {
      const PrintedText printed = readPrintedText(text, name_, *pattern_, machine_);
      const std::vector<Touch>& all = printed.touches.touches;
      const std::size_t from = std::min(printed_, all.size());
      std::vector<Touch> fresh(all.begin() + static_cast<std::ptrdiff_t>(from), all.end());
      printed_ = all.size();
      problems_ = problems;
      return fresh;
    } catch (const InputError& e) {
      const std::size_t line = e.where().line;
      if (line == 0) {
        if (std::string(e.what()).find("no line matches") != std::string::npos) {
          problems_ = problems;
          return {};  // nothing printed yet
        }
        throw;
      }
      problems.push_back({line, e.what()});
      if (!blankLine(text, line)) throw;
    }
  }
  problems_ = problems;
  return {};
}

}  // namespace spindrift
