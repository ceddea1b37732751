// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/artefact_surface.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "core/base/error.h"
#include "core/base/printed_number.h"

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
  // Beyond these no machine holds the part and no computation with it stays finite.
  constexpr double least_mm = 1e-3;
  constexpr double most_mm = 1e4;
  constexpr double most_per_mm = 1e4;
  const auto require = [](std::string_view what, double value, double least, double most, std::string_view unit) {
    if (!(value >= least && value <= most))
      throw InputError(fmt::format("{}: found {} {}; allowed: {:g} to {:g}.", what, printed(value), unit,
                                   printed(least), printed(most)));
  };
  require("Size of the artefact in x", size_mm.x(), least_mm, most_mm, "mm");
  require("Size of the artefact in y", size_mm.y(), least_mm, most_mm, "mm");
  for (const double amplitude : {amplitude_x_mm, amplitude_y_mm, amplitude_xy_mm})
    require("Amplitude of the surface", amplitude, -most_mm, most_mm, "mm");
  for (const double wave_number : {wave_number_x_per_mm, wave_number_y_per_mm})
    require("Wave number of the surface", wave_number, 0.0, most_per_mm, "rad/mm");
  for (const Bump& b : bumps) {
    require("Radius of a bump", b.radius_mm, least_mm, most_mm, "mm");
    require("Height of a bump", b.height_mm, -most_mm, most_mm, "mm");
    for (const double place : b.centre_mm) require("Place of a bump", place, -most_mm, most_mm, "mm");
  }
}

}  // namespace spindrift
