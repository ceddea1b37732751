// SPDX-License-Identifier: Apache-2.0
// CSV (csv.h), one row after the other: for files that are too long to be held as text.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/file_reader.h"

namespace spindrift {

/// The rows below the header of a CSV file. Every byte is checked before the first row is given. Of a file no more than
/// a block of lines is in memory; what is appended to it meanwhile is not read.
class CsvRows {
 public:
  /// Throws InputError: file missing, not text, no header, a duplicate column.
  explicit CsvRows(const std::filesystem::path& file);
  /// The same of text that outlives the rows; `name` stands for the file in errors.
  CsvRows(std::string_view text, const std::filesystem::path& name);
  CsvRows(const CsvRows&) = delete;
  CsvRows& operator=(const CsvRows&) = delete;

  /// Goes on to the next row, the first at the first call; false after the last. Throws InputError: a quote that is not
  /// closed, a row with another number of fields than the header (said to be a decimal comma where it looks like one).
  [[nodiscard]] bool next();

  /// The fields of the row, as many as columns. They hold until the next row is read; those of text in memory hold as
  /// long as the text, if what takeUnquoted returns is kept.
  [[nodiscard]] std::span<const std::string_view> fields() const noexcept { return fields_; }
  /// What fields of this row that stood in quotes point into.
  [[nodiscard]] std::vector<std::shared_ptr<const std::string>> takeUnquoted() { return std::move(unquoted_); }
  /// Line of the row, from 1.
  [[nodiscard]] std::size_t line() const noexcept { return line_; }
  /// "line 12" or "line 12, column sigma" of this file, for errors about the row.
  [[nodiscard]] SourcePlace place() const;
  [[nodiscard]] SourcePlace place(std::size_t column) const;

  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  [[nodiscard]] const std::vector<std::string>& columnNames() const noexcept { return names_; }
  /// There are at most as many rows, and they have at most as many fields as the file has bytes.
  [[nodiscard]] std::size_t mostRows() const noexcept { return most_rows_; }

 private:
  /// The next block of whole lines of the file; empty at its end, and of text in memory.
  [[nodiscard]] std::string_view block();
  [[nodiscard]] bool nextLine(std::string_view& line);
  void checkBytes();
  /// The fields of the next line that is neither empty nor a comment.
  [[nodiscard]] bool nextFields();
  void readHeader();

  std::filesystem::path file_;
  std::optional<FileReader> reader_;
  std::string buffer_;  // of the file: [0, given_) was given out as a block, [given_, filled_) is the next line
  std::size_t given_ = 0;
  std::size_t filled_ = 0;
  std::size_t unread_ = std::numeric_limits<std::size_t>::max();  // bytes of the file that may still be read
  std::string_view rest_;                                         // whole lines
  std::vector<std::string> names_;
  std::vector<std::string_view> fields_;
  std::vector<std::shared_ptr<const std::string>> unquoted_;
  std::size_t line_ = 0;
  std::size_t bytes_ = 0;
  std::size_t most_rows_ = 0;
};

/// Index of a column; throws InputError naming the missing column and those that are there.
[[nodiscard]] std::size_t csvColumn(const std::filesystem::path& file, const std::vector<std::string>& names,
                                    std::string_view name);

/// Says that a field is no finite number.
[[nodiscard]] InputError notANumber(const SourcePlace& place, std::string_view field);

/// True for a text that a spreadsheet would run as a formula, however many marks (') stand before it.
[[nodiscard]] bool isFormula(std::string_view text) noexcept;

}  // namespace spindrift
