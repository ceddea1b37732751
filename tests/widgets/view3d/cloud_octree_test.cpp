// SPDX-License-Identifier: GPL-3.0-or-later
// Every point of a cloud is in one box of the octree, its upper levels look like the whole, and what a camera does not
// see is not drawn.
#include "widgets/view3d/cloud_octree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/random.h"

namespace spindrift::gui {
namespace {

const std::atomic<bool> never = false;
constexpr std::size_t everything = std::numeric_limits<std::size_t>::max();

std::shared_ptr<std::vector<float>> sheet(std::size_t count) {
  Random random(3);
  auto xyz = std::make_shared<std::vector<float>>();
  for (std::size_t i = 0; i < count; ++i) {
    const double x = random.uniform(0, 300);
    const double y = random.uniform(0, 130);
    for (const double v : {x, y, 0.01 * x * y / 130}) xyz->push_back(static_cast<float>(v));
  }
  return xyz;
}

Camera cameraAbove(const QSizeF& size) {
  Camera camera;
  camera.look(StandardView::Top);
  camera.fit({0, 0, 0}, {300, 130, 3}, size);
  return camera;
}

TEST(CloudOctree, HoldsEveryPointOnceInsideItsBox) {
  const auto xyz = sheet(200'000);
  const auto tree = CloudOctree::build(xyz, never);
  std::vector<std::uint32_t> order = tree->order();
  std::size_t points = 0;
  std::size_t largest = 0;
  for (const CloudOctree::Node& node : tree->nodes()) {
    points += node.count;
    largest = std::max(largest, node.count);
    for (std::size_t k = node.first; k < node.first + node.count; ++k) {
      const Eigen::Vector3f p = Eigen::Map<const Eigen::Vector3f>(xyz->data() + 3 * static_cast<std::size_t>(order[k]));
      ASSERT_TRUE((p.array() >= node.low_mm.array()).all() && (p.array() <= node.high_mm.array()).all());
    }
  }
  EXPECT_EQ(points, 200'000U);
  EXPECT_LE(largest, 2 * CloudOctree::points_per_node);
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
  const auto again = CloudOctree::build(xyz, never);
  EXPECT_EQ(again->order(), tree->order());
}

TEST(CloudOctree, ASmallBudgetCoversThePictureEvenly) {
  const auto xyz = sheet(400'000);
  const auto tree = CloudOctree::build(xyz, never);
  const QSizeF size(640, 320);
  const auto seen = tree->visible(cameraAbove(size), size, 40'000);
  std::size_t points = 0;
  std::array<int, 24> cells{};
  for (const int i : seen) {
    const CloudOctree::Node& node = tree->nodes()[static_cast<std::size_t>(i)];
    points += node.count;
    for (std::size_t k = node.first; k < node.first + node.count; ++k) {
      const float* p = xyz->data() + 3 * static_cast<std::size_t>(tree->order()[k]);
      ++cells[static_cast<std::size_t>(std::min(7, static_cast<int>(p[0] / 37.5F)) +
                                       8 * std::min(2, static_cast<int>(p[1] / 43.4F)))];
    }
  }
  EXPECT_LE(points, 40'000U);
  EXPECT_GT(points, 10'000U);
  for (const int cell : cells) EXPECT_GT(cell, static_cast<int>(points) / 24 / 4) << "a gap in the picture";
}

TEST(CloudOctree, SeesOnlyWhatIsInThePictureAndAllOfThat) {
  const auto xyz = sheet(400'000);
  const auto tree = CloudOctree::build(xyz, never);
  const QSizeF size(640, 320);
  Camera camera = cameraAbove(size);
  const auto count = [&](const std::vector<int>& nodes) {
    return std::accumulate(nodes.begin(), nodes.end(), std::size_t{0}, [&](std::size_t sum, int i) {
      return sum + tree->nodes()[static_cast<std::size_t>(i)].count;
    });
  };
  EXPECT_EQ(count(tree->visible(camera, size, everything)), 400'000U);
  for (const bool orthographic : {true, false}) {
    camera = cameraAbove(size);
    camera.orthographic = orthographic;
    camera.zoom(8.0, QPointF(200, 100), size);
    const auto nodes = tree->visible(camera, size, everything);
    EXPECT_LT(count(nodes), 150'000U);
    std::vector<bool> drawn(400'000, false);
    for (const int i : nodes) {
      const CloudOctree::Node& node = tree->nodes()[static_cast<std::size_t>(i)];
      for (std::size_t k = node.first; k < node.first + node.count; ++k) drawn[tree->order()[k]] = true;
    }
    const QRectF picture(QPointF(0, 0), size);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const auto at = camera.project(Eigen::Map<const Eigen::Vector3f>(xyz->data() + 3 * i).cast<double>(), size);
      if (at && picture.contains(*at)) {
        ASSERT_TRUE(drawn[i]) << i;
      }
    }
  }
}

TEST(CloudOctree, FindsThePointThatASearchOfAllFinds) {
  const auto xyz = sheet(60'000);
  const auto tree = CloudOctree::build(xyz, never);
  const QSizeF size(640, 320);
  const Camera camera = cameraAbove(size);
  const auto all = [](const Eigen::Vector3d&) { return true; };
  Random random(8);
  for (int k = 0; k < 40; ++k) {
    const QPointF pixel(random.uniform(20, 620), random.uniform(40, 280));
    const auto found = tree->pointAt(camera, size, pixel, 0.7, all);
    double nearest = 1e9;
    for (std::size_t i = 0; i < 60'000; ++i) {
      const auto at = camera.project(Eigen::Map<const Eigen::Vector3f>(xyz->data() + 3 * i).cast<double>(), size);
      nearest = std::min(nearest, std::hypot(at->x() - pixel.x(), at->y() - pixel.y()));
    }
    EXPECT_EQ(found.has_value(), nearest <= 0.7);
  }
  EXPECT_FALSE(tree->pointAt(camera, size, QPointF(320, 160), 6, [](const Eigen::Vector3d&) { return false; }));
}

TEST(CloudOctree, CloudsThatCannotBeDividedAndNone) {
  const auto one_place = std::make_shared<std::vector<float>>(3 * 100'000, 1.5F);
  const auto tree = CloudOctree::build(one_place, never);
  std::size_t points = 0;
  for (const CloudOctree::Node& node : tree->nodes()) points += node.count;
  EXPECT_EQ(points, 100'000U);
  EXPECT_TRUE(CloudOctree::build(std::make_shared<std::vector<float>>(), never)->nodes().empty());
  const std::atomic<bool> cancelled = true;
  EXPECT_EQ(CloudOctree::build(one_place, cancelled), nullptr);
}

}  // namespace
}  // namespace spindrift::gui
