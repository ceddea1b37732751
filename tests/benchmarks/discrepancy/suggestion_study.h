// SPDX-License-Identifier: GPL-3.0-or-later
// Does the measurement that the search suggests tell the truth from its rivals, and better than chance?
//
// One effect is hidden, weakly enough that some campaigns end ambiguous with it in the set. The machine then rests
// until the next morning and does what is suggested; the readings asked for are added, with noise of their own, and the
// search runs again over both days: the machine runs the programme of the suggestion and is measured at its points and
// times. Beside it, the same number of readings in the same span at random times of a random day's work and at random
// points of those measured. Counted is how often the truth is then named alone.
#pragma once

#include <cstdint>

namespace spindrift::study {

struct SuggestionStudyOptions {
  std::uint64_t seed = 1;
  int campaigns = 400;    ///< searched for ambiguous ones
  int random_draws = 2;   ///< of random measurements, per ambiguous campaign
  bool list = false;      ///< print every ambiguous campaign
  bool required = false;  ///< the suggestion names the truth alone in 85 %, and more often than chance
};

/// 0, or 1 where something required is missed.
[[nodiscard]] int runSuggestionStudy(const SuggestionStudyOptions& options);

}  // namespace spindrift::study
