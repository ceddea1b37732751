// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/open_simulator.h"

#include "core/base/error.h"
#include "core/discrepancy/discrepancy.h"
#include "core/simulation/scenario_simulator.h"
#include "core/simulator/program_simulator.h"
#include "core/simulator/sensitivity_table.h"

namespace spindrift {

std::unique_ptr<Simulator> openSimulator(const std::filesystem::path& file, const Campaign& campaign,
                                         const ObservationSet& observations) {
  const SimulatorFile simulator = openSimulatorFile(file);
  switch (simulator.kind) {
    case SimulatorKind::Scenario:
      return std::make_unique<ScenarioSimulator>(simulator);
    case SimulatorKind::Command:
    case SimulatorKind::Calculix:
      return std::make_unique<ProgramSimulator>(simulator, campaign.log);
    case SimulatorKind::Sensitivities: {
      // A campaign without a simulation of its own is told now.
      (void)discrepancyInput(campaign, observations);
      const auto base = [campaign](const ObservationSet& at) { return discrepancyInput(campaign, at).predicted; };
      return std::make_unique<SensitivityTable>(simulator, base);
    }
  }
  SPINDRIFT_ASSERT(false, "every kind of simulator is known");
  return nullptr;
}

}  // namespace spindrift
