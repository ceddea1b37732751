// SPDX-License-Identifier: Apache-2.0
// What the error parameters of FORMATS.md mean, in one line each, so that a report explains its own abbreviations.
#pragma once

#include <string>
#include <string_view>

namespace spindrift {

/// "EC0C_urad" -> "rotation of the table about Z"; also of ISO 230-1 names of an axis ("EAY_urad" ->
/// "angular error of the Y axis about X"), of the ball artefact ("gX_um_per_m") and of the nine-parameter model
/// ("alpha_X_um_per_m"). Empty for a name that is not known.
[[nodiscard]] std::string parameterMeaning(std::string_view name);

}  // namespace spindrift
