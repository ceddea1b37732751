// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/small_error.h"

namespace spindrift {

SmallError SmallError::at(const Eigen::Vector3d& lever_mm) const {
  return {translation_mm + rotation_rad.cross(lever_mm), rotation_rad};
}

SmallError& SmallError::operator+=(const SmallError& other) {
  translation_mm += other.translation_mm;
  rotation_rad += other.rotation_rad;
  return *this;
}

SmallError& SmallError::operator-=(const SmallError& other) {
  translation_mm -= other.translation_mm;
  rotation_rad -= other.rotation_rad;
  return *this;
}

SmallError SmallError::fromTransform(const RigidTransform& near_identity) {
  return {near_identity.translation_mm(), near_identity.rotationVector_rad()};
}

}  // namespace spindrift
