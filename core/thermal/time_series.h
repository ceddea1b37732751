// SPDX-License-Identifier: Apache-2.0
// Measured signals over time: import of any CSV, quality of each signal, averaging to a coarser period, merging of fast
// temperatures with sparse measurements.
//
// Time s; temperatures are converted to degC (`_K`, `_degF` columns, or `temperature_unit`) and named so (`T_b_degF`
// becomes `T_b_degC`, or `T_b_degF_degC` beside a column of that name), everything else keeps the
// unit its column name ends in (`_um`, `_urad`, `_rpm`, `_mm_min`, ...). A missing value is NaN inside the program and
// an EMPTY field in a file; the text "nan" is an error (FORMATS.md). States (speeds, feeds, switches) hold until the
// next row, everything else is linear between rows.
// Failure: InputError with file, line and what to do: no time column, a non-number, a clock that runs back, Kelvin or
// Fahrenheit in a column that says degC.
#pragma once

#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/machine/log_table.h"

namespace spindrift {

enum class SignalKind { Temperature, Speed, Feed, Switch, Position, Displacement, Other };

[[nodiscard]] std::string_view toString(SignalKind kind) noexcept;
/// Kind by the end of the name (`_degC`, `_K`, `_degF`, `_rpm`, `_mm_min`, `_um`, `_urad`, `_mm`, ...); a signal that
/// is only 0 or 1 and has no unit is a switch.
[[nodiscard]] SignalKind signalKind(std::string_view name, std::span<const double> values);
/// True for what holds until the next row (speeds, feeds, switches).
[[nodiscard]] constexpr bool holdsUntilNextRow(SignalKind kind) noexcept {
  return kind == SignalKind::Speed || kind == SignalKind::Feed || kind == SignalKind::Switch;
}

/// Friction: what a spindle or an axis heats by, whichever way it turns or moves.
[[nodiscard]] constexpr bool isDriven(SignalKind kind) noexcept {
  return kind == SignalKind::Speed || kind == SignalKind::Feed;
}

struct Signal {
  std::string name;
  SignalKind kind = SignalKind::Other;
  std::vector<double> values;  ///< as long as the series' time; NaN where missing
};

/// What is noteworthy about one signal.
struct SignalQuality {
  std::string name;
  std::size_t missing = 0;         ///< samples
  double longest_gap_s = 0.0;      ///< longest run of missing samples or rows
  std::size_t outliers = 0;        ///< isolated samples further than 6 robust sigma from the median of their neighbours
  std::vector<double> steps_at_s;  ///< sudden lasting changes between two rows (at most 50 are listed)
  bool constant = false;
  double minimum = 0.0;
  double maximum = 0.0;
};

struct TimeSeries {
  std::filesystem::path file;
  std::vector<double> time_s;
  std::vector<Signal> signals;
  std::vector<std::string> notes;  ///< sentences about what was found and done while reading

  /// A temperature is also found by the name it had in its file before it was converted ("T_b_degF" for "T_b_degC").
  [[nodiscard]] const Signal* find(std::string_view name) const noexcept;
  /// Throws InputError naming the column and those that are there.
  [[nodiscard]] const Signal& at(std::string_view name) const;
  [[nodiscard]] std::vector<std::string> names() const;
  /// Median distance of two rows, s.
  [[nodiscard]] double medianPeriod_s() const;
  /// Value at any time by the rule of its kind; gaps are bridged; outside the record the first resp. last value.
  [[nodiscard]] double valueAt(const Signal& signal, double time_s) const;
};

struct TimeSeriesOptions {
  /// "" (as the column names say, and checked), "degC", "K" or "degF" for every temperature column.
  std::string temperature_unit;
  /// Accept the text "nan" as a missing value.
  bool accept_nan_text = false;
};

/// Read row by row: beside the numbers no more than a block of lines of the file is in memory.
[[nodiscard]] TimeSeries readTimeSeries(const std::filesystem::path& file, const TimeSeriesOptions& options = {});
/// The same from text; `name` stands for the file in errors.
[[nodiscard]] TimeSeries parseTimeSeries(std::string_view text, const std::filesystem::path& name,
                                         const TimeSeriesOptions& options = {});

[[nodiscard]] SignalQuality signalQuality(const TimeSeries& series, const Signal& signal);

/// A signal on bins of equal length: the mean over each bin (a box filter whose first zero lies at the new sampling
/// frequency, which is the anti-alias filter here; models that average their own prediction in the same way see no
/// distortion). A bin without a sample is NaN.
struct BinnedSeries {
  double period_s = 0.0;
  std::vector<double> time_s;             ///< centres of the bins
  std::vector<std::pair<int, int>> rows;  ///< first and one past the last row of each bin
  [[nodiscard]] std::vector<double> mean(std::span<const double> values) const;
};
/// `from_s` <= t < `to_s`; period > 0.
[[nodiscard]] BinnedSeries binSeries(std::span<const double> time_s, double period_s,
                                     double from_s = -std::numeric_limits<double>::infinity(),
                                     double to_s = std::numeric_limits<double>::infinity());

/// A uniform grid from the first to the last time of the series. Where it is coarser than the rows (anti-alias): the
/// mean over the period around each time, and of what holds until the next row the mean over the period after it, for
/// that is what acts until the next time of the grid. Else interpolation by the rule of the kind. Gaps longer than
/// `longest_bridge_s` stay missing (NaN).
[[nodiscard]] TimeSeries resampled(const TimeSeries& series, double period_s, double longest_bridge_s);

/// Adds sparse signals (for example probing results) to the rows of `fast`: each sparse value stands at the nearest row
/// within `tolerance_s`, everywhere else the signal is missing. Values without a row are counted in a note. Throws
/// InputError if a name is in both.
[[nodiscard]] TimeSeries merged(const TimeSeries& fast, const TimeSeries& sparse, double tolerance_s);

}  // namespace spindrift
