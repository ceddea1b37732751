// SPDX-License-Identifier: Apache-2.0
// A control as the closed loop needs it: state, signals, programmes with what they print, and a channel that takes a
// compensation. One file per make behind this interface (linuxcnc_control.h); FOCAS, TNC or Sinumerik are others.
//
// Nothing moves that was not looked at first: a programme is an ApprovedProgram (program_approval.h), which exists only
// after its dry run stayed inside the travel and the operator said yes. Any call may throw ConnectionError: the control
// is then gone until connect() succeeds again. Positions mm in machine coordinates, compensation um in MCF (to be added
// to what was commanded), time s.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/connect/source.h"
#include "core/control/program_approval.h"

namespace spindrift {

struct ControlState {
  enum class Condition { Unreachable, EmergencyStop, Off, NotHomed, Busy, Ready };
  Condition condition = Condition::Unreachable;
  std::string sentence;  ///< what it is and what to do about it
  bool homed = false;
  int tool = 0;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();  ///< where the control believes to be
  /// Where the drives stand at position zero: another one after homing elsewhere. Its differences matter only.
  Eigen::Vector3d home_mm = Eigen::Vector3d::Zero();
  [[nodiscard]] bool ready() const noexcept { return condition == Condition::Ready; }
};

/// One of the things that are looked at before a control is trusted.
struct ControlFinding {
  std::string what;
  bool good = false;
  std::string sentence;  ///< what was found, and what is allowed where it is not good
};

struct CompensationStatus {
  bool watched = false;                                  ///< the watchdog hears us: the channel is open
  Eigen::Vector3d wanted_um = Eigen::Vector3d::Zero();   ///< as the control holds it
  Eigen::Vector3d applied_um = Eigen::Vector3d::Zero();  ///< what the drives add now
};

class MachineControl {
 public:
  virtual ~MachineControl() = default;
  [[nodiscard]] virtual std::string name() const = 0;

  virtual void connect(const std::stop_token& stop) = 0;
  virtual void close() noexcept = 0;
  /// The start-up check: limits, watchdog, units, what the channel holds. Moves nothing.
  [[nodiscard]] virtual std::vector<ControlFinding> check() = 0;
  /// Never throws: a control that is gone is Unreachable, with the reason.
  [[nodiscard]] virtual ControlState state() noexcept = 0;

  /// Out of emergency stop, on, homed; `confirmed` by the operator. Throws InputError: not confirmed, or the words of
  /// the control why not.
  virtual void switchOn(bool confirmed) = 0;
  /// Starts a programme; returns at once. Throws InputError: not ready, refused, with the words of the control.
  virtual void start(const ApprovedProgram& program) = 0;
  virtual void abort() = 0;
  /// Messages of the control since the last call.
  [[nodiscard]] virtual std::vector<std::string> messages() = 0;
  /// Lines that programmes have printed since the last call, as they come.
  [[nodiscard]] virtual std::vector<std::string> printed() = 0;
  /// Values of signals; nothing where there is none.
  [[nodiscard]] virtual std::vector<std::optional<double>> signals(const std::vector<std::string>& names) = 0;

  /// Opens the channel at the compensation that is applied now, so that nothing steps.
  virtual void openChannel(bool hold_when_silent) = 0;
  /// What the control does when nobody writes any more: hold the compensation, or let it fade to zero.
  virtual void holdWhenSilent(bool hold) = 0;
  /// Wants this compensation and tells the watchdog that somebody is there.
  virtual CompensationStatus compensate(const Eigen::Vector3d& offset_um) = 0;
  [[nodiscard]] virtual CompensationStatus compensation() = 0;
};

}  // namespace spindrift
