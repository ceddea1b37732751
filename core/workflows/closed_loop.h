// SPDX-License-Identifier: Apache-2.0
// Measure, model, compensate, on a control and live (papers P1 and P2, and the mission of Spindrift in one piece).
//
//   programme   spindle speeds over time; measuring cycles between them, by time or because the last one was off
//   cycle       touches of an artefact; deviation e = -(reading - first reading) - (compensation then - at first)
//   simulation  the user's simulation of the machine, driven by what the log says; compensated with from the beginning
//   discrepancy at `discrepancy_s` what was measured is held against it; what is missing is named, the operator adds
//   it,
//               and the compensation takes it in
//   identified  from `identify_s` on models over time, identified on all that was measured (response_fit.h), kept true
//               by every cycle (GainOffsetFilter) and identified again where a cycle is off by more than the action
//               control limit; an axis is compensated by them where they predicted the last cycles better than the
//               simulation did
//
// Times are the machine's (signal machine-time, else the clock's); deviations um relative to the first cycle. Whatever
// the control does (off, emergency stop, killed, restarted) is said and survived: the channel fades, and the loop goes
// on when it is back.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/base/json_reader.h"
#include "core/control/compensation_channel.h"
#include "core/control/linuxcnc_control.h"
#include "core/discrepancy/discrepancy.h"
#include "core/machine/observation.h"
#include "core/simulation/scenario.h"

namespace spindrift {

/// A touch of the measuring cycle: from `before_mm` straight to `target_mm`, which lies behind the surface.
struct LoopTouch {
  std::string point;
  Component component = Component::EZ;
  Eigen::Vector3d before_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_mm = Eigen::Vector3d::Zero();
};

struct LoopSpeed {
  double from_s = 0.0;
  double spindle_rpm = 0.0;
};

struct LoopPlan {
  MachineDescription machine;
  LinuxcncControlOptions control;
  std::vector<std::string> temperatures;  ///< columns; their signals are named as temperatureSignal() says
  std::vector<LoopTouch> touches;         ///< the first of a component stands for the tool point
  double safe_z_mm = 0.0;                 ///< above everything
  double clear_mm = 10.0;                 ///< away from a wall before moving along it
  double feed_mm_min = 60.0;              ///< of a touch
  double touch_sigma_um = 0.35;
  Eigen::Vector3d reference_mm = Eigen::Vector3d::Zero();  ///< tool point that is compensated
  std::vector<LoopSpeed> programme;
  double duration_s = 0.0;
  double measure_every_s = 1200.0;
  double shortest_s = 600.0;     ///< between two cycles, also when one was off
  double action_limit_um = 4.0;  ///< ACL
  double discrepancy_s = 0.0;    ///< 0: the simulation is not held against anything
  double identify_s = 0.0;       ///< 0: no identified models
  ChannelLimits limits;
  bool hold_when_silent = false;
  double patience_s = 60.0;  ///< for a control that went away, s of the clock
  std::optional<Scenario> simulation;

  /// plan.json ("spindrift-loop-plan", version 1): the fields above by their names; "simulation" and "machine" are
  /// files beside it. Throws InputError.
  [[nodiscard]] static LoopPlan read(const std::filesystem::path& file);
  [[nodiscard]] static LoopPlan parse(const JsonNode& root, const std::filesystem::path& file);
  void validate() const;
};

/// Who decides.
struct LoopOperator {
  ApprovedProgram::Confirm confirm;  ///< what would move
  /// Which of the effects that were named are added.
  std::function<std::vector<std::string>(const DiscrepancyResult&)> add;
};

enum class LoopStage { None, Simulation, WithEffect, Identified };
[[nodiscard]] std::string_view toString(LoopStage stage) noexcept;

struct LoopStatus {
  double time_s = 0.0;
  LoopStage stage = LoopStage::None;
  std::string channel;  ///< CompensationChannel::sentence
  std::string control;  ///< ControlState::sentence
  int cycles = 0;
};

struct LoopEvent {
  double time_s = 0.0;
  std::string text;
};

struct LoopCycle {
  double time_s = 0.0;
  LoopStage stage = LoopStage::None;
  std::string why;
  /// Per component X, Y, Z at its first touch: without compensation, and with what was applied; NaN: not touched.
  Eigen::Vector3d without_um = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector3d with_um = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
};

struct LoopResult {
  std::vector<LoopCycle> cycles;
  std::vector<LoopEvent> events;
  std::vector<std::string> effects;  ///< that were added
  std::string verdict;               ///< of the discrepancy
  std::vector<std::pair<double, LoopStage>> stages;
  double largest_step_um = 0.0;
  double largest_rate_um_s = 0.0;
  int losses = 0;  ///< of the control
  bool completed = false;

  /// rms over the cycles of a stage (all with a compensation for None), per component.
  [[nodiscard]] Eigen::Vector3d rmsWithout(LoopStage stage) const;
  [[nodiscard]] Eigen::Vector3d rmsWith(LoopStage stage) const;
  /// Keys of FORMATS.md, and stages, cycles, events.
  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::string summary() const;
  [[nodiscard]] std::string report(const std::string& title) const;  ///< HTML
};

/// Runs to the end of the plan and leaves a campaign in `folder` (new or empty). Throws InputError: the start-up check
/// fails, not confirmed; Cancelled.
[[nodiscard]] LoopResult runClosedLoop(const LoopPlan& plan, MachineControl& control, const LoopOperator& who,
                                       const std::filesystem::path& folder, JobContext& job,
                                       const std::function<void(const LoopStatus&)>& look = {});

/// Programme of one measuring cycle, from above `start_mm`.
[[nodiscard]] std::string measuringProgram(const LoopPlan& plan);

}  // namespace spindrift
