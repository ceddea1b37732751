// SPDX-License-Identifier: Apache-2.0
#include "core/base/csv.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/atomic_file.h"
#include "core/base/text.h"
#include "core/base/untrusted_text.h"

namespace spindrift {
namespace {

/// True for a text that a spreadsheet would run as a formula, however many marks (') stand before it.
bool isFormula(std::string_view text) {
  const std::size_t first = text.find_first_not_of('\'');
  return first != std::string_view::npos && std::string_view("=+-@\t\r").find(text[first]) != std::string_view::npos;
}

/// The mark that csvField puts before a formula is no part of the text.
std::string_view withoutMark(std::string_view field) {
  if (field.starts_with('\'') && isFormula(field)) field.remove_prefix(1);
  return field;
}

/// Takes one field off the front of `line` (which must not be at its end marker); sets `more` if a comma followed.
std::string_view takeField(std::string_view& line, bool& more, std::vector<std::shared_ptr<const std::string>>& owned,
                           const SourcePlace& place) {
  std::string_view field;
  const std::string_view start = trimmed(line);
  if (!start.empty() && start.front() == '"') {
    std::string text;
    std::size_t i = static_cast<std::size_t>(start.data() - line.data()) + 1;
    for (;; ++i) {
      if (i >= line.size()) throw InputError(place, "a quoted field is not closed; allowed: a second double quote.");
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
      throw InputError(
          place, fmt::format("text \"{}\" follows a closing quote; allowed: a comma.", trimmed(line.substr(0, comma))));
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

CsvTable CsvTable::read(const std::filesystem::path& file) {
  return parse(readFile(file), file);
}

CsvTable CsvTable::parse(std::string content, const std::filesystem::path& name) {
  CsvTable table;
  table.file_ = name;
  table.text_ = std::make_shared<const std::string>(std::move(content));
  std::string_view rest = *table.text_;
  if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
  if (rest.find('\0') != std::string_view::npos) {
    throw InputError({name, ""}, "is not a text file (it contains zero bytes); allowed: CSV in UTF-8.");
  }
  if (const std::size_t bad = firstInvalidUtf8(rest); bad != std::string_view::npos) {
    const auto line = std::count(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(bad), '\n') + 1;
    throw InputError({name, fmt::format("line {}", line)},
                     fmt::format("the byte 0x{:02X} is no UTF-8 (Latin-1, perhaps); allowed: CSV in UTF-8.",
                                 static_cast<unsigned>(static_cast<unsigned char>(rest[bad]))));
  }
  std::size_t line_number = 0;
  std::vector<std::string_view> fields;
  while (!rest.empty()) {
    ++line_number;
    const std::size_t end = rest.find('\n');
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    const std::string_view visible = trimmed(line);
    if (visible.empty() || visible.front() == '#') continue;
    const SourcePlace place{name, fmt::format("line {}", line_number)};
    fields.clear();
    for (bool more = true; more;) fields.push_back(takeField(line, more, table.unquoted_, place));
    if (table.names_.empty()) {
      if (fields.size() == 1 && fields[0].find(';') != std::string_view::npos) {
        throw InputError(place,
                         "the columns are separated by semicolons; allowed: commas, and numbers with a decimal point.");
      }
      for (const std::string_view field : fields) {
        if (field.empty()) throw InputError(place, "a column has no name; allowed: one name per column.");
        if (table.hasColumn(field)) {
          throw InputError(place, fmt::format("column \"{}\" appears twice; allowed: each name once.", field));
        }
        table.names_.emplace_back(field);
      }
      // Known before it is filled: a vector that grows holds its content twice.
      const auto rows = static_cast<std::size_t>(std::count(rest.begin(), rest.end(), '\n')) + 1;
      table.fields_.reserve(std::min(rows * table.names_.size(), rest.size() + 1));
      table.lines_.reserve(rows);
      continue;
    }
    if (fields.size() != table.names_.size()) {
      throw InputError(place, fmt::format("{} fields instead of {}{}; allowed: {} fields separated by commas, numbers "
                                          "with a decimal point.",
                                          fields.size(), table.names_.size(),
                                          looksLikeDecimalComma(fields, table.names_.size())
                                              ? " (numbers seem to be written with a decimal comma)"
                                              : "",
                                          table.names_.size()));
    }
    table.fields_.insert(table.fields_.end(), fields.begin(), fields.end());
    table.lines_.push_back(line_number);
  }
  if (table.names_.empty()) throw InputError({name, ""}, "is empty; allowed: CSV with one header row.");
  return table;
}

bool CsvTable::hasColumn(std::string_view name) const noexcept {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

std::size_t CsvTable::column(std::string_view name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) {
    throw InputError({file_, "header"}, fmt::format("column \"{}\" is missing; found: {}.", name, joinedList(names_)));
  }
  return static_cast<std::size_t>(found - names_.begin());
}

std::string_view CsvTable::text(std::size_t row, std::size_t column) const {
  SPINDRIFT_ASSERT(row < lines_.size() && column < names_.size(), "CSV field out of range");
  return fields_[row * names_.size() + column];
}

double CsvTable::number(std::size_t row, std::size_t column) const {
  const std::string_view field = text(row, column);
  double value = 0.0;
  if (!parseNumber(field, value)) {
    throw InputError(place(row, column),
                     fmt::format("\"{}\" is not a number; allowed: a finite number with a decimal point.", field));
  }
  return value;
}

std::vector<double> CsvTable::numbers(std::string_view name) const {
  const std::size_t index = column(name);
  std::vector<double> values(rowCount());
  for (std::size_t row = 0; row < values.size(); ++row) values[row] = number(row, index);
  return values;
}

std::string CsvTable::requiredText(std::size_t row, std::size_t column) const {
  const std::string_view field = text(row, column);
  if (field.empty()) throw InputError(place(row, column), "the field is empty; allowed: a name.");
  return std::string(field);
}

SourcePlace CsvTable::place(std::size_t row) const {
  SPINDRIFT_ASSERT(row < lines_.size(), "CSV row out of range");
  return {file_, fmt::format("line {}", lines_[row])};
}

SourcePlace CsvTable::place(std::size_t row, std::size_t column) const {
  return {file_, fmt::format("line {}, column {}", lines_.at(row), names_.at(column))};
}

std::string csvField(std::string_view plain) {
  double number = 0.0;
  const std::string text = (isFormula(plain) && !parseNumber(plain, number) ? "'" : "") + std::string(plain);
  // Plain, it would be read as several fields, without its blanks, or, at the beginning of a line, as a comment.
  const bool plain_is_enough = text.find_first_of(",\"\r\n") == std::string_view::npos &&
                               trimmed(text).size() == text.size() && !text.starts_with('#');
  if (plain_is_enough) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    // A row is a line for whoever reads it.
    quoted += c == '\r' || c == '\n' ? ' ' : c;
  }
  return quoted + '"';
}

}  // namespace spindrift
