// SPDX-License-Identifier: GPL-3.0-or-later
// The solid things of the 3D view, drawn by VTK (private to view3d; VTK itself stays in scene.cpp).
#pragma once

#include <Eigen/Core>
#include <QImage>
#include <functional>
#include <memory>
#include <optional>

#include "widgets/view3d/machine_bodies.h"
#include "widgets/view3d/view3d.h"

namespace spindrift::gui {

class Scene {
 public:
  Scene();
  ~Scene();

  void setBodies(const MachineBodies& bodies);
  void setBodiesVisible(bool all, bool tool_side);
  void setField(const Field* field, const FieldStyle& style, const ColourScale& scale);
  void setCloud(const ViewCloud& cloud, const std::optional<ColourScale>& scale);
  void setShapes(const std::vector<ViewShape>& shapes);
  void setArrows(const std::vector<ViewArrow>& arrows, double exaggeration);
  void setSurface(const std::optional<ViewSurface>& surface, const SurfaceBox& box, const ColourScale& scale);
  void setColours();  ///< from the theme
  /// The numbers on the table stay, what lies beyond the plane goes.
  void setClip(const std::optional<ClipPlane>& plane);

  [[nodiscard]] const std::optional<MachineBodies>& bodies() const;
  [[nodiscard]] bool bodiesShown() const;
  [[nodiscard]] bool toolSideShown() const;
  /// Box around everything that is visible; empty if there is nothing.
  [[nodiscard]] std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>> bounds() const;

  /// Where the line of sight through a pixel first meets a surface; empty if it meets none.
  [[nodiscard]] std::optional<Eigen::Vector3d> surfaceAt(const Camera& camera, const QPointF& pixel,
                                                         const QSizeF& size) const;

  /// The cloud's point nearest to a pixel; nothing while a large cloud is being sorted.
  [[nodiscard]] std::optional<std::size_t> cloudPointAt(const Camera& camera, const QSizeF& size, const QPointF& pixel,
                                                        const std::function<bool(const Eigen::Vector3d&)>& shown) const;

  /// Draws everything (of a large cloud what there is time for) and reads the picture back.
  [[nodiscard]] QImage draw(const Camera& camera, const QSize& pixels, double device_pixel_ratio, bool smooth);
  /// Adds the next part of a large cloud to the last picture; `wait`: also if that has to be sorted first. False when
  /// there is nothing left to add.
  bool refine(QImage& picture, bool wait);
  [[nodiscard]] bool complete() const;
  /// True while a large cloud is prepared in the background.
  [[nodiscard]] bool sorting() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace spindrift::gui
