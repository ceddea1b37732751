// SPDX-License-Identifier: GPL-3.0-or-later
// The camera of the 3D view: it turns about the vertical and tilts, so that a machine never lies on its side.
#pragma once

#include <Eigen/Core>
#include <QMarginsF>
#include <QPointF>
#include <QRectF>
#include <QSizeF>
#include <optional>

namespace spindrift::gui {

enum class StandardView { Isometric, Top, Front, Right };

/// Everything that decides where a point appears; copied between linked views. Lengths mm, angles rad.
struct Camera {
  Eigen::Vector3d focal_point_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d vertical = Eigen::Vector3d::UnitZ();  ///< what is up at the machine: Z, or Y for a horizontal spindle
  double azimuth_rad = -0.7;                            ///< direction to the viewer in the horizontal plane
  double elevation_rad = 0.5;                           ///< -pi/2 ... pi/2
  double half_height_mm = 100;                          ///< half the height of the picture at the focal point
  bool orthographic = true;

  [[nodiscard]] Eigen::Vector3d forward() const;  ///< into the picture
  [[nodiscard]] Eigen::Vector3d right() const;
  [[nodiscard]] Eigen::Vector3d up() const;
  [[nodiscard]] double distance_mm() const;  ///< of the eye (perspective)
  [[nodiscard]] Eigen::Vector3d eye_mm() const;

  void turn(double azimuth_rad, double elevation_rad);
  /// Moves the scene by a number of pixels.
  void pan(const QPointF& pixels, const QSizeF& size);
  /// Zooms by `factor` (> 1: closer) and keeps what is under `at` where it is.
  void zoom(double factor, const QPointF& at, const QSizeF& size);
  void look(StandardView view);
  /// Shows the whole box, as large as the picture without its margins (pixels) allows, in the middle of that.
  void fit(const Eigen::Vector3d& low_mm, const Eigen::Vector3d& high_mm, const QSizeF& size,
           const QMarginsF& margins = QMarginsF(2, 2, 2, 2));
  /// The rectangle around a box as it is seen; empty if a part of it lies behind the eye.
  [[nodiscard]] QRectF frame(const Eigen::Vector3d& low_mm, const Eigen::Vector3d& high_mm, const QSizeF& size) const;

  /// Pixels; empty if the point lies behind the eye.
  [[nodiscard]] std::optional<QPointF> project(const Eigen::Vector3d& point_mm, const QSizeF& size) const;
  /// Distance into the picture, for sorting.
  [[nodiscard]] double depth_mm(const Eigen::Vector3d& point_mm) const;
  /// Where the line of sight through a pixel meets the plane `normal` . p = `offset`; empty if it runs along it.
  [[nodiscard]] std::optional<Eigen::Vector3d> meetPlane(const QPointF& pixel, const QSizeF& size,
                                                         const Eigen::Vector3d& normal, double offset_mm) const;
  [[nodiscard]] bool operator==(const Camera&) const = default;
};

/// Half the opening angle of the perspective camera.
inline constexpr double half_view_angle_rad = 0.2618;

}  // namespace spindrift::gui
