// SPDX-License-Identifier: Apache-2.0
// CSV as FORMATS.md writes it: C locale, comma separated, one header row, '#' starts a comment line, UTF-8 (a byte
// order mark and CRLF are accepted), fields may stand in double quotes. Every complaint names file, line, column and
// value.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"

namespace spindrift {

/// A whole CSV file in memory. Column names are unique; every row has as many fields as the header.
class CsvTable {
 public:
  /// Throws InputError: file missing, not text, no header, a duplicate column, a row with another number of fields
  /// (said to be a decimal comma where it looks like one).
  [[nodiscard]] static CsvTable read(const std::filesystem::path& file);
  /// The same from text in memory; `name` stands for the file in errors.
  [[nodiscard]] static CsvTable parse(std::string text, const std::filesystem::path& name);

  [[nodiscard]] std::size_t rowCount() const noexcept { return lines_.size(); }
  [[nodiscard]] const std::vector<std::string>& columnNames() const noexcept { return names_; }
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }

  [[nodiscard]] bool hasColumn(std::string_view name) const noexcept;
  /// Index of a column; throws InputError naming the missing column and those that are there.
  [[nodiscard]] std::size_t column(std::string_view name) const;

  [[nodiscard]] std::string_view text(std::size_t row, std::size_t column) const;
  /// A finite number; throws InputError with file, line, column and value.
  [[nodiscard]] double number(std::size_t row, std::size_t column) const;
  /// True if the field is empty.
  [[nodiscard]] bool empty(std::size_t row, std::size_t column) const { return text(row, column).empty(); }
  /// A whole column of numbers.
  [[nodiscard]] std::vector<double> numbers(std::string_view name) const;
  /// Text that must not be empty.
  [[nodiscard]] std::string requiredText(std::size_t row, std::size_t column) const;

  /// "line 12" or "line 12, column sigma" of this file, for errors.
  [[nodiscard]] SourcePlace place(std::size_t row) const;
  [[nodiscard]] SourcePlace place(std::size_t row, std::size_t column) const;

 private:
  std::filesystem::path file_;
  std::vector<std::string> names_;
  std::vector<std::string_view> fields_;  // row major, into *text_ or unquoted_
  std::vector<std::size_t> lines_;        // line number of each row, from 1
  std::shared_ptr<const std::string> text_;
  std::vector<std::shared_ptr<const std::string>> unquoted_;
};

/// A field for writing: quoted if it holds a comma, a quote or a line break; a text that a spreadsheet would run as a
/// formula (it begins with =, +, -, @, a tab or a carriage return and is no number) gets a mark (') in front, which
/// CsvTable takes off again.
[[nodiscard]] std::string csvField(std::string_view plain);

}  // namespace spindrift
