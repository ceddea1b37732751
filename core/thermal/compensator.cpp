// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/compensator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <vector>

#include "core/thermal/thermal_model.h"

namespace spindrift {
namespace {

/// Why an output cannot be compensated with; empty if it can.
std::string problemOf(const ThermalModel& model, const ThermalOutput& output, bool forced) {
  if (output.unit != "um" && output.unit != "urad")
    return fmt::format("Output {} has the unit \"{}\"; allowed: \"um\" or \"urad\".", output.name, output.unit);
  if (output.terms.empty())
    return fmt::format(
        "Output {} has no terms, only a constant (an ARX model with complex, negative or double poles has no "
        "equivalent in first-order time constants); allowed: a model identified with --method response or oe.",
        output.name);
  if (!std::isfinite(output.offset)) return fmt::format("The offset of output {} is not finite.", output.name);
  for (const LagTerm& term : output.terms) {
    if (term.input < 0 || static_cast<std::size_t>(term.input) >= model.inputs.size())
      return fmt::format("Output {} uses input {}, which the model does not have.", output.name, term.input);
    if (!std::isfinite(term.gain) || !std::isfinite(term.tau_s) || term.tau_s < 0.0)
      return fmt::format(
          "Output {} has a gain of {} with a time constant of {} s; allowed: finite numbers, no negative "
          "time constant (it would be unstable).",
          output.name, term.gain, term.tau_s);
  }
  if (!forced && output.verdict && !output.verdict->good_enough)
    return fmt::format(
        "The identification called the model of {} not good enough ({}); allowed: a better model, or "
        "loading it by force.",
        output.name, output.verdict->reason.empty() ? "no reason given" : output.verdict->reason);
  return {};
}

// Two doubles in one register of every 64-bit processor; compilers make scalars of it where there is none.
using Pair = double __attribute__((vector_size(16)));

inline Pair pairAt(const double* p) noexcept {
  Pair v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

/// Four sums side by side (one would wait for every addition) and one for what is left over from groups of four.
struct Sums {
  Pair first{0.0, 0.0};
  Pair second{0.0, 0.0};
  double rest = 0.0;
  [[nodiscard]] double total() const noexcept {
    const Pair both = first + second;
    return (both[0] + both[1]) + rest;
  }
};

/// v = a v + c u for one round of lags; adds the new states to the sums.
inline void advance(double* v, const double* a, const double* c, const double* u, int count, Sums& sums) noexcept {
  int j = 0;
  for (; j + 4 <= count; j += 4) {
    const Pair first = pairAt(a + j) * pairAt(v + j) + pairAt(c + j) * pairAt(u + j);
    const Pair second = pairAt(a + j + 2) * pairAt(v + j + 2) + pairAt(c + j + 2) * pairAt(u + j + 2);
    std::memcpy(v + j, &first, sizeof first);
    std::memcpy(v + j + 2, &second, sizeof second);
    sums.first += first;
    sums.second += second;
  }
  for (; j < count; ++j) {
    v[j] = a[j] * v[j] + c[j] * u[j];
    sums.rest += v[j];
  }
}

inline void addProducts(const double* g, const double* u, int count, Sums& sums) noexcept {
  int j = 0;
  for (; j + 4 <= count; j += 4) {
    sums.first += pairAt(g + j) * pairAt(u + j);
    sums.second += pairAt(g + j + 2) * pairAt(u + j + 2);
  }
  for (; j < count; ++j) sums.rest += g[j] * u[j];
}

}  // namespace

std::string Compensator::load(const ThermalModel& model, double cycle_s, const CompensatorLimits& limits) {
  *this = Compensator();
  if (!(cycle_s > 0.0) || !std::isfinite(cycle_s)) return "The cycle time must be positive.";
  if (!(limits.limit > 0.0) || !(limits.slew_per_s > 0.0) || !(limits.stale_after_s >= 0.0) ||
      !(limits.recover_after_s >= 0.0) || !(limits.range_margin >= 0.0) || !(limits.minimum_margin >= 0.0) ||
      !(limits.update_limit >= 0.0) || !(limits.least_gain >= 0.0) || !(limits.most_gain >= limits.least_gain)) {
    return "A limit of the compensator is negative or zero.";
  }
  for (const double limit : {limits.limit, limits.slew_per_s, limits.stale_after_s, limits.recover_after_s,
                             limits.range_margin, limits.minimum_margin, limits.update_limit, limits.most_gain})
    if (!std::isfinite(limit)) return "A limit of the compensator is not finite.";
  if (model.outputs.empty() || model.outputs.size() > maximum_outputs) return "The model has no output or more than 8.";
  if (model.inputs.size() > transform_.size()) return "The model has too many inputs.";
  for (const ThermalOutput& output : model.outputs) {
    if (std::string problem = problemOf(model, output, limits.forced); !problem.empty()) return problem;
    forced_ = forced_ || (output.verdict && !output.verdict->good_enough);
  }
  for (const ThermalInput& input : model.inputs) {
    int source = 0;
    while (source < inputs_ && input.name != input_names_[source]) ++source;
    if (source == inputs_) {
      if (inputs_ == maximum_inputs) return "The model has more than 32 input signals.";
      input_names_[inputs_++] = input.name;
      const double range = input.train_max - input.train_min;
      const bool driven =
          input.kind == SignalKind::Speed || input.kind == SignalKind::Feed || input.kind == SignalKind::Switch;
      const double margin = std::max(limits.range_margin * range, driven ? 0.0 : limits.minimum_margin);
      size_only_[source] = isDriven(input.kind);
      train_low_[source] = input.train_min;
      train_high_[source] = input.train_max;
      low_[source] = input.train_min - margin;
      high_[source] = input.train_max + margin;
      if (!(std::isfinite(low_[source]) && std::isfinite(high_[source])))
        return fmt::format("The range of training of input {} is not finite.", input.name);
    }
    if (!(input.scale > 0.0) || !(input.power > 0.0) || !std::isfinite(input.scale) || !std::isfinite(input.power))
      return fmt::format("Input {} has the scale {} and the power {}; allowed: finite and positive.", input.name,
                         input.scale, input.power);
    transform_[transforms_++] = {source, input.power, 1.0 / input.scale};
  }
  int rounds = 0;
  for (std::size_t o = 0; o < model.outputs.size(); ++o) {
    const ThermalOutput& output = model.outputs[o];
    output_names_[o] = output.name;
    offset_[o] = output.offset;
    gain_factor_[o] = 1.0;
    first_[o] = lags_;
    if (static_cast<std::size_t>(lags_) + output.terms.size() > maximum_lags)
      return "The model has more than 1024 time constants.";
    std::vector<std::vector<const LagTerm*>> of(model.inputs.size());
    for (const LagTerm& term : output.terms) {
      of[term.input].push_back(&term);
      offset_[o] -= term.gain * model.inputs[term.input].reference;
    }
    std::vector<int> order(of.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int l, int r) { return of[l].size() > of[r].size(); });
    while (!order.empty() && of[order.back()].empty()) order.pop_back();
    used_[o] = static_cast<int>(order.size());
    std::copy(order.begin(), order.end(), order_[o].begin());
    same_order_[o] = o > 0 && used_[o] == used_[o - 1] && order_[o] == order_[o - 1];
    for (std::size_t round = 0; !order.empty() && round < of[order.front()].size(); ++round, ++rounds) {
      for (std::size_t place = 0; place < order.size() && of[order[place]].size() > round; ++place, ++lags_) {
        const LagTerm& term = *of[order[place]][round];
        const LagStep step = lagStep(cycle_s, term.tau_s, holdsUntilNextRow(model.inputs[term.input].kind));
        // With w = x - b1 u the input enters once per step: w1 = a w0 + (a b1 + b0) u0, and b1 u goes straight to the
        // output.
        a_[lags_] = step.a;
        c_[lags_] = term.gain * (step.a * step.b1 + step.b0);
        rest_[lags_] = term.gain * (1.0 - step.b1);
        direct_[o][place] += term.gain * step.b1;
        if (term.gain != 0.0) longest_lag_s_ = std::max(longest_lag_s_, term.tau_s);
        ++round_size_[rounds];
      }
    }
    first_[o + 1] = lags_;
    first_round_[o + 1] = rounds;
    ++outputs_;
  }
  cycle_s_ = cycle_s;
  limits_ = limits;
  state_ = CompensatorState::Running;
  reset();
  return {};
}

const char* Compensator::inputName(int index) const noexcept {
  return index >= 0 && index < inputs_ ? input_names_[index].c_str() : "";
}

const char* Compensator::outputName(int index) const noexcept {
  return index >= 0 && index < outputs_ ? output_names_[index].c_str() : "";
}

void Compensator::reset() noexcept {
  started_ = false;
  since_start_s_ = 0.0;
  fallback_ = false;
  good_for_s_ = 0.0;
  bad_for_s_.fill(0.0);
  was_bad_ = false;
  broken_for_s_ = 0.0;
}

CompensatorStatus Compensator::status() const noexcept {
  CompensatorStatus status{state_, refused_, refused_update_, forced_, broken_for_s_ > 0.0};
  for (int i = inputs_ - 1; started_ && i >= 0; --i)
    if (last_good_[i] < train_low_[i] || last_good_[i] > train_high_[i]) status.outside_training = i;
  for (int o = outputs_ - 1; o >= 0; --o)
    if (std::abs(output_[o]) >= limits_.limit) status.limited_output = o;
  constexpr double settled = 3.0;  // time constants
  status.settling_s = std::max(0.0, settled * longest_lag_s_ - since_start_s_);
  return status;
}

bool Compensator::update(int output, double gain_factor, double offset_correction) noexcept {
  if (output < 0 || output >= outputs_) return false;
  // Written so that NaN fails.
  const bool possible =
      gain_factor >= limits_.least_gain && gain_factor <= limits_.most_gain &&
      std::abs(correction_[output] + offset_correction) <= std::min(limits_.update_limit, limits_.limit);
  if (!possible) {
    refused_update_ = output;
    return false;
  }
  if (refused_update_ == output) refused_update_ = -1;
  gain_factor_[output] = gain_factor;
  correction_[output] += offset_correction;
  return true;
}

double Compensator::powered(double v, double power) noexcept {
  if (power == 1.0) return v;
  if (power == 2.0) return v * std::abs(v);
  const double magnitude = std::abs(v);
  return std::copysign(power == 1.5 ? magnitude * std::sqrt(magnitude) : std::pow(magnitude, power), v);
}

/// A lag whose input stays zero, a spindle that stands for days, decays to numbers below 1e-308, with which some
/// processors take a hundred times longer. It is zero long before; a few lags a step are enough to be in time, for the
/// way from here to there takes more steps than the round of all lags.
void Compensator::sweep() noexcept {
  constexpr double nothing = 1e-100;
  constexpr int at_once = 4;
  for (int k = 0; k < at_once; ++k) {
    if (++swept_ >= lags_) swept_ = 0;
    if (std::abs(v_[swept_]) < nothing) v_[swept_] = 0.0;
  }
}

/// An input was not known for a while and is again: its lags went on with its last good value. It moved on in the
/// meantime, straight as far as anybody knows, and so do they: the response of a lag to a straight line of the length
/// h = gap / tau that ends at f is f (1 - (1 - exp(-h)) / h).
void Compensator::catchUp(int source, double gap_s) noexcept {
  const double cycles = gap_s / cycle_s_;
  std::array<double, 3 * maximum_inputs> moved{};
  for (int t = 0; t < transforms_; ++t) {
    if (transform_[t].source != source) continue;
    moved[t] = (now_[t] - before_[t]) * cycles / (cycles + 1.0);
    before_[t] += moved[t];
  }
  for (int o = 0; o < outputs_; ++o) {
    int lag = first_[o];
    for (int r = first_round_[o]; r < first_round_[o + 1]; ++r) {
      for (int j = 0; j < round_size_[r]; ++j, ++lag) {
        const int t = order_[o][j];
        if (transform_[t].source != source || moved[t] == 0.0) continue;
        const double h = -std::log(a_[lag]) * cycles;
        const double part = h < 1e-6 ? 0.5 * h : 1.0 + std::expm1(-h) / h;
        v_[lag] += rest_[lag] * moved[t] * part;
      }
    }
  }
}

CompensatorState Compensator::step(const double* inputs, const double* age_s, double* outputs) noexcept {
  if (state_ == CompensatorState::Empty) {
    refused_ = -1;
    return state_;
  }
  static constexpr auto none = [] {
    std::array<double, maximum_inputs> values{};
    values.fill(std::numeric_limits<double>::quiet_NaN());
    return values;
  }();
  if (inputs == nullptr) inputs = none.data();
  std::array<double, maximum_inputs> acting;
  for (int i = 0; i < inputs_; ++i) acting[i] = size_only_[i] ? std::abs(inputs[i]) : inputs[i];
  inputs = acting.data();
  // Inputs: a bad one keeps its last good value for a while.
  refused_ = -1;
  bool lost = false;
  std::array<double, maximum_inputs> gap_s;  // of inputs that are good again
  bool back = false;
  // The usual case without branches per input; written so that NaN fails.
  bool all_good = age_s == nullptr && !was_bad_;
  for (int i = 0; i < inputs_; ++i) all_good = all_good & (inputs[i] >= low_[i]) & (inputs[i] <= high_[i]);
  if (all_good) {
    for (int i = 0; i < inputs_; ++i) last_good_[i] = inputs[i];
  } else {
    for (int i = 0; i < inputs_; ++i) {
      const double age = age_s != nullptr ? age_s[i] : 0.0;
      const bool good = inputs[i] >= low_[i] && inputs[i] <= high_[i] && age >= 0.0 && age <= limits_.stale_after_s;
      gap_s[i] = good ? bad_for_s_[i] : 0.0;
      back = back || gap_s[i] > 0.0;
      if (good) {
        last_good_[i] = inputs[i];
        bad_for_s_[i] = 0.0;
      } else {
        if (refused_ < 0) refused_ = i;
        bad_for_s_[i] = std::min(bad_for_s_[i] + cycle_s_, 1e9);
        lost =
            lost || bad_for_s_[i] > limits_.stale_after_s || !(age <= limits_.stale_after_s) || age < 0.0 || !started_;
      }
    }
    was_bad_ = refused_ >= 0;
  }
  // Out of fall-back only by inputs that are good, not by held ones: an input with a good value now and then would
  // otherwise be believed again as long as each of them is held.
  if (refused_ >= 0 && (lost || fallback_)) {
    fallback_ = true;
    good_for_s_ = 0.0;
  } else if (fallback_) {
    good_for_s_ += cycle_s_;
    fallback_ = good_for_s_ < limits_.recover_after_s;
  }
  state_ = fallback_       ? CompensatorState::Fallback
           : refused_ >= 0 ? CompensatorState::Holding
                           : CompensatorState::Running;
  if (!started_ && refused_ >= 0) {
    // Nothing to go by: to zero, where it is from the beginning unless the model's own value broke or after a reset.
    for (int o = 0; o < outputs_; ++o) {
      const double change = limits_.slew_per_s * cycle_s_;
      output_[o] = std::clamp(0.0, output_[o] - change, output_[o] + change);
      outputs[o] = output_[o];
    }
    return state_;
  }
  for (int t = 0; t < transforms_; ++t)
    now_[t] = powered(last_good_[transform_[t].source] * transform_[t].inverse_scale, transform_[t].power);
  const bool at_rest = !started_;
  if (back && !at_rest)
    for (int i = 0; i < inputs_; ++i)
      if (gap_s[i] > 0.0) catchUp(i, gap_s[i]);
  since_start_s_ = at_rest ? 0.0 : std::min(since_start_s_ + cycle_s_, 1e12);
  started_ = true;
  const double largest_change = limits_.slew_per_s * cycle_s_;
  std::array<double, maximum_outputs> value;
  bool broken = false;
  alignas(64) std::array<double, 3 * maximum_inputs> before;
  alignas(64) std::array<double, 3 * maximum_inputs> now;
  for (int o = 0; o < outputs_; ++o) {
    const int used = used_[o];
    if (!same_order_[o]) {
      for (int j = 0; j < used; ++j) {
        before[j] = before_[order_[o][j]];
        now[j] = now_[order_[o][j]];
      }
    }
    Sums sums;
    const int rounds_end = first_round_[o + 1];
    double* v = &v_[0] + first_[o];
    const double* a = &a_[0] + first_[o];
    const double* c = &c_[0] + first_[o];
    if (at_rest) {
      const double* rest = &rest_[0] + first_[o];
      for (int r = first_round_[o]; r < rounds_end; ++r)
        for (int j = 0; j < round_size_[r]; ++j) sums.rest += * v++ = *rest++ * now[j];
    } else {
      for (int r = first_round_[o]; r < rounds_end; ++r) {
        const int size = round_size_[r];
        advance(v, a, c, before.data(), size, sums);
        v += size;
        a += size;
        c += size;
      }
    }
    addProducts(direct_[o].data(), now.data(), used, sums);
    value[o] = -(gain_factor_[o] * (offset_[o] + sums.total()) + correction_[o]);
    broken = broken || !std::isfinite(value[o]);
  }
  // One output that is no number restarts the lags of all: none of them is what the model says.
  const bool fade = fallback_ || (broken && broken_for_s_ > limits_.stale_after_s);
  for (int o = 0; o < outputs_; ++o) {
    const double target = fade ? 0.0 : broken ? output_[o] : std::clamp(value[o], -limits_.limit, limits_.limit);
    output_[o] = std::clamp(target, output_[o] - largest_change, output_[o] + largest_change);
    outputs[o] = output_[o];
  }
  for (int t = 0; t < transforms_; ++t) before_[t] = now_[t];
  sweep();
  if (broken) {
    started_ = false;  // a lag that is no number stays so: all begin at rest again
    if (state_ == CompensatorState::Running) state_ = CompensatorState::Holding;
    if (fade) state_ = CompensatorState::Fallback;
    broken_for_s_ = std::min(broken_for_s_ + cycle_s_, 1e9);
  } else {
    broken_for_s_ = 0.0;
  }
  return state_;
}

}  // namespace spindrift
