// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/measurement_update.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/math/statistics.h"

namespace spindrift {

void UpdateOptions::validate() const {
  if (!(interval_s > 0.0)) throw InputError("the interval of the on-machine measurements must be positive, in s.");
  if (!(measurement_sigma > 0.0) || !(gain_bound > 0.0) || !(slowest_tau_s > 0.0) || !(offset_tau_s > 0.0) ||
      !(offset_sigma > 0.0) || !(gain_sigma >= 0.0) || !(gain_drift_per_sqrt_h >= 0.0) ||
      !(smallest_simulated >= 0.0) || !(context_sigma >= 0.0) || !(gate_sigma > 0.0)) {
    throw InputError(
        "an option of the update is negative or zero; allowed: positive sigmas, time constants and bounds.");
  }
}

GainOffsetFilter::GainOffsetFilter(const UpdateOptions& options) : options_(options) {
  const auto size = static_cast<Eigen::Index>(2 + options.context.size());
  options_.context.clear();  // only the number matters here
  state_ = Eigen::VectorXd::Zero(size);
  state_[0] = 1.0;
  covariance_ = Eigen::MatrixXd::Zero(size, size);
  covariance_.diagonal().setConstant(options.context_sigma * options.context_sigma);
  covariance_(0, 0) = options.gain_sigma * options.gain_sigma;
  covariance_(1, 1) = options.offset_sigma * options.offset_sigma;
}

Eigen::VectorXd GainOffsetFilter::row(double simulated, std::span<const double> context) const {
  SPINDRIFT_ASSERT(static_cast<Eigen::Index>(context.size()) + 2 == state_.size(), "context signals differ in number");
  Eigen::VectorXd h(state_.size());
  h[0] = simulated;
  h[1] = 1.0;
  for (std::size_t i = 0; i < context.size(); ++i) h[static_cast<Eigen::Index>(i + 2)] = simulated * context[i];
  return h;
}

void GainOffsetFilter::advance(double dt_s) {
  if (dt_s <= 0.0) return;
  const double keep = std::exp(-dt_s / options_.offset_tau_s);
  // The gain drifts freely up to a quarter, the offset is a remainder of stated size and memory.
  covariance_(0, 0) =
      std::min(covariance_(0, 0) + options_.gain_drift_per_sqrt_h * options_.gain_drift_per_sqrt_h * dt_s / 3600.0,
               std::max(covariance_(0, 0), std::max(0.25, options_.gain_sigma) * std::max(0.25, options_.gain_sigma)));
  state_[1] *= keep;
  covariance_.row(1) *= keep;
  covariance_.col(1) *= keep;
  covariance_(1, 1) += (1.0 - keep * keep) * options_.offset_sigma * options_.offset_sigma;
}

bool GainOffsetFilter::measure(double measured, double simulated, std::span<const double> context, double model_sigma) {
  const Eigen::VectorXd h = row(simulated, context);
  const double known = h.dot(covariance_ * h) + options_.measurement_sigma * options_.measurement_sigma;
  const double off = measured - h.dot(state_);
  const bool wild = begun_ && std::abs(off) > options_.gate_sigma * std::sqrt(known + model_sigma * model_sigma);
  if (wild && !(off * refused_by_ > 0.0)) {
    refused_by_ = off;
    return false;
  }
  begun_ = true;
  refused_by_ = wild ? off : 0.0;  // until one is within the gate again, those on this side are believed
  if (wild) covariance_(1, 1) += off * off - known;  // a jump of the offset, its size as likely as can be
  const Eigen::VectorXd ph = covariance_ * h;
  const double s = h.dot(ph) + options_.measurement_sigma * options_.measurement_sigma;
  state_ += ph / s * off;
  covariance_ -= ph * ph.transpose() / s;
  return true;
}

double GainOffsetFilter::value(double simulated, std::span<const double> context) const {
  return row(simulated, context).dot(state_);
}

double GainOffsetFilter::sigma(double simulated, std::span<const double> context) const {
  const Eigen::VectorXd h = row(simulated, context);
  return std::sqrt(std::max(0.0, h.dot(covariance_ * h)));
}

double GainOffsetFilter::gainSigma() const {
  return std::sqrt(std::max(0.0, covariance_(0, 0)));
}
double GainOffsetFilter::offsetSigma() const {
  return std::sqrt(std::max(0.0, covariance_(1, 1)));
}

void GainOffsetFilter::restore(const Eigen::VectorXd& state, const Eigen::MatrixXd& covariance) {
  if (state.size() != state_.size() || covariance.rows() != state_.size() || covariance.cols() != state_.size() ||
      !state.allFinite() || !covariance.allFinite())
    throw InputError("the state of a filter does not fit; allowed: finite numbers, as many as it has unknowns.");
  state_ = state;
  covariance_ = covariance;
  begun_ = true;
  refused_by_ = 0.0;
}

UpdateRun runWithUpdates(std::span<const double> time_s, std::span<const double> measured,
                         std::span<const double> simulated, const UpdateOptions& options) {
  options.validate();
  SPINDRIFT_ASSERT(time_s.size() == measured.size() && time_s.size() == simulated.size(), "series differ in length");
  UpdateRun run;
  run.predicted.assign(simulated.begin(), simulated.end());
  const bool kalman = options.kind == UpdateKind::Kalman;
  if (kalman) run.sigma.assign(simulated.size(), 0.0);
  for (const auto& signal : options.context)
    SPINDRIFT_ASSERT(signal.size() == time_s.size(), "a context signal differs in length");
  GainOffsetFilter filter(options);
  std::vector<double> context(options.context.size());
  double next = options.start_s;
  double zero_measured = 0.0;
  double zero_simulated = 0.0;
  bool have_zero = false;
  double gain = 1.0;
  double correction = 0.0;
  double corrected_at = options.start_s;
  double last_time = time_s.empty() ? 0.0 : time_s.front();
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (kalman) filter.advance(time_s[i] - last_time);
    for (std::size_t c = 0; c < context.size(); ++c) context[c] = options.context[c][i];
    last_time = time_s[i];
    const double before =
        options.kind == UpdateKind::Gain ? zero_measured + gain * (simulated[i] - zero_simulated)
        : options.kind == UpdateKind::Arx
            ? simulated[i] + correction * std::exp(-(time_s[i] - corrected_at) / options.slowest_tau_s)
        : kalman ? filter.value(simulated[i] - zero_simulated, context) + zero_simulated
                 : simulated[i];
    run.predicted[i] = options.kind == UpdateKind::Gain && !have_zero ? simulated[i] : before;
    if (kalman) run.sigma[i] = filter.sigma(simulated[i] - zero_simulated, context);
    if (options.kind == UpdateKind::None || time_s[i] < next || !std::isfinite(measured[i])) continue;
    // The row of the measurement itself shows the prediction before it: nothing is judged with its own measurement.
    while (next <= time_s[i]) next += options.interval_s;
    UpdateEvent event;
    event.time_s = time_s[i];
    event.measured = measured[i];
    event.predicted_before = run.predicted[i];
    if (options.kind == UpdateKind::Gain) {
      if (!have_zero) {
        zero_measured = measured[i];
        zero_simulated = simulated[i];
        have_zero = true;
        event.used = false;
      } else {
        const double s = simulated[i] - zero_simulated;
        if (s == 0.0 || std::abs(s) < options.smallest_simulated) {
          event.used = false;
        } else {
          gain = std::clamp((measured[i] - zero_measured) / s, -options.gain_bound, options.gain_bound);
        }
      }
      event.gain = gain;
    } else if (options.kind == UpdateKind::Arx) {
      correction = measured[i] - simulated[i];
      corrected_at = time_s[i];
      event.offset = correction;
    } else {
      event.used = filter.measure(measured[i] - zero_simulated, simulated[i] - zero_simulated, context);
      event.gain = filter.gain();
      event.offset = filter.offset();
      event.gain_sigma = filter.gainSigma();
      event.offset_sigma = filter.offsetSigma();
    }
    run.events.push_back(event);
  }
  return run;
}

std::vector<IntervalPoint> sweepIntervals(std::span<const double> time_s, std::span<const double> measured,
                                          std::span<const double> simulated, const UpdateOptions& options,
                                          const std::vector<double>& intervals_s) {
  std::vector<IntervalPoint> out;
  for (std::size_t k = 0; k <= intervals_s.size(); ++k) {
    UpdateOptions trial = options;
    IntervalPoint point;
    if (k == 0) {
      trial.kind = UpdateKind::None;
      point.interval_s = std::numeric_limits<double>::infinity();
    } else {
      trial.interval_s = point.interval_s = intervals_s[k - 1];
    }
    const UpdateRun run = runWithUpdates(time_s, measured, simulated, trial);
    std::vector<double> m;
    std::vector<double> s;
    std::vector<double> d;
    for (std::size_t i = 0; i < time_s.size(); ++i) {
      if (time_s[i] < options.start_s || !std::isfinite(measured[i])) continue;
      m.push_back(measured[i]);
      s.push_back(run.predicted[i]);
      d.push_back(measured[i] - run.predicted[i]);
    }
    point.fit_percent = fitPercent(m, s);
    point.p2p = peakToPeak(d);
    point.rms = rootMeanSquare(d);
    point.measurements = run.events.size();
    out.push_back(point);
  }
  return out;
}

}  // namespace spindrift
