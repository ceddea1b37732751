// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/artefact_surface.h"

#include <cmath>

#include "core/base/error.h"

namespace spindrift {

double ArtefactSurface::height_mm(double x_mm, double y_mm) const {
  double z =
      amplitude_x_mm * std::sin(wave_number_x_per_mm * x_mm) + amplitude_y_mm * std::sin(wave_number_y_per_mm * y_mm);
  if (amplitude_xy_mm != 0.0)
    z += amplitude_xy_mm * std::sin(wave_number_x_per_mm * x_mm + wave_number_y_per_mm * y_mm);
  for (const Bump& b : bumps) {
    const double dx = x_mm - b.centre_mm.x();
    const double dy = y_mm - b.centre_mm.y();
    z += b.height_mm * std::exp(-(dx * dx + dy * dy) / (2.0 * b.radius_mm * b.radius_mm));
  }
  return z;
}

Eigen::Vector2d ArtefactSurface::gradient(double x_mm, double y_mm) const {
  Eigen::Vector2d g{amplitude_x_mm * wave_number_x_per_mm * std::cos(wave_number_x_per_mm * x_mm),
                    amplitude_y_mm * wave_number_y_per_mm * std::cos(wave_number_y_per_mm * y_mm)};
  if (amplitude_xy_mm != 0.0)
    g += amplitude_xy_mm * std::cos(wave_number_x_per_mm * x_mm + wave_number_y_per_mm * y_mm) *
         Eigen::Vector2d(wave_number_x_per_mm, wave_number_y_per_mm);
  for (const Bump& b : bumps) {
    const Eigen::Vector2d d = Eigen::Vector2d(x_mm, y_mm) - b.centre_mm;
    const double r2 = b.radius_mm * b.radius_mm;
    g -= b.height_mm * std::exp(-d.squaredNorm() / (2.0 * r2)) / r2 * d;
  }
  return g;
}

void ArtefactSurface::validate() const {
  if (!(size_mm.minCoeff() > 0.0) || !size_mm.allFinite())
    throw InputError("The size of the artefact must be positive in x and y (mm).");
  for (const double value :
       {amplitude_x_mm, amplitude_y_mm, amplitude_xy_mm, wave_number_x_per_mm, wave_number_y_per_mm}) {
    if (!std::isfinite(value))
      throw InputError(
          "An amplitude or wave number of the surface is not a number; allowed: finite numbers (mm, rad/mm).");
  }
  if (!(wave_number_x_per_mm >= 0.0) || !(wave_number_y_per_mm >= 0.0))
    throw InputError("The wave numbers of the surface must not be negative (rad/mm).");
  for (const Bump& b : bumps)
    if (!(b.radius_mm > 0.0)) throw InputError("The radius of a bump must be positive (mm).");
}

}  // namespace spindrift
