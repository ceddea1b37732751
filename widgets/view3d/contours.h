// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of equal value on a regular grid (marching squares with linear interpolation on the edges).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <utility>
#include <vector>

#include "core/machine/field.h"

namespace spindrift::gui {

/// Segments (x, y in mm) where the value, row by row as in FieldGrid, crosses `level`.
[[nodiscard]] std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> contourSegments(
    const FieldGrid& grid, const std::function<double(std::size_t)>& value, double level);

}  // namespace spindrift::gui
