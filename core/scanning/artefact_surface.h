// SPDX-License-Identifier: Apache-2.0
// The free-form top surface of an artefact for the laser profiler.
//
// P3 (4): z = sin(3/5 x) + 5/2 sin(1/6 y), x in [0, 11], y in [0, 41] mm, swept (so the two curves add). Variants:
// other amplitudes and wave numbers, a phase, and round bumps that make the surface unique (a purely periodic one fits
// again after a shift by one period).
#pragma once

#include <Eigen/Core>
#include <vector>

namespace spindrift {

struct ArtefactSurface {
  /// z += height exp(-((x - x0)^2 + (y - y0)^2) / (2 radius^2)).
  struct Bump {
    Eigen::Vector2d centre_mm = Eigen::Vector2d::Zero();
    double radius_mm = 2.0;
    double height_mm = 0.5;
  };
  Eigen::Vector2d size_mm{11.0, 41.0};
  double amplitude_x_mm = 1.0;
  double wave_number_x_per_mm = 0.6;
  double amplitude_y_mm = 2.5;
  double wave_number_y_per_mm = 1.0 / 6.0;
  /// Additional product term: amplitude_xy sin(kx x + ky y), 0 in the paper.
  double amplitude_xy_mm = 0.0;
  std::vector<Bump> bumps;

  /// Height (mm) at (x, y) in the artefact's frame: origin at its corner.
  [[nodiscard]] double height_mm(double x_mm, double y_mm) const;
  /// (dz/dx, dz/dy).
  [[nodiscard]] Eigen::Vector2d gradient(double x_mm, double y_mm) const;
  [[nodiscard]] bool contains(double x_mm, double y_mm) const noexcept {
    return x_mm >= 0.0 && y_mm >= 0.0 && x_mm <= size_mm.x() && y_mm <= size_mm.y();
  }
  /// Throws InputError for sizes or wave numbers that make no sense.
  void validate() const;
};

}  // namespace spindrift
