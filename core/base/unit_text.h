// SPDX-License-Identifier: Apache-2.0
// Units as people read them. Files and options write them in ASCII (um, urad, degC); texts say µm, µrad and °C.
#pragma once

#include <string>
#include <string_view>

namespace spindrift {

/// "um" -> "µm", "urad/K" -> "µrad/K", "um/(m K)" -> "µm/(m K)"; whole words only, a unit without them stays.
[[nodiscard]] std::string printedUnit(std::string_view unit);

}  // namespace spindrift
