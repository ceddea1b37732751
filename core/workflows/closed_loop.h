// SPDX-License-Identifier: Apache-2.0
// Measure, model, compensate, on a control and live (papers P1 and P2, and the mission of Spindrift in one piece).
//
//   programme   spindle speeds over time; measuring cycles between them, by time or because the last one was off
//   cycle       touches of an artefact; deviation e = -(reading - first reading) - (compensation then - at first)
//   simulation  the user's simulation of the machine, driven by what the log says; compensated with from the beginning
//   discrepancy at `discrepancy_s` what was measured is held against it; what is missing is named, the operator accepts
//               or rejects each name, and the compensation takes in what was accepted
//   identified  from `identify_s` on models over time, identified on all that was measured (response_fit.h), kept true
//               by every cycle (GainOffsetFilter) and identified again where a cycle is off by more than the action
//               control limit; an axis is compensated by them where they predicted the last cycles better than the
//               simulation did
//
// Times are the machine's (signal machine-time, else the clock's); deviations um relative to the first cycle. Whatever
// the control does (off, emergency stop, killed, restarted) is said and survived: the channel fades, and the loop goes
// on when it is back. A loop that was ended in any way goes on in its folder (loop_state.h); meanwhile the control's
// watchdog has faded the compensation, or held it.
//
//   other tool  the compensation goes on, which does not depend on the tool; measuring cycles wait for the tool of the
//               first one
//   homed anew  the compensation is off until a cycle has shown whether the zero has moved; a shift beyond what the
//               models allow is taken out of the reference and said
//   other programme (the operator's)  is never aborted: the loop waits for its end
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/job_context.h"
#include "core/base/json_reader.h"
#include "core/control/compensation_channel.h"
#include "core/control/linuxcnc_control.h"
#include "core/discrepancy/discrepancy.h"
#include "core/machine/observation.h"
#include "core/reporting/report.h"
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

/// Which of the effects that the discrepancy step names are added to the simulation.
struct LoopAcceptance {
  enum class Rule {
    Named,   ///< all that are named without rivals
    Listed,  ///< those of `ids` that are named
    Ask      ///< the operator is asked for each
  };
  Rule rule = Rule::Named;
  std::vector<std::string> ids;
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
  LoopAcceptance accept;
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

/// What the operator may change while the loop runs, from any thread.
struct LoopWishes {
  std::atomic<bool> stop{false};   ///< fade to zero, end the programme, leave
  std::atomic<bool> leave{false};  ///< end the programme and leave: the control's watchdog fades, or holds
  std::atomic<bool> hold{false};   ///< when nobody writes: hold (true) or fade
};

/// Who decides.
struct LoopOperator {
  ApprovedProgram::Confirm confirm;  ///< what would move
  /// Rule::Ask: ids of what is added. May take its time, the loop goes on meanwhile; called on a thread of its own.
  std::function<std::vector<std::string>(const DiscrepancyResult&, const std::stop_token&)> choose;
  std::shared_ptr<LoopWishes> wishes;  ///< may be null
};

enum class LoopStage { None, Simulation, WithEffect, Identified };
[[nodiscard]] std::string_view toString(LoopStage stage) noexcept;

struct LoopStatus {
  double time_s = 0.0;
  double duration_s = 0.0;
  LoopStage stage = LoopStage::None;
  ControlState control;
  std::string channel;  ///< CompensationChannel::sentence
  bool active = false;
  std::string reason;                                    ///< why it is off; empty while it is active
  Eigen::Vector3d applied_um = Eigen::Vector3d::Zero();  ///< by the drives
  Eigen::Vector3d sigma_um = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());  ///< how sure
  double age_s = 0.0;                                                                              ///< of the inputs
  bool hold_when_silent = false;
  bool measuring = false;
  bool asking = false;  ///< waits for the operator's choice of effects
  bool stopping = false;
  double next_cycle_s = 0.0;
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
  /// What the model in use had predicted of `without_um`, and its standard uncertainty; NaN: nothing, not known.
  Eigen::Vector3d predicted_um = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector3d sigma_um = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
};

struct LoopResult {
  std::vector<LoopCycle> cycles;
  std::vector<LoopEvent> events;
  std::vector<std::string> effects;  ///< that were added
  std::string verdict;               ///< of the discrepancy
  std::vector<std::pair<double, LoopStage>> stages;
  double largest_step_um = 0.0;
  double largest_rate_um_s = 0.0;
  int losses = 0;                                             ///< of the control
  int resumed = 0;                                            ///< times that the program was ended and the loop went on
  double ended_s = std::numeric_limits<double>::quiet_NaN();  ///< when it began to fade for good
  bool completed = false;

  /// rms over the cycles of a stage (all with a compensation for None), per component.
  [[nodiscard]] Eigen::Vector3d rmsWithout(LoopStage stage) const;
  [[nodiscard]] Eigen::Vector3d rmsWith(LoopStage stage) const;
  /// Keys of FORMATS.md, and stages, cycles, events.
  [[nodiscard]] nlohmann::json json() const;
  [[nodiscard]] std::string summary() const;
  [[nodiscard]] Report report(const std::string& title) const;
};

/// Called with every turn, some ten times a second, on the thread of the loop.
using LoopLook = std::function<void(const LoopStatus&, const LoopResult&)>;

/// When the machine's time was 0, UTC in s since 1970, asked while it is `time_s`.
using UtcOfZero = std::function<double(double time_s)>;

/// Runs to the end of the plan, or until the operator stops it, and leaves a campaign in `folder`: new, empty, or that
/// of the same plan's loop that was ended before, which then goes on. Throws InputError: the start-up check fails, not
/// confirmed, the folder holds something else; Cancelled, after the compensation has faded. `utc_of_zero` dates
/// the campaign; empty: by the system's clock.
[[nodiscard]] LoopResult runClosedLoop(const LoopPlan& plan, MachineControl& control, const LoopOperator& who,
                                       const std::filesystem::path& folder, JobContext& job, const LoopLook& look = {},
                                       UtcOfZero utc_of_zero = {});

/// Programme of one measuring cycle, from above `start_mm`.
[[nodiscard]] std::string measuringProgram(const LoopPlan& plan);

}  // namespace spindrift
