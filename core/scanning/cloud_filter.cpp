// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "core/base/error.h"
#include "core/math/statistics.h"
#include "core/scanning/cloud.h"
#include "core/scanning/robust_box.h"

namespace spindrift {
namespace {

std::size_t trimEdges(const PointCloud& cloud, const CloudFilterOptions& options, CloudMask& keep) {
  const CloudSpacing spacing = cloudSpacing(cloud);
  const double gap = options.gap_factor * spacing.along_profile_mm;
  const double trim = options.edge_samples * spacing.along_profile_mm;
  std::size_t dropped = 0;
  const auto drop = [&](std::size_t i) {
    dropped += keep[i];
    keep[i] = 0;
  };
  std::vector<double> y_values;
  for (std::size_t k = 0; k < cloud.profileCount(); ++k)
    y_values.push_back(cloud.points_mm[cloud.profile_start[k]].y());
  const auto [y_low, y_high] = std::minmax_element(y_values.begin(), y_values.end());
  for (std::size_t k = 0; k < cloud.profileCount(); ++k) {
    const std::size_t first = cloud.profile_start[k];
    const std::size_t end = cloud.profile_start[k + 1];
    if (y_values[k] < *y_low + options.edge_distance_mm || y_values[k] > *y_high - options.edge_distance_mm) {
      for (std::size_t i = first; i < end; ++i) drop(i);
      continue;
    }
    // Edges of this profile: its ends, gaps, and lasting jumps (a jump of single points is an outlier, no edge).
    std::vector<double> edges{cloud.points_mm[first].x(), cloud.points_mm[end - 1].x()};
    constexpr std::size_t wide = 8;
    for (std::size_t i = first + 1; i < end; ++i) {
      const Eigen::Vector3d& a = cloud.points_mm[i - 1];
      const Eigen::Vector3d& b = cloud.points_mm[i];
      const bool open = std::abs(b.x() - a.x()) > gap;
      bool step = false;
      if (std::abs(b.z() - a.z()) > options.step_mm && i >= first + wide && i + wide <= end) {
        std::vector<double> before, after;
        for (std::size_t j = 0; j < wide; ++j) {
          before.push_back(cloud.points_mm[i - 1 - j].z());
          after.push_back(cloud.points_mm[i + j].z());
        }
        step = std::abs(median(before) - median(after)) > options.step_mm;
      }
      if (open || step) {
        edges.push_back(a.x());
        edges.push_back(b.x());
      }
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = first; i < end; ++i) {
      const double x = cloud.points_mm[i].x();
      const auto right = std::lower_bound(edges.begin(), edges.end(), x);
      double distance = right == edges.end() ? 0.0 : *right - x;
      if (right != edges.begin()) distance = std::min(distance, x - *(right - 1));
      if (distance < trim) drop(i);
    }
  }
  return dropped;
}

/// Weighted plane z = a + b x + c y; false if the points do not span one.
bool fitPlane(const std::vector<Eigen::Vector3d>& points, const std::vector<double>& weights, Eigen::Vector3d& plane) {
  Eigen::Matrix3d n = Eigen::Matrix3d::Zero();
  Eigen::Vector3d r = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d row(1.0, points[i].x(), points[i].y());
    n += weights[i] * row * row.transpose();
    r += weights[i] * points[i].z() * row;
  }
  n.diagonal() += Eigen::Vector3d(0.0, 1e-9, 1e-9) * std::max(n(0, 0), 1e-12);
  const Eigen::LDLT<Eigen::Matrix3d> ldlt(n);
  if (ldlt.info() != Eigen::Success) return false;
  plane = ldlt.solve(r);
  return plane.allFinite();
}

std::size_t dropOutliers(const PointCloud& cloud, const CloudFilterOptions& options, CloudMask& keep) {
  const CloudSpacing spacing = cloudSpacing(cloud);
  const double cell = options.cell_mm > 0.0
                          ? options.cell_mm
                          : std::max(std::sqrt(60.0 * spacing.along_profile_mm * spacing.between_profiles_mm), 1e-6);
  double x_low = 1e300, x_high = -1e300, y_low = 1e300, y_high = -1e300;
  const RobustBox plausible = plausibleBox(cloud);
  std::size_t stray = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (keep[i] == 0) continue;
    if (!isInside(plausible, cloud.points_mm[i])) {
      keep[i] = 0;
      ++stray;
      continue;
    }
    x_low = std::min(x_low, cloud.points_mm[i].x());
    x_high = std::max(x_high, cloud.points_mm[i].x());
    y_low = std::min(y_low, cloud.points_mm[i].y());
    y_high = std::max(y_high, cloud.points_mm[i].y());
  }
  if (x_high < x_low) return stray;
  const auto columns = static_cast<std::size_t>(std::min((x_high - x_low) / cell, 20000.0)) + 1;
  const auto rows = static_cast<std::size_t>(std::min((y_high - y_low) / cell, 20000.0)) + 1;
  if (columns * rows > 50 * cloud.size() + 1000)
    return stray;  // a cloud that is no height map: nothing local to compare
  // Points sorted by cell (counting sort).
  const auto cellOf = [&](const Eigen::Vector3d& p) {
    const auto c = std::min(static_cast<std::size_t>((p.x() - x_low) / cell), columns - 1);
    const auto r = std::min(static_cast<std::size_t>((p.y() - y_low) / cell), rows - 1);
    return r * columns + c;
  };
  std::vector<std::uint32_t> start(columns * rows + 1, 0);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (keep[i] != 0) ++start[cellOf(cloud.points_mm[i]) + 1];
  for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
  std::vector<std::uint32_t> order(start.back());
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (keep[i] != 0) order[next[cellOf(cloud.points_mm[i])]++] = static_cast<std::uint32_t>(i);

  std::vector<float> residual(order.size(), 0.0F);
  std::vector<double> spread;
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights, sizes;
  for (std::size_t c = 0; c + 1 < start.size(); ++c) {
    const std::size_t count = start[c + 1] - start[c];
    if (count < 6) {
      for (std::size_t k = start[c]; k < start[c + 1]; ++k) residual[k] = count < 3 ? 1e30F : 0.0F;
      continue;
    }
    points.clear();
    const Eigen::Vector3d origin = cloud.points_mm[order[start[c]]];
    for (std::size_t k = start[c]; k < start[c + 1]; ++k) points.push_back(cloud.points_mm[order[k]] - origin);
    // Median height as the start, then reweighted planes.
    std::vector<double> z;
    for (const auto& p : points) z.push_back(p.z());
    Eigen::Vector3d plane(median(z), 0.0, 0.0);
    double scale = 0.0;
    for (int iteration = 0; iteration < 6; ++iteration) {
      sizes.clear();
      for (const auto& p : points) sizes.push_back(std::abs(p.z() - plane.dot(Eigen::Vector3d(1.0, p.x(), p.y()))));
      scale = std::max(1.4826 * median(sizes), 1e-9);
      weights.clear();
      for (const double s : sizes) {
        const double t = s / (4.0 * scale);
        weights.push_back(t < 1.0 ? (1.0 - t * t) * (1.0 - t * t) : 0.0);
      }
      if (!fitPlane(points, weights, plane)) break;
    }
    for (std::size_t k = 0; k < points.size(); ++k)
      residual[start[c] + k] =
          static_cast<float>(std::abs(points[k].z() - plane.dot(Eigen::Vector3d(1.0, points[k].x(), points[k].y()))));
    spread.push_back(scale);
  }
  if (spread.empty()) return stray;
  const double typical = median(spread);
  std::size_t dropped = stray;
  std::size_t s = 0;
  for (std::size_t c = 0; c + 1 < start.size(); ++c) {
    // A cell may be rougher than most (curvature, a rim): its own spread counts up to three times the typical one.
    const bool fitted = start[c + 1] - start[c] >= 6;
    const double scale = fitted ? std::clamp(spread[s++], typical, 3.0 * typical) : typical;
    for (std::size_t k = start[c]; k < start[c + 1]; ++k)
      if (residual[k] > options.outlier_threshold * scale) {
        keep[order[k]] = 0;
        ++dropped;
      }
  }
  return dropped;
}

}  // namespace

void CloudFilterOptions::validate() const {
  if (edge_samples < 0) throw InputError("The number of samples trimmed at an edge must not be negative.");
  if (!(gap_factor > 1.0)) throw InputError("A gap must be longer than one spacing.");
  if (!(step_mm > 0.0)) throw InputError("The height of a step must be positive (mm).");
  if (!(edge_distance_mm >= 0.0)) throw InputError("The distance trimmed at an edge must not be negative (mm).");
  if (!(outlier_threshold > 0.0)) throw InputError("The threshold for outliers must be positive.");
  if (!(cell_mm >= 0.0)) throw InputError("The width of a cell must not be negative (mm).");
}

CloudFilterResult filterCloud(const PointCloud& cloud, const CloudFilterOptions& options) {
  options.validate();
  CloudFilterResult result;
  result.keep.assign(cloud.size(), 1);
  result.fate.assign(cloud.size(), PointFate::Used);
  const auto note = [&result](PointFate fate) {
    for (std::size_t i = 0; i < result.keep.size(); ++i)
      if (result.keep[i] == 0 && result.fate[i] == PointFate::Used) result.fate[i] = fate;
  };
  if (cloud.profileCount() >= 3) result.edge_points = trimEdges(cloud, options, result.keep);
  note(PointFate::Edge);
  result.outlier_points = dropOutliers(cloud, options, result.keep);
  note(PointFate::Outlier);
  return result;
}

}  // namespace spindrift
