// SPDX-License-Identifier: Apache-2.0
#include "core/machine/log_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "core/base/text.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

/// The column of time as far as it is read; its error is told after those of rows.
struct Clock {
  std::optional<std::size_t> column;
  double seconds = 1.0;  ///< of one unit
  std::string before;    ///< text of the row before
  std::optional<InputError> error;

  Clock(const std::vector<std::string>& names, std::span<const TimeColumn> time_names) {
    for (const TimeColumn& candidate : time_names) {
      const auto found = std::find(names.begin(), names.end(), candidate.name);
      if (found == names.end()) continue;
      column = static_cast<std::size_t>(found - names.begin());
      seconds = candidate.seconds;
      return;
    }
  }

  void take(const CsvRows& rows, LogTable& table) {
    if (error || !column) return;
    const std::string_view field = rows.fields()[*column];
    double value = 0.0;
    if (!parseNumber(field, value)) {
      error = notANumber(rows.place(*column), field);
      return;
    }
    value *= seconds;
    if (!table.time_s.empty() && value < table.time_s.back()) {
      error.emplace(rows.place(*column),
                    fmt::format("the clock jumps back from {} to {}; allowed: a time that never decreases (cut the "
                                "file at the jump, or correct the clock from here on).",
                                before, field));
      return;
    }
    if (!table.time_s.empty() && value == table.time_s.back()) ++table.repeated;
    table.time_s.push_back(value);
    before = field;
  }
};

void take(LogColumn& column, const CsvRows& rows, std::size_t index, bool nan_is_missing) {
  const std::string_view field = rows.fields()[index];
  double value = not_there;
  if (field.empty() || (nan_is_missing && saysMissing(field))) {
    ++column.missing;
  } else if (parseNumber(field, value)) {
    ++column.numbers;
  } else {
    value = not_there;  // what was read of "1e999" is no number
    if (column.word_count++ == 0) {
      column.words_at = rows.place(index);
      column.words = field;
    }
  }
  column.values.push_back(value);
}

std::vector<double> present(std::span<const double> values) {
  std::vector<double> out;
  std::copy_if(values.begin(), values.end(), std::back_inserter(out), [](double v) { return std::isfinite(v); });
  return out;
}

}  // namespace

std::optional<double> medianOfKelvin(std::span<const double> values) {
  std::vector<double> known = present(values);
  if (known.empty()) return std::nullopt;
  const double middle = median(std::move(known));
  return middle > 250.0 && middle < 400.0 ? std::optional(middle) : std::nullopt;
}

bool mayBeFahrenheit(std::span<const double> values) {
  std::vector<double> known = present(values);
  if (known.empty()) return true;
  return *std::min_element(known.begin(), known.end()) >= 50.0 && median(std::move(known)) <= 130.0;
}

bool saysMissing(std::string_view field) {
  std::string lower(field);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower == "nan" || lower == "na" || lower == "n/a" || lower == "-nan";
}

LogTable LogTable::read(CsvRows& rows, std::span<const TimeColumn> time_names, bool nan_is_missing) {
  const std::vector<std::string>& names = rows.columnNames();
  Clock clock(names, time_names);
  LogTable table;
  table.file = rows.file();
  table.time_s.reserve(rows.mostRows());
  std::vector<LogColumn> columns(names.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    columns[c].name = names[c];
    if (clock.column != c) columns[c].values.reserve(rows.mostRows());
  }
  std::size_t count = 0;
  while (rows.next()) {
    ++count;
    clock.take(rows, table);
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (clock.column != c) spindrift::take(columns[c], rows, c, nan_is_missing);
  }
  if (!clock.column) {
    if (time_names.size() == 1) (void)csvColumn(table.file, names, time_names.front().name);
    throw InputError(
        {table.file, "header"},
        fmt::format("there is no time column; allowed: time_s, time_min or time_h; found: {}.", joinedList(names)));
  }
  if (count == 0) throw InputError({table.file, ""}, "holds no rows; allowed: at least one row.");
  if (clock.error) throw InputError(*clock.error);
  for (LogColumn& column : columns)
    if (column.word_count > column.numbers) column.values = std::vector<double>();
  columns.erase(columns.begin() + static_cast<std::ptrdiff_t>(*clock.column));
  table.columns = std::move(columns);
  return table;
}

std::vector<double> bridged(std::span<const double> time_s, std::span<const double> values, bool hold) {
  std::vector<double> out(values.begin(), values.end());
  std::ptrdiff_t last = -1;
  const auto count = static_cast<std::ptrdiff_t>(out.size());
  for (std::ptrdiff_t i = 0; i <= count; ++i) {
    if (i < count && !std::isfinite(out[i])) continue;
    for (std::ptrdiff_t k = last + 1; k < i; ++k) {
      if (last < 0) {
        if (i < count) out[k] = out[i];
      } else if (i >= count || hold || time_s[i] <= time_s[last]) {
        out[k] = out[last];
      } else {
        out[k] = out[last] + (time_s[k] - time_s[last]) / (time_s[i] - time_s[last]) * (out[i] - out[last]);
      }
    }
    last = i;
  }
  return out;
}

}  // namespace spindrift
