// SPDX-License-Identifier: GPL-3.0-or-later
// A simple model of a machine: boxes and round bodies placed from its kinematic chain and travels. For pictures, not
// for measuring.
#pragma once

#include <Eigen/Core>
#include <QString>
#include <limits>
#include <vector>

#include "core/machine/machine_description.h"

namespace spindrift::gui {

enum class BodyKind { Bed, WorkpieceSide, Table, Column, ToolSide, Spindle };

/// An axis-parallel box in MCF, mm, or the cylinder inside it (then as wide in both directions across its axis).
struct Body {
  QString name;
  BodyKind kind = BodyKind::Bed;
  Eigen::Vector3d low_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d high_mm = Eigen::Vector3d::Zero();
  int round_about = -1;  ///< 0, 1, 2: a cylinder about X, Y, Z; -1: a box
};

/// A motion to be drawn as a double arrow: the travel of a linear axis beside the body that moves.
struct AxisMotion {
  QString name;
  int direction = 0;  ///< 0, 1, 2 for X, Y, Z
  Eigen::Vector3d from_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_mm = Eigen::Vector3d::Zero();
};

struct MachineBodies {
  std::vector<Body> bodies;
  std::vector<AxisMotion> motions;
  Eigen::Vector3d vertical = Eigen::Vector3d::UnitZ();
  /// The working area on the table: the rectangle on which grid and heat map lie.
  Eigen::Vector3d table_low_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d table_high_mm = Eigen::Vector3d::Zero();
};

/// `lowest_mm`: the lowest place that was measured, along the vertical; what is measured lies on the table or above it.
[[nodiscard]] MachineBodies machineBodies(const MachineDescription& machine,
                                          double lowest_mm = std::numeric_limits<double>::infinity());

}  // namespace spindrift::gui
