// SPDX-License-Identifier: Apache-2.0
// The compensator that a control would run, beside what is measured, while data come: prediction and measurement of the
// last hour.
//
// The compensator (core/thermal/compensator.h) steps once a cycle over what the columns held at that moment; what it
// commands is minus the prediction. Only looked at: nothing is written to the machine.
#pragma once

#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/thermal/compensator.h"
#include "core/thermal/thermal_model.h"

namespace spindrift {

class LiveCompensation {
 public:
  static constexpr double history_s = 3600.0;

  struct Held {
    double value = 0.0;
    double good_until_s = 0.0;  ///< until when its source was there to say otherwise (s, any clock)
  };
  /// What a column held at a time; nothing where that is not known.
  using ValueAt = std::function<std::optional<Held>(const std::string& column, double time_s)>;

  struct Point {
    double time_s = 0.0;
    double prediction = 0.0;  ///< in the unit of the output
    double measured = std::numeric_limits<double>::quiet_NaN();
    CompensatorState state = CompensatorState::Empty;
  };

  /// Throws InputError: the compensator cannot take the model.
  explicit LiveCompensation(const ThermalModel& model, double cycle_s = 1.0);

  /// Steps all cycles up to `now_s`, at most the last hour of them. It begins where all inputs are known. A value that
  /// holds is fresh while its source is there: its age counts from good_until_s.
  void advance(double now_s, const ValueAt& value_at);

  [[nodiscard]] const std::string& output() const noexcept { return output_; }
  /// Names of the columns that the model needs.
  [[nodiscard]] std::vector<std::string> inputs() const;
  /// The first of them that the last step had no good value of; empty if there is none.
  [[nodiscard]] std::string refusedInput() const;
  [[nodiscard]] const std::deque<Point>& points() const noexcept { return points_; }
  /// Measured minus predicted about its mean, rms over the points that have both; NaN for fewer than two.
  [[nodiscard]] double remainderRms() const;

 private:
  Compensator compensator_;
  std::string output_;
  double cycle_s_;
  std::optional<double> next_s_;
  std::deque<Point> points_;
};

}  // namespace spindrift
