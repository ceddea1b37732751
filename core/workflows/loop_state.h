// SPDX-License-Identifier: Apache-2.0
// A closed loop over the end of the program: loop-state.json in its folder, written after every row of the log and
// every cycle, whole or not at all. What is measured is in it as well, so that a kill between two files loses nothing:
// observations.csv and loop.json are written anew from it. The log's rows are read from log.csv, which only grows.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/json_reader.h"
#include "core/workflows/closed_loop.h"

namespace spindrift {

inline constexpr const char* loop_state_file = "loop-state.json";

/// What the loop was about to do; the models' part is LoopModels::state().
struct LoopState {
  double time_s = 0.0;
  double began_unix_s = 0.0;  ///< where time is 0 for a control that states none
  LoopStage stage = LoopStage::None;
  double next_cycle_s = 0.0;
  std::string why = "time";
  bool searched = false;  ///< the simulation was held against the readings, and the operator has decided
  std::size_t tried = 0;
  bool ours = false;       ///< a programme of the loop was running
  bool measuring = false;  ///< it was a measuring cycle, with the spindle at rest
  std::optional<int> tool;
  std::optional<Eigen::Vector3d> home_mm;
  bool rehomed = false;
  LoopResult result;
  nlohmann::json models;

  [[nodiscard]] nlohmann::json json(const LoopPlan& plan) const;
  /// Throws InputError: not such a file, of another plan, of a loop that has ended.
  [[nodiscard]] static LoopState read(const std::filesystem::path& file, const LoopPlan& plan);
};

}  // namespace spindrift
