// SPDX-License-Identifier: Apache-2.0
// The control LinuxCNC as a source: positions, switches and state over the network shell linuxcncrsh, everything else
// (speeds, feeds, temperatures) from pins and signals of its HAL. Read only: nothing is enabled, set or moved.
//
// Address of an item: "position.x" (y, z, a, b, c: where the machine is), "command.x" (where it was told to be),
// "joint.0", "flood", "mist", "machine", "estop", "mode", "program_status", "feed_override", "spindle" (OFF, FORWARD,
// REVERSE), "probe"; or "hal:NAME" of a pin or signal, "hal:spindle.0.speed-out". HAL is read on the control's computer
// alone. linuxcncrsh can serve one client: it is left alone where only pins are wanted.
#pragma once

#include <memory>
#include <string>

#include "core/connect/source.h"

namespace spindrift {

struct LinuxcncOptions {
  std::string url;       ///< "linuxcnc://192.168.1.60:5007"
  std::string password;  ///< of linuxcncrsh --connectpw; empty: that of a fresh installation
  double interval_s = 1.0;
  double answer_s = 5.0;
};

/// Throws std::invalid_argument that says what is allowed.
void checkLinuxcncAddress(const std::string& address);

[[nodiscard]] std::unique_ptr<Source> makeLinuxcncSource(const LinuxcncOptions& options);

}  // namespace spindrift
