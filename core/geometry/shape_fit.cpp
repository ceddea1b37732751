// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/shape_fit.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "core/base/count_text.h"
#include "core/math/distributions.h"

namespace spindrift {

void ShapeFitOptions::validate() const {
  SPINDRIFT_ASSERT(sigma_mm >= 0.0 && std::isfinite(sigma_mm), "sigma of a shape fit must not be negative");
  SPINDRIFT_ASSERT(outlier_threshold > 0.0, "outlier threshold of a shape fit must be positive");
  SPINDRIFT_ASSERT(!known_radius_mm || *known_radius_mm > 0.0, "a known radius must be positive");
  SPINDRIFT_ASSERT(largest_amplification > 1.0, "largest amplification of a shape fit must exceed 1");
  SPINDRIFT_ASSERT(max_iterations > 0, "a shape fit needs at least one iteration");
}

namespace {

std::string directionText(const double* v, int dimension) {
  constexpr const char* axis[] = {"x", "y", "z"};
  int largest = 0;
  for (int k = 1; k < dimension; ++k) {
    if (std::abs(v[k]) > std::abs(v[largest])) largest = k;
  }
  double norm = 0.0;
  for (int k = 0; k < dimension; ++k) norm += v[k] * v[k];
  norm = std::sqrt(norm);
  if (norm > 0.0 && std::abs(v[largest]) > 0.995 * norm) return axis[largest];
  const double sign = v[largest] < 0.0 ? -1.0 : 1.0;
  std::string text = "(";
  for (int k = 0; k < dimension; ++k) text += fmt::format("{}{:.2f}", k > 0 ? ", " : "", sign * v[k] / norm);
  return text + ")";
}

template <int D>
struct RoundFit {
  using Point = Eigen::Matrix<double, D, 1>;
  using Parameters = Eigen::Matrix<double, D + 1, 1>;
  using Square = Eigen::Matrix<double, D + 1, D + 1>;
  FitStatus status = FitStatus::NotRun;
  Point centre = Point::Zero();
  double radius = 0.0;
  double sum_squares = 0.0;
  int used = 0;
  Square cofactor = Square::Zero();
  Parameters weak = Parameters::Zero();
  double amplification = 0.0;
};

/// Fit without the point `skip` (-1: with all of them).
template <int D>
void fitRound(std::span<const Eigen::Matrix<double, D, 1>> points, const ShapeFitOptions& options, int skip,
              RoundFit<D>& fit) {
  using Point = typename RoundFit<D>::Point;
  using Square = typename RoundFit<D>::Square;
  using Parameters = typename RoundFit<D>::Parameters;
  const int n = static_cast<int>(points.size());
  const bool free_radius = !options.known_radius_mm.has_value();
  Point mean = Point::Zero();
  fit.used = 0;
  for (int i = 0; i < n; ++i) {
    if (i == skip) continue;
    mean += points[i];
    ++fit.used;
  }
  mean /= std::max(fit.used, 1);

  Eigen::Matrix<double, D, D> scatter = Eigen::Matrix<double, D, D>::Zero();
  Point third = Point::Zero();
  double second = 0.0;
  for (int i = 0; i < n; ++i) {
    if (i == skip) continue;
    const Point q = points[i] - mean;
    const double q2 = q.squaredNorm();
    scatter.noalias() += q * q.transpose();
    third += q * q2;
    second += q2;
  }
  Point centre = Point::Zero();  // from here on relative to `mean`
  double radius = 0.0;
  if (second > 0.0) {
    // Algebraic circle: |q|^2 = 2 q.c + k. Directions without spread get no part of the start.
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, D, D>> spread;
    spread.computeDirect(scatter);
    const auto& values = spread.eigenvalues();
    for (int k = 0; k < D; ++k) {
      if (values(k) < 1e-9 * values(D - 1)) continue;
      const auto v = spread.eigenvectors().col(k);
      centre += 0.5 * v * (v.dot(third) / values(k));
    }
    radius = std::sqrt(centre.squaredNorm() + second / fit.used);
  }
  if (options.start_mm) centre = options.start_mm->template head<D>() - mean;
  if (!free_radius) radius = *options.known_radius_mm;

  const auto evaluate = [&](const Point& c, double r, Square* normal, Parameters* gradient) {
    double sum = 0.0;
    if (normal != nullptr) {
      normal->setZero();
      gradient->setZero();
    }
    for (int i = 0; i < n; ++i) {
      if (i == skip) continue;
      Point u = points[i] - mean - c;
      const double distance = u.norm();
      const double residual = distance - r;
      sum += residual * residual;
      if (normal == nullptr) continue;
      if (distance > 0.0) u /= distance;
      Parameters row;
      row.template head<D>() = u;
      row(D) = free_radius ? 1.0 : 0.0;
      normal->noalias() += row * row.transpose();
      *gradient += row * residual;
    }
    if (normal != nullptr && !free_radius) (*normal)(D, D) = 1.0;
    return sum;
  };

  fit.status = FitStatus::NoConvergence;
  Square normal;
  Parameters gradient;
  double sum = evaluate(centre, radius, &normal, &gradient);
  double damping = 0.0;
  const double scale = std::sqrt(second / std::max(fit.used, 1));
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    Square damped = normal;
    // A trace of damping keeps directions that the points leave open from running away; it does not move the solution.
    damped.diagonal().array() += damping + 1e-13 * fit.used;
    const Parameters step = damped.ldlt().solve(gradient);
    if (!step.allFinite()) break;
    const Point next = centre + step.template head<D>();
    const double next_radius = free_radius ? radius + step(D) : radius;
    if (damping == 0.0 && step.norm() <= 1e-12 * (scale + radius)) {
      centre = next;
      radius = next_radius;
      sum = evaluate(centre, radius, &normal, &gradient);
      fit.status = FitStatus::Converged;
      break;
    }
    const double next_sum = evaluate(next, next_radius, nullptr, nullptr);
    if (!(next_sum <= sum * (1.0 + 1e-6))) {
      damping = damping > 0.0 ? damping * 10.0 : 1e-3 * fit.used;
      if (damping > 1e12) break;
      continue;
    }
    centre = next;
    radius = next_radius;
    damping = damping > 1e-9 ? damping * 0.1 : 0.0;
    sum = evaluate(centre, radius, &normal, &gradient);
  }
  fit.centre = centre + mean;
  fit.radius = radius;
  fit.sum_squares = sum;

  Eigen::SelfAdjointEigenSolver<Square> modes(normal);
  int weakest = 0;
  if (!free_radius) {
    // The frozen radius is an eigenvector of its own; it is not a direction of the fit.
    while (weakest < D && std::abs(modes.eigenvectors()(D, weakest)) > 0.999) ++weakest;
  }
  const double smallest = modes.eigenvalues()(weakest);
  fit.weak = modes.eigenvectors().col(weakest);
  fit.amplification = smallest > 0.0 ? 1.0 / std::sqrt(smallest) : std::numeric_limits<double>::infinity();
  const int unknowns = D + (free_radius ? 1 : 0);
  if (fit.used < unknowns || !(fit.amplification <= options.largest_amplification)) {
    fit.status = FitStatus::Degenerate;
    return;
  }
  fit.cofactor =
      modes.eigenvectors() * modes.eigenvalues().cwiseInverse().asDiagonal() * modes.eigenvectors().transpose();
  if (!free_radius) {
    fit.cofactor.col(D).setZero();
    fit.cofactor.row(D).setZero();
  }
}

/// Signed distance of a point from the fitted shape and the factor of its variance (1 + J C J^T).
template <int D>
double deletedResidual(const RoundFit<D>& fit, const typename RoundFit<D>::Point& point, bool free_radius,
                       double& variance_factor) {
  typename RoundFit<D>::Parameters row;
  typename RoundFit<D>::Point u = point - fit.centre;
  const double distance = u.norm();
  row.template head<D>() = distance > 0.0 ? typename RoundFit<D>::Point(u / distance) : u;
  row(D) = free_radius ? 1.0 : 0.0;
  variance_factor = 1.0 + row.dot(fit.cofactor * row);
  return distance - fit.radius;
}

double outlierLimit(const ShapeFitOptions& options, int points, int dof) {
  if (options.sigma_mm > 0.0) return options.outlier_threshold;
  return dof > 0 ? studentQuantile(1.0 - 0.5e-3 / points, dof) : std::numeric_limits<double>::infinity();
}

template <int D, typename Result>
Result fitRoundShape(std::span<const Eigen::Matrix<double, D, 1>> points, const ShapeFitOptions& options,
                     const char* shape) {
  options.validate();
  const bool free_radius = !options.known_radius_mm.has_value();
  const int unknowns = D + (free_radius ? 1 : 0);
  const int n = static_cast<int>(points.size());
  Result result;
  RoundFit<D> fit;
  fit.status = FitStatus::Degenerate;
  if (n > 0) fitRound<D>(points, options, -1, fit);
  if (options.tolerate_one_bad_point && n > unknowns) {
    const bool may_locate = n >= unknowns + 2;
    int worst = -1;
    RoundFit<D> without;
    if (may_locate) {
      RoundFit<D> candidate;
      for (int i = 0; i < n; ++i) {
        fitRound<D>(points, options, i, candidate);
        if (candidate.status != FitStatus::Converged) continue;
        if (worst < 0 || candidate.sum_squares < without.sum_squares) {
          without = candidate;
          worst = i;
        }
      }
    }
    if (worst >= 0) {
      double factor = 1.0;
      const double residual = deletedResidual<D>(without, points[worst], free_radius, factor);
      const int dof = n - 1 - unknowns;
      const double sigma =
          options.sigma_mm > 0.0 ? options.sigma_mm : std::sqrt(without.sum_squares / std::max(dof, 1));
      if (std::abs(residual) > outlierLimit(options, n, dof) * sigma * std::sqrt(factor) &&
          std::abs(residual) > 1e-12 * without.radius) {
        fit = without;
        result.rejected = worst;
      }
    }
  }
  result.status = fit.status;
  result.points_used = fit.used;
  result.degrees_of_freedom = fit.used - unknowns;
  result.centre_mm = fit.centre;
  result.radius_mm = fit.radius;
  result.cofactor = fit.cofactor;
  result.weak = fit.weak;
  result.amplification = fit.amplification;
  result.rms_mm = std::sqrt(fit.sum_squares / std::max(fit.used, 1));
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (int i = 0; i < n; ++i) {
    if (i == result.rejected) continue;
    const double residual = (points[i] - fit.centre).norm() - fit.radius;
    low = std::min(low, residual);
    high = std::max(high, residual);
  }
  result.form_mm = high > low ? high - low : 0.0;
  result.sigma_mm = options.sigma_mm;
  if (!(result.sigma_mm > 0.0) && result.degrees_of_freedom > 0) {
    result.sigma_mm = std::sqrt(fit.sum_squares / result.degrees_of_freedom);
  }
  if (result.sigma_mm > 0.0) {
    result.covariance = result.sigma_mm * result.sigma_mm * result.cofactor;
  } else {
    result.covariance.diagonal().setConstant(std::numeric_limits<double>::infinity());
  }
  switch (result.status) {
    case FitStatus::Converged:
      result.message = "converged";
      break;
    case FitStatus::Degenerate:
      result.covariance.setZero();
      result.covariance.diagonal().setConstant(std::numeric_limits<double>::infinity());
      if (n < unknowns) {
        result.message =
            fmt::format("{} too few for a {}{}; allowed: at least {}", countOf(n, "point is", "points are"), shape,
                        free_radius ? "" : " of known radius", unknowns);
      } else {
        const double centre_part = fit.weak.template head<D>().norm();
        const std::string along = directionText(fit.weak.data(), D);
        result.message = fmt::format("the points do not determine the {}: {}", shape,
                                     centre_part < 0.05 ? std::string("its radius is open")
                                     : std::abs(fit.weak(D)) > 0.3
                                         ? fmt::format("its radius and its centre along {} are open together", along)
                                         : fmt::format("its centre along {} is open", along));
      }
      break;
    default:
      result.message = "the iteration did not settle";
  }
  if (result.usable() && options.tolerate_one_bad_point && options.sigma_mm > 0.0 && result.degrees_of_freedom > 0 &&
      chiSquaredTail(fit.sum_squares / (options.sigma_mm * options.sigma_mm), result.degrees_of_freedom) < 1e-6) {
    result.status = FitStatus::Rejected;
    result.message = fmt::format("the points contradict a {} by {:.4f} mm and no single one of them is to blame", shape,
                                 result.form_mm);
  }
  return result;
}

/// Principal axes of the points without `skip`, ascending, and their centroid.
struct Scatter {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Vector3d values = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  int used = 0;
};

Scatter scatterOf(std::span<const Eigen::Vector3d> points, int skip) {
  Scatter s;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    if (i == skip) continue;
    s.centroid += points[i];
    ++s.used;
  }
  s.centroid /= std::max(s.used, 1);
  Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    if (i == skip) continue;
    const Eigen::Vector3d q = points[i] - s.centroid;
    m.noalias() += q * q.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> modes(m);
  s.values = modes.eigenvalues().cwiseMax(0.0);
  s.axes = modes.eigenvectors();
  return s;
}

Eigen::Vector3d oriented(const Eigen::Vector3d& v) {
  Eigen::Index largest = 0;
  v.cwiseAbs().maxCoeff(&largest);
  return v(largest) < 0.0 ? Eigen::Vector3d(-v) : v;
}

/// Common part of plane and line: `across` = number of principal axes, from the smallest, that residuals live in.
/// Unknowns counted in residual equations: plane 3 of n, line 4 of 2 n.
Scatter robustScatter(std::span<const Eigen::Vector3d> points, const ShapeFitOptions& options, int across, int unknowns,
                      ShapeFitSummary& summary) {
  options.validate();
  const int n = static_cast<int>(points.size());
  const auto squares = [&](const Scatter& s) { return s.values.head(across).sum(); };
  Scatter s = scatterOf(points, -1);
  const int dof_without = across * (n - 1) - unknowns;
  if (options.tolerate_one_bad_point && dof_without > 0) {
    int worst = -1;
    Scatter without;
    for (int i = 0; i < n; ++i) {
      const Scatter candidate = scatterOf(points, i);
      if (worst < 0 || squares(candidate) < squares(without)) {
        without = candidate;
        worst = i;
      }
    }
    if (worst >= 0) {
      const double sigma = options.sigma_mm > 0.0 ? options.sigma_mm : std::sqrt(squares(without) / dof_without);
      const Eigen::Vector3d q = without.axes.transpose() * (points[worst] - without.centroid);
      double factor = 1.0 + 1.0 / without.used;
      for (int k = across; k < 3; ++k) factor += without.values(k) > 0.0 ? q(k) * q(k) / without.values(k) : 0.0;
      const double distance = q.head(across).norm();
      if (distance > outlierLimit(options, n, dof_without) * sigma * std::sqrt(factor) && distance > 0.0) {
        s = without;
        summary.rejected = worst;
      }
    }
  }
  summary.points_used = s.used;
  summary.degrees_of_freedom = across * s.used - unknowns;
  summary.rms_mm = std::sqrt(squares(s) / std::max(s.used, 1));
  summary.sigma_mm = options.sigma_mm;
  if (!(summary.sigma_mm > 0.0) && summary.degrees_of_freedom > 0) {
    summary.sigma_mm = std::sqrt(squares(s) / summary.degrees_of_freedom);
  }
  return s;
}

}  // namespace

CircleFit fitCircle(std::span<const Eigen::Vector2d> points_mm, const ShapeFitOptions& options) {
  return fitRoundShape<2, CircleFit>(points_mm, options, "circle");
}

SphereFit fitSphere(std::span<const Eigen::Vector3d> points_mm, const ShapeFitOptions& options) {
  return fitRoundShape<3, SphereFit>(points_mm, options, "sphere");
}

PlaneFit fitPlane(std::span<const Eigen::Vector3d> points_mm, const ShapeFitOptions& options) {
  PlaneFit fit;
  const Scatter s = robustScatter(points_mm, options, 1, 3, fit);
  fit.point_mm = s.centroid;
  fit.normal = oriented(s.axes.col(0));
  fit.weak = s.axes.col(1);
  if (s.used < 3) {
    fit.status = FitStatus::Degenerate;
    fit.message = fmt::format("{} too few for a plane; allowed: at least 3", countOf(s.used, "point is", "points are"));
    return fit;
  }
  // Amplification of noise into the tilt, at the radius of the point cloud.
  fit.amplification =
      s.values(1) > 0.0 ? std::sqrt(s.values(2) / s.values(1)) : std::numeric_limits<double>::infinity();
  if (!(fit.amplification <= options.largest_amplification)) {
    fit.status = FitStatus::Degenerate;
    fit.message = fmt::format("the points do not determine the plane: they have no spread along {}",
                              directionText(fit.weak.data(), 3));
    return fit;
  }
  double low = 0.0;
  double high = 0.0;
  for (int i = 0; i < static_cast<int>(points_mm.size()); ++i) {
    if (i == fit.rejected) continue;
    const double distance = fit.normal.dot(points_mm[i] - fit.point_mm);
    low = std::min(low, distance);
    high = std::max(high, distance);
  }
  fit.form_mm = high - low;
  fit.offset_sigma_mm = fit.sigma_mm / std::sqrt(static_cast<double>(s.used));
  for (int k = 1; k < 3; ++k) {
    fit.normal_covariance += fit.sigma_mm * fit.sigma_mm / s.values(k) * s.axes.col(k) * s.axes.col(k).transpose();
  }
  fit.status = FitStatus::Converged;
  fit.message = "converged";
  return fit;
}

LineFit fitLine(std::span<const Eigen::Vector3d> points_mm, const ShapeFitOptions& options) {
  LineFit fit;
  const Scatter s = robustScatter(points_mm, options, 2, 4, fit);
  fit.point_mm = s.centroid;
  fit.direction = oriented(s.axes.col(2));
  if (s.used < 2) {
    fit.status = FitStatus::Degenerate;
    fit.message = fmt::format("{} too few for a line; allowed: at least 2", countOf(s.used, "point is", "points are"));
    return fit;
  }
  fit.amplification = s.values(2) - s.values(1) > 0.0 ? std::sqrt(s.values(2) / (s.values(2) - s.values(1)))
                                                      : std::numeric_limits<double>::infinity();
  if (!(s.values(2) > 0.0) || !(fit.amplification <= options.largest_amplification)) {
    fit.status = FitStatus::Degenerate;
    fit.message = "the points do not determine the line: no direction has more spread than the others";
    return fit;
  }
  for (int i = 0; i < static_cast<int>(points_mm.size()); ++i) {
    if (i == fit.rejected) continue;
    const Eigen::Vector3d q = points_mm[i] - fit.point_mm;
    fit.form_mm = std::max(fit.form_mm, (q - fit.direction * fit.direction.dot(q)).norm());
  }
  fit.offset_sigma_mm = fit.sigma_mm / std::sqrt(static_cast<double>(s.used));
  fit.direction_sigma_rad = fit.sigma_mm / std::sqrt(s.values(2));
  fit.direction_covariance = fit.direction_sigma_rad * fit.direction_sigma_rad *
                             (Eigen::Matrix3d::Identity() - fit.direction * fit.direction.transpose());
  fit.status = FitStatus::Converged;
  fit.message = "converged";
  return fit;
}

}  // namespace spindrift
