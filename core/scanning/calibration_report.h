// SPDX-License-Identifier: Apache-2.0
// A calibration of the profiler as JSON (keys of FORMATS.md) and as text for people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/scanning/profiler_calibration.h"

namespace spindrift {

/// `alpha_rad` ... `dz_mm`, `standard_uncertainty` with the same keys, `covariance` (6 x 6, rad and mm),
/// `undetermined`.
[[nodiscard]] nlohmann::json calibrationJson(const ProfilerCalibration& calibration);
[[nodiscard]] std::string calibrationSummary(const ProfilerCalibration& calibration);

}  // namespace spindrift
