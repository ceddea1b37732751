// SPDX-License-Identifier: Apache-2.0
// The verdicts on the scans of a campaign, as a session keeps them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/scanning/scan_check.h"

namespace spindrift {

[[nodiscard]] nlohmann::json payloadOfScanChecks(const std::vector<ScanCheck>& checks);
/// The other way; of the capture only the cloud is kept.
[[nodiscard]] std::vector<ScanCheck> scanChecksFrom(const nlohmann::json& payload);

}  // namespace spindrift
