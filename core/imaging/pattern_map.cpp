// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "core/imaging/decoder.h"

namespace spindrift {

Eigen::Vector2d PatternMap::imageOf(const Eigen::Vector2d& pattern_um) const {
  const double c = std::cos(tilt_rad) / pixel_length_um;
  const double s = std::sin(tilt_rad) / pixel_length_um;
  const double y = mirrored ? pattern_um.y() : -pattern_um.y();
  const double u = c * pattern_um.x() - s * y + origin_x_px;
  const double v = s * pattern_um.x() + c * y + origin_y_px;
  const double scale = 1.0 + k1_per_px2 * (u * u + v * v);
  return {centre_x_px + scale * u, centre_y_px + scale * v};
}

Eigen::Vector2d PatternMap::undistorted(const Eigen::Vector2d& pixel) const {
  const double x = pixel.x() - centre_x_px;
  const double y = pixel.y() - centre_y_px;
  // r_distorted = r (1 + k1 r^2): Newton for the factor r / r_distorted.
  const double q = k1_per_px2 * (x * x + y * y);
  double factor = 1.0;
  for (int i = 0; i < 4; ++i) {
    factor -= (factor * (1.0 + q * factor * factor) - 1.0) / (1.0 + 3.0 * q * factor * factor);
  }
  return {centre_x_px + factor * x, centre_y_px + factor * y};
}

Eigen::Vector2d PatternMap::patternOf(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d u = undistorted(pixel);
  const double x = u.x() - centre_x_px - origin_x_px;
  const double y = u.y() - centre_y_px - origin_y_px;
  const double c = std::cos(tilt_rad) * pixel_length_um;
  const double s = std::sin(tilt_rad) * pixel_length_um;
  const double Y = -s * x + c * y;
  return {c * x + s * y, mirrored ? Y : -Y};
}

}  // namespace spindrift
