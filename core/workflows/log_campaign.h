// SPDX-License-Identifier: Apache-2.0
// A campaign made of nothing but a log: what a user has who wants a model over time and nothing else.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/machine/operating_log.h"
#include "core/thermal/time_series.h"
#include "core/workflows/campaign_series.h"

namespace spindrift {

/// Writes campaign.json, machine.json and log.csv (a copy of `csv`, byte for byte) into a new folder. The machine is
/// named "not described" and has three axes without a travel of its own; nothing of a model over time depends on it.
/// Throws InputError if the log cannot be read or the folder is there and not empty.
void writeLogCampaign(const std::filesystem::path& csv, const std::filesystem::path& folder);

[[nodiscard]] bool hasOutputSignals(const OperatingLog& log);

}  // namespace spindrift
