// SPDX-License-Identifier: GPL-3.0-or-later
// Artefact, styli, travel and path of a probing cycle as shapes of the 3D view. MCF, mm.
#pragma once

#include <optional>
#include <vector>

#include "core/probing/checked_program.h"
#include "core/probing/touch_verdict.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {

/// Where the first ball stands: the centre found in the first cycle, else what the first touches on it say; empty for
/// hole bars and where nothing is known.
[[nodiscard]] std::optional<Eigen::Vector3d> firstBallPosition(const Artefact& artefact, const TouchList* touches,
                                                               const TouchEvaluation* evaluation);

/// Balls, or the bar with its holes at a table angle.
void addArtefact(std::vector<ViewShape>& shapes, const MachineDescription& machine, const Artefact& artefact,
                 const Eigen::Vector3d& first_ball_mm, double c_deg);
/// Names of the balls or holes, as points without a value.
[[nodiscard]] std::vector<ViewPoint> featureLabels(const MachineDescription& machine, const Artefact& artefact,
                                                   const Eigen::Vector3d& first_ball_mm, double c_deg);
/// All styli as they stand when `stylus` is at `tip_mm`; that one is marked.
void addStyli(std::vector<ViewShape>& shapes, const MachineDescription& machine, const std::string& stylus,
              const Eigen::Vector3d& tip_mm);
/// The box of the travels of X, Y and Z.
void addTravel(std::vector<ViewShape>& shapes, const MachineDescription& machine);
/// The moves of the tip at one table angle: approaches and retracts marked.
void addPath(std::vector<ViewShape>& shapes, const CyclePlan& plan, double c_deg);
/// A small ball per touch, by its state.
void addTouches(std::vector<ViewShape>& shapes, const std::vector<TouchVerdict>& verdicts, double c_deg);

[[nodiscard]] Tone toneOf(TouchState state);

}  // namespace spindrift::gui
