// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulator/sensitivity_table.h"
#include "core/simulator/simulator_file.h"
#include "tests/fuzz/readers.h"

namespace spindrift::testing {
namespace {

void simulator(std::string_view bytes) {
  (void)openSimulatorFile(scratchFile("simulator.json", bytes));
}

void sensitivities(std::string_view bytes) {
  (void)scratchFile("sensitivities/sensitivities.csv", bytes);
  const SimulatorFile file = openSimulatorFile(
      scratchFile("sensitivities/simulator.json",
                  R"({"format":"spindrift-simulator","version":1,"kind":"sensitivities","table":"sensitivities.csv",
"parameters":[{"name":"h","value":1,"unit":"W","standard_uncertainty":0.1,"min":0,"max":2,"what":"heat"}]})"));
  (void)SensitivityTable(file, [](const ObservationSet&) { return std::vector<double>(); });
}

constexpr Reader readers[] = {{"simulator", simulator}, {"sensitivities", sensitivities}};

}  // namespace

std::span<const Reader> simulatorReaders() {
  return readers;
}

}  // namespace spindrift::testing
