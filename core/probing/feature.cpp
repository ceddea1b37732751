// SPDX-License-Identifier: Apache-2.0
#include "core/probing/feature.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spindrift {

bool isSurfaceTouch(const Touch& touch, const Eigen::Vector3d& axis) {
  return std::abs(touch.approach.dot(axis)) > 0.7;
}

SurfaceHeight fitSurfaceHeight(const TouchList& list, std::span<const std::size_t> indices,
                               const Eigen::Vector3d& normal, double stylus_radius_mm, double sigma_mm) {
  SurfaceHeight surface;
  if (indices.empty()) {
    surface.status = FitStatus::Degenerate;
    surface.message = "no touch on the surface; its height is open";
    return surface;
  }
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  double squares = 0.0;
  std::vector<double> heights;
  for (const std::size_t i : indices) {
    const Touch& t = list.touches[i];
    heights.push_back(normal.dot(t.position_mm + stylus_radius_mm * t.approach));
    low = std::min(low, heights.back());
    high = std::max(high, heights.back());
    surface.height_mm += heights.back();
  }
  const auto n = static_cast<double>(heights.size());
  surface.height_mm /= n;
  for (const double h : heights) squares += (h - surface.height_mm) * (h - surface.height_mm);
  surface.form_mm = high - low;
  surface.sigma_mm = sigma_mm > 0.0 ? sigma_mm / std::sqrt(n)
                     : n > 1.0      ? std::sqrt(squares / (n - 1.0) / n)
                                    : std::numeric_limits<double>::infinity();
  surface.status = FitStatus::Converged;
  surface.message = "converged";
  return surface;
}

ProbedFeature fitFeature(const TouchList& list, std::span<const std::size_t> indices, FeatureKind kind,
                         double stylus_radius_mm, const FeatureOptions& options) {
  SPINDRIFT_ASSERT(!indices.empty(), "a feature needs touches");
  SPINDRIFT_ASSERT(std::abs(options.axis.norm() - 1.0) < 1e-6, "the axis of a hole is a unit vector");
  ProbedFeature result;
  const Touch& first = list.touches[indices.front()];
  result.kind = kind;
  result.cycle = first.cycle;
  result.artefact = first.artefact;
  result.feature = first.feature;
  result.stylus = first.stylus;
  result.c_deg = first.c_deg;
  result.touches.assign(indices.begin(), indices.end());
  for (const std::size_t i : indices) result.time_s += list.touches[i].time_s / static_cast<double>(indices.size());

  ShapeFitOptions fit_options;
  fit_options.sigma_mm = options.sigma_mm;
  fit_options.tolerate_one_bad_point = options.tolerate_one_bad_touch;
  fit_options.outlier_threshold = options.outlier_threshold;
  fit_options.largest_amplification = options.largest_amplification;
  const double side = kind == FeatureKind::Sphere ? 1.0 : -1.0;  // the stylus is outside a sphere, inside a hole
  if (options.known_diameter_mm) {
    const double radius = 0.5 * *options.known_diameter_mm + side * stylus_radius_mm;
    if (!(radius > 0.0)) {
      result.status = FitStatus::Rejected;
      result.message = fmt::format("a stylus of radius {} mm does not fit into a hole of diameter {} mm",
                                   stylus_radius_mm, *options.known_diameter_mm);
      return result;
    }
    fit_options.known_radius_mm = radius;
  }
  const auto take = [&](const auto& fit, const std::vector<std::size_t>& used) {
    result.status = fit.status;
    result.message = fit.message;
    result.diameter_mm = 2.0 * (fit.radius_mm - side * stylus_radius_mm);
    const auto last = fit.covariance.rows() - 1;
    result.diameter_sigma_mm = 2.0 * std::sqrt(fit.covariance(last, last));
    result.form_mm = fit.form_mm;
    result.rms_mm = fit.rms_mm;
    if (fit.rejected >= 0) result.rejected = used[static_cast<std::size_t>(fit.rejected)];
  };
  if (kind == FeatureKind::Sphere) {
    std::vector<Eigen::Vector3d> points;
    Eigen::Vector3d start = Eigen::Vector3d::Zero();
    for (const std::size_t i : indices) points.push_back(list.touches[i].position_mm);
    if (fit_options.known_radius_mm) {
      for (const std::size_t i : indices) {
        start += (list.touches[i].position_mm + *fit_options.known_radius_mm * list.touches[i].approach) /
                 static_cast<double>(indices.size());
      }
      fit_options.start_mm = start;
    }
    const SphereFit fit = fitSphere(points, fit_options);
    take(fit, result.touches);
    result.centre_mm = fit.centre_mm;
    result.covariance = fit.covariance.topLeftCorner<3, 3>();
    result.weak = fit.weak.head<3>();
    result.has_wall = true;
    return result;
  }

  // Hole: wall across the axis, surface along it.
  const Eigen::Vector3d u = options.axis.unitOrthogonal();
  Eigen::Vector3d across_a = u;
  // Prefer machine axes, so that covariances read naturally.
  for (int k = 0; k < 3; ++k) {
    if (std::abs(options.axis(k)) < 1e-9) {
      across_a = Eigen::Vector3d::Unit(k);
      break;
    }
  }
  const Eigen::Vector3d across_b = options.axis.cross(across_a);
  std::vector<std::size_t> wall;
  std::vector<std::size_t> surface;
  for (const std::size_t i : indices) {
    (isSurfaceTouch(list.touches[i], options.axis) ? surface : wall).push_back(i);
  }
  double wall_height = 0.0;
  std::vector<Eigen::Vector2d> points;
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  for (const std::size_t i : wall) {
    const Eigen::Vector3d& p = list.touches[i].position_mm;
    points.emplace_back(across_a.dot(p), across_b.dot(p));
    wall_height += options.axis.dot(p) / static_cast<double>(wall.size());
    const Eigen::Vector3d centre = p - fit_options.known_radius_mm.value_or(0.0) * list.touches[i].approach;
    start += Eigen::Vector3d(across_a.dot(centre), across_b.dot(centre), 0.0) / static_cast<double>(wall.size());
  }
  if (fit_options.known_radius_mm) fit_options.start_mm = start;
  const CircleFit fit = fitCircle(points, fit_options);
  take(fit, wall);
  result.has_wall = fit.usable();
  Eigen::Matrix<double, 3, 2> frame;
  frame << across_a, across_b;
  result.centre_mm = frame * fit.centre_mm;
  result.covariance = frame * fit.covariance.topLeftCorner<2, 2>() * frame.transpose();
  result.weak = frame * fit.weak.head<2>();
  const SurfaceHeight height = fitSurfaceHeight(list, surface, options.axis, stylus_radius_mm, options.sigma_mm);
  result.has_surface = height.status == FitStatus::Converged;
  result.centre_mm += options.axis * (result.has_surface ? height.height_mm : wall_height);
  if (result.has_surface) {
    result.covariance += height.sigma_mm * height.sigma_mm * options.axis * options.axis.transpose();
  }
  return result;
}

}  // namespace spindrift
