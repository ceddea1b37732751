// SPDX-License-Identifier: Apache-2.0
// How a probability is written, wherever it is read: window, report, command line.
#pragma once

#include <string>

namespace spindrift {

/// "97 %", "< 1 %", "> 99 %" of a probability in 0 ... 1, never certain; a dash if it is not known.
[[nodiscard]] std::string percentText(double probability);

}  // namespace spindrift
