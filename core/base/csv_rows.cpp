// SPDX-License-Identifier: Apache-2.0
#include "core/base/csv_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/base/atomic_file.h"
#include "core/base/text.h"
#include "core/base/untrusted_text.h"

namespace spindrift {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 18;

/// The mark that csvField puts before a formula is no part of the text.
std::string_view withoutMark(std::string_view field) {
  if (field.starts_with('\'') && isFormula(field)) field.remove_prefix(1);
  return field;
}

/// Takes one field off the front of `line` (which must not be at its end marker); sets `more` if a comma followed.
/// `place` makes the place of the line, for errors.
template <class Place>
std::string_view takeField(std::string_view& line, bool& more, std::vector<std::shared_ptr<const std::string>>& owned,
                           const Place& place) {
  std::string_view field;
  const std::string_view start = trimmed(line);
  if (!start.empty() && start.front() == '"') {
    std::string text;
    std::size_t i = static_cast<std::size_t>(start.data() - line.data()) + 1;
    for (;; ++i) {
      if (i >= line.size()) throw InputError(place(), "a quoted field is not closed; allowed: a second double quote.");
      if (line[i] != '"') {
        text += line[i];
      } else if (i + 1 < line.size() && line[i + 1] == '"') {
        text += '"';
        ++i;
      } else {
        break;
      }
    }
    line.remove_prefix(i + 1);
    owned.push_back(std::make_shared<const std::string>(std::move(text)));
    field = withoutMark(*owned.back());
    const std::size_t comma = line.find(',');
    if (!trimmed(line.substr(0, comma)).empty()) {
      throw InputError(place(), fmt::format("text \"{}\" follows a closing quote; allowed: a comma.",
                                            trimmed(line.substr(0, comma))));
    }
    more = comma != std::string_view::npos;
    line.remove_prefix(more ? comma + 1 : line.size());
    return field;
  }
  const std::size_t comma = line.find(',');
  field = trimmed(line.substr(0, comma));
  more = comma != std::string_view::npos;
  line.remove_prefix(more ? comma + 1 : line.size());
  return withoutMark(field);
}

bool looksLikeDecimalComma(const std::vector<std::string_view>& fields, std::size_t expected) {
  const auto digits = [](std::string_view t) {
    return !t.empty() && std::all_of(t.begin(), t.end(), [](char c) { return (c >= '0' && c <= '9') || c == '-'; });
  };
  const auto whole = static_cast<std::size_t>(std::count_if(fields.begin(), fields.end(), digits));
  return fields.size() > expected && whole >= 2 * (fields.size() - expected);
}

}  // namespace

CsvRows::CsvRows(const std::filesystem::path& file) : file_(file) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) {
    reader_.emplace(file);
    checkBytes();
    // What another program appends from now on is not checked, and not read.
    reader_->seek(0);
    unread_ = bytes_;
    given_ = filled_ = 0;
    rest_ = block();
  } else {
    // A pipe is read once only.
    buffer_ = readFile(file);
    rest_ = buffer_;
    checkBytes();
  }
  readHeader();
}

CsvRows::CsvRows(std::string_view text, const std::filesystem::path& name) : file_(name), rest_(text) {
  checkBytes();
  readHeader();
}

std::string_view CsvRows::block() {
  if (!reader_) return {};
  std::memmove(buffer_.data(), buffer_.data() + given_, filled_ - given_);
  filled_ -= given_;
  given_ = 0;
  for (;;) {
    if (filled_ == buffer_.size()) buffer_.resize(std::max(block_bytes, 2 * buffer_.size()));
    const std::span<char> free(buffer_.data() + filled_, std::min(buffer_.size() - filled_, unread_));
    const std::size_t count = free.empty() ? 0 : reader_->read(free);
    unread_ -= count;
    filled_ += count;
    const std::size_t end = std::string_view(free.data(), count).rfind('\n');
    if (count > 0 && end == std::string_view::npos) continue;
    given_ = count == 0 ? filled_ : filled_ - count + end + 1;
    return {buffer_.data(), given_};
  }
}

bool CsvRows::nextLine(std::string_view& line) {
  if (rest_.empty()) rest_ = block();
  if (rest_.empty()) return false;
  ++line_;
  const std::size_t end = rest_.find('\n');
  line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (line_ == 1 && line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return true;
}

void CsvRows::checkBytes() {
  std::size_t lines = 0;
  std::optional<InputError> bad_byte;  // told if there are no zero bytes
  bool first = true;
  for (std::string_view part = reader_ ? block() : rest_; !part.empty(); part = block()) {
    bytes_ += part.size();
    if (first && part.starts_with("\xef\xbb\xbf")) part.remove_prefix(3);
    first = false;
    if (part.find('\0') != std::string_view::npos) {
      throw InputError({file_, ""}, "is not a text file (it contains zero bytes); allowed: CSV in UTF-8.");
    }
    if (const std::size_t bad = bad_byte ? std::string_view::npos : firstInvalidUtf8(part);
        bad != std::string_view::npos) {
      const auto before = std::count(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(bad), '\n');
      bad_byte.emplace(SourcePlace::atLine(file_, lines + static_cast<std::size_t>(before) + 1),
                       fmt::format("the byte 0x{:02X} is not UTF-8 (Latin-1, perhaps); allowed: CSV in UTF-8.",
                                   static_cast<unsigned>(static_cast<unsigned char>(part[bad]))));
    }
    lines += static_cast<std::size_t>(std::count(part.begin(), part.end(), '\n'));
  }
  if (bad_byte) throw InputError(*bad_byte);
  most_rows_ = lines + 1;
}

SourcePlace CsvRows::place() const {
  return SourcePlace::atLine(file_, line_);
}

SourcePlace CsvRows::place(std::size_t column) const {
  return SourcePlace::atLine(file_, line_, fmt::format("column {}", names_.at(column)));
}

bool CsvRows::nextFields() {
  std::string_view line;
  do {
    if (!nextLine(line)) return false;
  } while (trimmed(line).empty() || trimmed(line).front() == '#');
  fields_.clear();
  unquoted_.clear();
  for (bool more = true; more;) fields_.push_back(takeField(line, more, unquoted_, [this] { return place(); }));
  return true;
}

void CsvRows::readHeader() {
  if (!nextFields()) throw InputError({file_, ""}, "is empty; allowed: CSV with one header row.");
  if (fields_.size() == 1 && fields_[0].find(';') != std::string_view::npos) {
    throw InputError(place(),
                     "the columns are separated by semicolons; allowed: commas, and numbers with a decimal point.");
  }
  if (fields_.size() == 1 && fields_[0].find('\t') != std::string_view::npos)
    throw InputError(place(), "the columns are separated by tabs; allowed: commas.");
  for (const std::string_view field : fields_) {
    if (field.empty()) throw InputError(place(), "a column has no name; allowed: one name per column.");
    if (std::find(names_.begin(), names_.end(), field) != names_.end()) {
      throw InputError(place(), fmt::format("column \"{}\" appears twice; allowed: each name once.", field));
    }
    names_.emplace_back(field);
  }
  most_rows_ = std::min(most_rows_, bytes_ / names_.size() + 1);
}

bool CsvRows::next() {
  if (!nextFields()) return false;
  if (fields_.size() == names_.size()) return true;
  throw InputError(place(), fmt::format("{} fields instead of {}{}; allowed: {} fields separated by commas, numbers "
                                        "with a decimal point.",
                                        fields_.size(), names_.size(),
                                        looksLikeDecimalComma(fields_, names_.size())
                                            ? " (numbers seem to be written with a decimal comma)"
                                            : "",
                                        names_.size()));
}

std::size_t csvColumn(const std::filesystem::path& file, const std::vector<std::string>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw InputError({file, "header"}, fmt::format("column \"{}\" is missing; found: {}.", name, joinedList(names)));
  }
  return static_cast<std::size_t>(found - names.begin());
}

InputError notANumber(const SourcePlace& place, std::string_view field) {
  return {place, fmt::format("\"{}\" is not a number; allowed: a finite number with a decimal point.", field)};
}

bool isFormula(std::string_view text) noexcept {
  const std::size_t first = text.find_first_not_of('\'');
  return first != std::string_view::npos && std::string_view("=+-@\t\r").find(text[first]) != std::string_view::npos;
}

}  // namespace spindrift
