// SPDX-License-Identifier: Apache-2.0
// Text that measuring programmes print, read by a template that a user adapts to his control without programming.
//
// Template (JSON): {"format":"spindrift-printed-text","version":1,
//   "touch_line":"T A{feature} B{stylus} C{c_deg} D{touch} X{x} Y{y} Z{z} I{nx} J{ny} K{nz} S{time}",
//   "cycle_line":"CYCLE {cycle}", "cycle_prefix":"M",
//   "values":{"feature":{"1":"H1"},"stylus":{"1":"p0"}}, "artefact":"bar", "position":"stylus_centre"|
//   "spindle_reference", "mm_per_unit":1, "s_per_unit":0.001, "touch_interval_s":3, "cycle_interval_s":600, "c_sign":1,
//   "decimal_comma":false}
// A placeholder {name} takes a word or number, {skip} takes anything; blanks match any number of blanks, or none before
// a placeholder. Places: feature, stylus, artefact, cycle, c_deg, touch, x, y, z, nx, ny, nz, time. Lines that match
// neither pattern are counted and ignored. What a line does not carry comes from the template or from what stands
// before (touches are then numbered, times counted up).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/json_reader.h"
#include "core/probing/touch.h"

namespace spindrift {

struct PrintedText {
  TouchList touches;
  int ignored_lines = 0;
};

/// Throws InputError: a bad template (unknown place, missing key) or a matching line with a value that is none.
[[nodiscard]] PrintedText readPrintedText(std::string_view text, const std::filesystem::path& name,
                                          const JsonNode& pattern, const MachineDescription& machine);

}  // namespace spindrift
