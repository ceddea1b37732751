// SPDX-License-Identifier: Apache-2.0
#include "core/control/compensation_channel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace spindrift {

void ChannelLimits::validate() const {
  const auto require = [](double value, const char* what) {
    if (!(value > 0.0) || !std::isfinite(value))
      throw InputError(fmt::format("Limits of the compensation: {} is {:g}; allowed: above zero.", what, value));
  };
  require(limit_um, "limit_um");
  require(rate_um_s, "rate_um_s");
  require(step_um, "step_um");
  require(oldest_s, "oldest_s");
}

CompensationChannel::CompensationChannel(const ChannelLimits& limits) : limits_(limits) {
  limits_.validate();
}

void CompensationChannel::begin(const Eigen::Vector3d& applied_um, double now_s) {
  written_um_ = applied_um;
  last_s_ = now_s;
  reason_ = "waiting for the first set value";
}

Eigen::Vector3d CompensationChannel::next(const Wish& wish, const ControlState& state, double now_s) {
  wish_ = wish;
  reason_.clear();
  using Condition = ControlState::Condition;
  if (state.condition != Condition::Ready && state.condition != Condition::Busy) {
    reason_ = state.sentence;
  } else if (!wish.refused.empty()) {
    reason_ = wish.refused;
  } else if (!wish.offset_um.allFinite()) {
    reason_ = "the model gives a value that is not a number";
  } else if (!(wish.age_s <= limits_.oldest_s)) {
    reason_ = fmt::format("the inputs of the model are {:.0f} s old; allowed: {:.0f} s", wish.age_s, limits_.oldest_s);
  }
  const Eigen::Vector3d wanted = active() ? wish.offset_um : Eigen::Vector3d::Zero();
  // A clock that stands or runs backwards moves nothing.
  const double dt_s = std::max(0.0, now_s - last_s_);
  last_s_ = std::max(last_s_, now_s);
  const double most = std::min(limits_.step_um, limits_.rate_um_s * dt_s);
  for (int axis = 0; axis < 3; ++axis) {
    const double target = std::clamp(wanted[axis], -limits_.limit_um, limits_.limit_um);
    const double step = std::clamp(target - written_um_[axis], -most, most);
    written_um_[axis] += step;
    largest_step_um_ = std::max(largest_step_um_, std::abs(step));
    if (dt_s > 0.0) largest_rate_um_s_ = std::max(largest_rate_um_s_, std::abs(step) / dt_s);
  }
  return written_um_;
}

std::string CompensationChannel::sentence() const {
  const auto axis = [&](int i, bool sure) {
    const double v = written_um_[i];
    std::string out = fmt::format("{} {:+.1f}", "XYZ"[i], std::abs(v) < 0.05 ? 0.0 : v);
    if (sure && std::isfinite(wish_.sigma_um[i])) out += fmt::format(" ± {:.1f}", wish_.sigma_um[i]);
    return out;
  };
  const auto values = [&](bool sure) {
    return fmt::format("{}, {}, {} µm", axis(0, sure), axis(1, sure), axis(2, sure));
  };
  if (!active()) return fmt::format("off, fading from {}: {}", values(false), reason_);
  return fmt::format("active: {}; inputs {:.0f} s old", values(true), wish_.age_s);
}

}  // namespace spindrift
