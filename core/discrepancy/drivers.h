// SPDX-License-Identifier: Apache-2.0
// What can excite an effect: signals derived from the operating log, and their response through a lag.
//
//   tau q' + q = u(t), q(0) = 0, solved exactly: u holds between rows (speeds, feeds, switches) or is linear
//   (temperatures, as deviation from the start of the log). Times s; speeds krpm^p, feeds m/min, temperatures K,
//   switches 0 or 1.
#pragma once

#include <Eigen/Core>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/machine/effect.h"
#include "core/machine/machine_description.h"
#include "core/machine/operating_log.h"
#include "core/machine/sensor_role.h"

namespace spindrift {

struct Driver {
  std::string name;
  std::string unit;                     ///< for the gain's name: "krpm", "K", "m_per_min", "on"
  bool linear = false;                  ///< linear between rows; else it holds
  SensorRole role = SensorRole::Other;  ///< temperatures
  std::vector<double> values;           ///< at the rows of the log
  bool settled = false;                 ///< before the log it had its first value for long; false: it was zero
  /// Standard deviation of what noise and rounding of its sensors leave in `values`, and how long that follows itself
  /// (its correlation falls to 1/e), s.
  double error = 0.0;
  double error_time_s = 0.0;
};

/// On from the first row, where the log does not say when the instrument was switched on.
constexpr std::string_view assumed_instrument = "instrument_on_assumed";

/// Signals by name: "spindle_rpm^1", "^1.5", "^2" (krpm^p), "feed_x" (m/min), "speed_c" (rpm) and the squares of both,
/// "feed_x^2", "speed_c^2" (friction is not quite in proportion to speed), "coolant", "instrument_on",
/// "coolant*T_room" (on x K), every temperature under its own name, "column_difference" (front minus rear),
/// "column_side_difference" (left minus right), and heat times position "spindle_rpm^1*pos_y", and
/// assumed_instrument.
/// Signals that never change are left out and named in `dead`.
class DriverTable {
 public:
  DriverTable() = default;
  DriverTable(const MachineDescription& machine, const OperatingLog* log);

  [[nodiscard]] const Driver* find(std::string_view name) const;
  [[nodiscard]] bool has(std::string_view name) const { return find(name) != nullptr; }
  [[nodiscard]] const std::vector<Driver>& all() const noexcept { return drivers_; }
  [[nodiscard]] std::vector<std::string> temperatures(std::initializer_list<SensorRole> roles) const;
  [[nodiscard]] std::vector<std::string> temperatures() const;
  /// Temperatures of the room, or, where the log has none, of the parts that follow it: rear of the column, table.
  [[nodiscard]] std::vector<std::string> room() const;
  /// Spindle heat: powers of the speed and spindle temperatures.
  [[nodiscard]] std::vector<std::string> spindleHeat() const;
  [[nodiscard]] const std::vector<std::string>& dead() const noexcept { return dead_; }
  /// What every temperature of the log is taken for, dead ones too.
  [[nodiscard]] const std::vector<SensorReading>& sensors() const noexcept { return sensors_; }
  [[nodiscard]] const std::vector<double>& time_s() const noexcept { return time_s_; }
  [[nodiscard]] bool empty() const noexcept { return time_s_.empty(); }
  /// Adds a signal of the user's, with a value at every time of time_s(); one that is zero throughout is dead.
  void addOwn(Driver driver);
  /// Moves all signals: what the log says of time t is taken for t - offset_s of the observations.
  void shiftClock(double offset_s);

  /// The driver after a lag at increasing `times_s`. `tau_on_s` = 0: no lag. `tau_off_s` < 0: the same as on.
  [[nodiscard]] Eigen::VectorXd response(const Driver& driver, double tau_on_s, double tau_off_s,
                                         std::span<const double> times_s) const;

 private:
  void add(Driver driver);
  /// A row soon after the beginning of every gap of the log, from which on what is not known is guessed (log_gaps.h).
  void fillGaps();
  std::vector<double> time_s_;
  std::vector<Driver> drivers_;
  std::vector<std::string> dead_;
  std::vector<SensorReading> sensors_;
};

/// Number of non-linear parameters of a variant.
[[nodiscard]] int parameterCount(const EffectVariant& variant);
/// Their names with units: "tau_s", "tau_2_s", "onset_s", ...
[[nodiscard]] std::vector<std::string> parameterNames(const EffectVariant& variant);
/// The error of an input's response, from the errors of its driver (in whose unit it is): its standard deviation, and
/// the time it follows itself, s. The lag averages it: sigma sqrt(T / (T + tau)) over T + tau, a first-order lag of an
/// error with correlation exp(-|t| / T). `start`: of the value from which temperatures are counted; what that adds to
/// the response changes with exp(-t / tau_s), and is a constant without a lag. 0 without a driver.
struct ResponseError {
  double standard_deviation = 0.0;
  double time_s = 0.0;
  double start = 0.0;
  double tau_s = 0.0;
};
[[nodiscard]] ResponseError responseError(const DriverTable& table, const EffectVariant& variant,
                                          std::span<const double> parameters, std::size_t input);
/// q_i(t) of every input, one column each. `parameters` as long as parameterCount.
[[nodiscard]] Eigen::MatrixXd inputResponses(const DriverTable& table, const EffectVariant& variant,
                                             std::span<const double> parameters, std::span<const double> times_s);

}  // namespace spindrift
