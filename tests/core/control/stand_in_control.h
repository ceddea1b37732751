// SPDX-License-Identifier: GPL-3.0-or-later
// A control that is none, for tests of what stands on MachineControl: a machine with a spindle that warms up in faster
// time, programmes that take a while, touches with the deviation of the moment, a watchdog that fades what nobody
// writes. The machine goes on while no control is connected with it. What an operator does, a test does to the machine.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <mutex>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/control/machine_control.h"

namespace spindrift::testing {

class StandInMachine {
 public:
  using Deviation = std::function<Eigen::Vector3d(double warmth, const Eigen::Vector3d& place_mm)>;
  /// `factor`: machine seconds per second. `deviation`: um, of a warmth of 0 ... 1.
  StandInMachine(double factor, Deviation deviation) : factor_(factor), deviation_um_(std::move(deviation)) {}

  /// Is told the spindle's speed and the time, before anything is asked; knows the temperatures (signal names).
  void onLive(std::function<void(double rpm, double time_s)> told,
              std::function<double(const std::string& column)> temperature_degC) {
    told_ = std::move(told);
    temperature_degC_ = std::move(temperature_degC);
  }

  // What an operator or an accident does.
  void set(ControlState::Condition condition) {
    const std::scoped_lock lock(mutex_);
    condition_ = condition;
  }
  void changeTool(int tool) {
    const std::scoped_lock lock(mutex_);
    tool_ = tool;
  }
  /// The zero of the axes is where it was, off by this.
  void home(const Eigen::Vector3d& shift_mm) {
    const std::scoped_lock lock(mutex_);
    home_mm_ += shift_mm;
  }
  void runOtherProgram(bool runs) {
    const std::scoped_lock lock(mutex_);
    other_ = runs;
  }
  [[nodiscard]] Eigen::Vector3d applied_um() {
    const std::scoped_lock lock(mutex_);
    live();
    return applied_um_;
  }
  [[nodiscard]] Eigen::Vector3d trueDeviation_um(const Eigen::Vector3d& place_mm) {
    const std::scoped_lock lock(mutex_);
    live();
    return deviation_um_(warmth_, place_mm);
  }
  [[nodiscard]] double time_s() {
    const std::scoped_lock lock(mutex_);
    live();
    return time_s_;
  }
  [[nodiscard]] int aborts() {
    const std::scoped_lock lock(mutex_);
    return aborts_;
  }

 private:
  friend class StandInControl;
  static double steadyNow() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
  /// Heat, programme and watchdog up to now.
  void live() {
    const double now = steadyNow();
    const double dt_s = (now - looked_) * factor_;
    looked_ = now;
    time_s_ += dt_s;
    if (told_) told_(rpm_, time_s_);
    constexpr double tau_s = 1500.0, full_rpm = 6000.0;
    warmth_ += (rpm_ / full_rpm - warmth_) * (1.0 - std::exp(-dt_s / tau_s));
    if (running_ && now >= ends_) {
      running_ = false;
      rpm_ = 0.0;
    }
    if (watched_ && now - heard_ > 1.0) watched_ = false;
    if (!watched_ && !hold_) {
      const double most = 50.0 * std::max(0.0, now - faded_);
      for (int axis = 0; axis < 3; ++axis) applied_um_[axis] -= std::clamp(applied_um_[axis], -most, most);
    }
    faded_ = now;
  }

  std::mutex mutex_;
  double factor_;
  Deviation deviation_um_;
  std::function<void(double, double)> told_;
  std::function<double(const std::string&)> temperature_degC_;
  double looked_ = steadyNow();
  double time_s_ = 1.0;
  double warmth_ = 0.0;
  double rpm_ = 0.0;
  bool running_ = false;
  bool other_ = false;
  double ends_ = 0.0;
  int aborts_ = 0;
  int tool_ = 1;
  Eigen::Vector3d home_mm_ = Eigen::Vector3d::Zero();
  ControlState::Condition condition_ = ControlState::Condition::Ready;
  bool watched_ = false, hold_ = false;
  double heard_ = 0.0, faded_ = 0.0;
  Eigen::Vector3d applied_um_ = Eigen::Vector3d::Zero();
  std::vector<std::string> printed_;
};

class StandInControl final : public MachineControl {
 public:
  explicit StandInControl(StandInMachine& machine) : m_(machine) {}

  [[nodiscard]] std::string name() const override { return "stand-in"; }
  void connect(const std::stop_token&) override {
    const std::scoped_lock lock(m_.mutex_);
    if (m_.condition_ == ControlState::Condition::Unreachable) throw ConnectionError("nobody answers");
    m_.printed_.clear();
  }
  void close() noexcept override {}
  [[nodiscard]] std::vector<ControlFinding> check() override { return {{"watchdog", true, "1 s"}}; }
  [[nodiscard]] ControlState state() noexcept override {
    using Condition = ControlState::Condition;
    const std::scoped_lock lock(m_.mutex_);
    m_.live();
    ControlState out;
    out.condition = m_.condition_;
    if (out.condition == Condition::Ready && (m_.running_ || m_.other_)) out.condition = Condition::Busy;
    out.sentence = out.condition == Condition::Ready           ? "Ready."
                   : out.condition == Condition::Busy          ? "A program is running."
                   : out.condition == Condition::EmergencyStop ? "The control is in emergency stop."
                   : out.condition == Condition::Unreachable   ? "nobody answers"
                                                               : "The machine is off: switch it on.";
    out.homed = true;
    out.tool = m_.tool_;
    out.home_mm = m_.home_mm_;
    return out;
  }
  void switchOn(bool confirmed) override {
    if (!confirmed) throw InputError("The machine is not switched on: it was not confirmed.");
  }
  void start(const ApprovedProgram& program) override {
    const std::scoped_lock lock(m_.mutex_);
    m_.live();
    if (m_.running_ || m_.other_) throw InputError("busy");
    m_.running_ = true;
    m_.rpm_ = program.run().largest_rpm;
    m_.ends_ = StandInMachine::steadyNow() + (program.run().touches > 0 ? 0.15 : 1e6);
    // What a measuring programme prints: the moves that probe, in their order, each with its (LOG,TOUCH ...).
    std::vector<DryMove> probing;
    for (const DryMove& move : program.run().moves) {
      if (move.probing) probing.push_back(move);
    }
    std::istringstream lines(program.text());
    std::size_t next = 0;
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("(LOG,TOUCH ") || next >= probing.size()) continue;
      const DryMove& move = probing[next++];
      std::istringstream words(line.substr(5));
      std::string mark, point, component;
      words >> mark >> point >> component;
      const Eigen::Vector3d with_mm = 1e-3 * (m_.deviation_um_(m_.warmth_, move.to_mm) + m_.applied_um_);
      const Eigen::Vector3d at = move.to_mm - with_mm - m_.home_mm_, c = 1e-3 * m_.applied_um_;
      std::ostringstream out;
      out.precision(9);
      out << mark << ' ' << point << ' ' << component << ' ' << at.x() << ' ' << at.y() << ' ' << at.z() << ' ' << c.x()
          << ' ' << c.y() << ' ' << c.z();
      m_.printed_.push_back(out.str());
    }
  }
  void abort() override {
    const std::scoped_lock lock(m_.mutex_);
    m_.live();
    ++m_.aborts_;
    m_.running_ = m_.other_ = false;
    m_.rpm_ = 0.0;
  }
  [[nodiscard]] std::vector<std::string> messages() override { return {}; }
  [[nodiscard]] std::vector<std::string> printed() override {
    const std::scoped_lock lock(m_.mutex_);
    return std::exchange(m_.printed_, {});
  }
  [[nodiscard]] std::vector<std::optional<double>> signals(const std::vector<std::string>& names) override {
    const std::scoped_lock lock(m_.mutex_);
    m_.live();
    if (m_.condition_ == ControlState::Condition::Unreachable) throw ConnectionError("nobody answers");
    std::vector<std::optional<double>> out;
    for (const std::string& name : names) {
      if (name == "machine-time") {
        out.emplace_back(m_.time_s_);
      } else if (name == "spindle.0.speed-out") {
        out.emplace_back(m_.rpm_);
      } else if (m_.temperature_degC_) {
        std::string column = name;  // as temperatureSignal() made it
        std::replace(column.begin(), column.end(), '-', '_');
        out.emplace_back(m_.temperature_degC_(column));
      } else {
        out.emplace_back(20.0 + 12.0 * m_.warmth_);
      }
    }
    return out;
  }
  void openChannel(bool hold_when_silent) override {
    const std::scoped_lock lock(m_.mutex_);
    m_.live();
    m_.hold_ = hold_when_silent;
    m_.watched_ = true;
    m_.heard_ = StandInMachine::steadyNow();
  }
  void holdWhenSilent(bool hold) override {
    const std::scoped_lock lock(m_.mutex_);
    m_.hold_ = hold;
  }
  CompensationStatus compensate(const Eigen::Vector3d& offset_um) override {
    {
      const std::scoped_lock lock(m_.mutex_);
      m_.live();
      if (m_.condition_ == ControlState::Condition::Unreachable) throw ConnectionError("nobody answers");
      m_.heard_ = StandInMachine::steadyNow();
      if (m_.watched_) m_.applied_um_ = offset_um;
    }
    return compensation();
  }
  [[nodiscard]] CompensationStatus compensation() override {
    const std::scoped_lock lock(m_.mutex_);
    m_.live();
    return {m_.watched_, m_.applied_um_, m_.applied_um_};
  }

 private:
  StandInMachine& m_;
};

}  // namespace spindrift::testing
