// SPDX-License-Identifier: Apache-2.0
// A smooth change of an artefact's surface between two scans: what a registration falls back to where no motion of its
// scan model explains a scan, because the artefact bends or the machine does along the scan.
//
// Model: after the motion the heights of the source over the target (mm, along z) are noise and
//   d + (z - z0) (d_x z_x + d_y z_y),   d(x, y) = sum over i + j <= n of a_ij P_i(s) P_j(t):
// the surface z is higher by d, and where d tilts it the relief shifts sideways, about the height z0 of the centroid.
// P are the polynomials of Legendre, s and t from -1 to 1 over the rectangle of the target. Beforehand the a_ij of
// order 2 and more are independent, of mean 0 and standard deviation A p^i q^j over its largest. Size A (0.02 um to 0.1
// mm) and smoothness p, q (0.03 to 0.9) are weighed by their evidence, the likelihood of the heights with any motion
// allowed; estimate and covariance are means over them.
//
// a_00, a_10 and a_01 look like a motion and are left to it (0). What they are depends on where the artefact is held:
// their covariance is the mean square over all places of the rectangle at which the surface neither moves nor turns.
// That, and what of the others the relief lets a motion do as well, is in the uncertainty of the motion.
// Source: Rasmussen and Williams, Gaussian Processes for Machine Learning (2006), 2.7 (a motion beside the field) and
// 5.4 (evidence).
#pragma once

#include <Eigen/Core>

namespace spindrift {

struct FreeForm {
  static constexpr int most_order = 8;
  static constexpr int plane_terms = 3;  ///< of order 0 and 1: mean and tilt

  /// Rectangle of the target, profiler's frame (mm).
  Eigen::Vector2d low_mm = Eigen::Vector2d::Zero();
  Eigen::Vector2d high_mm = Eigen::Vector2d::Ones();
  double middle_mm = 0.0;             ///< z0
  int order = 0;                      ///< n
  Eigen::VectorXd coefficients_mm;    ///< a_ij in the order of evaluateTerms()
  Eigen::MatrixXd covariance_mm2;     ///< of the coefficients
  double log_evidence = 0.0;          ///< natural logarithm of the evidence against that of no change
  double misfit_ratio_without = 0.0;  ///< RegistrationResult::misfit_ratio of the motion alone
  /// What the covariance does to (u, w) of the motion (mm, rad): a part of RegistrationResult::covariance.
  Eigen::Matrix<double, 6, 6> motion_covariance = Eigen::Matrix<double, 6, 6>::Zero();

  [[nodiscard]] static int termCount(int order) noexcept { return (order + 1) * (order + 2) / 2; }
  /// P_i(s) P_j(t) by i + j, then by j; termCount() numbers.
  [[nodiscard]] Eigen::VectorXd terms(double s, double t) const;
  /// A place on the target: where it is, and the slopes dz/dx, dz/dy there.
  struct Place {
    double x_mm = 0.0, y_mm = 0.0, z_mm = 0.0;
    double zx = 0.0, zy = 0.0;
  };
  /// What a unit of each term adds to the height at a place.
  void evaluateTerms(const Place& place, double* terms) const noexcept;
  /// What the change adds to the height at a place (mm).
  [[nodiscard]] double height_mm(const Place& place) const noexcept;

  struct Value {
    double mm = 0.0;
    double standard_uncertainty_mm = 0.0;
  };
  /// d less its mean and its tilt over the rectangle: the change of shape, whatever the motion.
  [[nodiscard]] Value shape(double x_mm, double y_mm) const;
  /// Coefficients of the shape, each times the root mean square of its polynomial over the rectangle (mm).
  [[nodiscard]] Eigen::VectorXd shapeVector_mm() const;
  /// Root mean square of the shape over the rectangle.
  [[nodiscard]] double rms_mm() const { return shapeVector_mm().norm(); }
};

}  // namespace spindrift
