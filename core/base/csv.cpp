// SPDX-License-Identifier: Apache-2.0
#include "core/base/csv.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/atomic_file.h"
#include "core/base/csv_rows.h"
#include "core/base/text.h"

namespace spindrift {
CsvTable CsvTable::read(const std::filesystem::path& file) {
  return parse(readFile(file), file);
}

CsvTable CsvTable::parse(std::string content, const std::filesystem::path& name) {
  CsvTable table;
  table.text_ = std::make_shared<const std::string>(std::move(content));
  CsvRows rows(*table.text_, name);
  table.file_ = name;
  table.names_ = rows.columnNames();
  // Known before it is filled: a vector that grows holds its content twice.
  table.fields_.reserve(rows.mostRows() * table.names_.size());
  table.lines_.reserve(rows.mostRows());
  while (rows.next()) {
    table.fields_.insert(table.fields_.end(), rows.fields().begin(), rows.fields().end());
    table.lines_.push_back(rows.line());
    for (auto& text : rows.takeUnquoted()) table.unquoted_.push_back(std::move(text));
  }
  return table;
}

bool CsvTable::hasColumn(std::string_view name) const noexcept {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

std::size_t CsvTable::column(std::string_view name) const {
  return csvColumn(file_, names_, name);
}

std::string_view CsvTable::text(std::size_t row, std::size_t column) const {
  SPINDRIFT_ASSERT(row < lines_.size() && column < names_.size(), "CSV field out of range");
  return fields_[row * names_.size() + column];
}

double CsvTable::number(std::size_t row, std::size_t column) const {
  const std::string_view field = text(row, column);
  double value = 0.0;
  if (!parseNumber(field, value)) throw notANumber(place(row, column), field);
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
  return SourcePlace::atLine(file_, lines_[row]);
}

SourcePlace CsvTable::place(std::size_t row, std::size_t column) const {
  return SourcePlace::atLine(file_, lines_.at(row), fmt::format("column {}", names_.at(column)));
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
