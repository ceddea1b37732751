// SPDX-License-Identifier: Apache-2.0
#include "core/finite_elements/fe_simulation.h"

#include "core/base/json_reader.h"
#include "core/finite_elements/fe_deviation.h"

namespace spindrift {

bool isFeMap(const std::filesystem::path& file) {
  if (file.extension() != ".json") return false;
  const JsonNode root = JsonNode::read(file);
  return root.value().is_object() && root.value().value("format", nlohmann::json()) == fe_map_format;
}

SimulationTable readSimulation(const std::filesystem::path& file, std::vector<std::string>& notes) {
  if (!isFeMap(file)) return SimulationTable::read(file);
  JobContext quiet;
  const FeDeviation fe = feDeviation(FeMap::read(file), openFeResult, quiet);
  notes.insert(notes.end(), fe.notes.begin(), fe.notes.end());
  return SimulationTable(fe.rows, fe.by_place, file);
}

}  // namespace spindrift
