// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/rigid_transform.h"

#include "core/base/error.h"

namespace spindrift {

RigidTransform::RigidTransform(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation_mm)
    : rotation_(rotation), translation_mm_(translation_mm) {
  SPINDRIFT_ASSERT(
      (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm() < 1e-6 && rotation.determinant() > 0.0,
      "not a rotation matrix");
}

RigidTransform RigidTransform::fromMatrix(const Eigen::Matrix4d& matrix) {
  return {matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>()};
}

RigidTransform RigidTransform::fromAlphaBetaGamma(double alpha_rad, double beta_rad, double gamma_rad,
                                                  const Eigen::Vector3d& translation_mm) {
  const Eigen::Matrix3d rotation =
      (Eigen::AngleAxisd(alpha_rad, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(beta_rad, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(gamma_rad, Eigen::Vector3d::UnitZ()))
          .toRotationMatrix();
  return {rotation, translation_mm};
}

RigidTransform RigidTransform::fromRotationVector(const Eigen::Vector3d& rotation_rad,
                                                  const Eigen::Vector3d& translation_mm) {
  const double angle = rotation_rad.norm();
  Eigen::Matrix3d rotation;
  if (angle < 1e-4) {
    // Series to fourth order: the direction of a tiny vector is not well defined, its cross matrix is.
    const Eigen::Matrix3d k = crossMatrix(rotation_rad);
    rotation = Eigen::Matrix3d::Identity() + (1.0 - angle * angle / 6.0) * k + (0.5 - angle * angle / 24.0) * k * k;
  } else {
    rotation = Eigen::AngleAxisd(angle, rotation_rad / angle).toRotationMatrix();
  }
  return {rotation, translation_mm};
}

Eigen::Matrix4d RigidTransform::matrix() const {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = rotation_;
  m.topRightCorner<3, 1>() = translation_mm_;
  return m;
}

Eigen::Vector3d RigidTransform::rotationVector_rad() const {
  const Eigen::Vector3d axis_sine(rotation_(2, 1) - rotation_(1, 2), rotation_(0, 2) - rotation_(2, 0),
                                  rotation_(1, 0) - rotation_(0, 1));
  const double sine = 0.5 * axis_sine.norm();
  const double cosine = 0.5 * (rotation_.trace() - 1.0);
  const double angle = std::atan2(sine, cosine);
  if (sine < 1e-7 && cosine > 0.0) return 0.5 * axis_sine;
  if (sine < 1e-7) {
    const Eigen::AngleAxisd aa(rotation_);
    return aa.axis() * aa.angle();
  }
  return axis_sine * (0.5 * angle / sine);
}

RigidTransform RigidTransform::inverse() const {
  RigidTransform result;
  result.rotation_ = rotation_.transpose();
  result.translation_mm_ = -(result.rotation_ * translation_mm_);
  return result;
}

RigidTransform RigidTransform::operator*(const RigidTransform& other) const {
  RigidTransform result;
  result.rotation_ = rotation_ * other.rotation_;
  result.translation_mm_ = rotation_ * other.translation_mm_ + translation_mm_;
  return result;
}

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

}  // namespace spindrift
