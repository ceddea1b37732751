// SPDX-License-Identifier: Apache-2.0
// Least-squares match of a filled circle: I = b + c T(r) - c T'(r) n . shift, T(r) = Phi((R - r) / sigma).
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/imaging/decoder_parts.h"

namespace spindrift::decoding {

EdgeProfile::EdgeProfile(double blur) : blur_px(blur), band_px(2.3 * blur + 1.0) {
  cells.resize(static_cast<std::size_t>(2.0 * band_px * cells_per_px) + 2);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const double e = static_cast<double>(k) / cells_per_px - band_px;
    cells[k].level = static_cast<float>(0.5 * std::erfc(e / (blur * std::numbers::sqrt2)));
    cells[k].slope =
        static_cast<float>(-std::exp(-0.5 * e * e / (blur * blur)) / (blur * std::sqrt(2.0 * std::numbers::pi)));
  }
}

RingMatch matchCircle(const GrayImage& image, const FiducialPattern& pattern, const PatternMap& map,
                      const Eigen::Vector2d& centre_um, const EdgeProfile& edge,
                      const Eigen::Vector2d& light_gradient) {
  RingMatch result;
  const Eigen::Vector2d start = map.imageOf(centre_um);
  const double radius = 0.5 * (map.imageOf(centre_um + Eigen::Vector2d(pattern.circle_radius_um, 0)) -
                               map.imageOf(centre_um - Eigen::Vector2d(pattern.circle_radius_um, 0)))
                                  .norm();
  const double band = edge.band_px;
  const double outer = radius + band;
  const double inner = std::max(0.0, radius - band);
  const int x0 = static_cast<int>(std::ceil(start.x() - outer));
  const int x1 = static_cast<int>(std::floor(start.x() + outer));
  const int y0 = static_cast<int>(std::ceil(start.y() - outer));
  const int y1 = static_cast<int>(std::floor(start.y() + outer));
  if (x0 < 0 || y0 < 0 || x1 >= image.width() || y1 >= image.height()) return result;

  Eigen::Matrix4f M = Eigen::Matrix4f::Zero();
  Eigen::Vector4f g = Eigen::Vector4f::Zero();
  float square = 0.0F;
  const float first = static_cast<float>(radius - band);
  const float outer2 = static_cast<float>(outer * outer);
  const float inner2 = static_cast<float>(inner * inner);
  const int last = static_cast<int>(edge.cells.size()) - 1;
  const float gx = static_cast<float>(light_gradient.x());
  const float gy = static_cast<float>(light_gradient.y());
  for (int y = y0; y <= y1; ++y) {
    const std::uint8_t* line = image.row(y);
    const float dy = static_cast<float>(y - start.y());
    for (int x = x0; x <= x1; ++x) {
      const float dx = static_cast<float>(x - start.x());
      const float r2 = dx * dx + dy * dy;
      if (r2 >= outer2 || r2 <= inner2) continue;
      const float r = std::sqrt(r2);
      const float index = std::max(0.0F, (r - first) * static_cast<float>(EdgeProfile::cells_per_px));
      const EdgeProfile::Cell& cell =
          edge.cells[static_cast<std::size_t>(std::min(static_cast<int>(index + 0.5F), last))];
      const float t = cell.level;
      const float q = cell.slope / std::max(r, 1e-3F);
      const float qx = q * dx;
      const float qy = q * dy;
      const float level = static_cast<float>(line[x]) * (1.0F - gx * dx - gy * dy) - line_ground;
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
