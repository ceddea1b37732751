// SPDX-License-Identifier: Apache-2.0
#include "core/connect/source_clock.h"

#include <algorithm>
#include <cmath>

namespace spindrift {

double SourceClock::best() const noexcept {
  const double least = std::min(previous_, present_);
  return std::isfinite(least) ? least : std::numeric_limits<double>::quiet_NaN();
}

void SourceClock::restart(double difference_s, double received_s) {
  previous_ = none;
  present_ = difference_s;
  half_began_s_ = received_s;
}

double SourceClock::toLocal(double stamped_s, double received_s) {
  if (!std::isfinite(stamped_s)) return received_s;
  const double difference = received_s - stamped_s;
  const double known = best();
  if (std::isnan(known)) {
    restart(difference, received_s);
  } else if (stamped_s < newest_stamp_s_ - tolerance_s || difference < known - tolerance_s) {
    ++steps_;
    restart(difference, received_s);
    newest_stamp_s_ = -none;
  } else {
    if (received_s - half_began_s_ > half_window_s) {
      previous_ = present_;
      present_ = none;
      half_began_s_ = received_s;
    }
    present_ = std::min(present_, difference);
  }
  newest_stamp_s_ = std::max(newest_stamp_s_, stamped_s);
  return std::min(stamped_s + best(), received_s);
}

}  // namespace spindrift
