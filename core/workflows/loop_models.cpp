// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/loop_models.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "core/base/csv.h"
#include "core/base/error.h"
#include "core/base/no_number.h"
#include "core/thermal/response_fit.h"

namespace spindrift {
namespace {

constexpr double memory = 0.7;  // of squares of what a prediction was off: about the last three cycles

std::string nameOf(const LoopTouch& touch) {
  return touch.point + " " + std::string(toString(touch.component));
}

void remember(double& square, int count, double off) {
  square = count == 0 ? off * off : memory * square + (1.0 - memory) * off * off;
}

}  // namespace

LoopModels::LoopModels(const LoopPlan& plan, Say say) : plan_(plan), say_(std::move(say)) {
  if (plan.simulation) twin_.emplace(*plan.simulation);
  columns_.resize(1 + plan.temperatures.size());
  for (const LoopTouch& touch : plan.touches) {
    std::optional<std::string>& first = first_touch_[static_cast<std::size_t>(axisIndex(touch.component))];
    if (!first) first = nameOf(touch);
  }
}

// --- what comes

void LoopModels::drive(double spindle_rpm, double now_s) {
  if (twin_) twin_->advance(spindle_rpm, now_s);
}

void LoopModels::addRow(double time_s, const std::vector<double>& values) {
  SPINDRIFT_ASSERT(values.size() == columns_.size(), "a row of the log has a value for every column");
  times_.push_back(time_s);
  for (std::size_t c = 0; c < columns_.size(); ++c) columns_[c].push_back(values[c]);
  refresh();
  if (times_.size() < 2) return;
  for (auto& [axis, each] : identified_) each.filter.advance(times_.back() - times_[times_.size() - 2]);
}

std::vector<double> LoopModels::lastRow() const {
  SPINDRIFT_ASSERT(!times_.empty(), "the log has a row");
  std::vector<double> out;
  for (const std::vector<double>& column : columns_) out.push_back(column.back());
  return out;
}

std::optional<LoopReading> LoopModels::reading(const std::string& line, double now_s, LoopStage stage) const {
  // "TOUCH point component x y z cx cy cz"
  std::istringstream words(line);
  std::string mark, point, component;
  LoopReading out;
  words >> mark >> point >> component >> out.position_mm.x() >> out.position_mm.y() >> out.position_mm.z() >>
      out.applied_mm.x() >> out.applied_mm.y() >> out.applied_mm.z();
  if (!words || mark != "TOUCH") return std::nullopt;
  out.name = point + " " + component;
  out.time_s = now_s;
  const auto measured = componentFromString(component);
  if (measured && !isRotation(*measured) && begun()) {
    // What the models say now, not when the cycle is over: after the spindle has stopped everything moves fast.
    const int axis = axisIndex(*measured);
    out.by_simulation_um = simulatedNow()[axis];
    if (const auto found = identified_.find(axis); found != identified_.end()) out.by_model_um = found->second.run;
    out.predicted_um = predicted(stage)[axis];
    out.sigma_um = sigma(stage)[axis];
  }
  if (twin_) {
    for (const LoopTouch& touch : plan_.touches) {
      if (nameOf(touch) == out.name)
        out.simulated_um = twin_->deviation_um(touch.target_mm)[axisIndex(touch.component)];
    }
  }
  return out;
}

void LoopModels::take(std::vector<LoopReading> readings, const std::string& state, bool off, LoopCycle& cycle,
                      std::set<int>& again) {
  SPINDRIFT_ASSERT(readings.size() == plan_.touches.size(), "a cycle has a reading for each touch");
  if (!begun()) {
    for (const LoopReading& reading : readings) zero_[reading.name] = reading;
    if (twin_) zero_reference_um_ = twin_->deviation_um(plan_.reference_mm);
  }
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const LoopTouch& touch = plan_.touches[i];
    const int axis = axisIndex(touch.component);
    const LoopReading& now = readings[i];
    const LoopReading& zero = zero_.at(now.name);
    const double with_um = -1e3 * (now.position_mm[axis] - zero.position_mm[axis]);
    const double without_um = with_um - 1e3 * (now.applied_mm[axis] - zero.applied_mm[axis]);
    Observation row;
    row.time_s = now.time_s;
    row.state = state;
    row.point = touch.point;
    row.position_mm = touch.target_mm;
    row.component = touch.component;
    row.value = without_um;
    row.sigma = plan_.touch_sigma_um;
    row.instrument = "probe";
    observations_.rows.push_back(row);
    simulated_.push_back(now.simulated_um - zero.simulated_um);
    if (first_touch_[static_cast<std::size_t>(axis)] != now.name) continue;
    cycle.with_um[axis] = with_um;
    cycle.without_um[axis] = without_um;
    if (cycle.stage != LoopStage::None) {
      cycle.predicted_um[axis] = now.predicted_um;
      cycle.sigma_um[axis] = now.sigma_um;
    }
    if (observations_.rows.size() > readings.size()) judge(axis, now, without_um);
    if (off || cycle.stage == LoopStage::None || std::abs(with_um) <= plan_.action_limit_um) continue;
    say_(fmt::format("{} is off by {:+.1f} µm; action control limit {:g} µm", "XYZ"[axis], with_um,
                     plan_.action_limit_um));
    if (cycle.stage == LoopStage::Identified) again.insert(axis);
  }
}

Eigen::Vector3d LoopModels::takeShift(const std::vector<LoopReading>& readings) {
  Eigen::Vector3d shift_um = Eigen::Vector3d::Zero();
  if (!begun()) return shift_um;
  for (const LoopReading& now : readings) {
    for (int axis = 0; axis < 3; ++axis) {
      if (first_touch_[static_cast<std::size_t>(axis)] != now.name) continue;
      const LoopReading& zero = zero_.at(now.name);
      const double measured_um =
          -1e3 * (now.position_mm[axis] + now.applied_mm[axis] - zero.position_mm[axis] - zero.applied_mm[axis]);
      const double known_um = std::isfinite(now.sigma_um) ? now.sigma_um : plan_.action_limit_um;
      const double off_um = measured_um - now.predicted_um;
      if (std::abs(off_um) > 3.0 * std::hypot(known_um, plan_.touch_sigma_um)) shift_um[axis] = off_um;
    }
  }
  for (auto& [name, zero] : zero_) zero.position_mm -= 1e-3 * shift_um;
  return shift_um;
}

// --- models

void LoopModels::judge(int axis, const LoopReading& told, double measured_um) {
  Trust& trust = trusted_[static_cast<std::size_t>(axis)];
  if (twin_) remember(trust.simulation_um2, trust.judged++, measured_um - told.by_simulation_um);
  const auto found = identified_.find(axis);
  if (found == identified_.end()) return;
  Identified& each = found->second;
  remember(trust.model_um2, trust.cycles++, measured_um - each.filter.value(told.by_model_um));
  // That one compensates the axis which has predicted better.
  const bool better = !twin_ || (trust.cycles >= 2 && trust.model_um2 < trust.simulation_um2);
  if (better != trust.identified) {
    trust.identified = better;
    say_(fmt::format("{} is compensated by the {}: {:.1f} µm off against {:.1f} µm", "XYZ"[axis],
                     better ? "identified model" : "simulation",
                     std::sqrt(better ? trust.model_um2 : trust.simulation_um2),
                     std::sqrt(better ? trust.simulation_um2 : trust.model_um2)));
  }
  const double off_um = measured_um - each.filter.value(told.by_model_um);
  if (!each.filter.measure(measured_um, told.by_model_um, {}, modelSigma(each))) {
    say_(fmt::format(
        "{} measured {:+.1f} µm off the prediction, far beyond its uncertainty: used if the next cycle confirms it",
        "XYZ"[axis], off_um));
    return;
  }
  each.told = each.features;
}

void LoopModels::add(const std::filesystem::path& model_file) {
  effect_file_ = model_file;
  refresh();
  // What the completed simulation was off at the cycles that are there: the old one's errors are not its own.
  for (Trust& trust : trusted_) trust.judged = 0;
  for (std::size_t i = plan_.touches.size(); i < observations_.rows.size(); ++i) {
    const Observation& o = observations_.rows[i];
    const auto axis = static_cast<std::size_t>(axisIndex(o.component));
    if (first_touch_[axis] != o.point + " " + std::string(toString(o.component))) continue;
    Trust& trust = trusted_[axis];
    remember(trust.simulation_um2, trust.judged++,
             o.value - simulated_[i] - effectAt(o.time_s, static_cast<int>(axis)));
  }
}

void LoopModels::identify(int axis, const JobContext& job) {
  TimeSeries known = series();
  std::vector<double> measured(times_.size(), no_number);
  for (const Observation& o : observations_.rows) {
    if (axisIndex(o.component) != axis ||
        first_touch_[static_cast<std::size_t>(axis)] != o.point + " " + std::string(toString(o.component)))
      continue;
    const auto after = std::lower_bound(times_.begin(), times_.end(), o.time_s);
    const auto row = std::min<std::ptrdiff_t>(after - times_.begin(), static_cast<std::ptrdiff_t>(times_.size()) - 1);
    measured[static_cast<std::size_t>(row)] = o.value;
  }
  const std::string name = fmt::format("e{}_um", "xyz"[axis]);
  const std::string_view component = toString(static_cast<Component>(axis));
  known.signals.push_back({name, SignalKind::Displacement, measured});
  std::vector<std::string> inputs{"spindle_rpm"};
  inputs.insert(inputs.end(), plan_.temperatures.begin(), plan_.temperatures.end());
  ResponseFitOptions options;
  options.period_s = row_s;
  options.strengths = {0.5};
  options.slow_preferences = {0.25};
  options.minimum_samples = least_cycles;
  ResponseFitResult fit;
  try {
    fit = fitResponse(known, name, inputs, -1e300, 1e300, options, job);
  } catch (const InputError& few) {
    fit.message = few.what();
  }
  if (fit.status != FitStatus::Converged) {
    say_(fmt::format("no model of {} yet: {}", component, fit.message));
    return;
  }
  const bool first = !identified_.contains(axis);
  const double left_um = fit.model.outputs.front().noise_sigma;
  identified_.insert_or_assign(axis, identifiedFrom(fit.model, left_um));
  if (first) trusted_[static_cast<std::size_t>(axis)].identified = !twin_;
  say_(fmt::format("model of {} identified from {} cycles; {:.2f} µm off where it was not trained", component,
                   observations_.rows.size() / plan_.touches.size(), fit.left_out_rms));
}

LoopModels::Identified LoopModels::identifiedFrom(ThermalModel model, double left_um) const {
  UpdateOptions update;
  update.measurement_sigma = plan_.touch_sigma_um;
  update.offset_sigma = std::max(left_um, 1.0);
  update.offset_tau_s = 4.0 * 3600.0;
  update.gain_sigma = 0.1;
  update.gain_drift_per_sqrt_h = 0.02;
  Identified out{std::move(model), GainOffsetFilter(update), 0.0, {}, {}};
  out.refresh(series());
  out.told = out.features;
  return out;
}

void LoopModels::Identified::refresh(const TimeSeries& series) {
  run = model.predict(series, 0).value.back();
  features = model.features(series, 0).bottomRows(1).transpose();
}

Eigen::Vector3d LoopModels::predicted(LoopStage stage) const {
  if (!begun() || stage == LoopStage::None) return Eigen::Vector3d::Zero();
  Eigen::Vector3d out = simulatedNow();
  if (stage != LoopStage::Identified) return out;
  for (const auto& [axis, each] : identified_) {
    if (trusted_[static_cast<std::size_t>(axis)].identified) out[axis] = each.filter.value(each.run);
  }
  return out;
}

Eigen::Vector3d LoopModels::sigma(LoopStage stage) const {
  Eigen::Vector3d out = Eigen::Vector3d::Constant(no_number);
  if (!begun() || stage == LoopStage::None) return out;
  for (int axis = 0; axis < 3; ++axis) {
    const Trust& trust = trusted_[static_cast<std::size_t>(axis)];
    const auto found = identified_.find(axis);
    if (stage == LoopStage::Identified && trust.identified && found != identified_.end()) {
      out[axis] = identifiedSigma(found->second);
    } else if (twin_ && trust.judged > 0) {
      out[axis] = std::sqrt(trust.simulation_um2);
    }
  }
  return out;
}

double LoopModels::identifiedSigma(const Identified& each) const {
  return std::hypot(each.filter.sigma(each.run), modelSigma(each));
}

double LoopModels::modelSigma(const Identified& each) {
  const ThermalOutput& output = each.model.outputs.front();
  const Eigen::VectorXd change = each.features - each.told;
  if (output.covariance.rows() != change.size()) return 0.0;
  return std::abs(each.filter.gain()) * output.uncertainty_factor *
         std::sqrt(std::max(0.0, change.dot(output.covariance * change)));
}

Eigen::Vector3d LoopModels::simulatedNow() const {
  if (!twin_) return Eigen::Vector3d::Zero();
  return twin_->deviation_um(plan_.reference_mm) - zero_reference_um_ + effect_um_;
}

double LoopModels::effectAt(double time_s, int axis) const {
  if (!effects_) return 0.0;
  DeviationQuery from, to;
  from.time_s = observations_.rows.front().time_s;
  to.time_s = time_s;
  from.position_mm = to.position_mm = plan_.reference_mm;
  const auto component = static_cast<Component>(axis);
  return effects_->predict(to, component).value - effects_->predict(from, component).value;
}

/// What the log says now, for models that are slow to ask.
void LoopModels::refresh() {
  if (effect_file_ && times_.size() > 2) {
    const OperatingLog now = log();
    effects_ = EffectModel::read(*effect_file_, plan_.machine, &now, observations_.points());
    for (int axis = 0; axis < 3; ++axis) effect_um_[axis] = effectAt(times_.back(), axis);
  }
  if (identified_.empty()) return;
  const TimeSeries now = series();
  for (auto& [axis, each] : identified_) each.refresh(now);
}

OperatingLog LoopModels::log() const {
  OperatingLog out(times_);
  out.setSignal("spindle_rpm", columns_[0]);
  for (std::size_t c = 0; c < plan_.temperatures.size(); ++c) out.setSignal(plan_.temperatures[c], columns_[c + 1]);
  return out;
}

TimeSeries LoopModels::series() const {
  TimeSeries out;
  out.time_s = times_;
  out.signals.push_back({"spindle_rpm", SignalKind::Speed, columns_[0]});
  for (std::size_t c = 0; c < plan_.temperatures.size(); ++c)
    out.signals.push_back({plan_.temperatures[c], SignalKind::Temperature, columns_[c + 1]});
  return out;
}

DiscrepancyInput LoopModels::discrepancyInput() const {
  DiscrepancyInput input;
  input.machine = plan_.machine;
  input.log = log();
  input.observations = observations_;
  input.predicted = simulated_;
  return input;
}

std::string LoopModels::simulationTable() const {
  std::string table = "time_s,point,component,predicted\n";
  for (std::size_t i = 0; i < simulated_.size(); ++i) {
    const Observation& o = observations_.rows[i];
    table += fmt::format("{:.1f},{},{},{:.4f}\n", o.time_s, csvField(o.point), toString(o.component), simulated_[i]);
  }
  return table;
}

}  // namespace spindrift
