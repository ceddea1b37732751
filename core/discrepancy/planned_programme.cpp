// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/planned_programme.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/discrepancy/catalogue.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

using Eigen::Index;

constexpr double log_step_s = 60.0;

/// What the log shows the machine to do.
struct Abilities {
  double spindle_rpm = 0.0;
  std::array<double, 3> feed_mm_min{};
  double c_rpm = 0.0;
  bool coolant = false;
  std::array<double, 3> position_mm{};                          ///< where work usually is
  std::array<std::optional<std::array<double, 2>>, 3> ends_mm;  ///< where it goes, if it moves
};

Abilities abilitiesOf(const DiscrepancyInput& input) {
  Abilities out;
  const OperatingLog& log = *input.log;
  const auto highest = [&](const std::string& name) {
    const std::vector<double>* values = log.signal(name);
    double most = 0.0;
    if (values != nullptr) {
      for (const double v : *values) most = std::isfinite(v) ? std::max(most, std::abs(v)) : most;
    }
    return most;
  };
  out.spindle_rpm = highest("spindle_rpm");
  out.c_rpm = highest("speed_c_rpm");
  out.coolant = highest("coolant") > 0.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::string letter = axis_letters[a];
    out.feed_mm_min[a] = highest(fmt::format("feed_{}_mm_min", letter));
    const std::string upper(1, "XYZ"[a]);
    if (const LinearAxis* axis = input.machine.findAxis(upper)) {
      out.position_mm[a] = 0.5 * (axis->travel_mm[0] + axis->travel_mm[1]);
    }
    if (const std::vector<double>* at = log.signal(fmt::format("pos_{}_mm", letter)); at != nullptr && !at->empty()) {
      out.position_mm[a] = median(*at);
      const auto [low, high] = std::minmax_element(at->begin(), at->end());
      if (*high - *low > 20.0) out.ends_mm[a] = std::array<double, 2>{*low, *high};
    }
  }
  return out;
}

/// One thing that moves.
struct Action {
  std::string name;
  ProgrammeStep step;
};

std::vector<Action> actionsOf(const Abilities& able) {
  std::vector<Action> actions;
  ProgrammeStep rest;
  rest.action = "rest";
  rest.position_mm = able.position_mm;
  for (std::size_t a = 0; a < 3; ++a) {
    if (!(able.feed_mm_min[a] > 0.0)) continue;
    ProgrammeStep s = rest;
    s.feed_mm_min[a] = able.feed_mm_min[a];
    s.action = fmt::format("{} alone at {:g} m/min", "XYZ"[a], able.feed_mm_min[a] * 1e-3);
    actions.push_back({std::string(1, "XYZ"[a]), s});
  }
  if (able.spindle_rpm > 0.0) {
    ProgrammeStep s = rest;
    s.spindle_rpm = able.spindle_rpm;
    s.action = fmt::format("the spindle alone at {:g} rpm", able.spindle_rpm);
    actions.push_back({"spindle", s});
  }
  if (able.c_rpm > 0.0) {
    ProgrammeStep s = rest;
    s.c_rpm = able.c_rpm;
    s.action = fmt::format("C alone at {:g} rpm", able.c_rpm);
    actions.push_back({"C", s});
  }
  if (able.coolant) {
    ProgrammeStep s = rest;
    s.coolant = true;
    s.action = "the coolant alone";
    actions.push_back({"coolant", s});
  }
  return actions;
}

/// Puts steps one after another; times in parts of the whole, rounded to minutes.
class Sequence {
 public:
  Sequence(double whole_s, ProgrammeStep rest) : whole_s_(whole_s), rest_(std::move(rest)) {}
  Sequence& add(ProgrammeStep step, double until_part) {
    const double to = std::max(60.0 * std::round(whole_s_ * until_part / 60.0), at_s_);
    if (!(to > at_s_)) return *this;
    step.from_s = at_s_;
    step.to_s = to;
    at_s_ = to;
    steps_.push_back(std::move(step));
    return *this;
  }
  Sequence& rest(double until_part) { return add(rest_, until_part); }
  [[nodiscard]] PlannedProgramme done() const { return {steps_, false}; }

 private:
  double whole_s_;
  ProgrammeStep rest_;
  double at_s_ = 0.0;
  std::vector<ProgrammeStep> steps_;
};

/// Those of a machine: values at the rows of its log.
std::vector<double> courseAt(const DriverTable& logged, const Driver& driver, const std::vector<double>& times_s) {
  std::vector<double> asked = times_s;
  for (double& t : asked) t = std::min(t + logged.time_s().front(), logged.time_s().back());
  const Eigen::VectorXd values = logged.response(driver, 0.0, -1.0, asked);
  return {values.data(), values.data() + values.size()};
}

bool isRoom(const DriverTable& logged, const std::string& name) {
  const std::vector<std::string> room = logged.temperatures({SensorRole::Room});
  return std::find(room.begin(), room.end(), name) != room.end();
}

constexpr std::array<double, 3> heat_lags_s{600.0, 2400.0, 9000.0};
constexpr std::array<double, 3> room_lags_s{0.0, 1800.0, 7200.0};

}  // namespace

std::vector<PlannedProgramme> possibleProgrammes(const DiscrepancyInput& input, const ProgrammeQuestion& question) {
  std::vector<PlannedProgramme> out;
  if (!input.log || input.log->empty()) return out;
  const Abilities able = abilitiesOf(input);
  const std::vector<Action> actions = actionsOf(able);
  const double whole_s = 3600.0 * question.hours;
  ProgrammeStep rest;
  rest.action = "rest";
  rest.position_mm = able.position_mm;
  const auto sequence = [&] { return Sequence(whole_s, rest); };
  out.push_back(sequence().rest(1.0).done());
  ProgrammeStep again = rest;
  again.action = "the program of the log again";
  again.as_logged = true;
  out.push_back(sequence().add(again, 1.0).done());
  for (const Action& a : actions) {
    for (const double part : {0.25, 0.5, 0.75}) out.push_back(sequence().add(a.step, part).rest(1.0).done());
    Sequence cycles = sequence();
    for (int k = 0; k < 4; ++k) cycles.add(a.step, 0.25 * k + 0.125).rest(0.25 * (k + 1));
    out.push_back(cycles.done());
  }
  for (std::size_t i = 0; i < actions.size(); ++i) {
    for (std::size_t j = i + 1; j < actions.size(); ++j) {
      out.push_back(sequence().add(actions[i].step, 0.3).rest(0.5).add(actions[j].step, 0.8).rest(1.0).done());
    }
  }
  if (actions.size() > 2) {
    Sequence each = sequence();
    const double part = 1.0 / static_cast<double>(actions.size());
    for (std::size_t i = 0; i < actions.size(); ++i) {
      const double from = part * static_cast<double>(i);
      each.add(actions[i].step, from + 0.65 * part).rest(from + part);
    }
    out.push_back(each.done());
  }
  if (question.positions && able.spindle_rpm > 0.0) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (!able.ends_mm[a]) continue;
      ProgrammeStep near = rest;
      near.spindle_rpm = able.spindle_rpm;
      ProgrammeStep far = near;
      near.position_mm[a] = (*able.ends_mm[a])[0];
      far.position_mm[a] = (*able.ends_mm[a])[1];
      for (ProgrammeStep* s : {&near, &far}) {
        s->action = fmt::format("the spindle alone at {:g} rpm with {} at {:.0f} mm", able.spindle_rpm, "XYZ"[a],
                                s -> position_mm[a]);
      }
      out.push_back(sequence().add(near, 0.35).rest(0.6).add(far, 0.9).rest(1.0).done());
    }
  }
  if (question.instrument) {
    const std::size_t count = out.size();
    for (std::size_t i = 0; i < count; ++i) {
      out.push_back(out[i]);
      out.back().restart_instrument = true;
    }
  }
  return out;
}

SensorResponses::SensorResponses(const DriverTable& logged) : logged_(&logged) {
  if (logged.empty()) return;
  constexpr std::size_t most_rows = 480;
  const std::vector<double>& all = logged.time_s();
  std::vector<double> times;
  const std::size_t stride = std::max<std::size_t>(1, all.size() / most_rows);
  for (std::size_t i = 0; i < all.size(); i += stride) times.push_back(all[i]);
  const auto n = static_cast<Index>(times.size());
  std::vector<Column> columns;
  for (const char* name : {"spindle_rpm^1.5", "feed_x", "feed_y", "feed_z", "speed_c", "coolant"}) {
    if (!logged.has(name)) continue;
    for (const double tau : heat_lags_s) columns.push_back({name, tau, 0.0});
  }
  const std::vector<std::string> rooms = logged.temperatures({SensorRole::Room});
  if (!rooms.empty()) {
    for (const double tau : room_lags_s) columns.push_back({rooms.front(), tau, 0.0});
  }
  const auto used = static_cast<Index>(columns.size());
  // What was warm at the start, and a room that no sensor shows: fitted beside, not predicted.
  const Index beside = rooms.empty() ? 6 : 3;
  Eigen::MatrixXd x(n, used + beside);
  for (Index c = 0; c < used; ++c) {
    const Column& column = columns[static_cast<std::size_t>(c)];
    x.col(c) = logged.response(*logged.find(column.driver), column.tau_s, -1.0, times);
  }
  const double span = std::max(1.0, times.back() - times.front());
  for (Index r = 0; r < n; ++r) {
    const double since = times[static_cast<std::size_t>(r)] - times.front();
    x(r, used) = 1.0;
    x(r, used + 1) = std::exp(-since / 1800.0);
    x(r, used + 2) = std::exp(-since / 7200.0);
    for (Index k = 3; k < beside; ++k) x(r, used + k) = std::pow(since / span, static_cast<double>(k - 2));
  }
  const Eigen::VectorXd size = x.colwise().norm() / std::sqrt(static_cast<double>(n));
  Eigen::VectorXd inverse(size.size());
  for (Index c = 0; c < size.size(); ++c) inverse[c] = size[c] > 0.0 ? 1.0 / size[c] : 0.0;
  const Eigen::MatrixXd scaled = x * inverse.asDiagonal();
  Eigen::MatrixXd normal = scaled.transpose() * scaled;
  constexpr double ridge = 1e-3;
  normal.diagonal().array() += ridge * static_cast<double>(n);
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(normal);
  for (const std::string& name : logged.temperatures()) {
    if (isRoom(logged, name)) continue;
    const Eigen::VectorXd y = logged.response(*logged.find(name), 0.0, -1.0, times);
    const Eigen::VectorXd gains = inverse.cwiseProduct(ldlt.solve(scaled.transpose() * y));
    Sensor sensor{name, columns};
    for (Index c = 0; c < used; ++c) sensor.columns[static_cast<std::size_t>(c)].gain = gains[c];
    sensors_.push_back(std::move(sensor));
  }
}

Eigen::VectorXd SensorResponses::predict(const Driver& sensor, const DriverTable& motion,
                                         const std::vector<double>& times_s) const {
  const auto n = static_cast<Index>(times_s.size());
  Eigen::VectorXd out = Eigen::VectorXd::Zero(n);
  const auto found =
      std::find_if(sensors_.begin(), sensors_.end(), [&](const Sensor& s) { return s.name == sensor.name; });
  if (found == sensors_.end()) {
    const std::vector<double> course = courseAt(*logged_, sensor, times_s);
    return Eigen::Map<const Eigen::VectorXd>(course.data(), n).array() - course.front();
  }
  for (const Column& column : found->columns) {
    const Driver* driver = motion.find(column.driver);
    if (driver != nullptr) {
      out += column.gain * motion.response(*driver, column.tau_s, -1.0, times_s);
    } else if (isRoom(*logged_, column.driver)) {
      // The night has brought the machine to the temperature of the room.
      std::vector<double> asked = times_s;
      for (double& t : asked) t = std::min(t + logged_->time_s().front(), logged_->time_s().back());
      out += column.gain * logged_->response(*logged_->find(column.driver), column.tau_s, -1.0, asked);
    }
  }
  return out.array() - out[0];
}

DriverTable plannedDrivers(const DiscrepancyInput& input, const DriverTable& logged, const SensorResponses& sensors,
                           const PlannedProgramme& programme) {
  std::vector<double> times;
  for (double t = 0.0; t < programme.steps.back().to_s + log_step_s; t += log_step_s) times.push_back(t);
  const OperatingLog& old = *input.log;
  const double begin = old.time_s().front();
  const double last = old.time_s().back();
  const auto stepAt = [&](double t) -> const ProgrammeStep& {
    for (const ProgrammeStep& s : programme.steps) {
      if (t < s.to_s) return s;
    }
    return programme.steps.back();
  };
  OperatingLog log(times);
  const auto set = [&](const std::string& name, auto&& value) {
    if (!old.has(name)) return;
    std::vector<double> values;
    values.reserve(times.size());
    for (const double t : times) {
      const ProgrammeStep& s = stepAt(t);
      values.push_back(s.as_logged ? old.at(name, std::min(begin + t, last)) : value(s));
    }
    log.setSignal(name, std::move(values));
  };
  set("spindle_rpm", [](const ProgrammeStep& s) { return s.spindle_rpm; });
  set("speed_c_rpm", [](const ProgrammeStep& s) { return s.c_rpm; });
  set("coolant", [](const ProgrammeStep& s) { return s.coolant ? 1.0 : 0.0; });
  for (std::size_t a = 0; a < 3; ++a) {
    set(fmt::format("feed_{}_mm_min", axis_letters[a]), [a](const ProgrammeStep& s) { return s.feed_mm_min[a]; });
    const std::string position = fmt::format("pos_{}_mm", axis_letters[a]);
    set(position, [a](const ProgrammeStep& s) { return s.position_mm[a]; });
    // A position that never changes is no driver of its own; heat at that place still is.
    if (const std::vector<double>* values = log.signal(position)) {
      std::vector<double> moved = *values;
      moved.back() += 1e-3;
      log.setSignal(position, std::move(moved));
    }
  }
  // An instrument that stays on has been warm for long: only switching it on anew moves anything.
  log.setSignal("instrument_on", std::vector<double>(times.size(), programme.restart_instrument ? 1.0 : 0.0));
  const std::vector<std::string> temperatures = logged.temperatures();
  if (temperatures.empty()) return DriverTable(input.machine, &log);
  const bool repeats =
      std::any_of(programme.steps.begin(), programme.steps.end(), [](const ProgrammeStep& s) { return s.as_logged; });
  std::optional<DriverTable> motion;
  if (!repeats) motion.emplace(input.machine, &log);
  for (const std::string& name : temperatures) {
    const Driver& sensor = *logged.find(name);
    std::vector<double> values(times.size());
    if (repeats || isRoom(logged, name)) {
      values = courseAt(logged, sensor, times);
    } else {
      const Eigen::VectorXd predicted = sensors.predict(sensor, *motion, times);
      values.assign(predicted.data(), predicted.data() + predicted.size());
    }
    log.setSignal(name, std::move(values));
  }
  return DriverTable(input.machine, &log);
}

Eigen::MatrixXd plannedResponses(const DriverTable& planned, const EffectVariant& variant,
                                 const std::vector<double>& parameters, const std::vector<double>& times_s) {
  const auto rows = static_cast<Index>(times_s.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(rows, static_cast<Index>(variant.inputs.size()));
  std::size_t next = 0;
  for (std::size_t i = 0; i < variant.inputs.size(); ++i) {
    const EffectInput& input = variant.inputs[i];
    auto column = out.col(static_cast<Index>(i));
    const std::string name = input.driver == assumed_instrument ? "instrument_on" : input.driver;
    const Driver* driver = name.empty() ? nullptr : planned.find(name);
    const std::size_t at = variant.shared_lag ? 0 : next;
    switch (input.dynamics) {
      case Dynamics::None:
        if (name.empty()) column.setOnes();
        if (driver != nullptr) column = planned.response(*driver, 0.0, -1.0, times_s);
        break;
      case Dynamics::Lag:
        if (driver != nullptr) column = planned.response(*driver, parameters[at], -1.0, times_s);
        if (!variant.shared_lag) ++next;
        break;
      case Dynamics::AsymmetricLag:
        if (driver != nullptr) column = planned.response(*driver, parameters[at], parameters[at + 1], times_s);
        if (!variant.shared_lag) next += 2;
        break;
      case Dynamics::Start:
        if (!variant.shared_lag) ++next;
        break;
      case Dynamics::Step:
        ++next;
        break;
      case Dynamics::Pulse:
        next += 3;
        break;
    }
  }
  return out;
}

}  // namespace spindrift
