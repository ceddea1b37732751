// SPDX-License-Identifier: Apache-2.0
// A small error of a machine: three translations (mm) and three rotations (rad) at a stated point, first order only.
//
// FORMATS.md: a rotation (EA, EB, EC) about X, Y, Z at the origin moves a point (x, y, z) by
// ex = EX - EC*y + EB*z, ey = EY + EC*x - EA*z, ez = EZ - EB*x + EA*y. Errors of this type add; they do not compose
// like rigid motions (the product terms, 1e-4 * 1e-4, are far below any instrument).
#pragma once

#include <Eigen/Core>

#include "core/geometry/rigid_transform.h"

namespace spindrift {

struct SmallError {
  Eigen::Vector3d translation_mm = Eigen::Vector3d::Zero();  ///< EX, EY, EZ
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();    ///< EA, EB, EC

  /// The same error stated at a point that lies `lever_mm` away from the present one.
  [[nodiscard]] SmallError at(const Eigen::Vector3d& lever_mm) const;

  SmallError& operator+=(const SmallError& other);
  SmallError& operator-=(const SmallError& other);
  [[nodiscard]] friend SmallError operator+(SmallError a, const SmallError& b) { return a += b; }
  [[nodiscard]] friend SmallError operator-(SmallError a, const SmallError& b) { return a -= b; }
  [[nodiscard]] friend SmallError operator*(double factor, const SmallError& e) {
    return {factor * e.translation_mm, factor * e.rotation_rad};
  }
  [[nodiscard]] SmallError operator-() const { return {-translation_mm, -rotation_rad}; }

  /// First-order error of a motion near identity, at the origin.
  [[nodiscard]] static SmallError fromTransform(const RigidTransform& near_identity);
};

}  // namespace spindrift
