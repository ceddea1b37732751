// SPDX-License-Identifier: Apache-2.0
// A simulation that cannot be run here, kind "sensitivities" of simulator.json: another program told by how much its
// predictions change with each parameter (`time_s,point,component,parameter,d_predicted`, um or urad per unit).
//
//   prediction = base + sum over parameters of (value - value of the table) d_predicted, linear in time
//
// `base` is the simulation that the campaign came with, made with the values of the table: those of simulator.json, or
// what its "table_values" says instead (in a version whose values were changed). Where a parameter that differs has no
// sensitivity there is no prediction.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/machine/simulation_table.h"
#include "core/simulator/simulator.h"
#include "core/simulator/simulator_file.h"

namespace spindrift {

/// um or urad for every observation, NaN where there is none.
using BasePrediction = std::function<std::vector<double>(const ObservationSet& at)>;

class SensitivityTable final : public Simulator {
 public:
  /// Throws InputError: a parameter of simulator.json without a row, a row of a parameter that simulator.json does not
  /// have, two rows for the same, times that run backwards.
  SensitivityTable(const SimulatorFile& file, BasePrediction base);

  [[nodiscard]] bool linear() const noexcept override { return true; }
  [[nodiscard]] SimulatorRun run(const ParameterValues& values, const ObservationSet& at,
                                 const JobContext& job) const override;
  void writeVersion(const ParameterValues& values, const std::filesystem::path& folder,
                    const nlohmann::json& change) const override;

 private:
  /// Base and sensitivities at the observations asked for last.
  struct Matched {
    std::string key;
    std::vector<double> base;
    std::map<std::string, std::vector<double>> sensitivity;  ///< by parameter
  };
  [[nodiscard]] std::shared_ptr<const Matched> matchedTo(const ObservationSet& at) const;

  SimulatorFile simulator_file_;
  std::string table_;  ///< relative to the folder
  BasePrediction base_;
  ParameterValues table_values_;
  std::map<std::string, SimulationTable> sensitivity_;
  /// What has rows in the table, by parameter: nothing of a component of a point means that it does not move it.
  std::map<std::string, std::set<std::pair<std::string, Component>>> moved_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const Matched> matched_;
};

}  // namespace spindrift
