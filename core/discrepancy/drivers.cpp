// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/drivers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/error.h"
#include "core/discrepancy/log_gaps.h"
#include "core/math/smoothing.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

/// No part of a machine follows changes that are much quicker.
constexpr double longest_noise_s = 600.0;

/// Mean rise of the sensors of one side of the column.
struct ColumnSide {
  std::vector<double> sum;
  double error_power = 0.0;  ///< sum of the variances of their errors
  double error_time = 0.0;   ///< the same, each times the time it follows itself
  int sensors = 0;

  void add(const Driver& rise) {
    sum.resize(rise.values.size(), 0.0);
    for (std::size_t i = 0; i < rise.values.size(); ++i) sum[i] += rise.values[i];
    const double variance = rise.error * rise.error;
    error_power += variance;
    error_time += variance * rise.error_time_s;
    ++sensors;
  }
};

/// Difference of two sides, without values unless both have sensors.
Driver difference(const char* name, const ColumnSide& warm, const ColumnSide& cold) {
  Driver out;
  out.name = name;
  out.unit = "K";
  out.linear = true;
  if (warm.sensors == 0 || cold.sensors == 0) return out;
  out.values.resize(warm.sum.size());
  for (std::size_t i = 0; i < out.values.size(); ++i)
    out.values[i] = warm.sum[i] / warm.sensors - cold.sum[i] / cold.sensors;
  double power = 0.0;
  double time = 0.0;
  for (const ColumnSide* side : {&warm, &cold}) {
    const double count = side->sensors * side->sensors;
    power += side->error_power / count;
    time += side->error_time / count;
  }
  out.error = std::sqrt(power);
  out.error_time_s = power > 0.0 ? time / power : 0.0;
  return out;
}

/// Made of several sensors: no temperature of a place.
bool isDifference(const Driver& driver) {
  return driver.name == "column_difference" || driver.name == "column_side_difference";
}

}  // namespace

void DriverTable::add(Driver driver) {
  double low = 0.0;
  double high = 0.0;
  if (!driver.values.empty()) {
    const auto [a, b] = std::minmax_element(driver.values.begin(), driver.values.end());
    low = *a;
    high = *b;
  }
  // A switch that is on all the time still heats from the start; a temperature that never moves is a dead sensor.
  const bool moves = driver.linear ? high - low > 1e-6 : high != 0.0 || low != 0.0;
  if (!moves || !std::isfinite(low) || !std::isfinite(high)) {
    dead_.push_back(driver.name);
    return;
  }
  drivers_.push_back(std::move(driver));
}

DriverTable::DriverTable(const MachineDescription& machine, const OperatingLog* log) {
  if (log == nullptr || log->empty()) return;
  time_s_ = log->time_s();
  const std::size_t n = time_s_.size();
  const auto scaled = [&](const std::vector<double>& v, double factor, double power) {
    std::vector<double> out(n);
    for (std::size_t i = 0; i < n; ++i) out[i] = std::isfinite(v[i]) ? std::pow(std::abs(v[i]) * factor, power) : 0.0;
    return out;
  };
  const std::vector<double>* rpm = log->signal("spindle_rpm");
  if (rpm != nullptr) {
    add({"spindle_rpm^1", "krpm", false, SensorRole::Other, scaled(*rpm, 1e-3, 1.0)});
    add({"spindle_rpm^1.5", "krpm1.5", false, SensorRole::Other, scaled(*rpm, 1e-3, 1.5)});
    add({"spindle_rpm^2", "krpm2", false, SensorRole::Other, scaled(*rpm, 1e-3, 2.0)});
  }
  for (const char* axis : {"x", "y", "z"}) {
    if (const auto* feed = log->signal(fmt::format("feed_{}_mm_min", axis))) {
      add({fmt::format("feed_{}", axis), "m_per_min", false, SensorRole::Other, scaled(*feed, 1e-3, 1.0)});
      add({fmt::format("feed_{}^2", axis), "m2_per_min2", false, SensorRole::Other, scaled(*feed, 1e-3, 2.0)});
    }
  }
  if (const auto* speed = log->signal("speed_c_rpm")) {
    add({"speed_c", "rpm", false, SensorRole::Other, scaled(*speed, 1.0, 1.0)});
    add({"speed_c^2", "rpm2", false, SensorRole::Other, scaled(*speed, 1.0, 2.0)});
  }
  for (const char* name : {"coolant", "instrument_on"}) {
    if (const auto* on = log->signal(name)) add({name, "on", false, SensorRole::Other, scaled(*on, 1.0, 1.0)});
  }
  if (log->signal("instrument_on") == nullptr) {
    add({std::string(assumed_instrument), "on", false, SensorRole::Other, std::vector<double>(n, 1.0)});
  }
  std::map<SensorRole, ColumnSide> sides;
  for (const std::string& name : log->temperatureNames()) {
    // The noise of a sensor is a cause of no deviation: left in, it makes a slow lag of any other sensor look better.
    const SmoothedSignal smooth = smoothWithinNoise(time_s_, *log->signal(name), longest_noise_s);
    const std::vector<double>& values = smooth.values;
    // The start is the mean of the first rows, so that the noise of one reading does not count as a step.
    const std::size_t first = std::min<std::size_t>(n, 3);
    double start = 0.0;
    for (std::size_t i = 0; i < first; ++i) start += values[i] / static_cast<double>(first);
    std::vector<double> deviation(n);
    for (std::size_t i = 0; i < n; ++i) deviation[i] = values[i] - start;
    sensors_.push_back(readSensor(machine.temperature_sensors, name));
    const SensorRole role = sensors_.back().role;
    const std::size_t before = drivers_.size();
    add({name, "K", true, role, deviation, false, smooth.error, smooth.error_time_s});
    if (drivers_.size() > before) sides[role].add(drivers_.back());
  }
  const auto addDifference = [&](const char* name, SensorRole warm, SensorRole cold) {
    Driver both = difference(name, sides[warm], sides[cold]);
    if (!both.values.empty()) add(std::move(both));
  };
  addDifference("column_difference", SensorRole::ColumnFront, SensorRole::ColumnRear);
  addDifference("column_side_difference", SensorRole::ColumnLeft, SensorRole::ColumnRight);
  if (const auto* on = log->signal("coolant")) {
    for (const std::string& room : this->room()) {
      std::vector<double> product = scaled(*on, 1.0, 1.0);
      const Driver& rise = *find(room);
      for (std::size_t i = 0; i < n; ++i) product[i] *= rise.values[i];
      add({"coolant*" + room, "on_K", false, SensorRole::Other, std::move(product), false, rise.error,
           rise.error_time_s});
    }
  }
  if (rpm != nullptr) {
    for (const char* axis : {"x", "y", "z"}) {
      const auto* position = log->signal(fmt::format("pos_{}_mm", axis));
      if (position == nullptr) continue;
      const auto [low, high] = std::minmax_element(position->begin(), position->end());
      if (!(*high - *low > 1e-6)) continue;
      for (const double power : {1.0, 1.5, 2.0}) {
        std::vector<double> product = scaled(*rpm, 1e-3, power);
        for (std::size_t i = 0; i < n; ++i) product[i] *= (*position)[i] * 1e-3;
        const std::string unit = power == 1.0 ? "krpm_m" : fmt::format("krpm{}_m", power);
        add({fmt::format("spindle_rpm^{}*pos_{}", power, axis), unit, false, SensorRole::Other, std::move(product)});
      }
    }
  }
  fillGaps();
}

void DriverTable::addOwn(Driver driver) {
  SPINDRIFT_ASSERT(driver.values.size() == time_s_.size(), "a value for every row of the log");
  const bool zero = std::all_of(driver.values.begin(), driver.values.end(), [](double v) { return v == 0.0; });
  if (zero) {
    dead_.push_back(driver.name);
  } else {
    drivers_.push_back(std::move(driver));
  }
}

void DriverTable::fillGaps() {
  const std::vector<LogGap> gaps = logGaps(time_s_);
  for (auto gap = gaps.rbegin(); gap != gaps.rend(); ++gap) {
    const auto after = static_cast<std::ptrdiff_t>(gap->row_before) + 1;
    const double inserted_s = gap->from_s + 0.01 * (gap->to_s - gap->from_s);
    for (Driver& driver : drivers_) {
      const double before = driver.values[gap->row_before];
      const double next = driver.values[gap->row_before + 1];
      double guess = before;
      if (driver.linear) {
        guess += 0.01 * (next - before);
      } else if (next != before) {
        guess = mean(driver.values);
      }
      driver.values.insert(driver.values.begin() + after, guess);
    }
    time_s_.insert(time_s_.begin() + after, inserted_s);
  }
}

void DriverTable::shiftClock(double offset_s) {
  for (double& t : time_s_) t -= offset_s;
}

const Driver* DriverTable::find(std::string_view name) const {
  const auto found = std::find_if(drivers_.begin(), drivers_.end(), [&](const Driver& d) { return d.name == name; });
  return found == drivers_.end() ? nullptr : &*found;
}

std::vector<std::string> DriverTable::temperatures(std::initializer_list<SensorRole> roles) const {
  std::vector<std::string> names;
  for (const Driver& d : drivers_) {
    if (d.unit == "K" && !isDifference(d) && std::find(roles.begin(), roles.end(), d.role) != roles.end()) {
      names.push_back(d.name);
    }
  }
  return names;
}

std::vector<std::string> DriverTable::temperatures() const {
  std::vector<std::string> names;
  for (const Driver& d : drivers_) {
    if (d.unit == "K" && !isDifference(d)) names.push_back(d.name);
  }
  return names;
}

std::vector<std::string> DriverTable::room() const {
  std::vector<std::string> names = temperatures({SensorRole::Room});
  if (names.empty()) names = temperatures({SensorRole::ColumnRear, SensorRole::Table});
  return names;
}

std::vector<std::string> DriverTable::spindleHeat() const {
  std::vector<std::string> names;
  for (const char* name : {"spindle_rpm^1", "spindle_rpm^1.5", "spindle_rpm^2"}) {
    if (has(name)) names.emplace_back(name);
  }
  for (const std::string& name : temperatures({SensorRole::SpindleBearing, SensorRole::SpindleHousing}))
    names.push_back(name);
  return names;
}

Eigen::VectorXd DriverTable::response(const Driver& driver, double tau_on_s, double tau_off_s,
                                      std::span<const double> times_s) const {
  const std::size_t n = time_s_.size();
  SPINDRIFT_ASSERT(n > 0 && driver.values.size() == n, "a driver without its log");
  if (tau_off_s < 0.0) tau_off_s = tau_on_s;
  // A lag of first order over a step of dt, with the input u0 at its start and a slope: it keeps `decay` of its state,
  // and gains what the input alone brings.
  struct Lag {
    double tau_s, dt_s = -1.0, decay = 0.0;
    void step(double dt) {
      if (dt == dt_s) return;
      dt_s = dt;
      decay = tau_s > 0.0 ? std::exp(-dt / tau_s) : 0.0;
    }
    [[nodiscard]] double gain(double u0, double slope) const {
      const double start = u0 - slope * std::max(tau_s, 0.0);
      return start + slope * dt_s - start * decay;
    }
  };
  // Steps of the log are mostly of one length, and so are those to the readings after them.
  Lag on{tau_on_s}, off{tau_off_s}, reading_on = on, reading_off = off;
  const auto advanced = [](double q, Lag& lag, double u0, double slope, double dt) {
    lag.step(dt);
    return lag.gain(u0, slope) + q * lag.decay;
  };
  const bool lagged = tau_on_s > 0.0 || tau_off_s > 0.0;
  Eigen::VectorXd out(static_cast<Eigen::Index>(times_s.size()));
  std::size_t k = 0;
  const double before = driver.settled ? driver.values[0] : 0.0;
  double q = lagged ? before : driver.values[0];
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    const double t = times_s[i];
    while (k + 1 < n && time_s_[k + 1] <= t) {
      const double u = driver.values[k];
      // As far as an input is held it is one step.
      std::size_t end = k + 1;
      if (!driver.linear)
        while (end + 1 < n && time_s_[end + 1] <= t && driver.values[end] == u) ++end;
      const double dt = time_s_[end] - time_s_[k];
      if (!lagged) {
        q = driver.values[end];
      } else if (dt > 0.0) {
        const double slope = driver.linear ? (driver.values[end] - u) / dt : 0.0;
        q = advanced(q, u != 0.0 ? on : off, u, slope, dt);
      }
      k = end;
    }
    const double dt = std::max(0.0, t - time_s_[k]);
    double slope = 0.0;
    if (driver.linear && k + 1 < n && time_s_[k + 1] > time_s_[k]) {
      slope = (driver.values[k + 1] - driver.values[k]) / (time_s_[k + 1] - time_s_[k]);
    }
    if (t < time_s_[0]) {
      out[static_cast<Eigen::Index>(i)] = lagged ? before : driver.values[0];
    } else {
      out[static_cast<Eigen::Index>(i)] =
          lagged ? advanced(q, driver.values[k] != 0.0 ? reading_on : reading_off, driver.values[k], slope, dt)
                 : driver.values[k] + slope * dt;
    }
  }
  return out;
}

int parameterCount(const EffectVariant& variant) {
  int count = 0;
  bool counted_shared = false;
  for (const EffectInput& input : variant.inputs) {
    switch (input.dynamics) {
      case Dynamics::None:
        break;
      case Dynamics::Lag:
      case Dynamics::Start:
        if (!variant.shared_lag || !counted_shared) ++count;
        counted_shared = true;
        break;
      case Dynamics::AsymmetricLag:
        if (!variant.shared_lag || !counted_shared) count += 2;
        counted_shared = true;
        break;
      case Dynamics::Step:
        count += 1;
        break;
      case Dynamics::Pulse:
        count += 3;
        break;
    }
  }
  return count;
}

std::vector<std::string> parameterNames(const EffectVariant& variant) {
  std::vector<std::string> names;
  int lag = 0;
  const auto lagName = [&] { return ++lag == 1 ? std::string("tau_s") : fmt::format("tau_{}_s", lag); };
  for (const EffectInput& input : variant.inputs) {
    switch (input.dynamics) {
      case Dynamics::None:
        break;
      case Dynamics::Lag:
      case Dynamics::Start:
        if (!variant.shared_lag || lag == 0) names.push_back(lagName());
        break;
      case Dynamics::AsymmetricLag:
        if (variant.shared_lag && !names.empty()) break;
        names.emplace_back("tau_on_s");
        names.emplace_back("tau_off_s");
        break;
      case Dynamics::Step:
        names.emplace_back("onset_s");
        break;
      case Dynamics::Pulse:
        names.emplace_back("onset_s");
        names.emplace_back("length_s");
        names.push_back(lagName());
        break;
    }
  }
  return names;
}

ResponseError responseError(const DriverTable& table, const EffectVariant& variant, std::span<const double> parameters,
                            std::size_t input) {
  const std::string& name = variant.inputs[input].driver;
  const Driver* driver = name.empty() ? nullptr : table.find(name);
  if (driver == nullptr || !(driver->error > 0.0)) return {};
  double tau = 0.0;
  std::size_t next = 0;
  for (std::size_t i = 0; i <= input; ++i) {
    const std::size_t at = variant.shared_lag ? 0 : next;
    const Dynamics dynamics = variant.inputs[i].dynamics;
    if (dynamics == Dynamics::Lag) tau = parameters[at];
    if (dynamics == Dynamics::AsymmetricLag) tau = std::min(parameters[at], parameters[at + 1]);
    next += dynamics == Dynamics::None ? 0 : dynamics == Dynamics::AsymmetricLag ? 2 : 1;
  }
  // At its ends the smoother errs two to four times as much as within (measured, at noise of 0.02 and 0.05 K).
  constexpr double at_an_end = 3.0;
  ResponseError out;
  out.tau_s = std::max(0.0, tau);
  out.time_s = driver->error_time_s + out.tau_s;
  out.standard_deviation = driver->error;
  if (out.time_s > 0.0) out.standard_deviation *= std::sqrt(driver->error_time_s / out.time_s);
  if (out.tau_s > 0.0) out.start = at_an_end * driver->error;
  return out;
}

Eigen::MatrixXd inputResponses(const DriverTable& table, const EffectVariant& variant,
                               std::span<const double> parameters, std::span<const double> times_s) {
  const auto rows = static_cast<Eigen::Index>(times_s.size());
  Eigen::MatrixXd out(rows, static_cast<Eigen::Index>(variant.inputs.size()));
  std::size_t next = 0;
  for (std::size_t i = 0; i < variant.inputs.size(); ++i) {
    const EffectInput& input = variant.inputs[i];
    auto column = out.col(static_cast<Eigen::Index>(i));
    const Driver* driver = input.driver.empty() ? nullptr : table.find(input.driver);
    if (!input.driver.empty() && driver == nullptr) {
      throw InputError(fmt::format("the operating log has no signal for \"{}\", which the model needs.", input.driver));
    }
    switch (input.dynamics) {
      case Dynamics::None:
        if (driver == nullptr) {
          column.setOnes();
        } else {
          column = table.response(*driver, 0.0, -1.0, times_s);
        }
        break;
      case Dynamics::Lag: {
        const std::size_t at = variant.shared_lag ? 0 : next;
        column = table.response(*driver, parameters[at], -1.0, times_s);
        if (!variant.shared_lag) ++next;
        break;
      }
      case Dynamics::Start: {
        const std::size_t at = variant.shared_lag ? 0 : next;
        const double tau = parameters[at];
        const double begin = table.empty() ? 0.0 : table.time_s().front();
        for (Eigen::Index r = 0; r < rows; ++r) {
          const double since = std::max(0.0, times_s[static_cast<std::size_t>(r)] - begin);
          column[r] = tau > 0.0 ? std::exp(-since / tau) : 0.0;
        }
        if (!variant.shared_lag) ++next;
        break;
      }
      case Dynamics::AsymmetricLag: {
        const std::size_t at = variant.shared_lag ? 0 : next;
        column = table.response(*driver, parameters[at], parameters[at + 1], times_s);
        if (!variant.shared_lag) next += 2;
        break;
      }
      case Dynamics::Step:
        for (Eigen::Index r = 0; r < rows; ++r) {
          column[r] = times_s[static_cast<std::size_t>(r)] >= parameters[next] ? 1.0 : 0.0;
        }
        ++next;
        break;
      case Dynamics::Pulse: {
        const double onset = parameters[next];
        const double end = onset + parameters[next + 1];
        const double tau = parameters[next + 2];
        const auto rise = [tau](double t) { return t <= 0.0 ? 0.0 : tau > 0.0 ? 1.0 - std::exp(-t / tau) : 1.0; };
        for (Eigen::Index r = 0; r < rows; ++r) {
          const double t = times_s[static_cast<std::size_t>(r)];
          column[r] = rise(t - onset) - rise(t - end);
        }
        next += 3;
        break;
      }
    }
  }
  return out;
}

}  // namespace spindrift
