// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/time_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/csv_rows.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/machine/log_table.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

constexpr TimeColumn time_columns[] = {{"time_s", 1.0},   {"time_min", 60.0}, {"time_h", 3600.0},
                                       {"time_ms", 1e-3}, {"t_s", 1.0},       {"t_min", 60.0},
                                       {"t_h", 3600.0},   {"time", 1.0},      {"timestamp", 1.0}};

std::vector<double> present(std::span<const double> values) {
  std::vector<double> out;
  out.reserve(values.size());
  for (const double v : values)
    if (std::isfinite(v)) out.push_back(v);
  return out;
}

/// Without the unit of a temperature that is none in degC; empty if the name has no such unit.
std::string_view stemOfOtherUnit(std::string_view name) {
  for (const std::string_view unit : {"_degF", "_K"})
    if (name.ends_with(unit)) return name.substr(0, name.size() - unit.size());
  return {};
}

/// The name that a temperature has once it is in degC. If there is another of that name, the unit is added to its own.
std::string nameInCelsius(const TimeSeries& series, const std::string& name) {
  const std::string_view stem = stemOfOtherUnit(name);
  if (stem.empty()) return name;
  std::string converted = std::string(stem) + "_degC";
  const bool taken = std::any_of(series.signals.begin(), series.signals.end(),
                                 [&](const Signal& other) { return other.name == converted; });
  return taken ? name + "_degC" : converted;
}

/// Converts and checks the unit of the temperatures; a file cannot say degC and mean kelvin.
void settleTemperatureUnits(TimeSeries& series, const TimeSeriesOptions& options) {
  std::vector<Signal*> undeclared;
  for (Signal& signal : series.signals) {
    if (signal.kind != SignalKind::Temperature) continue;
    const std::string unit = !options.temperature_unit.empty() ? options.temperature_unit
                             : signal.name.ends_with("_K")     ? "K"
                             : signal.name.ends_with("_degF")  ? "degF"
                                                               : "degC";
    const std::string stated = signal.name;
    signal.name = nameInCelsius(series, stated);
    if (unit == "degC") {
      if (options.temperature_unit.empty()) undeclared.push_back(&signal);
      continue;
    }
    for (double& v : signal.values) v = unit == "K" ? v - 273.15 : (v - 32.0) / 1.8;
    series.notes.push_back(fmt::format("{} was read in {} and converted to degC.", stated, unit));
  }
  bool all_hot = !undeclared.empty();
  for (const Signal* signal : undeclared) {
    const std::optional<double> kelvin = medianOfKelvin(signal->values);
    if (kelvin) {
      throw InputError(
          {series.file, fmt::format("column {}", signal->name)},
          fmt::format("its median is {:.1f}, which looks like kelvin although the name says degC; allowed: "
                      "degC, or rename the column to end in _K, or give --temperature-unit K.",
                      *kelvin));
    }
    if (!mayBeFahrenheit(signal->values)) all_hot = false;
  }
  if (all_hot) {
    throw InputError({series.file, fmt::format("column {}", undeclared.front()->name)},
                     fmt::format("no temperature of the file is ever below 50 (median here {:.1f}), which looks like "
                                 "Fahrenheit although the name says degC; allowed: degC, or rename the columns to end "
                                 "in _degF, or give --temperature-unit degF (or degC if they really are that hot).",
                                 median(present(undeclared.front()->values))));
  }
  // One Fahrenheit sensor among others: its first value, converted, falls among the others.
  if (undeclared.size() >= 3) {
    std::vector<double> first;
    for (const Signal* s : undeclared) {
      const std::vector<double> values = present(s->values);
      first.push_back(values.empty() ? missing : values.front());
    }
    const double typical = median(present(first));
    for (std::size_t i = 0; i < undeclared.size(); ++i) {
      if (first[i] > 55.0 && typical < 40.0 && std::abs((first[i] - 32.0) / 1.8 - typical) < 6.0) {
        series.notes.push_back(fmt::format(
            "{} starts at {:.1f} where the others start near {:.1f}: it may be in Fahrenheit; if so, rename "
            "the column to end in _degF.",
            undeclared[i]->name, first[i], typical));
      }
    }
  }
}

}  // namespace

std::string_view toString(SignalKind kind) noexcept {
  switch (kind) {
    case SignalKind::Temperature:
      return "temperature";
    case SignalKind::Speed:
      return "speed";
    case SignalKind::Feed:
      return "feed";
    case SignalKind::Switch:
      return "switch";
    case SignalKind::Position:
      return "position";
    case SignalKind::Displacement:
      return "displacement";
    case SignalKind::Other:
      return "other";
  }
  return "other";
}

SignalKind signalKind(std::string_view name, std::span<const double> values) {
  if (name.ends_with("_degC") || name.ends_with("_K") || name.ends_with("_degF")) return SignalKind::Temperature;
  if (name.ends_with("_um") || name.ends_with("_urad") || name.ends_with("_nm") || name.ends_with("_mrad")) {
    return SignalKind::Displacement;
  }
  if (name.ends_with("_rpm")) return SignalKind::Speed;
  if (name.ends_with("_mm_min") || name.ends_with("_m_min")) return SignalKind::Feed;
  if (name.ends_with("_mm") || name.ends_with("_deg")) return SignalKind::Position;
  if (name == "coolant" || name == "instrument_on" || name == "compensation_on" || name.ends_with("_on")) {
    return SignalKind::Switch;
  }
  bool binary = !values.empty();
  for (const double v : values)
    if (std::isfinite(v) && v != 0.0 && v != 1.0) binary = false;
  return binary && !name.ends_with("_s") ? SignalKind::Switch : SignalKind::Other;
}

const Signal* TimeSeries::find(std::string_view name) const noexcept {
  const auto named = [this](std::string_view stem, std::string_view unit) -> const Signal* {
    for (const Signal& s : signals)
      if (s.name.size() == stem.size() + unit.size() && s.name.starts_with(stem) && s.name.ends_with(unit)) return &s;
    return nullptr;
  };
  if (const Signal* found = named(name, "")) return found;
  const std::string_view stem = stemOfOtherUnit(name);
  if (stem.empty()) return nullptr;
  const Signal* beside = named(name, "_degC");
  return beside != nullptr ? beside : named(stem, "_degC");
}

const Signal& TimeSeries::at(std::string_view name) const {
  if (const Signal* found = find(name)) return *found;
  const std::vector<std::string> all = names();
  throw InputError({file, "header"}, fmt::format("column \"{}\" is missing; found: {}.", name, joinedList(all)));
}

std::vector<std::string> TimeSeries::names() const {
  std::vector<std::string> out;
  for (const Signal& s : signals) out.push_back(s.name);
  return out;
}

double TimeSeries::medianPeriod_s() const {
  if (time_s.size() < 2) return 0.0;
  std::vector<double> distance(time_s.size() - 1);
  for (std::size_t i = 0; i + 1 < time_s.size(); ++i) distance[i] = time_s[i + 1] - time_s[i];
  return median(std::move(distance));
}

double TimeSeries::valueAt(const Signal& signal, double when) const {
  SPINDRIFT_ASSERT(!time_s.empty() && signal.values.size() == time_s.size(), "signal and time differ in length");
  const auto after = std::upper_bound(time_s.begin(), time_s.end(), when);
  std::ptrdiff_t low = after - time_s.begin() - 1;
  std::ptrdiff_t high = low + 1;
  const auto count = static_cast<std::ptrdiff_t>(time_s.size());
  while (low >= 0 && !std::isfinite(signal.values[low])) --low;
  while (high < count && !std::isfinite(signal.values[high])) ++high;
  if (low < 0) return high < count ? signal.values[high] : missing;
  if (high >= count || holdsUntilNextRow(signal.kind)) return signal.values[low];
  const double span = time_s[high] - time_s[low];
  if (span <= 0.0) return signal.values[low];
  return signal.values[low] + (when - time_s[low]) / span * (signal.values[high] - signal.values[low]);
}

namespace {

TimeSeries seriesOf(CsvRows& rows, const TimeSeriesOptions& options) {
  if (!options.temperature_unit.empty() && options.temperature_unit != "degC" && options.temperature_unit != "K" &&
      options.temperature_unit != "degF") {
    throw InputError(
        fmt::format("temperature unit \"{}\" is not known; allowed: degC, K, degF.", options.temperature_unit));
  }
  LogTable table = LogTable::read(rows, time_columns, options.accept_nan_text);
  TimeSeries series;
  series.file = table.file;
  series.time_s = std::move(table.time_s);
  if (table.repeated > 0)
    series.notes.push_back(fmt::format("{} rows repeat the time of the row before.", table.repeated));
  for (LogColumn& column : table.columns) {
    Signal signal;
    signal.name = column.name;
    const bool other = signalKind(signal.name, {}) == SignalKind::Other && !saysMissing(column.words);
    if (column.words_at && (column.numbers == 0 || (other && column.values.empty())) && !saysMissing(column.words)) {
      series.notes.push_back(fmt::format("Column {} holds text and was left out.", signal.name));
      continue;
    }
    // Words among the numbers of a column that means nothing to us (alarms) are values that are not known.
    if (column.words_at && !other) {
      throw InputError(
          *column.words_at,
          fmt::format("\"{}\" is not a number; allowed: a finite number with a decimal point{}.", column.words,
                      saysMissing(column.words) ? ", or an empty field where the value is missing" : ""));
    }
    if (column.numbers == 0) {
      series.notes.push_back(fmt::format("Column {} is empty and was left out.", signal.name));
      continue;
    }
    if (const std::size_t missing = column.missing + column.word_count; missing > 0)
      series.notes.push_back(
          fmt::format("{} of {} values of {} are missing.", missing, series.time_s.size(), signal.name));
    signal.values = std::move(column.values);
    signal.kind = signalKind(signal.name, signal.values);
    if (isDriven(signal.kind))
      for (double& v : signal.values) v = std::abs(v);
    series.signals.push_back(std::move(signal));
  }
  settleTemperatureUnits(series, options);
  return series;
}

}  // namespace

TimeSeries readTimeSeries(const std::filesystem::path& file, const TimeSeriesOptions& options) {
  CsvRows rows(file);
  return seriesOf(rows, options);
}

TimeSeries parseTimeSeries(std::string_view text, const std::filesystem::path& name, const TimeSeriesOptions& options) {
  CsvRows rows(text, name);
  return seriesOf(rows, options);
}

SignalQuality signalQuality(const TimeSeries& series, const Signal& signal) {
  SignalQuality quality;
  quality.name = signal.name;
  const std::vector<double> values = present(signal.values);
  quality.missing = signal.values.size() - values.size();
  if (values.empty()) return quality;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  quality.minimum = *low;
  quality.maximum = *high;
  quality.constant = *high - *low <= 1e-9 * std::max(1.0, std::abs(*high));
  const double period = series.medianPeriod_s();
  double last = series.time_s.front();
  for (std::size_t i = 0; i < signal.values.size(); ++i) {
    if (!std::isfinite(signal.values[i])) continue;
    if (series.time_s[i] - last > 1.5 * period)
      quality.longest_gap_s = std::max(quality.longest_gap_s, series.time_s[i] - last);
    last = series.time_s[i];
  }
  quality.longest_gap_s =
      std::max(quality.longest_gap_s, series.time_s.back() - last > 1.5 * period ? series.time_s.back() - last : 0.0);
  if (quality.constant || holdsUntilNextRow(signal.kind) || values.size() < 8) return quality;
  // Outliers and steps: distance from the medians of the three samples before and after.
  std::vector<double> jump;
  for (std::size_t i = 1; i < values.size(); ++i) jump.push_back(values[i] - values[i - 1]);
  const double sigma = std::max(robustSigma(jump), 1e-12 * (1.0 + std::abs(quality.maximum)));
  const auto median3 = [&](std::size_t i) { return median({values[i], values[i + 1], values[i + 2]}); };
  for (std::size_t i = 3; i + 3 < values.size(); ++i) {
    const double before = median3(i - 3);
    const double after = median3(i + 1);
    if (std::abs(values[i] - before) > 6.0 * sigma && std::abs(values[i] - after) > 6.0 * sigma &&
        std::abs(after - before) < 4.0 * sigma) {
      ++quality.outliers;
    } else if (std::abs(values[i] - values[i - 1]) > 8.0 * sigma && std::abs(median3(i) - before) > 6.0 * sigma &&
               quality.missing == 0 && quality.steps_at_s.size() < 50) {
      quality.steps_at_s.push_back(series.time_s[i]);
    }
  }
  return quality;
}

std::vector<double> BinnedSeries::mean(std::span<const double> values) const {
  std::vector<double> out(rows.size(), missing);
  for (std::size_t b = 0; b < rows.size(); ++b) {
    double sum = 0.0;
    int count = 0;
    for (int r = rows[b].first; r < rows[b].second; ++r) {
      if (!std::isfinite(values[r])) continue;
      sum += values[r];
      ++count;
    }
    if (count > 0) out[b] = sum / count;
  }
  return out;
}

BinnedSeries binSeries(std::span<const double> time_s, double period_s, double from_s, double to_s) {
  SPINDRIFT_ASSERT(period_s > 0.0, "a bin has a length");
  BinnedSeries bins;
  bins.period_s = period_s;
  const auto begin = std::lower_bound(time_s.begin(), time_s.end(), from_s) - time_s.begin();
  const auto end = std::lower_bound(time_s.begin(), time_s.end(), to_s) - time_s.begin();
  if (begin >= end) return bins;
  // A small shift keeps rows that stand exactly on a border in one bin in spite of rounding.
  const double origin = time_s[begin] - 1e-6 * period_s;
  for (auto row = begin; row < end;) {
    const auto index = static_cast<long>((time_s[row] - origin) / period_s);
    const double limit = origin + static_cast<double>(index + 1) * period_s;
    auto last = row;
    while (last < end && time_s[last] < limit) ++last;
    if (last == row) ++last;
    bins.time_s.push_back(origin + (static_cast<double>(index) + 0.5) * period_s);
    bins.rows.emplace_back(static_cast<int>(row), static_cast<int>(last));
    row = last;
  }
  return bins;
}

namespace {

/// Mean over the time from t_s to t_s + period_s of values that hold until the next one, at most bridge_s; NaN where
/// none does.
double meanFrom(const std::vector<double>& times_s, const std::vector<double>& values, double t_s, double period_s,
                double bridge_s) {
  double sum = 0.0;
  double whole_s = 0.0;
  auto r = std::upper_bound(times_s.begin(), times_s.end(), t_s) - times_s.begin();
  for (r = std::max<std::ptrdiff_t>(0, r - 1); r < std::ssize(times_s) && times_s[r] < t_s + period_s; ++r) {
    double end_s = times_s[r] + bridge_s;
    if (r + 1 < std::ssize(times_s)) {
      if (times_s[r + 1] > end_s) continue;
      end_s = times_s[r + 1];
    }
    const double held_s = std::min(end_s, t_s + period_s) - std::max(times_s[r], t_s);
    if (!(held_s > 0.0)) continue;
    sum += held_s * values[r];
    whole_s += held_s;
  }
  return whole_s > 0.0 ? sum / whole_s : missing;
}

}  // namespace

TimeSeries resampled(const TimeSeries& series, double period_s, double longest_bridge_s) {
  SPINDRIFT_ASSERT(period_s > 0.0 && !series.time_s.empty(), "resampling needs a period and rows");
  TimeSeries out;
  out.file = series.file;
  out.notes = series.notes;
  const double start = series.time_s.front();
  const auto count = static_cast<std::size_t>(std::floor((series.time_s.back() - start) / period_s + 1e-9)) + 1;
  const double median_s = series.medianPeriod_s();
  const bool coarser = period_s > 1.5 * median_s;
  const double bridge_s = std::max(longest_bridge_s, 1.5 * median_s);
  out.time_s.resize(count);
  for (std::size_t i = 0; i < count; ++i) out.time_s[i] = start + static_cast<double>(i) * period_s;
  for (const Signal& signal : series.signals) {
    Signal target{signal.name, signal.kind, std::vector<double>(count, missing)};
    std::vector<double> times;
    std::vector<double> values;
    for (std::size_t r = 0; r < series.time_s.size(); ++r) {
      if (!std::isfinite(signal.values[r])) continue;
      times.push_back(series.time_s[r]);
      values.push_back(signal.values[r]);
    }
    if (times.empty()) continue;
    std::size_t first = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double t = out.time_s[i];
      // A row on a border belongs to both sides, or the mean would be that of an earlier time.
      const double border_s = 1e-6 * period_s;
      const auto onBorder = [&](double row_s) { return std::abs(row_s - t) > 0.5 * period_s - border_s; };
      while (first < times.size() && times[first] < t - 0.5 * period_s - border_s) ++first;
      if (coarser && holdsUntilNextRow(signal.kind)) {
        // What holds until the next row is what acts until the next time: its mean over that.
        if (const double value = meanFrom(times, values, t, period_s, bridge_s); std::isfinite(value)) {
          target.values[i] = value;
          continue;
        }
      }
      double sum = 0.0;
      double whole = 0.0;
      for (std::size_t r = first; coarser && r < times.size() && times[r] <= t + 0.5 * period_s + border_s; ++r) {
        const double weight = onBorder(times[r]) ? 0.5 : 1.0;
        sum += weight * values[r];
        whole += weight;
      }
      if (whole > 0.0) {
        target.values[i] = sum / whole;
        continue;
      }
      const auto next = std::lower_bound(times.begin(), times.end(), t) - times.begin();
      const auto last = static_cast<std::ptrdiff_t>(times.size());
      if (next < last && times[next] == t) {
        target.values[i] = values[next];
      } else if (next > 0 && next < last && times[next] - times[next - 1] <= bridge_s) {
        const double w = (t - times[next - 1]) / (times[next] - times[next - 1]);
        target.values[i] =
            holdsUntilNextRow(signal.kind) ? values[next - 1] : (1.0 - w) * values[next - 1] + w * values[next];
      }
    }
    out.signals.push_back(std::move(target));
  }
  return out;
}

TimeSeries merged(const TimeSeries& fast, const TimeSeries& sparse, double tolerance_s) {
  TimeSeries out = fast;
  for (const Signal& signal : sparse.signals) {
    if (fast.find(signal.name) != nullptr) {
      throw InputError({sparse.file, "header"},
                       fmt::format("column {} is also in {}; allowed: each signal in one file only.", signal.name,
                                   fast.file.string()));
    }
    Signal target{signal.name, signal.kind, std::vector<double>(fast.time_s.size(), missing)};
    std::size_t lost = 0;
    for (std::size_t r = 0; r < sparse.time_s.size(); ++r) {
      if (!std::isfinite(signal.values[r])) continue;
      const auto next =
          std::lower_bound(fast.time_s.begin(), fast.time_s.end(), sparse.time_s[r]) - fast.time_s.begin();
      std::ptrdiff_t best = -1;
      for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, next - 1);
           k <= next && k < static_cast<std::ptrdiff_t>(fast.time_s.size()); ++k) {
        if (best < 0 || std::abs(fast.time_s[k] - sparse.time_s[r]) < std::abs(fast.time_s[best] - sparse.time_s[r]))
          best = k;
      }
      if (best < 0 || std::abs(fast.time_s[best] - sparse.time_s[r]) > tolerance_s) {
        ++lost;
      } else {
        target.values[best] = signal.values[r];
      }
    }
    if (lost > 0) {
      out.notes.push_back(
          fmt::format("{} values of {} have no row within {} s and were left out.", lost, signal.name, tolerance_s));
    }
    out.signals.push_back(std::move(target));
  }
  return out;
}

}  // namespace spindrift
