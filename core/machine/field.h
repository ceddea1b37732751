// SPDX-License-Identifier: Apache-2.0
// A field (heat map): one component of a model, of observations or of a residual over a plane of the working space.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/machine/component.h"
#include "core/machine/error_model.h"

namespace spindrift {

/// A regular grid in a plane z = const of MCF, nodes on the edges. nx, ny >= 2.
struct FieldGrid {
  double x_from_mm = 0.0;
  double x_to_mm = 0.0;
  double y_from_mm = 0.0;
  double y_to_mm = 0.0;
  double z_mm = 0.0;
  int nx = 41;
  int ny = 41;

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
