// SPDX-License-Identifier: Apache-2.0
// A simulation that another program runs, kinds "command" and "calculix" of simulator.json (FORMATS.md): templates are
// filled with the parameters and with tables from the log, the commands are run in a folder of their own, and the
// predictions are read back - from simulation.csv, or from the displacements of nodes (CalculiX, called `ccx`).
//
//   calculix: deviation of state k (from 1) at first_state_s + k state_interval_s; before any load, at first_state_s,
//   it is zero. The number of states is that of the *STATIC steps in the template of the displacements (the last
//   template where none has their name); where there is none it only has to be the same in every run. Tables reach to
//   the last state, otherwise to the end of the log.
//
// What is checked of every run: that the program is found, ends with status 0 within `time_limit_s` per command (600),
// prints no *ERROR (calculix), and gives finite predictions, as many as the first run that worked. Of a run that fails
// log and filled templates stay in a folder for temporary files, which the sentence names; of all others nothing stays.
// Answers are kept in memory and on the disk (answer_store.h) by all that goes in: filled templates, included files,
// commands.
//
// Temperatures of the log that drive the simulation add the errors of their sensors to the parameters (log_tables.h). A
// version with other values of these holds them in "sensor_values": {"sensor.T_room_degC.lag": 300}.
#pragma once

#include <memory>
#include <optional>

#include "core/machine/operating_log.h"
#include "core/simulator/simulator.h"
#include "core/simulator/simulator_file.h"

namespace spindrift {

class ProgramSimulator final : public Simulator {
 public:
  /// `log` of the campaign, for tables. Throws InputError: a file that is missing or leaves the folder, an unknown name
  /// in a template, no command, a table of a column that the log lacks.
  ProgramSimulator(const SimulatorFile& file, const std::optional<OperatingLog>& log);
  ~ProgramSimulator() override;

  [[nodiscard]] SimulatorRun run(const ParameterValues& values, const ObservationSet& at,
                                 const JobContext& job) const override;
  void writeVersion(const ParameterValues& values, const std::filesystem::path& folder,
                    const nlohmann::json& change) const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace spindrift
