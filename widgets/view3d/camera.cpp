// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace spindrift::gui {
namespace {

/// Horizontal directions that form a right-handed set with the vertical: for Z up they are X and Y, for Y up Z and X
/// turned so that azimuth -pi/2 looks along the depth of the machine.
void horizontalAxes(const Eigen::Vector3d& vertical, Eigen::Vector3d& a, Eigen::Vector3d& b) {
  a = std::abs(vertical.x()) > 0.9 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  b = vertical.cross(a).normalized();
}

}  // namespace

Eigen::Vector3d Camera::forward() const {
  Eigen::Vector3d a, b;
  horizontalAxes(vertical, a, b);
  const Eigen::Vector3d to_viewer = std::cos(elevation_rad) * (std::cos(azimuth_rad) * a + std::sin(azimuth_rad) * b) +
                                    std::sin(elevation_rad) * vertical;
  return -to_viewer;
}

Eigen::Vector3d Camera::right() const {
  Eigen::Vector3d a, b;
  horizontalAxes(vertical, a, b);
  return -std::sin(azimuth_rad) * a + std::cos(azimuth_rad) * b;
}

Eigen::Vector3d Camera::up() const {
  return right().cross(forward()).normalized();
}

double Camera::distance_mm() const {
  return half_height_mm / std::tan(half_view_angle_rad);
}

Eigen::Vector3d Camera::eye_mm() const {
  return focal_point_mm - distance_mm() * forward();
}

void Camera::turn(double azimuth, double elevation) {
  azimuth_rad = std::remainder(azimuth_rad + azimuth, 2 * std::numbers::pi);
  elevation_rad = std::clamp(elevation_rad + elevation, -std::numbers::pi / 2, std::numbers::pi / 2);
}

void Camera::pan(const QPointF& pixels, const QSizeF& size) {
  const double mm_per_pixel = 2 * half_height_mm / size.height();
  focal_point_mm += mm_per_pixel * (-pixels.x() * right() + pixels.y() * up());
}

void Camera::zoom(double factor, const QPointF& at, const QSizeF& size) {
  const double smaller = std::clamp(half_height_mm / factor, 1e-3, 1e6);
  const QPointF from_centre(at.x() - size.width() / 2, at.y() - size.height() / 2);
  const double before = 2 * half_height_mm / size.height();
  const double after = 2 * smaller / size.height();
  focal_point_mm += (before - after) * (from_centre.x() * right() - from_centre.y() * up());
  half_height_mm = smaller;
}

void Camera::look(StandardView view) {
  constexpr double right_angle = std::numbers::pi / 2;
  switch (view) {
    case StandardView::Isometric:
      // From the side of the table, not of the column: this stands at +Y of a vertical spindle, at +Z of a horizontal
      // one.
      azimuth_rad = std::abs(vertical.y()) > 0.9 ? 0.96 : -0.96;
      elevation_rad = 0.52;
      break;
    case StandardView::Top:
      azimuth_rad = -right_angle;
      elevation_rad = right_angle;
      break;
    case StandardView::Front:
      azimuth_rad = -right_angle;
      elevation_rad = 0;
      break;
    case StandardView::Right:
      azimuth_rad = 0;
      elevation_rad = 0;
      break;
  }
}

QRectF Camera::frame(const Eigen::Vector3d& low, const Eigen::Vector3d& high, const QSizeF& size) const {
  double left = 1e300, top = 1e300, right_most = -1e300, bottom = -1e300;
  for (int corner = 0; corner < 8; ++corner) {
    const auto at = project({(corner & 1) != 0 ? high.x() : low.x(), (corner & 2) != 0 ? high.y() : low.y(),
                             (corner & 4) != 0 ? high.z() : low.z()},
                            size);
    if (!at) return {};
    left = std::min(left, at->x());
    right_most = std::max(right_most, at->x());
    top = std::min(top, at->y());
    bottom = std::max(bottom, at->y());
  }
  return {left, top, right_most - left, bottom - top};
}

void Camera::fit(const Eigen::Vector3d& low, const Eigen::Vector3d& high, const QSizeF& size,
                 const QMarginsF& margins) {
  constexpr double least_px = 40;
  const QRectF inner = QRectF(QPointF(0, 0), size).marginsRemoved(margins);
  const QSizeF free(std::max(least_px, inner.width()), std::max(least_px, inner.height()));
  focal_point_mm = 0.5 * (low + high);
  half_height_mm = std::max(1e-3, (high - low).norm());  // everything lies before the eye
  // What is near grows faster in perspective: a few steps.
  for (int pass = 0; pass < (orthographic ? 1 : 6); ++pass) {
    QRectF seen = frame(low, high, size);
    if (seen.isNull()) break;
    half_height_mm *= std::max({seen.width() / free.width(), seen.height() / free.height(), 1e-6});
    seen = frame(low, high, size);
    pan(QPointF(inner.center() - seen.center()), size);
  }
}

std::optional<QPointF> Camera::project(const Eigen::Vector3d& point, const QSizeF& size) const {
  const Eigen::Vector3d p = point - focal_point_mm;
  double scale = size.height() / (2 * half_height_mm);
  if (!orthographic) {
    const double depth = distance_mm() + forward().dot(p);
    if (depth < 1e-6) return std::nullopt;
    scale *= distance_mm() / depth;
  }
  return QPointF(size.width() / 2 + scale * right().dot(p), size.height() / 2 - scale * up().dot(p));
}

double Camera::depth_mm(const Eigen::Vector3d& point) const {
  return forward().dot(point - focal_point_mm);
}

std::optional<Eigen::Vector3d> Camera::meetPlane(const QPointF& pixel, const QSizeF& size,
                                                 const Eigen::Vector3d& normal, double offset) const {
  const double mm_per_pixel = 2 * half_height_mm / size.height();
  const Eigen::Vector3d in_plane = focal_point_mm + mm_per_pixel * ((pixel.x() - size.width() / 2) * right() -
                                                                    (pixel.y() - size.height() / 2) * up());
  const Eigen::Vector3d start = orthographic ? Eigen::Vector3d(in_plane) : eye_mm();
  const Eigen::Vector3d direction = orthographic ? forward() : Eigen::Vector3d(in_plane - start);
  const double along = normal.dot(direction);
  if (std::abs(along) < 1e-9) return std::nullopt;
  return start + (offset - normal.dot(start)) / along * direction;
}

}  // namespace spindrift::gui
