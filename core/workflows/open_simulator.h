// SPDX-License-Identifier: Apache-2.0
// The simulator that simulator.json describes, for a campaign.
#pragma once

#include <filesystem>
#include <memory>

#include "core/machine/campaign.h"
#include "core/machine/observation.h"
#include "core/simulator/simulator.h"

namespace spindrift {

/// `file` is simulator.json. A table of sensitivities is about the predictions of the campaign's own simulation at the
/// observations. Throws InputError: see FORMATS.md, and what the kind of simulator says.
[[nodiscard]] std::unique_ptr<Simulator> openSimulator(const std::filesystem::path& file, const Campaign& campaign,
                                                       const ObservationSet& observations);

}  // namespace spindrift
