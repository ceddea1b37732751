// SPDX-License-Identifier: Apache-2.0
// Units as people read them. Files and options write them in ASCII (um, urad, degC); texts say µm, µrad and °C.
#pragma once

#include <string>
#include <string_view>

namespace spindrift {

/// "um" -> "µm", "urad/K" -> "µrad/K", "um/(m K)" -> "µm/(m K)"; whole words only, a unit without them stays.
[[nodiscard]] std::string printedUnit(std::string_view unit);

/// Unit of a measured deviation by the end of its name, as files write it: "um" (_um), "urad" (_urad), "um/m"
/// (_um_per_m, _um_m), "nm" (_nm), "mrad" (_mrad); empty for all others, whose unit is not known.
[[nodiscard]] std::string unitOfSignal(std::string_view name);

}  // namespace spindrift
