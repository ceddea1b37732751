// SPDX-License-Identifier: Apache-2.0
// Loads over time for a program: "tables" of simulator.json, made from columns of log.csv or from a window between two
// parameters, with the errors of the sensors that measured them.
//
//   table at the times 0, dt, 2 dt, ... of the program, time 0 = `first_state_s` of the campaign:
//     f(v) = (v / divide_by)^power, v(t) column of the log: linear between its rows, or as in the last row (hold)
//     at t, or with `mean_over_increment` its mean over (t - dt, t) - what a program needs that takes the value at the
//     end of an increment for all of it; then, with `minus_first`, minus the table's first value.
//   Without "between_rows" the rows are linear, and held in a mean over the increment. Means are integrals (exact where
//   rows hold or are linear with power 1), so that a load that begins within an increment has a tangent in its begin.
//   Outside the log its first and last row hold. A window is 1 from its begin to before its end, else 0.
//
//   sensor with gain g, offset o (K) and lag T (s): true = r0 + (r - r0) / (1 + g) - o + T dr/dt, r0 the first reading,
//   dr/dt the difference quotient of the readings over T (over what the log has of it at its ends).
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/json_reader.h"
#include "core/machine/operating_log.h"
#include "core/simulator/simulator.h"

namespace spindrift {

/// One table.
struct TimeTable {
  std::string name;
  std::string column;  ///< of the log; empty: a window
  SimulatorWindow window;
  bool minus_first = false;
  bool hold = false;
  double divide_by = 1.0;
  double power = 1.0;
  bool mean_over_increment = false;
};

/// Times of the program at which tables have a value: 0, increment, ..., up to `end_s`.
struct TableTimes {
  double first_s = 0.0;  ///< of the campaign at the program's time 0
  double increment_s = 0.0;
  double end_s = 0.0;
};

class LogTables {
 public:
  LogTables() = default;
  /// Reads the object `tables`. `own` are the parameters of the simulator. Throws InputError: a column that log.csv
  /// lacks, a window of unknown parameters.
  LogTables(const JsonNode& tables, const std::optional<OperatingLog>& log, const std::vector<SimulatorParameter>& own);

  [[nodiscard]] bool empty() const noexcept { return tables_.empty(); }
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] std::vector<SimulatorWindow> windows() const;
  /// Gain, offset and lag of every temperature among the columns; no offset where only changes count.
  [[nodiscard]] std::vector<SimulatorParameter> sensors() const;
  /// Values of one table. Not finite where a power has no value.
  [[nodiscard]] std::vector<double> values(const TimeTable& table, const TableTimes& times,
                                           const ParameterValues& parameters) const;
  /// The lines "time, value" of all tables, by name. Throws SimulatorFailed for a value that does not exist.
  [[nodiscard]] std::map<std::string, std::string> text(const TableTimes& times,
                                                        const ParameterValues& parameters) const;

 private:
  std::vector<TimeTable> tables_;
  OperatingLog log_;
};

/// What was true where a sensor read this; see above.
[[nodiscard]] std::vector<double> trueReadings(std::span<const double> time_s, std::span<const double> readings,
                                               double gain, double offset_K, double lag_s);

}  // namespace spindrift
