// SPDX-License-Identifier: GPL-3.0-or-later
// What simulator.json says, for the user, without a run.
#pragma once

#include <QString>
#include <filesystem>
#include <vector>

#include "core/machine/campaign.h"
#include "core/machine/observation.h"
#include "core/simulator/simulator.h"

namespace spindrift::gui {

struct OpenedSimulator {
  std::vector<SimulatorParameter> parameters;
  std::vector<SimulatorWindow> windows;
  QString kind;   ///< "CalculiX"
  QString runs;   ///< which programs will be run, one sentence
  QString error;  ///< why it cannot be used; else empty

  /// Any thread.
  [[nodiscard]] static OpenedSimulator read(const std::filesystem::path& file, const Campaign& campaign,
                                            const ObservationSet& observations);
};

}  // namespace spindrift::gui
