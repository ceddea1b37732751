// SPDX-License-Identifier: Apache-2.0
#include "core/machine/field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace spindrift {
namespace {

double cross(const Eigen::Vector2d& o, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return (a - o).x() * (b - o).y() - (a - o).y() * (b - o).x();
}

}  // namespace

double Field::largestMagnitude() const {
  double largest = 0.0;
  for (const double v : value) {
    if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
  }
  for (const Marker& marker : markers) largest = std::max(largest, std::abs(marker.value));
  return largest;
}

std::string Field::csv() const {
  std::string text = "x_mm,y_mm,z_mm,component,value,sigma,extrapolated\n";
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      const std::size_t i = grid.index(ix, iy);
      const Eigen::Vector3d p = grid.place_mm(grid.x_mm(ix), grid.y_mm(iy));
      text += fmt::format("{},{},{},{},{},{},{}\n", p.x(), p.y(), p.z(), toString(component), value[i], sigma[i],
                          extrapolated[i] ? 1 : 0);
    }
  }
  return text;
}

Field evaluateField(const ErrorModel& model, const FieldGrid& grid, Component component,
                    const DeviationQuery& conditions, const std::vector<Eigen::Vector2d>& measured_xy_mm) {
  SPINDRIFT_ASSERT(grid.nx >= 2 && grid.ny >= 2, "a field needs at least two nodes a side");
  Field field;
  field.grid = grid;
  field.component = component;
  field.value.resize(grid.size());
  field.sigma.resize(grid.size());
  field.extrapolated.resize(grid.size());
  const std::vector<Eigen::Vector2d> hull = convexHull(measured_xy_mm);
  DeviationQuery query = conditions;
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      query.position_mm = grid.place_mm(grid.x_mm(ix), grid.y_mm(iy));
      const PredictedComponent predicted = model.predict(query, component);
      const std::size_t i = grid.index(ix, iy);
      field.value[i] = predicted.value;
      field.sigma[i] = predicted.sigma;
      field.extrapolated[i] = !insideHull(hull, query.position_mm.head<2>());
    }
  }
  return field;
}

std::vector<Eigen::Vector2d> convexHull(std::vector<Eigen::Vector2d> points) {
  // Andrew's monotone chain.
  std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Eigen::Vector2d> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = hull.size();
    for (const Eigen::Vector2d& p : points) {
      while (hull.size() >= start + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

bool insideHull(const std::vector<Eigen::Vector2d>& hull, const Eigen::Vector2d& point, double tolerance_mm) {
  if (hull.empty()) return false;
  if (hull.size() == 1) return (point - hull[0]).norm() <= tolerance_mm;
  if (hull.size() == 2) {
    const Eigen::Vector2d d = hull[1] - hull[0];
    const double along = std::clamp((point - hull[0]).dot(d) / d.squaredNorm(), 0.0, 1.0);
    return (point - hull[0] - along * d).norm() <= tolerance_mm;
  }
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d& a = hull[i];
    const Eigen::Vector2d& b = hull[(i + 1) % hull.size()];
    if (cross(a, b, point) < -tolerance_mm * (b - a).norm()) return false;
  }
  return true;
}

}  // namespace spindrift
