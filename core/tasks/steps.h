// SPDX-License-Identifier: Apache-2.0
// How far the guided way from a machine to a report is on one campaign, from its tasks and from what their results say.
#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/tasks/task_graph.h"

namespace spindrift {

enum class StepId { Machine, WarmUp, Capture, Calibrate, Model, Discrepancy, Compensate, Verify, Review, Report };
inline constexpr std::array all_steps{StepId::Machine, StepId::WarmUp,      StepId::Capture,    StepId::Calibrate,
                                      StepId::Model,   StepId::Discrepancy, StepId::Compensate, StepId::Verify,
                                      StepId::Review,  StepId::Report};
[[nodiscard]] std::string_view toString(StepId step) noexcept;

enum class StepState {
  NotStarted,
  InProgress,  ///< begun, or being worked on now
  Attention,   ///< done, and what came out is not as it should be
  Current,     ///< done, and nothing it depends on has changed since
  Outdated,    ///< done, but something it depends on has changed
  Blocked,     ///< cannot be done yet; the sentence says why
};
[[nodiscard]] std::string_view toString(StepState state) noexcept;

struct StepReport {
  StepState state = StepState::NotStarted;
  std::string sentence;  ///< how far it is, what is wrong, what has changed, or why it is blocked
  /// Of the captures: taken or checked of all (InProgress), not usable of all (Attention). 0 of 0: nothing to count.
  std::size_t count = 0;
  std::size_t of = 0;
};

/// What only the files tell; counted apart because lists have to be read for it.
struct CaptureCounts {
  std::size_t listed = 0;    ///< captures in the lists of the campaign
  std::size_t to_check = 0;  ///< of these, of the instrument that the check is of
  std::size_t planned = 0;   ///< items of the plan; 0: there is none
  std::size_t taken = 0;     ///< of them
  /// Lists and plans that cannot be read count as empty: the pages say so.
  [[nodiscard]] static CaptureCounts of(const TaskGraph& graph);
};

/// What the step Review compares, as its inputs: kept (option_keys::reviewed) when it is looked at.
[[nodiscard]] nlohmann::json reviewedNow(const TaskGraph& graph);
/// The operator's word that the instrument was warm ("settled", "by"), if it was given.
[[nodiscard]] std::optional<nlohmann::json> warmStatement(const TaskGraph& graph);
[[nodiscard]] StepReport stepReport(const TaskGraph& graph, StepId step, const CaptureCounts& counts);
/// The task a step is about; empty for steps that are looked at only.
[[nodiscard]] std::string taskOfStep(const TaskGraph& graph, StepId step);

}  // namespace spindrift
