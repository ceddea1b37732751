// SPDX-License-Identifier: Apache-2.0
// The virtual machine as a simulation that can be run, kind "scenario" of simulator.json (FORMATS.md).
//
// Parameters are paths in scenario.json: "physics.friction", "environment.ramp_K_per_h",
// "programme.segments.3.spindle_rpm", "effects.external_heat.a.size" (ids hold dots: the longest key that is there or
// that the virtual machine knows is taken). Their values are those of simulator.json, whatever scenario.json says. An
// effect with size 0 is off; any other size switches it on. A "strength" becomes the size that it has in the scenario
// as it stands, so that other values change what the cause does.
//
//   prediction = sum of all causes that are on, at time, place, table angle, approach and tool offset of each
//   observation (um, urad); absolute, and nothing for observations after the end of the scenario. "simulation" of the
//   scenario, its instruments and sensors play no part.
//
// Nothing that was measured drives it: its temperatures are those of its own bodies and room, which come from physics,
// programme and environment. So it has no parameters of sensors (sensor.<name>.gain, .offset, .lag): the error of one
// would change the log and no prediction. They belong to programs whose loads are tables of log.csv (log_tables.h).
//
// Heat flow is run again only when something else than the setting of causes has changed.
#pragma once

#include <memory>

#include "core/simulator/simulator.h"
#include "core/simulator/simulator_file.h"

namespace spindrift {

class ScenarioSimulator final : public Simulator {
 public:
  /// Throws InputError: a scenario that is not as scenario.h describes it, a parameter that is no number in it.
  explicit ScenarioSimulator(const SimulatorFile& file);
  ~ScenarioSimulator() override;

  [[nodiscard]] SimulatorRun run(const ParameterValues& values, const ObservationSet& at,
                                 const JobContext& job) const override;
  /// scenario.json gets the values as well.
  void writeVersion(const ParameterValues& values, const std::filesystem::path& folder,
                    const nlohmann::json& change) const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace spindrift
