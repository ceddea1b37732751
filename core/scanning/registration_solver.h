// SPDX-License-Identifier: Apache-2.0
// Inside of registration.h: the iteration over cells and the covariance. Not for use elsewhere.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "core/scanning/free_form.h"
#include "core/scanning/height_spline.h"
#include "core/scanning/registration.h"

namespace spindrift {

/// Parameters: (u, w) and, for push_broom, the drift of u along the scan (3 per order).
inline constexpr int most_parameters = 12;
using MatrixP = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_parameters, most_parameters>;
using VectorP = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_parameters, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// The motion of registration.h.
struct ScanMotion {
  Eigen::Matrix3d to_cloud = Eigen::Matrix3d::Identity();  ///< M^-1
  Eigen::Matrix3d lever = Eigen::Matrix3d::Identity();     ///< Q
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();        ///< c
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();         ///< u
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< R
  /// u varies along the scan: u + drift.col(0) t + drift.col(1) t^2, t = (y - c_y) / drift_length.
  int drift_order = 0;
  double drift_length = 1.0;
  Eigen::Matrix<double, 3, 2> drift = Eigen::Matrix<double, 3, 2>::Zero();
  /// Standard deviation of drift.col(1) before anything is measured (mm); used when drift_order is 2.
  Eigen::Vector3d bend_sigma = Eigen::Vector3d::Ones();
  [[nodiscard]] int parameters() const noexcept { return 6 + 3 * drift_order; }
};

/// One source cell over the target.
struct CellResidual {
  std::uint32_t cell = 0;  ///< index in the source's grid
  float tx = 0.0F, ty = 0.0F;
  FreeForm::Place place;
  double residual = 0.0;  ///< mm
  double weight = 0.0;    ///< 1 / (1 / source points + 1 / target points)
  double robust = 0.0;    ///< Tukey's factor
  float drift_t = 0.0F;   ///< t of ScanMotion
  Vector6 jacobian = Vector6::Zero();
  /// All parameters of the motion.
  [[nodiscard]] VectorP row(int parameters) const;
};

/// Gauss-Newton with Tukey's loss over the cells of one source.
class RegistrationSolver {
 public:
  RegistrationSolver(const CellGrid& source, const RegistrationTarget& target, const RegistrationOptions& options);

  /// Residuals and Jacobians of some of the filled cells at a motion; of the heights less a change of the surface.
  void residuals(const ScanMotion& motion, const std::vector<std::uint32_t>& cells, std::vector<CellResidual>& out,
                 const FreeForm* change = nullptr) const;

  struct Outcome {
    ScanMotion motion;
    MatrixP normal;      ///< sum of weight * J J^T, and `prior`
    VectorP prior;       ///< what is known beforehand, in the unit of `normal`
    double scale = 0.0;  ///< robust standard deviation of residual * sqrt(weight) (mm)
    double tukey_threshold = 6.0;
    double overlap = 0.0;
    double inliers = 0.0;
    double median_residual = 0.0;  ///< mm
    int iterations = 0;
    bool converged = false;
    MatrixP free = MatrixP::Zero(6, 6);  ///< projector on the directions left free (scaled parameters)
    int free_count = 0;
    std::vector<CellResidual> cells;
  };
  [[nodiscard]] Outcome solve(ScanMotion motion, const std::vector<std::uint32_t>& cells, int iterations,
                              const FreeForm* change = nullptr) const;
  /// The second order of the drift added to an outcome of the first (push_broom).
  [[nodiscard]] Outcome bend(const Outcome& outcome) const;
  /// Starts on a lattice of shifts and turns; the best three are refined. Returns the best.
  [[nodiscard]] Outcome search() const;

  [[nodiscard]] ScanMotion start() const;
  /// What makes the parameters comparable (mm); one that is held by what was known beforehand counts as held by data.
  [[nodiscard]] VectorP scales(const MatrixP& normal, const VectorP& prior) const;
  /// Inverse of the normal matrix of an outcome on the directions that the surface determines.
  [[nodiscard]] MatrixP inverseNormal(const Outcome& outcome) const;
  [[nodiscard]] const std::vector<std::uint32_t>& allCells() const noexcept { return filled_; }
  /// Length that makes rotations comparable with shifts (mm).
  [[nodiscard]] double length() const noexcept { return length_; }
  /// Smaller is better; combines the residual with the overlap.
  [[nodiscard]] double cost(const Outcome& outcome) const noexcept;

 private:
  const CellGrid& source_;
  const RegistrationTarget& target_;
  const RegistrationOptions& options_;
  std::vector<std::uint32_t> filled_;
  double length_ = 1.0;
  double half_scan_ = 1.0;
};

/// Covariance of (u, w) from the final residuals; see registration.h.
struct RegistrationNoise {
  Matrix6 covariance = Matrix6::Zero();  ///< of (u, w)
  Matrix6 white = Matrix6::Zero();
  double misfit_ratio = 0.0;
  double correlation = 1.0;
  double unit_variance = 0.0;  ///< long-run variance of residual * sqrt(weight) (mm^2)
  /// Variance of errors that the cells of a row share: in height (mm^2), as a tilt about y, in their place along x.
  std::array<double, 3> row_variance{};
  double steep_share = 0.0;  ///< part of the first that goes with the square of the row's slope along y
};
[[nodiscard]] RegistrationNoise registrationNoise(const RegistrationSolver::Outcome& outcome, const CellGrid& source,
                                                  const CellGrid& target, const MatrixP& inverse_normal);

/// The motion of an outcome with the change of the surface beside it.
struct FreeFormOutcome {
  RegistrationSolver::Outcome outcome;  ///< residuals less the change
  FreeForm form;
};
/// The change of the surface that an outcome leaves, where the evidence for it is clear and it matters for the motion;
/// nothing otherwise, and where the change is larger than any that heat makes: another surface.
[[nodiscard]] std::optional<FreeFormOutcome> freeFormOutcome(const RegistrationSolver& solver,
                                                             const RegistrationSolver::Outcome& outcome,
                                                             const CellGrid& source, const CellGrid& target,
                                                             const RegistrationOptions& options);

}  // namespace spindrift
