// SPDX-License-Identifier: GPL-3.0-or-later
// The points of a large cloud in nested boxes, so that a view draws of it what it has time for: every box holds a
// random sample of its points, its children hold the others. The boxes of the upper levels are a thinned picture of the
// whole; all boxes together are every point once.
//
// After M. Wimmer and C. Scheiblauer, "Instant Points: Fast Rendering of Unprocessed Point Clouds", 2006 (nested
// octree).
#pragma once

#include <Eigen/Core>
#include <QPointF>
#include <QSizeF>
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "widgets/view3d/camera.h"

namespace spindrift::gui {

class CloudOctree {
 public:
  using Points = std::shared_ptr<const std::vector<float>>;  ///< x y z x y z ..., mm

  struct Node {
    Eigen::Vector3f low_mm = Eigen::Vector3f::Zero();  ///< box around its points and those of its children
    Eigen::Vector3f high_mm = Eigen::Vector3f::Zero();
    std::size_t first = 0;  ///< its own points: order()[first] to order()[first + count - 1]
    std::size_t count = 0;
    std::array<int, 8> children{};  ///< indices of nodes; 0: none (the root is nobody's child)
  };

  /// About 0.1 s per million points; any thread. Null if `cancelled` became true meanwhile. Coordinates are finite.
  [[nodiscard]] static std::shared_ptr<const CloudOctree> build(const Points& xyz_mm,
                                                                const std::atomic<bool>& cancelled);

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }

  /// Nodes that a camera sees, those that take most of the picture first, a parent before its children, until they hold
  /// `budget` points. Not empty unless nothing is seen.
  [[nodiscard]] std::vector<int> visible(const Camera& camera, const QSizeF& size, std::size_t budget) const;

  /// The point nearest to a pixel, within `radius_px`; of those about as near the one nearest to the viewer.
  [[nodiscard]] std::optional<std::size_t> pointAt(const Camera& camera, const QSizeF& size, const QPointF& pixel,
                                                   double radius_px,
                                                   const std::function<bool(const Eigen::Vector3d&)>& shown) const;

  static constexpr std::size_t points_per_node = 12'000;

 private:
  [[nodiscard]] Eigen::Vector3f at(std::uint32_t i) const {
    return Eigen::Map<const Eigen::Vector3f>(xyz_mm_->data() + 3 * static_cast<std::size_t>(i));
  }

  Points xyz_mm_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace spindrift::gui
