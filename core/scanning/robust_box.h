// SPDX-License-Identifier: Apache-2.0
// Where the points of a cloud are, whatever a few of them say: codes for "no value", reflections, slipped decimal
// points.
#pragma once

#include <Eigen/Core>

#include "core/scanning/cloud.h"

namespace spindrift {

struct RobustBox {
  Eigen::Vector3d low = Eigen::Vector3d::Zero();
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
};

/// The box of the middle 98 % of about 20,000 points per coordinate, mm: gross outliers do not count.
[[nodiscard]] RobustBox robustExtent(const PointCloud& cloud);

/// Beyond this box in x or y a point belongs to no artefact of this cloud: the middle of it, and as much again on every
/// side. Heights are open: they are judged against their neighbours.
[[nodiscard]] RobustBox plausibleBox(const PointCloud& cloud);

[[nodiscard]] inline bool isInside(const RobustBox& box, const Eigen::Vector3d& point_mm) {
  return point_mm.x() >= box.low.x() && point_mm.x() <= box.high.x() && point_mm.y() >= box.low.y() &&
         point_mm.y() <= box.high.y();
}

}  // namespace spindrift
