// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "core/imaging/image_pose.h"

namespace spindrift::testing {

/// A pose that shows the FCF place `place_um` under the pixel `u_minus_c`, FCF turned by `orientation_rad` in the
/// camera.
inline ImagePose syntheticPose(double pixel_length_um, double orientation_rad, const Eigen::Vector2d& place_um,
                               const Eigen::Vector2d& u_minus_c) {
  ImagePose pose;
  pose.status = FitStatus::Converged;
  pose.a = std::cos(-orientation_rad) / pixel_length_um;
  pose.b = std::sin(-orientation_rad) / pixel_length_um;
  pose.centre_px = {959.5, 539.5};
  pose.marks = 40;
  Eigen::Matrix2d S;
  S << pose.a, -pose.b, pose.b, pose.a;
  pose.origin_px = u_minus_c - S * Eigen::Vector2d(place_um.x(), -place_um.y());
  return pose;
}

}  // namespace spindrift::testing
