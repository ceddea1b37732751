// SPDX-License-Identifier: Apache-2.0
// The one reader of logs (log.csv of a campaign, records of signals over time): columns of numbers beside one of time.
//
// Read row by row: beside the numbers no more than a block of lines of the file is in memory. What a column without
// numbers means is for its reader to say; here it is kept with its name and the place of its first words. A word among
// numbers (a sensor that says "fail", an overflow written as inf) is a value that is not known.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/csv_rows.h"
#include "core/base/error.h"

namespace spindrift {

/// A name that stands for the time, and the length of its unit.
struct TimeColumn {
  std::string_view name;
  double seconds;
};

/// A column beside the time.
struct LogColumn {
  std::string name;
  /// As many as rows, NaN where the field is no number; none if fewer than half of the fields that hold something are
  /// numbers.
  std::vector<double> values;
  std::size_t numbers = 0;              ///< fields that are finite numbers, also beside words
  std::size_t missing = 0;              ///< fields that are empty, or say so where that is taken for missing
  std::optional<SourcePlace> words_at;  ///< the first field that is neither
  std::string words;                    ///< what stands there
  std::size_t word_count = 0;           ///< fields that are neither
};

struct LogTable {
  std::filesystem::path file;
  std::vector<double> time_s;  ///< never decreases
  std::size_t repeated = 0;    ///< rows that repeat the time of the row before
  std::vector<LogColumn> columns;

  /// The first of `time_names` that is there is the time. `nan_is_missing`: the texts "nan" and "n/a" stand for a
  /// missing value. Throws InputError; of several faults it tells that of a row, then that of the time: a row with
  /// another number of fields, no column of time, no row, a time that is no number or runs back.
  [[nodiscard]] static LogTable read(CsvRows& rows, std::span<const TimeColumn> time_names,
                                     bool nan_is_missing = false);
};

/// What speaks against a column of temperatures that says degC: its median is one that a workshop has in kelvin only.
/// Empty: nothing; else that median.
[[nodiscard]] std::optional<double> medianOfKelvin(std::span<const double> values);
/// True if none of the values is ever so cold as a workshop is in degC, and they may be one in degrees Fahrenheit.
[[nodiscard]] bool mayBeFahrenheit(std::span<const double> values);

/// True for "nan", "NA", "n/a": what other programs write for a missing value.
[[nodiscard]] bool saysMissing(std::string_view field);

/// Missing values (NaN) replaced: held from the row before or linear between rows; at the ends the nearest value. All
/// missing stays missing.
[[nodiscard]] std::vector<double> bridged(std::span<const double> time_s, std::span<const double> values, bool hold);

}  // namespace spindrift
