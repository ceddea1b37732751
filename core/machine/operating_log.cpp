// SPDX-License-Identifier: Apache-2.0
#include "core/machine/operating_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "core/base/csv_rows.h"
#include "core/machine/log_table.h"

namespace spindrift {
namespace {

constexpr TimeColumn time_names[] = {{"time_s", 1.0}};

/// True for the signals that FORMATS.md gives a meaning: they hold numbers.
bool hasMeaning(std::string_view name) {
  return OperatingLog::isTemperature(name) || name == "spindle_rpm" || name.starts_with("feed_") ||
         name.starts_with("pos_") || name.starts_with("speed_") || name == "coolant" || name == "instrument_on" ||
         name == "compensation_on";
}

void refuseKelvin(const std::filesystem::path& file, const LogColumn& column) {
  const std::optional<double> middle = medianOfKelvin(column.values);
  if (!middle) return;
  throw InputError({file, fmt::format("column {}", column.name)},
                   fmt::format("its median is {:.1f}, which looks like kelvin although the name says degC; allowed: "
                               "temperatures in °C.",
                               *middle));
}

}  // namespace

OperatingLog::OperatingLog(std::vector<double> time_s) : time_s_(std::move(time_s)) {}

void OperatingLog::setSignal(const std::string& name, std::vector<double> values) {
  if (values.size() != time_s_.size()) values.resize(time_s_.size(), std::numeric_limits<double>::quiet_NaN());
  values = bridged(time_s_, values, !isTemperature(name));
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
  LogTable table = LogTable::read(rows, time_names);
  OperatingLog log;
  log.file_ = file;
  log.time_s_ = std::move(table.time_s);
  for (LogColumn& column : table.columns) {
    if (column.words_at && hasMeaning(column.name)) throw notANumber(*column.words_at, column.words);
    if (column.values.empty()) continue;  // most fields are words, such as remarks
    if (isTemperature(column.name)) refuseKelvin(file, column);
    log.setSignal(column.name, std::move(column.values));
  }
  return log;
}

std::vector<std::string> OperatingLog::remarks(const std::filesystem::path& file) {
  CsvRows rows(file);
  std::vector<std::string> sentences;
  const LogTable table = LogTable::read(rows, time_names);
  if (table.repeated > 0) {
    sentences.push_back(fmt::format("The log repeats the time of the row before {}; the last row of one time holds.",
                                    table.repeated == 1 ? "once" : fmt::format("{} times", table.repeated)));
  }
  for (const LogColumn& column : table.columns) {
    if (!column.values.empty()) continue;
    sentences.push_back(fmt::format(
        "The column {} of the log was left out: \"{}\" in line {} and {} more of its fields are no numbers.",
        column.name, column.words, column.words_at->line, column.word_count - 1));
  }
  return sentences;
}

std::string OperatingLog::doubtOfTemperatureUnit() const {
  std::vector<std::string> names = temperatureNames();
  std::erase_if(names, [this](const std::string& name) { return !std::isfinite(signal(name)->front()); });
  const bool hot = !names.empty() && std::all_of(names.begin(), names.end(), [this](const std::string& name) {
    return mayBeFahrenheit(*signal(name));
  });
  if (!hot) return {};
  return fmt::format(
      "No temperature of the log is ever below 50 °C ({} begins at {:.1f}): they look like degrees Fahrenheit, "
      "although "
      "their names say degC.",
      names.front(), signal(names.front())->front());
}

void OperatingLog::moveClock(double offset_s) {
  for (double& time : time_s_) time += offset_s;
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
