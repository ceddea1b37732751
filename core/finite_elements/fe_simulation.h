// SPDX-License-Identifier: Apache-2.0
// A simulation as a campaign names it: a table of predictions, or finite-element results by their map.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/machine/simulation_table.h"

namespace spindrift {

/// True for a JSON file of the format of fe_map.h. Throws InputError if it cannot be read.
[[nodiscard]] bool isFeMap(const std::filesystem::path& file);
/// simulation.csv, or the deviations of finite-element results by their map; what is to be said of these goes into
/// `notes`. Throws InputError.
[[nodiscard]] SimulationTable readSimulation(const std::filesystem::path& file, std::vector<std::string>& notes);

}  // namespace spindrift
