// SPDX-License-Identifier: Apache-2.0
// The whole story with one command: a virtual machine with physics beside a real control (LinuxCNC, headless, of its
// own), whose simulation lacks one effect; the loop measures, names it, takes it in, identifies, and the error at the
// control shrinks. The truth is read after the loop has ended, for judging alone.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/job_context.h"
#include "core/workflows/closed_loop.h"

namespace spindrift {

struct LoopDemoOptions {
  std::filesystem::path folder;  ///< new or empty: campaign, loop.json, truth.csv, report.html
  double factor = 80.0;          ///< machine seconds per second
  double hours = 8.0;            ///< of the machine
};

/// True rms of the deviation at the tool point over a stage, um, per component.
struct LoopJudgement {
  std::string stage;
  double from_s = 0.0;
  double to_s = 0.0;
  Eigen::Vector3d without_um = Eigen::Vector3d::Zero();
  Eigen::Vector3d with_um = Eigen::Vector3d::Zero();
};

/// Judges by truth.csv what a loop reached (loop.json).
[[nodiscard]] std::vector<LoopJudgement> judgeLoop(const nlohmann::json& loop, const std::filesystem::path& truth);

/// loop.json with "truth" added. Throws InputError: no LinuxCNC here, no right to namespaces; what the loop says.
[[nodiscard]] nlohmann::json runLoopDemo(const LoopDemoOptions& options);
[[nodiscard]] std::string loopDemoSummary(const nlohmann::json& json);

/// The demonstration as files, to begin a plan of one's own with: plan.json, machine.json, simulation.json, truth.json
/// (of the virtual machine, `virtual-machine`), and in control/ the configuration of a LinuxCNC whose machine's time
/// runs `factor` times faster than the clock. Files of these names are replaced.
void writeLoopExample(const std::filesystem::path& folder, double hours, double factor);

/// The plan and the machine of the demonstration, for tests.
[[nodiscard]] LoopPlan demoPlan(double hours);
[[nodiscard]] Scenario demoTruth(double hours);

}  // namespace spindrift
