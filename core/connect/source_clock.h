// SPDX-License-Identifier: Apache-2.0
// How far the clock of a source is from ours, from the records alone.
//
// Model: received - stamped = offset + delay, delay >= 0. The offset is the least difference of the last minute or two
// (two halves that take turns), so that it follows a clock that drifts and takes no delivery that came late for a
// change of the clock. A clock that is set forward gives a smaller difference at once. One that is set back makes
// stamps run backwards, which a delay never does: then the estimate begins anew. The least delay cannot be told from
// the offset.
#pragma once

#include <limits>

namespace spindrift {

class SourceClock {
 public:
  /// When a value held, on our clock: never after `received_s`. `stamped_s` NaN: the source gave no time.
  [[nodiscard]] double toLocal(double stamped_s, double received_s);
  /// Source minus ours in s; NaN before the first stamp.
  [[nodiscard]] double offset_s() const noexcept { return -best(); }
  /// How often the source's clock was set, as seen from here.
  [[nodiscard]] int steps() const noexcept { return steps_; }

 private:
  static constexpr double half_window_s = 60.0;
  /// Data items of one adapter are not strictly in order; more than this is a clock that was set.
  static constexpr double tolerance_s = 5.0;
  static constexpr double none = std::numeric_limits<double>::infinity();

  [[nodiscard]] double best() const noexcept;
  void restart(double difference_s, double received_s);

  double previous_ = none;
  double present_ = none;
  double half_began_s_ = 0.0;
  double newest_stamp_s_ = -none;
  int steps_ = 0;
};

}  // namespace spindrift
