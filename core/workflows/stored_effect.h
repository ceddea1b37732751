// SPDX-License-Identifier: Apache-2.0
// What stories of a discrepancy keep in a session of effects and gaps (JSON). A number that was not there is null there
// and NaN here. Reading throws nlohmann::json::exception where a key is missing; keys that came later may be missing.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/reporting/discrepancy_report.h"

namespace spindrift {

/// NaN where the key holds no number.
[[nodiscard]] double storedNumber(const nlohmann::json& json, const char* key);
[[nodiscard]] std::vector<double> storedNumbers(const nlohmann::json& list);

[[nodiscard]] nlohmann::json storedEffect(const FoundEffect& effect);
[[nodiscard]] FoundEffect effectOfStored(const nlohmann::json& json);

[[nodiscard]] nlohmann::json storedGap(const DiscrepancyGap& gap);
[[nodiscard]] DiscrepancyGap gapOfStored(const nlohmann::json& json);

}  // namespace spindrift
