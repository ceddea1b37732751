// SPDX-License-Identifier: GPL-3.0-or-later
// What a decoder ought to find in an image of the virtual microscope.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/simulation/virtual_microscope.h"

namespace spindrift {

/// Ideal positions of what is wholly in view.
struct SceneTruth {
  struct Mark {
    int a = 0;  ///< row of an ellipse, i of a circle
    int b = 0;  ///< column of an ellipse, j of a circle
    double x_px = 0.0;
    double y_px = 0.0;
  };
  std::vector<Mark> ellipses;
  std::vector<Mark> circles;
};

/// Where the marks are; an ellipse counts as wholly in view if its outline is at least `margin_px` inside the image.
inline SceneTruth sceneTruth(const FiducialPattern& pattern, const MicroscopeScene& scene, double margin_px = 1.0) {
  SceneTruth truth;
  const auto inside = [&](const Eigen::Vector2d& p) {
    return p.x() >= margin_px && p.y() >= margin_px && p.x() <= scene.width_px - 1 - margin_px &&
           p.y() <= scene.height_px - 1 - margin_px;
  };
  const auto wholly = [&](const Eigen::Vector2d& centre, double rx, double ry) {
    for (int k = 0; k < 72; ++k) {
      const double t = 2.0 * std::numbers::pi * k / 72;
      if (!inside(scene.map.imageOf(centre + Eigen::Vector2d(rx * std::cos(t), ry * std::sin(t))))) return false;
    }
    return true;
  };
  const double half = 0.5 * pattern.ellipse_line_width_um;
  for (int row = pattern.first_row; row <= pattern.last_row; ++row) {
    for (int column = pattern.first_column; column <= pattern.last_column; ++column) {
      const Eigen::Vector2d centre = pattern.ellipseCentre(row, column);
      if (!wholly(centre, pattern.semi_axis_x_um + half, pattern.semi_axis_y_um + half)) continue;
      const Eigen::Vector2d p = scene.map.imageOf(centre);
      truth.ellipses.push_back({row, column, p.x(), p.y()});
    }
  }
  for (int j = pattern.first_circle_row; j <= pattern.last_circle_row; ++j) {
    for (int i = pattern.first_circle_column; i <= pattern.last_circle_column; ++i) {
      const Eigen::Vector2d centre = pattern.circleCentre(i, j);
      if (!wholly(centre, pattern.circle_radius_um, pattern.circle_radius_um)) continue;
      const Eigen::Vector2d p = scene.map.imageOf(centre);
      truth.circles.push_back({i, j, p.x(), p.y()});
    }
  }
  return truth;
}

}  // namespace spindrift
