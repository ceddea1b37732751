// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/log_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>

#include "core/base/text.h"

namespace spindrift {
namespace {

/// A column between its rows.
struct Course {
  std::span<const double> time_s;
  std::span<const double> value;
  bool hold = false;

  /// Number of the last row that is not after `t`; the first one before all of them.
  [[nodiscard]] std::size_t rowAt(double t) const {
    const auto after = std::upper_bound(time_s.begin(), time_s.end(), t);
    return after == time_s.begin() ? 0 : static_cast<std::size_t>(after - time_s.begin()) - 1;
  }
  [[nodiscard]] double at(double t) const {
    const std::size_t row = rowAt(t);
    if (hold || row + 1 >= time_s.size() || t <= time_s[row]) return value[row];
    const double span = time_s[row + 1] - time_s[row];
    return span > 0.0 ? value[row] + (t - time_s[row]) / span * (value[row + 1] - value[row]) : value[row];
  }
  /// Mean of f(value) between two times.
  template <typename F>
  [[nodiscard]] double mean(double from, double to, const F& f) const {
    // Gauss-Legendre with three points on what is smooth.
    constexpr std::array<double, 3> place{-0.7745966692414834, 0.0, 0.7745966692414834};
    constexpr std::array<double, 3> weight{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    double sum = 0.0;
    double begin = from;
    for (std::size_t row = rowAt(from); begin < to; ++row) {
      // Before the first row its value holds already.
      const bool last = row + 1 >= time_s.size();
      const double end = last ? to : std::min(to, time_s[row + 1]);
      if (end > begin) {
        const double length = end - begin;
        if (hold) {
          sum += length * f(value[row]);
        } else {
          for (std::size_t k = 0; k < place.size(); ++k) {
            sum += length * weight[k] * f(at(begin + 0.5 * length * (1.0 + place[k])));
          }
        }
        begin = end;
      }
      if (last) break;
    }
    return sum / (to - from);
  }
};

std::string sensorName(const std::string& column, std::string_view what) {
  return fmt::format("sensor.{}.{}", column, what);
}

double valueOf(const ParameterValues& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? 0.0 : found->second;
}

bool isTemperatureColumn(std::string_view column) {
  return OperatingLog::isTemperature(column) || column.ends_with("_degC");
}

TimeTable tableAt(const std::string& name, const JsonNode& node, const std::optional<OperatingLog>& log,
                  const std::vector<SimulatorParameter>& own) {
  TimeTable table;
  table.name = name;
  const auto column = node.find("column");
  const auto window = node.find("window");
  if (column.has_value() == window.has_value()) {
    node.reject("either \"column\", a column of log.csv, or \"window\", two parameters");
  }
  if (column) {
    table.column = column->name();
    if (!log) column->reject("a column of the campaign's log.csv, which this campaign does not have");
    if (!log->has(table.column)) column->reject(joinedList(log->names(), "or"));
  } else {
    const std::vector<JsonNode> items = window->items();
    if (items.size() != 2) window->reject("two names of parameters, begin and end");
    for (const JsonNode& item : items) {
      const std::string parameter = item.name();
      if (std::none_of(own.begin(), own.end(), [&](const SimulatorParameter& p) { return p.name == parameter; })) {
        item.reject("the name of a parameter of this simulator");
      }
    }
    table.window = {items[0].name(), items[1].name()};
    if (table.window.begin_s == table.window.end_s) items[1].reject("another parameter than that of the begin");
  }
  table.minus_first = node.booleanOr("minus_first", false);
  table.mean_over_increment = node.booleanOr("mean_over_increment", false);
  table.hold = table.mean_over_increment;
  if (const auto between = node.find("between_rows")) table.hold = between->oneOf({"linear", "hold"}) == "hold";
  if (const auto divide = node.find("divide_by")) {
    table.divide_by = divide->number();
    if (table.divide_by == 0.0) divide->reject("a number other than zero");
  }
  table.power = node.numberOr("power", 1.0);
  return table;
}

}  // namespace

LogTables::LogTables(const JsonNode& tables, const std::optional<OperatingLog>& log,
                     const std::vector<SimulatorParameter>& own) {
  for (const auto& [name, node] : tables.members()) tables_.push_back(tableAt(name, node, log, own));
  if (log) log_ = *log;
}

std::vector<std::string> LogTables::names() const {
  std::vector<std::string> out;
  for (const TimeTable& table : tables_) out.push_back(table.name);
  return out;
}

std::vector<SimulatorWindow> LogTables::windows() const {
  std::vector<SimulatorWindow> out;
  for (const TimeTable& table : tables_) {
    if (!table.column.empty()) continue;
    const bool known = std::any_of(out.begin(), out.end(), [&](const SimulatorWindow& w) {
      return w.begin_s == table.window.begin_s && w.end_s == table.window.end_s;
    });
    if (!known) out.push_back(table.window);
  }
  return out;
}

std::vector<SimulatorParameter> LogTables::sensors() const {
  std::vector<SimulatorParameter> out;
  std::set<std::string> done;
  for (const TimeTable& table : tables_) {
    if (!isTemperatureColumn(table.column) || !done.insert(table.column).second) continue;
    SimulatorParameter p;
    p.of_sensor = true;
    p.name = sensorName(table.column, "gain");
    p.unit = "1";
    p.standard_uncertainty = 0.02;
    p.min = -0.5;
    p.max = 0.5;
    p.what = fmt::format("relative error of the changes that {} reads", table.column);
    out.push_back(p);
    const bool absolute = std::any_of(tables_.begin(), tables_.end(), [&](const TimeTable& other) {
      return other.column == table.column && !other.minus_first;
    });
    if (absolute) {
      p.name = sensorName(table.column, "offset");
      p.unit = "K";
      p.standard_uncertainty = 0.3;
      p.min = -5.0;
      p.max = 5.0;
      p.what = fmt::format("error of {} at all times", table.column);
      out.push_back(p);
    }
    p.name = sensorName(table.column, "lag");
    p.unit = "s";
    p.standard_uncertainty = 120.0;
    p.min = 0.0;
    p.max = 3600.0;
    p.what = fmt::format("time by which {} follows late", table.column);
    out.push_back(p);
  }
  return out;
}

std::vector<double> trueReadings(std::span<const double> time_s, std::span<const double> readings, double gain,
                                 double offset_K, double lag_s) {
  SPINDRIFT_ASSERT(time_s.size() == readings.size(), "a reading at every time");
  std::vector<double> out(readings.begin(), readings.end());
  if (out.empty()) return out;
  const Course course{time_s, readings, false};
  for (std::size_t i = 0; i < out.size(); ++i) {
    double rate_K_per_s = 0.0;
    if (lag_s > 0.0) {
      const double from = std::max(time_s.front(), time_s[i] - 0.5 * lag_s);
      const double to = std::min(time_s.back(), time_s[i] + 0.5 * lag_s);
      if (to > from) rate_K_per_s = (course.at(to) - course.at(from)) / (to - from);
    }
    out[i] = readings.front() + (readings[i] - readings.front()) / (1.0 + gain) - offset_K + lag_s * rate_K_per_s;
  }
  return out;
}

std::vector<double> LogTables::values(const TimeTable& table, const TableTimes& times,
                                      const ParameterValues& parameters) const {
  const auto f = [&](double v) {
    const double divided = v / table.divide_by;
    return table.power == 1.0 ? divided : std::pow(divided, table.power);
  };
  const auto count = static_cast<std::size_t>(std::floor(times.end_s / times.increment_s + 1e-9));
  std::vector<double> out;
  out.reserve(count + 1);
  if (table.column.empty()) {
    const double on = valueOf(parameters, table.window.begin_s);
    const double off = valueOf(parameters, table.window.end_s);
    for (std::size_t k = 0; k <= count; ++k) {
      const double t = times.first_s + static_cast<double>(k) * times.increment_s;
      double part = on <= t && t < off ? 1.0 : 0.0;
      if (table.mean_over_increment && k > 0) {
        const double overlap = std::min(off, t) - std::max(on, t - times.increment_s);
        part = std::clamp(overlap / times.increment_s, 0.0, 1.0);
      }
      out.push_back(part * f(1.0) + (part < 1.0 ? (1.0 - part) * f(0.0) : 0.0));
    }
  } else {
    const std::vector<double>* readings = log_.signal(table.column);
    SPINDRIFT_ASSERT(readings != nullptr, "a column that was there when the tables were read");
    std::vector<double> corrected;
    const double gain = valueOf(parameters, sensorName(table.column, "gain"));
    const double offset = valueOf(parameters, sensorName(table.column, "offset"));
    const double lag = valueOf(parameters, sensorName(table.column, "lag"));
    if (gain != 0.0 || offset != 0.0 || lag != 0.0) {
      corrected = trueReadings(log_.time_s(), *readings, gain, offset, lag);
      readings = &corrected;
    }
    const Course course{log_.time_s(), *readings, table.hold};
    for (std::size_t k = 0; k <= count; ++k) {
      const double t = times.first_s + static_cast<double>(k) * times.increment_s;
      const bool mean = table.mean_over_increment && k > 0;
      out.push_back(mean ? course.mean(t - times.increment_s, t, f) : f(course.at(t)));
    }
  }
  if (table.minus_first) {
    const double first = out.front();
    for (double& v : out) v -= first;
  }
  return out;
}

std::map<std::string, std::string> LogTables::text(const TableTimes& times, const ParameterValues& parameters) const {
  std::map<std::string, std::string> out;
  for (const TimeTable& table : tables_) {
    const std::vector<double> all = values(table, times, parameters);
    std::string& lines = out[table.name];
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double t = static_cast<double>(k) * times.increment_s;
      if (!std::isfinite(all[k])) {
        throw SimulatorFailed(
            fmt::format("The table {} has no value at {:.6g} s: a power of a negative number, or of "
                        "zero; allowed: powers that every value of {} has.",
                        table.name, t, table.column.empty() ? "the window" : table.column));
      }
      // CalculiX reads 20 characters of a number.
      lines += fmt::format("{}{:.12g}, {:.12g}", k == 0 ? "" : "\n", t, all[k]);
    }
  }
  return out;
}

}  // namespace spindrift
