// SPDX-License-Identifier: Apache-2.0
#include "core/imaging/image_pose.h"

#include <cmath>

#include "core/math/least_squares.h"

namespace spindrift {
namespace {

Eigen::Vector2d withoutDistortion(const Eigen::Vector2d& d, double k1) {
  // d = (1 + k1 |u|^2) u, solved by fixed-point iteration; k1 |u|^2 is of the order of 1e-3.
  Eigen::Vector2d u = d;
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector2d next = d / (1.0 + k1 * u.squaredNorm());
    const double change = (next - u).norm();
    u = next;
    if (change < 1e-10) break;
  }
  return u;
}

}  // namespace

std::vector<MarkPosition> markPositions(const DecodeResult& decoded, const FiducialPattern& pattern) {
  std::vector<MarkPosition> marks;
  marks.reserve(decoded.subpatterns.size() + decoded.circles.size());
  for (const Subpattern& s : decoded.subpatterns) {
    if (s.sigma_px > 0.0) marks.push_back({pattern.ellipseCentre(s.row, s.column), {s.x_px, s.y_px}, s.sigma_px});
  }
  for (const CircleMark& c : decoded.circles) {
    if (c.sigma_px > 0.0) marks.push_back({pattern.circleCentre(c.i, c.j), {c.x_px, c.y_px}, c.sigma_px});
  }
  return marks;
}

double ImagePose::pixelLength_um() const {
  return 1.0 / std::hypot(a, b);
}
double ImagePose::tilt_rad() const {
  return std::atan2(b, a);
}
double ImagePose::orientation_rad() const {
  return mirrored ? std::atan2(b, a) : -std::atan2(b, a);
}
Eigen::Vector2d ImagePose::undistorted(const Eigen::Vector2d& pixel) const {
  return withoutDistortion(pixel - centre_px, k1_per_px2);
}
Eigen::Vector2d ImagePose::distorted(const Eigen::Vector2d& u_minus_c) const {
  return centre_px + (1.0 + k1_per_px2 * u_minus_c.squaredNorm()) * u_minus_c;
}

Eigen::Matrix2d ImagePose::patternPerPixel() const {
  const double m = mirrored ? 1.0 : -1.0;
  Eigen::Matrix2d inverse;
  inverse << a, b, -b, a;
  inverse /= a * a + b * b;
  inverse.row(1) *= m;
  return inverse;
}

Eigen::Vector2d ImagePose::patternAt(const Eigen::Vector2d& u_minus_c) const {
  return patternPerPixel() * (u_minus_c - origin_px);
}

double ImagePose::patternSigma_um(const Eigen::Vector2d& u_minus_c) const {
  // p = S^-1 (u - t): dp = -S^-1 (dS diag(1,m) p + dt), isotropic.
  const Eigen::Vector2d p = patternAt(u_minus_c);
  const double m = mirrored ? 1.0 : -1.0;
  Eigen::Matrix<double, 2, 4> D;
  D << p.x(), -m * p.y(), 1, 0, m * p.y(), p.x(), 0, 1;
  return pixelLength_um() * std::sqrt(0.5 * (D * covariance * D.transpose()).trace());
}

ImagePose fitImagePose(const std::vector<MarkPosition>& marks, const Eigen::Vector2d& centre_px, double k1_per_px2,
                       bool mirrored) {
  ImagePose pose;
  pose.centre_px = centre_px;
  pose.k1_per_px2 = k1_per_px2;
  pose.mirrored = mirrored;
  pose.marks = static_cast<int>(marks.size());
  if (marks.size() < 3) {
    pose.status = FitStatus::Degenerate;
    pose.message = "fewer than three marks";
    return pose;
  }
  const double m = mirrored ? 1.0 : -1.0;
  const auto rows = 2 * static_cast<Eigen::Index>(marks.size());
  Eigen::MatrixXd A(rows, 4);
  Eigen::VectorXd y(rows);
  Eigen::VectorXd sigma(rows);
  for (Eigen::Index i = 0; i < rows / 2; ++i) {
    const MarkPosition& mark = marks[static_cast<std::size_t>(i)];
    const Eigen::Vector2d u = withoutDistortion(mark.pixel - centre_px, k1_per_px2);
    const Eigen::Vector2d p(mark.pattern_um.x(), m * mark.pattern_um.y());
    A.row(2 * i) << p.x(), -p.y(), 1, 0;
    A.row(2 * i + 1) << p.y(), p.x(), 0, 1;
    y.segment<2>(2 * i) = u;
    sigma.segment<2>(2 * i).setConstant(mark.sigma_px);
  }
  const LinearFitResult fit = solveLinear(A, y, sigma);
  pose.status = fit.status;
  pose.message = fit.message;
  if (!fit.usable()) return pose;
  pose.a = fit.x(0);
  pose.b = fit.x(1);
  pose.origin_px = fit.x.tail<2>();
  // Errors of the artwork and of the model of the lens may exceed those of the marks.
  const double excess = fit.degrees_of_freedom > 0 ? std::max(1.0, fit.chi2 / fit.degrees_of_freedom) : 1.0;
  pose.covariance = fit.covariance * excess;
  pose.rms_px = std::sqrt(fit.residuals.squaredNorm() / static_cast<double>(rows));
  return pose;
}

}  // namespace spindrift
