// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/compensator.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/thermal/thermal_model.h"

namespace spindrift {
namespace {

void copyName(const std::string& from, std::array<char, 64>& to) noexcept {
  to.fill('\0');
  std::memcpy(to.data(), from.data(), std::min(from.size(), to.size() - 1));
}

}  // namespace

std::string Compensator::load(const ThermalModel& model, double cycle_s, const CompensatorLimits& limits) {
  *this = Compensator();
  if (!(cycle_s > 0.0) || !std::isfinite(cycle_s)) return "The cycle time must be positive.";
  if (!(limits.limit > 0.0) || !(limits.slew_per_s > 0.0) || !(limits.stale_after_s >= 0.0) ||
      !(limits.recover_after_s >= 0.0) || !(limits.range_margin >= 0.0) || !(limits.minimum_margin >= 0.0)) {
    return "A limit of the compensator is negative or zero.";
  }
  if (model.outputs.empty() || model.outputs.size() > maximum_outputs) return "The model has no output or more than 8.";
  if (model.inputs.size() > transform_.size()) return "The model has too many inputs.";
  for (const ThermalInput& input : model.inputs) {
    int source = 0;
    while (source < inputs_ && input.name.compare(0, 63, input_names_[source].data()) != 0) ++source;
    if (source == inputs_) {
      if (inputs_ == maximum_inputs) return "The model has more than 32 input signals.";
      copyName(input.name, input_names_[inputs_++]);
      const double range = input.train_max - input.train_min;
      const bool driven =
          input.kind == SignalKind::Speed || input.kind == SignalKind::Feed || input.kind == SignalKind::Switch;
      const double margin = std::max(limits.range_margin * range, driven ? 0.0 : limits.minimum_margin);
      low_[source] = input.train_min - margin;
      high_[source] = input.train_max + margin;
    }
    transform_[transforms_++] = {source, input.power, 1.0 / input.scale};
  }
  for (std::size_t o = 0; o < model.outputs.size(); ++o) {
    const ThermalOutput& output = model.outputs[o];
    copyName(output.name, output_names_[o]);
    offset_[o] = output.offset;
    gain_factor_[o] = 1.0;
    first_[o] = lags_;
    for (const LagTerm& term : output.terms) {
      if (lags_ == maximum_lags) return "The model has more than 1024 lags.";
      const ThermalInput& input = model.inputs[term.input];
      const LagStep step = lagStep(cycle_s, term.tau_s, holdsUntilNextRow(input.kind));
      lag_transform_[lags_] = term.input;
      a_[lags_] = step.a;
      // With w = x - b1 u the input enters once per step: w1 = a w0 + (a b1 + b0) u0, and b1 u goes straight to the
      // output.
      c_[lags_] = step.a * step.b1 + step.b0;
      rest_[lags_] = 1.0 - step.b1;
      direct_[o][term.input] += term.gain * step.b1;
      gain_[lags_] = term.gain;
      offset_[o] -= term.gain * input.reference;
      ++lags_;
    }
    first_[o + 1] = lags_;
    ++outputs_;
  }
  cycle_s_ = cycle_s;
  limits_ = limits;
  state_ = CompensatorState::Running;
  reset();
  return {};
}

const char* Compensator::inputName(int index) const noexcept {
  return index >= 0 && index < inputs_ ? input_names_[index].data() : "";
}

const char* Compensator::outputName(int index) const noexcept {
  return index >= 0 && index < outputs_ ? output_names_[index].data() : "";
}

void Compensator::reset() noexcept {
  started_ = false;
  good_for_s_ = limits_.recover_after_s;
  bad_for_s_.fill(0.0);
  output_.fill(0.0);
}

void Compensator::update(int output, double gain_factor, double offset_correction) noexcept {
  if (output < 0 || output >= outputs_ || !std::isfinite(gain_factor) || !std::isfinite(offset_correction)) return;
  gain_factor_[output] = gain_factor;
  correction_[output] += offset_correction;
}

double Compensator::powered(double v, double power) noexcept {
  if (power == 1.0) return v;
  if (power == 2.0) return v * std::abs(v);
  const double magnitude = std::abs(v);
  return std::copysign(power == 1.5 ? magnitude * std::sqrt(magnitude) : std::pow(magnitude, power), v);
}

CompensatorState Compensator::step(const double* inputs, const double* age_s, double* outputs) noexcept {
  if (state_ == CompensatorState::Empty) {
    refused_ = -1;
    return state_;
  }
  // Inputs: a bad one keeps its last good value for a while.
  refused_ = -1;
  bool lost = false;
  for (int i = 0; i < inputs_; ++i) {
    const double age = age_s != nullptr ? age_s[i] : 0.0;
    // Written so that NaN fails.
    const bool good = inputs[i] >= low_[i] && inputs[i] <= high_[i] && age >= 0.0 && age <= limits_.stale_after_s;
    if (good) {
      last_good_[i] = inputs[i];
      bad_for_s_[i] = 0.0;
    } else {
      if (refused_ < 0) refused_ = i;
      bad_for_s_[i] = std::min(bad_for_s_[i] + cycle_s_, 1e9);
      lost = lost || bad_for_s_[i] > limits_.stale_after_s || !(age <= limits_.stale_after_s) || age < 0.0 || !started_;
    }
  }
  if (refused_ >= 0 && lost) {
    good_for_s_ = 0.0;
  } else {
    good_for_s_ = std::min(good_for_s_ + cycle_s_, 1e9);
  }
  const bool fallback = good_for_s_ < limits_.recover_after_s;
  state_ = fallback        ? CompensatorState::Fallback
           : refused_ >= 0 ? CompensatorState::Holding
                           : CompensatorState::Running;
  if (!started_ && refused_ >= 0) {
    for (int o = 0; o < outputs_; ++o) outputs[o] = 0.0;
    return state_;
  }
  for (int t = 0; t < transforms_; ++t)
    now_[t] = powered(last_good_[transform_[t].source] * transform_[t].inverse_scale, transform_[t].power);
  if (!started_) {
    for (int k = 0; k < lags_; ++k) w_[k] = rest_[k] * now_[lag_transform_[k]];
    started_ = true;
  } else {
    for (int k = 0; k < lags_; ++k) w_[k] = a_[k] * w_[k] + c_[k] * before_[lag_transform_[k]];
  }
  for (int t = 0; t < transforms_; ++t) before_[t] = now_[t];
  const double largest_change = limits_.slew_per_s * cycle_s_;
  for (int o = 0; o < outputs_; ++o) {
    // Four sums side by side: one would wait for every addition.
    double sum0 = offset_[o];
    double sum1 = 0.0;
    double sum2 = 0.0;
    double sum3 = 0.0;
    int k = first_[o];
    for (; k + 4 <= first_[o + 1]; k += 4) {
      sum0 += gain_[k] * w_[k];
      sum1 += gain_[k + 1] * w_[k + 1];
      sum2 += gain_[k + 2] * w_[k + 2];
      sum3 += gain_[k + 3] * w_[k + 3];
    }
    for (; k < first_[o + 1]; ++k) sum0 += gain_[k] * w_[k];
    for (int t = 0; t < transforms_; ++t) sum1 += direct_[o][t] * now_[t];
    double value = (sum0 + sum1) + (sum2 + sum3);
    value = -(gain_factor_[o] * value + correction_[o]);
    double target = fallback ? 0.0 : std::clamp(value, -limits_.limit, limits_.limit);
    if (!(target >= -limits_.limit && target <= limits_.limit)) target = 0.0;
    output_[o] = std::clamp(target, output_[o] - largest_change, output_[o] + largest_change);
    outputs[o] = output_[o];
  }
  return state_;
}

}  // namespace spindrift
