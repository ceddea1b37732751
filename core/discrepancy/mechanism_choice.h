// SPDX-License-Identifier: Apache-2.0
// Which parameters of a simulator are behind the effects that were named, and which can be put in together.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/discrepancy/discrepancy.h"
#include "core/simulator/simulator.h"

namespace spindrift {

struct MechanismChoice {
  std::vector<std::string> names;     ///< of parameters, in the order of the effects
  std::vector<std::string> warnings;  ///< a sentence for each effect that no parameter causes
};

/// Behind an effect `simulation.<parameter>` is that parameter; behind one of the catalogue the mechanism that is said
/// to cause it, of several the one whose answer explains most of the gap. `result` is that of findDiscrepancy on
/// `input`, which has the simulator's tangents.
[[nodiscard]] MechanismChoice mechanismsBehind(const DiscrepancyInput& input, const DiscrepancyResult& result,
                                               const Simulator& simulator);

/// Why parameters of these names cannot be put in together: one sentence, empty if they can. `twins`: names of
/// parameters that do the same to the readings, in pairs (DiscrepancyResult::twins).
[[nodiscard]] std::string whyNotTogether(const std::vector<std::string>& names,
                                         const std::vector<SimulatorParameter>& parameters,
                                         const std::vector<SimulatorWindow>& windows,
                                         const std::vector<std::pair<std::string, std::string>>& twins);

}  // namespace spindrift
