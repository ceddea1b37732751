// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/contours.h"

#include <array>
#include <cmath>

namespace spindrift::gui {

std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> contourSegments(
    const FieldGrid& grid, const std::function<double(std::size_t)>& value, double level) {
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> segments;
  for (int iy = 0; iy + 1 < grid.ny; ++iy) {
    for (int ix = 0; ix + 1 < grid.nx; ++ix) {
      const std::array<Eigen::Vector2d, 4> corner{
          Eigen::Vector2d(grid.x_mm(ix), grid.y_mm(iy)), Eigen::Vector2d(grid.x_mm(ix + 1), grid.y_mm(iy)),
          Eigen::Vector2d(grid.x_mm(ix + 1), grid.y_mm(iy + 1)), Eigen::Vector2d(grid.x_mm(ix), grid.y_mm(iy + 1))};
      const std::array<double, 4> v{value(grid.index(ix, iy)) - level, value(grid.index(ix + 1, iy)) - level,
                                    value(grid.index(ix + 1, iy + 1)) - level, value(grid.index(ix, iy + 1)) - level};
      std::array<Eigen::Vector2d, 4> crossing;
      int count = 0;
      for (std::size_t a = 0; a < 4; ++a) {
        const std::size_t b = (a + 1) % 4;
        if (!std::isfinite(v[a]) || !std::isfinite(v[b]) || (v[a] < 0) == (v[b] < 0)) continue;
        const double t = v[a] / (v[a] - v[b]);
        crossing[static_cast<std::size_t>(count++)] = corner[a] + t * (corner[b] - corner[a]);
      }
      if (count >= 2) segments.emplace_back(crossing[0], crossing[1]);
      if (count == 4) segments.emplace_back(crossing[2], crossing[3]);
    }
  }
  return segments;
}

}  // namespace spindrift::gui
