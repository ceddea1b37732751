// SPDX-License-Identifier: Apache-2.0
// The control LinuxCNC, 2.9: commands and state over linuxcncrsh (its one client), signals and the compensation through
// a halcmd child on the same computer, touches from the file that programmes print into. Nothing of it is linked.
//
// What it has to survive: ACK means accepted and the cause of a refusal is only in `get error`; a programme is over
// when it was RUNNING and is IDLE; a machine that is switched off keeps the hidden compensation; a control that was
// killed still answers for a while through its old shell. So HAL is asked for a beat of its own with every state.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/connect/hal_commands.h"
#include "core/connect/linuxcnc_shell.h"
#include "core/control/control_configuration.h"
#include "core/control/machine_control.h"

namespace spindrift {

struct LinuxcncControlOptions {
  LinuxcncShell::Options shell;
  std::string enable_password = "EMCTOO";  ///< of `set enable`, that of a fresh installation; never shown
  std::filesystem::path folder;  ///< where its configuration lies, programmes are put and printed text appears
  double answer_s = 5.0;
  // What the start-up check allows the control to allow.
  double largest_limit_mm = 0.5;
  double largest_speed_mm_s = 0.1;
  double largest_watchdog_s = 10.0;
};

class LinuxcncControl final : public MachineControl {
 public:
  explicit LinuxcncControl(LinuxcncControlOptions options);

  [[nodiscard]] std::string name() const override { return shell_.name(); }
  void connect(const std::stop_token& stop) override;
  void close() noexcept override;
  [[nodiscard]] std::vector<ControlFinding> check() override;
  [[nodiscard]] ControlState state() noexcept override;
  void switchOn(bool confirmed) override;
  void start(const ApprovedProgram& program) override;
  void abort() override;
  [[nodiscard]] std::vector<std::string> messages() override { return shell_.errors(); }
  [[nodiscard]] std::vector<std::string> printed() override;
  [[nodiscard]] std::vector<std::optional<double>> signals(const std::vector<std::string>& names) override;
  void openChannel(bool hold_when_silent) override;
  void holdWhenSilent(bool hold) override;
  CompensationStatus compensate(const Eigen::Vector3d& offset_um) override;
  [[nodiscard]] CompensationStatus compensation() override;

 private:
  [[nodiscard]] std::string ask(const std::string& request);
  void demand(const std::string& command, double patience_s = 0.0);
  void waitFor(const std::string& request, const std::string& answer, double patience_s);

  LinuxcncControlOptions options_;
  LinuxcncShell shell_;
  HalCommands hal_;
  bool beat_ = false;
  std::uintmax_t read_ = 0;  ///< bytes of the printed text that were taken
  bool known_ = false;       ///< from where
  std::string pending_;
  std::vector<std::string> unread_;  ///< of the programme before
  int programs_ = 0;
};

}  // namespace spindrift
