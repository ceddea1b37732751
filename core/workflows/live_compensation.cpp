// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/live_compensation.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace spindrift {

LiveCompensation::LiveCompensation(const ThermalModel& model, double cycle_s) : cycle_s_(cycle_s) {
  // Only looked at: also a model that no control may load is shown; the page says what speaks against it.
  CompensatorLimits limits;
  limits.forced = true;
  const std::string problem = compensator_.load(model, cycle_s, limits);
  if (!problem.empty()) throw InputError("The compensator cannot run this model: " + problem);
  output_ = compensator_.outputName(0);
}

std::vector<std::string> LiveCompensation::inputs() const {
  std::vector<std::string> names;
  for (int i = 0; i < compensator_.inputCount(); ++i) names.emplace_back(compensator_.inputName(i));
  return names;
}

std::string LiveCompensation::refusedInput() const {
  const int refused = compensator_.refusedInput();
  return refused < 0 ? std::string() : compensator_.inputName(refused);
}

void LiveCompensation::advance(double now_s, const ValueAt& value_at) {
  if (!next_s_ || now_s - *next_s_ > history_s) {
    if (next_s_) compensator_.reset();  // what lies between was not seen
    next_s_ = std::floor((now_s - history_s) / cycle_s_) * cycle_s_;
    points_.clear();
  }
  const auto inputs = static_cast<std::size_t>(compensator_.inputCount());
  std::vector<double> values(inputs), ages(inputs), out(static_cast<std::size_t>(compensator_.outputCount()));
  for (; *next_s_ <= now_s; *next_s_ += cycle_s_) {
    const double t = *next_s_;
    bool all = true;
    for (std::size_t i = 0; i < inputs; ++i) {
      const auto held = value_at(compensator_.inputName(static_cast<int>(i)), t);
      all = all && held.has_value();
      values[i] = held ? held->value : std::numeric_limits<double>::quiet_NaN();
      ages[i] = held ? std::max(0.0, t - held->good_until_s) : 0.0;
    }
    if (!all && points_.empty()) continue;
    // It is shown as one that has been running: the slew limit after its start is no part of the prediction.
    if (points_.empty()) {
      constexpr int most_steps = 100'000;
      double before = std::numeric_limits<double>::quiet_NaN();
      for (int k = 0; k < most_steps && out[0] != before; ++k) {
        before = out[0];
        (void)compensator_.step(values.data(), ages.data(), out.data());
      }
    }
    Point point;
    point.time_s = t;
    point.state = compensator_.step(values.data(), ages.data(), out.data());
    point.prediction = -out[0];
    // What a lost source measured last is no measurement of now.
    const auto measured = value_at(output_, t);
    if (measured && t - measured->good_until_s <= 2.0 * cycle_s_) point.measured = measured->value;
    points_.push_back(point);
  }
  while (!points_.empty() && points_.front().time_s < now_s - history_s) points_.pop_front();
}

double LiveCompensation::remainderRms() const {
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (const Point& point : points_) {
    if (!std::isfinite(point.measured)) continue;
    const double left = point.measured - point.prediction;
    sum += left;
    squares += left * left;
    ++count;
  }
  if (count < 2.0) return std::numeric_limits<double>::quiet_NaN();
  return std::sqrt(std::max(0.0, squares / count - sum / count * (sum / count)));
}

}  // namespace spindrift
