// SPDX-License-Identifier: Apache-2.0
// Displacements of measured points over the table as a drawing: an arrow for X and Y with its uncertainty, the disc's
// colour and a number for Z. Positions mm, displacements um.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/reporting/drawing.h"

namespace spindrift {

/// One point; a component that was not measured is NaN.
struct PointDisplacement {
  std::string point;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d change_um = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_um = Eigen::Vector3d::Zero();
};

struct PointMapOptions {
  std::string title;
  std::string subtitle;
  int width_px = 820;
};

/// How much arrows are exaggerated is written below, a round factor for which the longest is no more than about a sixth
/// of the picture and each ends, with its bars, inside the frame. Nothing if fewer than two points differ in place.
[[nodiscard]] std::optional<Drawing> pointMap(const std::vector<PointDisplacement>& points,
                                              const PointMapOptions& options);

}  // namespace spindrift
