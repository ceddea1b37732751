// SPDX-License-Identifier: Apache-2.0
#include "core/machine/operating_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/csv_rows.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

/// Fills NaN: states keep the last known value, temperatures are interpolated; ends take the nearest known value.
void fillGaps(const std::vector<double>& time_s, std::vector<double>& values, bool interpolate) {
  std::size_t known = values.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    for (std::size_t k = known == values.size() ? 0 : known + 1; k < i; ++k) {
      if (known == values.size()) {
        values[k] = values[i];
      } else if (interpolate && time_s[i] > time_s[known]) {
        const double part = (time_s[k] - time_s[known]) / (time_s[i] - time_s[known]);
        values[k] = values[known] + part * (values[i] - values[known]);
      } else {
        values[k] = values[known];
      }
    }
    known = i;
  }
  if (known == values.size()) return;
  for (std::size_t k = known + 1; k < values.size(); ++k) values[k] = values[known];
}

/// True for the signals that FORMATS.md gives a meaning: they hold numbers.
bool hasMeaning(std::string_view name) {
  return OperatingLog::isTemperature(name) || name == "spindle_rpm" || name.starts_with("feed_") ||
         name.starts_with("pos_") || name.starts_with("speed_") || name == "coolant" || name == "instrument_on" ||
         name == "compensation_on";
}

/// A column as far as it is read.
struct LogColumn {
  bool known = false;  ///< what is no number is an error; else a column of words (a remark, a programme name)
  bool numeric = true;
  std::vector<double> values;  ///< NaN where the field is empty
  std::optional<InputError> error;

  void take(const CsvRows& rows, std::size_t column, bool is_time) {
    if (!numeric) return;
    const std::string_view field = rows.fields()[column];
    double value = std::numeric_limits<double>::quiet_NaN();
    if (!parseNumber(field, value) && (is_time || !field.empty())) {
      if (known) error = notANumber(rows.place(column), field);
    } else if (is_time && !values.empty() && value < values.back()) {
      error.emplace(
          rows.place(column),
          fmt::format("time runs backwards from {} s to {} s; allowed: rows in order of time.", values.back(), value));
    } else {
      values.push_back(value);
      return;
    }
    numeric = false;
    values = std::vector<double>();  // gives the memory back
  }
};

}  // namespace

OperatingLog::OperatingLog(std::vector<double> time_s) : time_s_(std::move(time_s)) {}

void OperatingLog::setSignal(const std::string& name, std::vector<double> values) {
  if (values.size() != time_s_.size()) values.resize(time_s_.size(), std::numeric_limits<double>::quiet_NaN());
  fillGaps(time_s_, values, isTemperature(name));
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) {
    names_.push_back(name);
    values_.push_back(std::move(values));
  } else {
    values_[static_cast<std::size_t>(found - names_.begin())] = std::move(values);
  }
}

OperatingLog OperatingLog::read(const std::filesystem::path& file) {
  CsvRows rows(file);
  const std::vector<std::string>& names = rows.columnNames();
  std::vector<LogColumn> columns(names.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    columns[c].known = names[c] == "time_s" || hasMeaning(names[c]);
    columns[c].values.reserve(rows.mostRows());
  }
  const auto time = std::find(names.begin(), names.end(), "time_s") - names.begin();
  std::size_t count = 0;
  while (rows.next()) {
    ++count;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      columns[c].take(rows, c, static_cast<std::ptrdiff_t>(c) == time);
    }
  }
  // A row that is none is told first, then the time, then the columns from left to right.
  const std::size_t time_column = csvColumn(file, names, "time_s");
  if (count == 0) throw InputError({file, ""}, "holds no rows; allowed: at least one row.");
  if (columns[time_column].error) throw InputError(*columns[time_column].error);
  OperatingLog log;
  log.file_ = file;
  log.time_s_ = std::move(columns[time_column].values);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].error) throw InputError(*columns[c].error);
    if (c != time_column && columns[c].numeric) log.setSignal(names[c], std::move(columns[c].values));
  }
  return log;
}

bool OperatingLog::has(std::string_view name) const noexcept {
  return signal(name) != nullptr;
}

const std::vector<double>* OperatingLog::signal(std::string_view name) const noexcept {
  const auto found = std::find(names_.begin(), names_.end(), name);
  return found == names_.end() ? nullptr : &values_[static_cast<std::size_t>(found - names_.begin())];
}

double OperatingLog::at(std::string_view name, double time_s) const {
  const std::vector<double>* values = signal(name);
  SPINDRIFT_ASSERT(values != nullptr && !values->empty(), "a signal that the log does not have");
  const auto after = std::upper_bound(time_s_.begin(), time_s_.end(), time_s);
  if (after == time_s_.begin()) return values->front();
  const auto index = static_cast<std::size_t>(after - time_s_.begin()) - 1;
  if (index + 1 >= time_s_.size() || !isTemperature(name)) return (*values)[index];
  const double span = time_s_[index + 1] - time_s_[index];
  if (!(span > 0.0)) return (*values)[index];
  return (*values)[index] + (time_s - time_s_[index]) / span * ((*values)[index + 1] - (*values)[index]);
}

bool OperatingLog::isTemperature(std::string_view name) noexcept {
  return name.starts_with("T_") && name.ends_with("_degC");
}

std::vector<std::string> OperatingLog::temperatureNames() const {
  std::vector<std::string> names;
  std::copy_if(names_.begin(), names_.end(), std::back_inserter(names),
               [](const std::string& n) { return isTemperature(n); });
  return names;
}

}  // namespace spindrift
