// SPDX-License-Identifier: Apache-2.0
// A field (heat map): one component of a model, of observations or of a residual over a plane of the working space.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/machine/component.h"
#include "core/machine/error_model.h"

namespace spindrift {

/// A regular grid in a plane of MCF, nodes on the edges. nx, ny >= 2. The plane is z = const; with `normal_axis` 0 or 1
/// it is x or y = const, and "x" and "y" of the grid are the remaining axes in the order XYZ, "z" the level.
struct FieldGrid {
  double x_from_mm = 0.0;
  double x_to_mm = 0.0;
  double y_from_mm = 0.0;
  double y_to_mm = 0.0;
  double z_mm = 0.0;
  int nx = 41;
  int ny = 41;
  int normal_axis = 2;  ///< 0 X, 1 Y, 2 Z

  /// A place of the plane in MCF; `out_mm` off the plane along its normal.
  [[nodiscard]] Eigen::Vector3d place_mm(double x_mm, double y_mm, double out_mm = 0.0) const {
    Eigen::Vector3d place;
    place(normal_axis) = z_mm + out_mm;
    place(firstAxis()) = x_mm;
    place(secondAxis()) = y_mm;
    return place;
  }
  [[nodiscard]] int firstAxis() const { return normal_axis == 0 ? 1 : 0; }
  [[nodiscard]] int secondAxis() const { return normal_axis == 2 ? 1 : 2; }
  [[nodiscard]] double x_mm(int ix) const { return x_from_mm + (x_to_mm - x_from_mm) * ix / (nx - 1); }
  [[nodiscard]] double y_mm(int iy) const { return y_from_mm + (y_to_mm - y_from_mm) * iy / (ny - 1); }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
  [[nodiscard]] std::size_t index(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(ix);
  }
};

/// Values on the grid, row by row (x fastest), um or urad. `extrapolated` marks nodes outside the convex hull of the
/// measured points (in x, y).
struct Field {
  FieldGrid grid;
  Component component = Component::EX;
  std::vector<double> value;
  std::vector<double> sigma;
  std::vector<bool> extrapolated;
  /// Measured points to be drawn on top.
  struct Marker {
    std::string point;
    Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
    double value = 0.0;
    double sigma = 0.0;
    bool used = true;  ///< took part in the fit
  };
  std::vector<Marker> markers;

  /// Largest |value| over nodes and markers, for a symmetric colour scale.
  [[nodiscard]] double largestMagnitude() const;
  /// CSV of FORMATS.md: x_mm,y_mm,z_mm,component,value,sigma,extrapolated.
  [[nodiscard]] std::string csv() const;
};

/// Evaluates a model over a grid. `measured_xy_mm` span the region in which the model is not extrapolated.
[[nodiscard]] Field evaluateField(const ErrorModel& model, const FieldGrid& grid, Component component,
                                  const DeviationQuery& conditions, const std::vector<Eigen::Vector2d>& measured_xy_mm);

/// Convex hull (counter-clockwise) and test; a point within `tolerance_mm` of the border counts as inside.
[[nodiscard]] std::vector<Eigen::Vector2d> convexHull(std::vector<Eigen::Vector2d> points);
[[nodiscard]] bool insideHull(const std::vector<Eigen::Vector2d>& hull, const Eigen::Vector2d& point,
                              double tolerance_mm = 1e-6);

}  // namespace spindrift
