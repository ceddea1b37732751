// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/cloud.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/math/statistics.h"
#include "core/scanning/robust_box.h"

namespace spindrift {
namespace {

std::string label(const PointCloud& cloud) {
  return cloud.name.empty() ? "The cloud" : cloud.name;
}

}  // namespace

Eigen::Vector3d PointCloud::centroid_mm() const {
  SPINDRIFT_ASSERT(!points_mm.empty(), "the centroid of an empty cloud does not exist");
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points_mm) sum += p;
  return sum / static_cast<double>(points_mm.size());
}

void findProfiles(PointCloud& cloud) {
  cloud.profile_start.clear();
  const std::size_t n = cloud.size();
  if (n < 12) return;
  const auto& p = cloud.points_mm;
  // A profile runs along x in one direction; at its end x jumps back by much more than a spacing.
  std::size_t forward = 0;
  for (std::size_t i = 1; i < n; ++i) forward += p[i].x() > p[i - 1].x() ? 1U : 0U;
  const double sign = 2 * forward >= n ? 1.0 : -1.0;
  std::vector<std::size_t> start{0};
  for (std::size_t i = 1; i < n; ++i)
    if (sign * (p[i].x() - p[i - 1].x()) < 0.0) start.push_back(i);
  if (start.size() < 3 || n < 4 * start.size()) return;
  // Points of one profile share one carriage position (to a tenth of the distance between profiles).
  const double distance = std::abs(p[start.back()].y() - p[start.front()].y()) / static_cast<double>(start.size() - 1);
  std::size_t scattered = 0;
  for (std::size_t k = 0; k < start.size(); ++k) {
    const std::size_t end = k + 1 < start.size() ? start[k + 1] : n;
    double low = p[start[k]].y();
    double high = low;
    for (std::size_t i = start[k]; i < end; ++i) {
      low = std::min(low, p[i].y());
      high = std::max(high, p[i].y());
    }
    if (high - low > 0.1 * distance) ++scattered;
  }
  if (20 * scattered > start.size()) return;
  start.push_back(n);
  cloud.profile_start = std::move(start);
}

CloudSpacing cloudSpacing(const PointCloud& cloud) {
  CloudSpacing spacing;
  if (cloud.size() < 4) return spacing;
  if (cloud.profileCount() >= 3) {
    std::vector<double> along;
    std::vector<double> between;
    const std::size_t step = std::max<std::size_t>(1, cloud.profileCount() / 200);
    for (std::size_t k = 0; k < cloud.profileCount(); k += step) {
      const std::size_t first = cloud.profile_start[k];
      const std::size_t end = cloud.profile_start[k + 1];
      for (std::size_t i = first + 1; i < end; i += 7)
        along.push_back(std::abs(cloud.points_mm[i].x() - cloud.points_mm[i - 1].x()));
    }
    for (std::size_t k = 1; k < cloud.profileCount(); ++k)
      between.push_back(
          std::abs(cloud.points_mm[cloud.profile_start[k]].y() - cloud.points_mm[cloud.profile_start[k - 1]].y()));
    spacing.along_profile_mm = along.empty() ? 0.0 : median(std::move(along));
    // The mean keeps step over the whole scan; lost profiles make it deviate from the median.
    const double typical = median(between);
    double sum = 0.0, count = 0.0;
    for (const double d : between)
      if (d > 0.5 * typical && d < 1.5 * typical) {
        sum += d;
        count += 1.0;
      }
    spacing.between_profiles_mm = count > 0.0 ? sum / count : typical;
  }
  if (!(spacing.along_profile_mm > 0.0) || !(spacing.between_profiles_mm > 0.0)) {
    const RobustBox e = robustExtent(cloud);
    const Eigen::Vector3d size = e.high - e.low;
    const double area = std::max(size.x() * size.y(), 1e-12);
    spacing.along_profile_mm = spacing.between_profiles_mm = std::sqrt(area / static_cast<double>(cloud.size()));
  }
  return spacing;
}

PointCloud masked(const PointCloud& cloud, const CloudMask& keep) {
  SPINDRIFT_ASSERT(keep.size() == cloud.size(), "a mask has one entry per point");
  PointCloud out;
  out.name = cloud.name;
  out.points_mm.reserve(cloud.size());
  if (cloud.profile_start.empty()) {
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (keep[i] != 0) out.points_mm.push_back(cloud.points_mm[i]);
    return out;
  }
  for (std::size_t k = 0; k < cloud.profileCount(); ++k) {
    const std::size_t before = out.size();
    for (std::size_t i = cloud.profile_start[k]; i < cloud.profile_start[k + 1]; ++i)
      if (keep[i] != 0) out.points_mm.push_back(cloud.points_mm[i]);
    if (out.size() > before) out.profile_start.push_back(before);
  }
  if (!out.empty()) out.profile_start.push_back(out.size());
  return out;
}

/// About 1,000 of the points lie on one straight line, to a millionth of its length.
bool isStraightLine(const PointCloud& cloud) {
  const std::size_t stride = cloud.size() / 1000 + 1;
  const Eigen::Vector3d& first = cloud.points_mm.front();
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < cloud.size(); i += stride) {
    const Eigen::Vector3d d = cloud.points_mm[i] - first;
    if (d.squaredNorm() > along.squaredNorm()) along = d;
  }
  const double length = along.norm();
  for (std::size_t i = 0; i < cloud.size(); i += stride)
    if (along.cross(cloud.points_mm[i] - first).norm() > 1e-6 * length * length) return false;
  return true;
}

void requireUsableCloud(const PointCloud& cloud, std::size_t least_points) {
  if (cloud.empty()) throw InputError(fmt::format("{} holds no points.", label(cloud)));
  if (cloud.size() < least_points)
    throw InputError(
        fmt::format("{} holds only {} points; at least {} are needed.", label(cloud), cloud.size(), least_points));
  const auto infinite = std::find_if(cloud.points_mm.begin(), cloud.points_mm.end(),
                                     [](const Eigen::Vector3d& p) { return !p.allFinite(); });
  if (infinite != cloud.points_mm.end())
    throw InputError(fmt::format("Point {} of {} is not finite ({}, {}, {}); allowed: finite coordinates in mm.",
                                 infinite - cloud.points_mm.begin() + 1, label(cloud), infinite->x(), infinite->y(),
                                 infinite->z()));
  const RobustBox e = robustExtent(cloud);
  const Eigen::Vector3d size = e.high - e.low;
  if (!(std::max(size.x(), size.y()) > 0.0))
    throw InputError(fmt::format("{} has no extent in x and y: all points lie at one place.", label(cloud)));
  if (isStraightLine(cloud))
    throw InputError(fmt::format("{} is a straight line: its points determine no surface.", label(cloud)));
  const double width = std::max(size.x(), size.y());
  if (width > 2000.0)
    throw InputError(fmt::format("{} is {:.4g} wide, which is implausible in mm: the unit seems to be µm; allowed: mm.",
                                 label(cloud), width));
  if (width < 0.2)
    throw InputError(fmt::format("{} is {:.2g} wide, which is implausible in mm: the unit seems to be m; allowed: mm.",
                                 label(cloud), width));
  if (size.z() > 100.0 * std::max(size.x(), 1e-9) && size.z() > 200.0)
    throw InputError(fmt::format(
        "{} is {:.3g} wide and {:.3g} high: its heights seem to be in µm and its x, y in mm; allowed: mm everywhere.",
        label(cloud), width, size.z()));
}

}  // namespace spindrift
