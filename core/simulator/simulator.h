// SPDX-License-Identifier: Apache-2.0
// A simulation that can be run: parameters in, predicted deviations out. What simulator.json (FORMATS.md) describes.
//
//   prediction(parameters) -> deviation (um, urad) for every observation; differences to the first state, as measured
//
// Three sources: the virtual machine (core/simulation/scenario_simulator.h), an external program that is run
// (program_simulator.h), and a table of sensitivities of a program that cannot be run here (sensitivity_table.h).
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/job_context.h"
#include "core/machine/observation.h"
#include "core/machine/simulation_row.h"

namespace spindrift {

/// A number that the simulation was made with, or a mechanism that it could have and is switched off.
struct SimulatorParameter {
  std::string name;  ///< "h_air"; of a sensor that drives the simulation "sensor.T_room_degC.gain", .offset, .lag
  double value = 0.0;
  std::string unit;
  double standard_uncertainty = 0.0;  ///< of the value (a mechanism that is off: a size it may well have)
  double min = 0.0;
  double max = 0.0;
  std::string what;                  ///< one phrase for the user
  std::vector<std::string> effects;  ///< ids of the catalogue that it can cause; empty: an ordinary parameter
  bool of_sensor = false;

  /// A mechanism that the simulation does not have.
  [[nodiscard]] bool off() const noexcept { return value == 0.0 && !effects.empty(); }
  /// As it stands beside a number: nothing for a plain number ("1").
  [[nodiscard]] std::string printedUnit() const { return unit == "1" ? std::string() : unit; }
  /// "simulation.h_air", "sensor.T_room_degC.gain".
  [[nodiscard]] std::string id() const { return of_sensor ? name : "simulation." + name; }
};

/// Values by name; what is not there has the simulator's own value.
using ParameterValues = std::map<std::string, double>;

/// A load that acts between two times which are parameters themselves.
struct SimulatorWindow {
  std::string begin_s;
  std::string end_s;
};

struct SimulatorRun {
  std::vector<double> predicted;  ///< um or urad for every observation; NaN where the simulation has none
  /// The whole answer over time where the program gives one, else empty: by point, in order of time.
  std::vector<SimulationRow> rows;
  double elapsed_s = 0.0;  ///< of the program; 0 when the answer was kept from before
};

/// Why one run gave no prediction. The simulator's files are as they were.
class SimulatorFailed : public InputError {
 public:
  explicit SimulatorFailed(const std::string& sentence) : InputError(sentence) {}
};

class Simulator {
 public:
  virtual ~Simulator() = default;
  /// Own parameters first, in the order of the file, then those of its sensors.
  [[nodiscard]] const std::vector<SimulatorParameter>& parameters() const noexcept { return parameters_; }
  [[nodiscard]] const SimulatorParameter* find(std::string_view name) const;
  [[nodiscard]] const std::vector<SimulatorWindow>& windows() const noexcept { return windows_; }
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  /// True if predictions are linear in all parameters, as those of a table are.
  [[nodiscard]] virtual bool linear() const noexcept { return false; }

  /// Any thread. The same values give the same answer without another run of the program. Throws SimulatorFailed with
  /// one sentence (program, values, what it said, where its log is kept), InputError for an unknown name or a value
  /// beyond its bounds, Cancelled.
  [[nodiscard]] virtual SimulatorRun run(const ParameterValues& values, const ObservationSet& at,
                                         const JobContext& job) const = 0;

  /// A new version of the simulator with these values in `folder` (made; has to be empty or absent): simulator.json and
  /// all files it needs, with what was changed in "history". Nothing of the present version is touched. Throws
  /// InputError.
  virtual void writeVersion(const ParameterValues& values, const std::filesystem::path& folder,
                            const nlohmann::json& change) const = 0;

 protected:
  std::filesystem::path file_;
  std::vector<SimulatorParameter> parameters_;
  std::vector<SimulatorWindow> windows_;
};

/// Runs of several parameter sets, as many at a time as the machine has cores. A set whose run fails has no prediction
/// and its sentence in `failed`.
struct SimulatorRuns {
  std::vector<SimulatorRun> runs;
  std::vector<std::string> failed;  ///< empty string: it did not
};
[[nodiscard]] SimulatorRuns runAll(const Simulator& simulator, const std::vector<ParameterValues>& sets,
                                   const ObservationSet& at, const JobContext& job, std::string_view stage);

}  // namespace spindrift
