// SPDX-License-Identifier: Apache-2.0
// A rigid motion between two named frames: p_in_target = R * p_in_source + t. Lengths in mm. Not for small errors: a
// deviation of the machine is a SmallError.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace spindrift {

/// Variables are named `target_from_source`, so that a product reads right when neighbours match:
/// a_from_c = a_from_b * b_from_c. R is a proper rotation; the constructors check it.
class RigidTransform {
 public:
  /// Identity.
  RigidTransform() = default;
  /// Throws InternalError if `rotation` is not a rotation (|R^T R - I| > 1e-6 or det < 0).
  RigidTransform(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation_mm);
  explicit RigidTransform(const Eigen::Vector3d& translation_mm) : translation_mm_(translation_mm) {}
  /// From a 4 x 4 matrix as FORMATS.md writes it (last row 0 0 0 1).
  [[nodiscard]] static RigidTransform fromMatrix(const Eigen::Matrix4d& matrix);
  /// Rx(alpha) * Ry(beta) * Rz(gamma), rad (PAPERS.md, P3 (6)).
  [[nodiscard]] static RigidTransform fromAlphaBetaGamma(double alpha_rad, double beta_rad, double gamma_rad,
                                                         const Eigen::Vector3d& translation_mm);
  /// Rotation vector (axis times angle, rad) and translation: exact exponential of the rotation.
  [[nodiscard]] static RigidTransform fromRotationVector(const Eigen::Vector3d& rotation_rad,
                                                         const Eigen::Vector3d& translation_mm);

  [[nodiscard]] const Eigen::Matrix3d& rotation() const noexcept { return rotation_; }
  [[nodiscard]] const Eigen::Vector3d& translation_mm() const noexcept { return translation_mm_; }
  [[nodiscard]] Eigen::Matrix4d matrix() const;
  /// Logarithm of the rotation: axis times angle, rad.
  [[nodiscard]] Eigen::Vector3d rotationVector_rad() const;

  [[nodiscard]] RigidTransform inverse() const;
  [[nodiscard]] RigidTransform operator*(const RigidTransform& other) const;
  /// A point (mm).
  [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& point_mm) const {
    return rotation_ * point_mm + translation_mm_;
  }

 private:
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation_mm_ = Eigen::Vector3d::Zero();
};

/// [v]x, so that [v]x w = v x w.
[[nodiscard]] Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v);

}  // namespace spindrift
