// SPDX-License-Identifier: Apache-2.0
// P4 (7)-(10) as printed: rotation of the head from the movements of three stylus centres, and the spindle drift.
//
// x_i, y_i, z_i: position of stylus centre i from the centre of rotation; o before, n after the machine warmed up. As
// algebra (7)-(9) are right for a small rotation a: n = o + a x o, when stylus 0 lies on the axis (x0 = y0 = 0 is not
// needed) and the equations used are independent. They ignore every translation: a displacement t of all three centres
// is taken for a rotation; the least squares of ball_cycle.h has no such bias. mm, rad.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "core/base/error.h"

namespace spindrift {

using StylusCentres = std::array<Eigen::Vector3d, 3>;

struct HeadRotation {
  FitStatus status = FitStatus::NotRun;
  std::string message = "not run";
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();
};

/// (7)-(9). Degenerate (with the name of the angle) if a denominator vanishes for the given styli.
[[nodiscard]] HeadRotation closedFormRotation(const StylusCentres& before_mm, const StylusCentres& after_mm);

/// (10): distance that the centre of stylus 0 has moved, mm.
[[nodiscard]] double spindleDrift(const Eigen::Vector3d& before_mm, const Eigen::Vector3d& after_mm);

}  // namespace spindrift
