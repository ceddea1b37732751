// SPDX-License-Identifier: GPL-3.0-or-later
// A machine and a real control for it, in namespaces of its own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "core/base/json_reader.h"
#include "core/control/control_configuration.h"
#include "core/control/linuxcnc_control.h"
#include "core/control/private_control.h"
#include "tests/core/connect/collected.h"
#include "tests/core/control/on_private_control.h"

namespace spindrift::testing {

inline MachineDescription threeAxisMill() {
  return MachineDescription::parse(JsonNode::parse(R"({"format":"spindrift-machine","version":1,"name":"mill",
    "chain":"V [w-Y'-X'-b-Z-(C)-t]","axes":[{"name":"X","travel_mm":[0,300]},{"name":"Y","travel_mm":[0,200]},
    {"name":"Z","travel_mm":[-250,0]}],"spindle":{"axis":"Z","max_rpm":6000}})",
                                                   "machine.json"),
                                   "machine.json");
}

inline ControlConfiguration cornerInTheMiddle() {
  ControlConfiguration c;
  c.corner_mm = {150.0, 100.0, -100.0};
  c.temperatures = {"T_spindle_degC"};
  return c;
}

/// A control that runs, and a driver of it that is connected.
struct RunningControl {
  explicit RunningControl(const ControlConfiguration& configuration = cornerInTheMiddle(),
                          const std::function<void(const std::filesystem::path&)>& also = {})
      : folder("/tmp/control") {
    std::filesystem::create_directories(folder);
    writeControlConfiguration(threeAxisMill(), configuration, folder);
    if (also) also(folder);
    start();
  }
  void start() {
    process = std::make_unique<LinuxcncProcess>(folder);
    LinuxcncControlOptions options;
    options.folder = folder;
    control = std::make_unique<LinuxcncControl>(options);
    const bool there = waitUntil(
        [&] {
          try {
            control->connect({});
            return true;
          } catch (const ConnectionError&) {
            return false;
          }
        },
        20.0);
    if (!there) throw InputError("The control does not start.");
  }
  ApprovedProgram approved(const std::string& text) {
    return ApprovedProgram::approve(text, threeAxisMill(), control->state().position_mm,
                                    [](const DryRun&) { return true; });
  }
  /// Runs a programme to its end; what it printed.
  std::vector<std::string> run(const std::string& text) {
    control->start(approved(text));
    if (!waitUntil([&] { return control->state().ready(); }, 60.0)) throw InputError("The programme does not end.");
    return control->printed();
  }

  std::filesystem::path folder;
  std::unique_ptr<LinuxcncProcess> process;
  std::unique_ptr<LinuxcncControl> control;
};

}  // namespace spindrift::testing
