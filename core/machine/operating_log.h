// SPDX-License-Identifier: Apache-2.0
// log.csv: what the machine did and how warm it was. Time s since the campaign start; temperatures degC.
//
// States (everything that is not a temperature) hold until the next row, temperatures (`T_..._degC`) are interpolated
// linearly (FORMATS.md). Outside the log the first resp. last value holds. A field may be empty: the signal is unknown
// there; states then keep the last known value, temperatures are interpolated over the gap. In a column without a
// meaning of its own a field that is no number is the same; a column in which most fields are words is no signal.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace spindrift {

class OperatingLog {
 public:
  /// Throws InputError: no `time_s`, a non-number, time that runs backwards, no rows, a temperature in kelvin.
  [[nodiscard]] static OperatingLog read(const std::filesystem::path& file);

  OperatingLog() = default;
  explicit OperatingLog(std::vector<double> time_s);
  /// Replaces or adds a signal; `values` as long as `time_s()`, NaN where unknown.
  void setSignal(const std::string& name, std::vector<double> values);
  /// Adds to every time.
  void moveClock(double offset_s);

  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  [[nodiscard]] const std::vector<double>& time_s() const noexcept { return time_s_; }
  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }
  [[nodiscard]] bool has(std::string_view name) const noexcept;
  /// Values at `time_s()`; gaps already filled as described above. Null if there is no such signal.
  [[nodiscard]] const std::vector<double>* signal(std::string_view name) const noexcept;
  /// Value at any time, by the rule of its kind. Throws InternalError for an unknown name.
  [[nodiscard]] double at(std::string_view name, double time_s) const;
  /// True for `T_..._degC`.
  [[nodiscard]] static bool isTemperature(std::string_view name) noexcept;
  /// Names of all temperatures.
  [[nodiscard]] std::vector<std::string> temperatureNames() const;
  /// Sentences about what `read` leaves out, columns most of whose fields are words, and about rows that repeat a time.
  /// Throws as `read`.
  [[nodiscard]] static std::vector<std::string> remarks(const std::filesystem::path& file);
  /// A sentence if all temperatures look like degrees Fahrenheit; else empty.
  [[nodiscard]] std::string doubtOfTemperatureUnit() const;
  [[nodiscard]] bool empty() const noexcept { return time_s_.empty(); }

 private:
  std::filesystem::path file_;
  std::vector<double> time_s_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> values_;
};

}  // namespace spindrift
