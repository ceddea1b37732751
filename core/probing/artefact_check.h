// SPDX-License-Identifier: Apache-2.0
// Are the artefacts and styli of a machine description right? One clear sentence per wrong cell of an editor, where the
// reader of machine.json stops at the first mistake; and what can be read but hardly be meant.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace spindrift {

struct ArtefactFinding {
  std::string key;    ///< of the artefact or stylus: "hole_diameter_mm", "nominal_positions_mm", "balls", "radius_mm"
  int row = -1;       ///< hole or ball from 0; -1: no row
  int column = -1;    ///< of a ball: 0 id, 1 diameter, 2 ... 4 x y z; of a vector: 0 ... 2; -1: the whole
  bool wrong = true;  ///< false: can be read, but is doubtful
  std::string sentence;  ///< with the value found and what is allowed
};

/// Of one entry of "artefacts"; `styli` is the list of the machine, for what must fit through a hole.
[[nodiscard]] std::vector<ArtefactFinding> checkArtefact(const nlohmann::json& artefact, const nlohmann::json& styli);
/// Of the list "styli"; `row` is the index of the stylus.
[[nodiscard]] std::vector<ArtefactFinding> checkStyli(const nlohmann::json& styli);

}  // namespace spindrift
