// SPDX-License-Identifier: Apache-2.0
// Which observations can be compared with the simulation. Internal to core/discrepancy.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/discrepancy/discrepancy.h"

namespace spindrift {

/// Rows of the observations.
struct ComparableRows {
  std::vector<std::size_t> fit;  ///< marked fit, with a prediction, where the log tells what the machine did: neither
                                 ///< in nor soon after a gap, nor between rows of different spindle speed
  std::vector<std::size_t> held_out;  ///< marked holdout, at such times
  std::size_t unmatched = 0;          ///< used, but without a prediction
};

/// Adds a warning for what is left out. Throws InputError: a sigma that is not positive, nothing to be used or fitted,
/// fewer than half of the observations with a prediction.
/// `log_clock_s`: clock of the log minus clock of the observations.
[[nodiscard]] ComparableRows comparableRows(const DiscrepancyInput& input, double log_clock_s,
                                            std::vector<std::string>& warnings);

/// Whether the log, with its clock moved by `offset_s`, still covers most of the readings to be fitted that it covers
/// without: beyond its ends nothing is known of the machine.
[[nodiscard]] bool logCovers(const DiscrepancyInput& input, double offset_s);

}  // namespace spindrift
