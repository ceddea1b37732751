// SPDX-License-Identifier: Apache-2.0
// Checks an operator runs on a campaign: has the instrument settled, do jogs read true, does it repeat when cold.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/imaging/jog_validation.h"
#include "core/imaging/warm_up.h"
#include "core/machine/campaign.h"
#include "core/workflows/clock_offsets.h"

namespace spindrift {

/// What it means that nobody looked whether the instrument had settled.
[[nodiscard]] std::string warmUpNotChecked();

struct CheckResult {
  nlohmann::json json = nlohmann::json::object();
  std::string summary;
  bool passed = false;
};

/// The file of a campaign that holds a measurement made for the warm-up alone: one point again and again, columns as in
/// observations.csv.
inline constexpr auto warm_up_file = "warm_up.csv";
/// What is in it, on the clock of the campaign; nothing: there is no such file. Throws InputError.
[[nodiscard]] std::optional<ObservationSet> warmUpMeasurement(const Campaign& campaign, const ClockOffsets& offsets);
/// As judgeWarmUp tells it: drift per axis in um/h, and the series it was seen in (s, um).
[[nodiscard]] CheckResult checkResultOf(const WarmUpResult& warm_up);
/// Back from its JSON. Throws InputError: it is something else.
[[nodiscard]] WarmUpResult warmUpFrom(const nlohmann::json& json);
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
