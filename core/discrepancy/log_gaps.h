// SPDX-License-Identifier: Apache-2.0
// Gaps of an operating log, and for how long after one the thermal state of the machine is not known.
//
// What happened in a gap is not known, and its heat is felt until it has gone: for twice the length of the gap, at most
// two hours, no observation is compared with what follows from the log. Within a gap a speed or a switch is taken as
// unchanged where it is the same before and after, else at its mean over the log; a temperature goes straight on.
#pragma once

#include <span>
#include <vector>

namespace spindrift {

struct LogGap {
  double from_s = 0.0;         ///< last row before it
  double to_s = 0.0;           ///< first row after it
  double known_from_s = 0.0;   ///< the states are known again
  std::size_t row_before = 0;  ///< index of the last row before it
};

/// Steps of more than half an hour and of more than 20 usual ones. `time_s` increases.
[[nodiscard]] std::vector<LogGap> logGaps(std::span<const double> time_s);

/// The states are not known at this time.
[[nodiscard]] bool inGap(std::span<const LogGap> gaps, double time_s);

}  // namespace spindrift
