// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/robust_box.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace spindrift {

RobustBox robustExtent(const PointCloud& cloud) {
  constexpr std::uint64_t most = 20000;
  // Odd steps far through the cloud: a stride that is a whole number of profiles would see a single place of them.
  constexpr std::uint64_t golden = 2654435761U;
  const std::uint64_t count = std::min<std::uint64_t>(most, cloud.size());
  RobustBox extent;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    values.reserve(count);
    for (std::uint64_t k = 0; k < count; ++k) {
      const std::uint64_t i = cloud.size() > most ? k * golden % cloud.size() : k;
      values.push_back(cloud.points_mm[i][axis]);
    }
    const auto at = [&](double p) {
      const auto k = static_cast<std::ptrdiff_t>(p * static_cast<double>(values.size() - 1));
      std::nth_element(values.begin(), values.begin() + k, values.end());
      return values[static_cast<std::size_t>(k)];
    };
    extent.low[axis] = at(0.01);
    extent.high[axis] = at(0.99);
  }
  return extent;
}

RobustBox plausibleBox(const PointCloud& cloud) {
  RobustBox box = robustExtent(cloud);
  const Eigen::Vector3d size = box.high - box.low;
  box.low -= size;
  box.high += size;
  return box;
}

}  // namespace spindrift
