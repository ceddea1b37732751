// SPDX-License-Identifier: Apache-2.0
// A registration as JSON (keys of FORMATS.md: um, urad at the centroid of the target) and as text for people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/scanning/registration.h"

namespace spindrift {

/// `target_from_source` (4 x 4, mm), `translation_um`, `rotation_urad`, `covariance` (6 x 6, um and urad; null where a
/// direction is free), `rms_um`, `points_used`, `elapsed_ms`, and more.
[[nodiscard]] nlohmann::json registrationJson(const RegistrationResult& result);
[[nodiscard]] std::string registrationSummary(const RegistrationResult& result);

}  // namespace spindrift
