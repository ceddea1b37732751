// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/view3d/cloud_octree.h"

#include <QRectF>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <utility>

namespace spindrift::gui {
namespace {

constexpr int deepest = 24;  ///< points in one place cannot be divided

/// The same numbers in every run (splitmix64).
std::uint64_t scrambled(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

/// What a box takes of the picture; the whole picture if a part of it lies behind the eye.
QRectF frameOf(const CloudOctree::Node& node, const Camera& camera, const QSizeF& size) {
  const QRectF frame = camera.frame(node.low_mm.cast<double>(), node.high_mm.cast<double>(), size);
  const bool behind = !camera.orthographic && frame.topLeft().isNull() && frame.width() == 0 && frame.height() == 0;
  return behind ? QRectF(QPointF(0, 0), size) : frame;
}

}  // namespace

std::shared_ptr<const CloudOctree> CloudOctree::build(const Points& xyz_mm, const std::atomic<bool>& cancelled) {
  auto tree = std::make_shared<CloudOctree>();
  tree->xyz_mm_ = xyz_mm;
  const std::size_t count = xyz_mm->size() / 3;
  std::vector<std::uint32_t>& order = tree->order_;
  order.resize(count);
  std::iota(order.begin(), order.end(), 0U);
  std::vector<std::uint32_t> sorted(count);
  struct Part {
    std::size_t begin, end;
    int parent, octant, depth;
  };
  std::vector<Part> parts;
  if (count > 0) parts.push_back({0, count, -1, 0, 0});
  while (!parts.empty()) {
    if (cancelled) return nullptr;
    const Part part = parts.back();
    parts.pop_back();
    const int index = static_cast<int>(tree->nodes_.size());
    if (part.parent >= 0)
      tree->nodes_[static_cast<std::size_t>(part.parent)].children[static_cast<std::size_t>(part.octant)] = index;
    Node& node = tree->nodes_.emplace_back();
    node.first = part.begin;
    node.low_mm = node.high_mm = tree->at(order[part.begin]);
    for (std::size_t i = part.begin; i < part.end; ++i) {
      const Eigen::Vector3f p = tree->at(order[i]);
      node.low_mm = node.low_mm.cwiseMin(p);
      node.high_mm = node.high_mm.cwiseMax(p);
    }
    const std::size_t size = part.end - part.begin;
    if (size <= 2 * points_per_node || part.depth == deepest) {
      node.count = size;
      continue;
    }
    // One point at random out of every stretch of the order is its sample; the others go to their octants.
    const Eigen::Vector3f middle = 0.5F * (node.low_mm + node.high_mm);
    std::vector<std::uint32_t> sample;
    sample.reserve(points_per_node);
    const auto placeOf = [&](std::size_t k) {  // of the sample's k-th point
      const std::size_t from = k * size / points_per_node;
      const std::size_t to = (k + 1) * size / points_per_node;
      return part.begin + from + scrambled(k + 977 * static_cast<std::size_t>(index)) % (to - from);
    };
    std::array<std::size_t, 9> start{};
    const auto octantOf = [&](std::uint32_t i) {
      const Eigen::Vector3f p = tree->at(i);
      return static_cast<std::size_t>((p.x() > middle.x() ? 1 : 0) + (p.y() > middle.y() ? 2 : 0) +
                                      (p.z() > middle.z() ? 4 : 0));
    };
    std::vector<std::uint8_t> octant(size);
    std::size_t next = placeOf(0);
    for (std::size_t i = part.begin; i < part.end; ++i) {
      if (i == next) {
        sample.push_back(order[i]);
        octant[i - part.begin] = 8;
        next = sample.size() < points_per_node ? placeOf(sample.size()) : part.end;
        continue;
      }
      const std::size_t o = octantOf(order[i]);
      octant[i - part.begin] = static_cast<std::uint8_t>(o);
      ++start[o + 1];
    }
    start[0] = part.begin + sample.size();
    for (std::size_t o = 1; o < 9; ++o) start[o] += start[o - 1];
    std::array<std::size_t, 9> at = start;
    for (std::size_t i = part.begin; i < part.end; ++i)
      if (octant[i - part.begin] < 8) sorted[at[octant[i - part.begin]]++] = order[i];
    std::copy(sample.begin(), sample.end(), order.begin() + static_cast<std::ptrdiff_t>(part.begin));
    std::copy(sorted.begin() + static_cast<std::ptrdiff_t>(start[0]),
              sorted.begin() + static_cast<std::ptrdiff_t>(part.end),
              order.begin() + static_cast<std::ptrdiff_t>(start[0]));
    node.count = sample.size();
    for (std::size_t o = 0; o < 8; ++o)
      if (start[o + 1] > start[o])
        parts.push_back({start[o], start[o + 1], index, static_cast<int>(o), part.depth + 1});
  }
  return tree;
}

std::vector<int> CloudOctree::visible(const Camera& camera, const QSizeF& size, std::size_t budget) const {
  const QRectF picture(QPointF(0, 0), size);
  using Seen = std::pair<double, int>;  // the larger side of its frame, node
  std::priority_queue<Seen> waiting;
  const auto offer = [&](int i) {
    const QRectF frame = frameOf(nodes_[static_cast<std::size_t>(i)], camera, size);
    // A box seen edge on has a frame of no width.
    if (frame.adjusted(-1, -1, 1, 1).intersects(picture)) waiting.emplace(std::max(frame.width(), frame.height()), -i);
  };
  std::vector<int> chosen;
  std::size_t points = 0;
  if (!nodes_.empty()) offer(0);
  while (!waiting.empty() && (chosen.empty() || points < budget)) {
    const int i = -waiting.top().second;
    waiting.pop();
    const Node& node = nodes_[static_cast<std::size_t>(i)];
    if (!chosen.empty() && points + node.count > budget) break;
    chosen.push_back(i);
    points += node.count;
    for (const int child : node.children)
      if (child != 0) offer(child);
  }
  return chosen;
}

std::optional<std::size_t> CloudOctree::pointAt(const Camera& camera, const QSizeF& size, const QPointF& pixel,
                                                double radius_px,
                                                const std::function<bool(const Eigen::Vector3d&)>& shown) const {
  constexpr double as_near_px = 1.5;
  double nearest = radius_px;
  double depth = 1e300;
  std::optional<std::size_t> best;
  std::vector<int> waiting;
  if (!nodes_.empty()) waiting.push_back(0);
  while (!waiting.empty()) {
    const Node& node = nodes_[static_cast<std::size_t>(waiting.back())];
    waiting.pop_back();
    if (!frameOf(node, camera, size).adjusted(-radius_px, -radius_px, radius_px, radius_px).contains(pixel)) continue;
    for (std::size_t k = node.first; k < node.first + node.count; ++k) {
      const Eigen::Vector3d p = at(order_[k]).cast<double>();
      const auto seen = camera.project(p, size);
      if (!seen) continue;
      const double distance = std::hypot(seen->x() - pixel.x(), seen->y() - pixel.y());
      if (distance > radius_px || !shown(p)) continue;
      const double z = camera.depth_mm(p);
      if (!best || distance < nearest - as_near_px || (distance < nearest + as_near_px && z < depth)) {
        nearest = std::min(nearest, distance);
        depth = z;
        best = order_[k];
      }
    }
    for (const int child : node.children)
      if (child != 0) waiting.push_back(child);
  }
  return best;
}

}  // namespace spindrift::gui
