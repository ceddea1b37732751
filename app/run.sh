#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing, builds and starts the desktop program on the demo session of the virtual machine. Without a
# display the same guided work runs on the offscreen platform; pictures and report are in build/tour.
# With --closed-loop: measured, named, compensated and proven on a real control (LinuxCNC) beside a virtual machine, in
# six minutes, as root; report in build/closed-loop.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [ "${1:-}" = --closed-loop ]; then
  shift
  targets=(spindrift-cli)
  extra_packages=(linuxcnc-uspace)
  . resources/setup.sh
  exec build/bin/spindrift-cli loop --demo --out build/closed-loop "$@"
fi
targets=(spindrift spindrift-cli)
. resources/setup.sh
if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
  exec build/bin/spindrift --demo "$@"
fi
QT_QPA_PLATFORM=offscreen build/bin/spindrift --tour build/tour "$@"
echo "No display: the guided tour ran off-screen. Pictures and report: build/tour"
