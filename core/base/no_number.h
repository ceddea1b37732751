// SPDX-License-Identifier: Apache-2.0
// The number that says that there is none.
#pragma once

#include <limits>

namespace spindrift {

/// A number that is not there; null in JSON, a dash on screen.
inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace spindrift
