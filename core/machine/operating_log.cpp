// SPDX-License-Identifier: Apache-2.0
#include "core/machine/operating_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/csv.h"
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
  const CsvTable table = CsvTable::read(file);
  const std::size_t time_column = table.column("time_s");
  if (table.rowCount() == 0) throw InputError({file, ""}, "holds no rows; allowed: at least one row.");
  OperatingLog log;
  log.file_ = file;
  log.time_s_.reserve(table.rowCount());
  for (std::size_t row = 0; row < table.rowCount(); ++row) {
    const double time = table.number(row, time_column);
    if (!log.time_s_.empty() && time < log.time_s_.back()) {
      throw InputError(table.place(row, time_column),
                       fmt::format("time runs backwards from {} s to {} s; allowed: rows in order of time.",
                                   log.time_s_.back(), time));
    }
    log.time_s_.push_back(time);
  }
  for (std::size_t column = 0; column < table.columnNames().size(); ++column) {
    if (column == time_column) continue;
    std::vector<double> values(table.rowCount(), std::numeric_limits<double>::quiet_NaN());
    bool numeric = true;
    // A column of words (a remark, a programme name) is not a signal, unless FORMATS.md gives it a meaning.
    const std::string& name = table.columnNames()[column];
    const bool known = isTemperature(name) || name == "spindle_rpm" || name.starts_with("feed_") ||
                       name.starts_with("pos_") || name.starts_with("speed_") || name == "coolant" ||
                       name == "instrument_on" || name == "compensation_on";
    for (std::size_t row = 0; row < table.rowCount() && numeric; ++row) {
      if (table.empty(row, column)) continue;
      if (known) {
        values[row] = table.number(row, column);
      } else {
        numeric = parseNumber(table.text(row, column), values[row]);
      }
    }
    if (numeric) log.setSignal(table.columnNames()[column], std::move(values));
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
