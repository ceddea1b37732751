// SPDX-License-Identifier: Apache-2.0
// Checks an operator runs on a campaign: has the instrument settled, do jogs read true, does it repeat when cold.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/imaging/jog_validation.h"
#include "core/imaging/warm_up.h"

namespace spindrift {

/// What it means that nobody looked whether the instrument had settled.
[[nodiscard]] std::string warmUpNotChecked();

struct CheckResult {
  nlohmann::json json = nlohmann::json::object();
  std::string summary;
  bool passed = false;
};

/// `log` may be null: then nobody can tell a drift of the instrument from the machine's own.
[[nodiscard]] CheckResult checkWarmUp(const ObservationSet& observations, const std::string& point,
                                      const WarmUpOptions& options, const OperatingLog* log);
/// Limit: one resolution of the axis.
[[nodiscard]] CheckResult checkJogs(const ObservationSet& observations, const MachineDescription& machine);
/// Limit: half a resolution of the axis.
[[nodiscard]] CheckResult checkRepeatability(const ObservationSet& observations, const MachineDescription& machine);
/// As these two tell it.
[[nodiscard]] CheckResult checkResultOf(const ResolutionCheck& check);
/// What the JSON of these two tells; sessions of earlier versions kept no axes. Throws InputError: it is something
/// else.
[[nodiscard]] ResolutionCheck resolutionCheckFrom(const nlohmann::json& json);

}  // namespace spindrift
