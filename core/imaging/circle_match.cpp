// SPDX-License-Identifier: Apache-2.0
// Least-squares match of a filled circle: I = b + c T(r) - c T'(r) n . shift, T(r) = Phi((R - r) / sigma).
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/imaging/decoder_parts.h"

namespace spindrift::decoding {

RingMatch matchCircle(const GrayImage& image, const FiducialPattern& pattern, const PatternMap& map,
                      const Eigen::Vector2d& centre_um, double blur_px, const Eigen::Vector2d& light_gradient) {
  RingMatch result;
  const Eigen::Vector2d start = map.imageOf(centre_um);
  const double radius = 0.5 * (map.imageOf(centre_um + Eigen::Vector2d(pattern.circle_radius_um, 0)) -
                               map.imageOf(centre_um - Eigen::Vector2d(pattern.circle_radius_um, 0)))
                                  .norm();
  const double band = 2.3 * blur_px + 1.0;
  const double outer = radius + band;
  const double inner = std::max(0.0, radius - band);
  const int x0 = static_cast<int>(std::ceil(start.x() - outer));
  const int x1 = static_cast<int>(std::floor(start.x() + outer));
  const int y0 = static_cast<int>(std::ceil(start.y() - outer));
  const int y1 = static_cast<int>(std::floor(start.y() + outer));
  if (x0 < 0 || y0 < 0 || x1 >= image.width() || y1 >= image.height()) return result;

  constexpr int steps_per_px = 16;
  const int cells = static_cast<int>(2.0 * band * steps_per_px) + 2;
  std::vector<float> profile(cells);
  std::vector<float> slope(cells);
  for (int k = 0; k < cells; ++k) {
    const double e = static_cast<double>(k) / steps_per_px - band;  // r - R
    profile[k] = static_cast<float>(0.5 * std::erfc(e / (blur_px * std::numbers::sqrt2)));
    slope[k] = static_cast<float>(-std::exp(-0.5 * e * e / (blur_px * blur_px)) /
                                  (blur_px * std::sqrt(2.0 * std::numbers::pi)));
  }
  Eigen::Matrix4f M = Eigen::Matrix4f::Zero();
  Eigen::Vector4f g = Eigen::Vector4f::Zero();
  float square = 0.0F;
  const float first = static_cast<float>(radius - band);
  const float gx = static_cast<float>(light_gradient.x());
  const float gy = static_cast<float>(light_gradient.y());
  for (int y = y0; y <= y1; ++y) {
    const std::uint8_t* line = image.row(y);
    const float dy = static_cast<float>(y - start.y());
    for (int x = x0; x <= x1; ++x) {
      const float dx = static_cast<float>(x - start.x());
      const float r = std::sqrt(dx * dx + dy * dy);
      if (r >= outer || r <= inner) continue;
      const float index = std::max(0.0F, (r - first) * steps_per_px);
      const int cell = std::min(static_cast<int>(index), cells - 2);
      const float part = index - static_cast<float>(cell);
      const float t = profile[cell] + part * (profile[cell + 1] - profile[cell]);
      const float q = (slope[cell] + part * (slope[cell + 1] - slope[cell])) / std::max(r, 1e-3F);
      const float qx = q * dx;
      const float qy = q * dy;
      const float level = static_cast<float>(line[x]) * (1.0F - gx * dx - gy * dy) - 100.0F;
      M(0, 0) += 1.0F;
      M(1, 0) += t;
      M(2, 0) += qx;
      M(3, 0) += qy;
      M(1, 1) += t * t;
      M(2, 1) += t * qx;
      M(3, 1) += t * qy;
      M(2, 2) += qx * qx;
      M(3, 2) += qx * qy;
      M(3, 3) += qy * qy;
      g[0] += level;
      g[1] += level * t;
      g[2] += level * qx;
      g[3] += level * qy;
      square += level * level;
    }
  }
  const double n = M(0, 0);
  if (n < 20.0) return result;
  Eigen::Matrix4d N = M.cast<double>().selfadjointView<Eigen::Lower>();
  const Eigen::Vector4d rhs = g.cast<double>();
  const Eigen::LDLT<Eigen::Matrix4d> solver(N);
  const Eigen::Vector4d p = solver.solve(rhs);
  if (!p.allFinite() || p[1] < 1.0) return result;
  const double total = square - rhs[0] * rhs[0] / n;
  const double residual = std::max(0.0, square - p.dot(rhs));
  result.contrast = p[1];
  result.correlation = total > 0.0 ? std::sqrt(std::clamp(1.0 - residual / total, 0.0, 1.0)) : 0.0;
  result.degrees_of_freedom = static_cast<int>(n) - 4;
  result.pixel_noise = std::sqrt(residual / (n - 4.0));
  result.effective_noise = result.pixel_noise;
  const Eigen::Vector2d moved(-p[2] / p[1], -p[3] / p[1]);
  result.unit_covariance_px2 = solver.solve(Eigen::Matrix4d::Identity()).bottomRightCorner<2, 2>() / (p[1] * p[1]);
  result.x_px = start.x() + moved.x();
  result.y_px = start.y() + moved.y();
  result.shift_px = moved.norm();
  result.visible = 1.0;
  result.found = true;
  return result;
}

}  // namespace spindrift::decoding
