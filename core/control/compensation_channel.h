// SPDX-License-Identifier: Apache-2.0
// The first of three nets around a live compensation: what Spindrift itself lets through to the control. (The second
// are range and speed in the control, limit3; the third its watchdog, when nobody writes any more.)
//
//   next = last applied wish + clamp(clamp(wanted, +-limit) - last, +-rate * dt), never more than `step` at once
//
// It is off (fades to zero at the same rate) while the control is off, in emergency stop, not homed, or the inputs of
// the model are too old or not finite; and comes back in the same way. Units um, s.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>

#include "core/control/machine_control.h"

namespace spindrift {

struct ChannelLimits {
  double limit_um = 150.0;  ///< magnitude per axis
  double rate_um_s = 0.2;   ///< change per second of the machine's time
  double step_um = 5.0;     ///< change between two writes, whatever the time between them
  double oldest_s = 60.0;   ///< age of the model's inputs beyond which nothing is known
  void validate() const;    ///< throws InputError
};

class CompensationChannel {
 public:
  explicit CompensationChannel(const ChannelLimits& limits);

  struct Wish {
    Eigen::Vector3d offset_um = Eigen::Vector3d::Zero();
    /// How sure, one standard uncertainty; NaN: not known.
    Eigen::Vector3d sigma_um = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    std::string refused;  ///< why it must not be applied at present; else empty
    double age_s = 0.0;   ///< of the oldest input
  };
  /// What to write now. `now_s`: the machine's time; the first call begins at `begin`'s value.
  [[nodiscard]] Eigen::Vector3d next(const Wish& wish, const ControlState& state, double now_s);
  /// Where the channel stands: what the drives add.
  void begin(const Eigen::Vector3d& applied_um, double now_s);

  [[nodiscard]] bool active() const noexcept { return reason_.empty(); }
  /// Why it is off; empty while it is active.
  [[nodiscard]] const std::string& reason() const noexcept { return reason_; }
  [[nodiscard]] const Eigen::Vector3d& written_um() const noexcept { return written_um_; }
  [[nodiscard]] double largestStep_um() const noexcept { return largest_step_um_; }
  [[nodiscard]] double largestRate_um_s() const noexcept { return largest_rate_um_s_; }
  /// "active: X +1.2 ± 0.4, Y 0.0 ± 0.3, Z −34.0 ± 0.8 µm; inputs 2 s old"; without "±" where nobody knows.
  [[nodiscard]] std::string sentence() const;

 private:
  ChannelLimits limits_;
  Wish wish_;
  Eigen::Vector3d written_um_ = Eigen::Vector3d::Zero();
  double last_s_ = 0.0;
  double largest_step_um_ = 0.0;
  double largest_rate_um_s_ = 0.0;
  std::string reason_ = "not begun";
};

}  // namespace spindrift
