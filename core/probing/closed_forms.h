// SPDX-License-Identifier: Apache-2.0
// P4 (7)-(10) as printed beside the joint evaluation, on the tracks that were measured: how far the closed forms are
// off where the machine does not only turn its head.
//
// The closed forms (star_stylus.h) use the movement of one ball's centre through three styli between the first cycle
// and another. Three styli on one ball touch the same place, so that every translation of the spindle against the ball
// (drift, screws, column) counts as a rotation; the joint evaluation (ball_cycle.h) separates them. Units: urad, um.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/probing/ball_cycle.h"

namespace spindrift {

struct HeadComparison {
  std::string cycle;
  std::string ball;
  std::optional<Eigen::Vector3d> closed_form_urad;             ///< (7)-(9); nothing: degenerate, see `message`
  Eigen::Vector3d joint_urad = Eigen::Vector3d::Zero();        ///< hX, hY, hZ
  Eigen::Vector3d joint_sigma_urad = Eigen::Vector3d::Zero();  ///< standard uncertainty
  double spindle_drift_um = 0.0;                               ///< (10)
  double joint_drift_um = 0.0;                                 ///< length of (dX, dY, dZ)
  std::string message;
};

/// One per cycle after the first and ball that three styli touched in both; empty with fewer than three styli.
[[nodiscard]] std::vector<HeadComparison> closedFormsBeside(const BallCycleResult& balls,
                                                            const MachineDescription& machine);

}  // namespace spindrift
