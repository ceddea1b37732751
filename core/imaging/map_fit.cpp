// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/imaging/decoder_parts.h"
#include "core/math/least_squares.h"

namespace spindrift::decoding {
namespace {

constexpr double k1_unit = 1e-9;  // keeps the columns of the normal matrix alike

}  // namespace

MapFit fitMap(const std::vector<MapPoint>& points, const PatternMap& start, bool fit_distortion) {
  MapFit fit;
  fit.map = start;
  fit.k1_sigma_per_px2 = std::numeric_limits<double>::infinity();
  if (points.size() < 2) {
    fit.status = FitStatus::Degenerate;
    return fit;
  }
  if (points.size() < 5) fit_distortion = false;
  const int n = fit_distortion ? 5 : 4;
  using Matrix = Eigen::Matrix<double, 5, 5>;
  using Vector = Eigen::Matrix<double, 5, 1>;
  Vector p;
  p << std::cos(start.tilt_rad) / start.pixel_length_um, std::sin(start.tilt_rad) / start.pixel_length_um,
      start.origin_x_px, start.origin_y_px, fit_distortion ? start.k1_per_px2 / k1_unit : 0.0;
  const double flip = start.mirrored ? 1.0 : -1.0;
  const Eigen::Vector2d centre(start.centre_x_px, start.centre_y_px);
  Matrix covariance = Matrix::Zero();
  double chi2 = 0.0;
  double sum2 = 0.0;
  double robust = 1.0;
  double reach = 0.0;
  for (const MapPoint& m : points) reach = std::max(reach, (m.pixel - centre).norm());
  for (int iteration = 0; iteration < 6; ++iteration) {
    Matrix N = Matrix::Zero();
    Vector g = Vector::Zero();
    chi2 = 0.0;
    sum2 = 0.0;
    std::vector<double> scaled;
    scaled.reserve(points.size());
    for (const MapPoint& m : points) {
      const double X = m.pattern_um.x();
      const double Y = flip * m.pattern_um.y();
      const Eigen::Vector2d u(p[0] * X - p[1] * Y + p[2], p[1] * X + p[0] * Y + p[3]);
      const double r2 = u.squaredNorm();
      const double k = p[4] * k1_unit;
      const Eigen::Vector2d residual = m.pixel - centre - (1.0 + k * r2) * u;
      Eigen::Matrix<double, 2, 4> du;
      du << X, -Y, 1, 0, Y, X, 0, 1;
      const Eigen::Matrix2d D = (1.0 + k * r2) * Eigen::Matrix2d::Identity() + 2.0 * k * u * u.transpose();
      Eigen::Matrix<double, 2, 5> J;
      J.leftCols<4>() = D * du;
      J.col(4) = k1_unit * r2 * u;
      const double z = residual.norm() / (std::sqrt(2.0) * m.sigma_px);
      scaled.push_back(z);
      const double w = huberWeight(z / robust, 2.5) / (m.sigma_px * m.sigma_px);
      N += w * J.transpose() * J;
      g += w * J.transpose() * residual;
      chi2 += w * residual.squaredNorm();
      sum2 += residual.squaredNorm();
    }
    std::nth_element(scaled.begin(), scaled.begin() + scaled.size() / 2, scaled.end());
    // The median of |r| / (sqrt(2) sigma) in the plane is 0.8326.
    robust = std::max(1e-9, scaled[scaled.size() / 2] / 0.8326);
    Eigen::MatrixXd Nn = N.topLeftCorner(n, n);
    const Eigen::VectorXd scale = Nn.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    Nn = scale.asDiagonal() * Nn * scale.asDiagonal();
    const Eigen::LDLT<Eigen::MatrixXd> solver(Nn);
    const Eigen::VectorXd step = scale.asDiagonal() * solver.solve(scale.asDiagonal() * g.head(n));
    covariance.setZero();
    covariance.topLeftCorner(n, n) =
        scale.asDiagonal() * solver.solve(Eigen::MatrixXd::Identity(n, n)) * scale.asDiagonal();
    if (!step.allFinite()) {
      fit.status = FitStatus::Degenerate;
      return fit;
    }
    p.head(n) += step;
    if (iteration > 1 && step.head(2).norm() * 3000.0 + step.segment(2, 2).norm() < 1e-5) break;
  }
  const int dof = 2 * static_cast<int>(points.size()) - n;
  fit.chi2_per_dof = dof > 0 ? chi2 / dof : 0.0;
  fit.rms_px = std::sqrt(sum2 / (2.0 * static_cast<double>(points.size())));
  covariance *= std::max(1.0, fit.chi2_per_dof);
  if (fit_distortion && std::sqrt(covariance(4, 4)) * k1_unit * reach * reach * reach > 0.5) {
    return fitMap(points, start, false);
  }
  const double scale = std::hypot(p[0], p[1]);
  fit.map.pixel_length_um = 1.0 / scale;
  fit.map.tilt_rad = std::atan2(p[1], p[0]);
  fit.map.origin_x_px = p[2];
  fit.map.origin_y_px = p[3];
  fit.map.k1_per_px2 = fit_distortion ? p[4] * k1_unit : 0.0;
  const Eigen::Vector2d along(p[0] / scale, p[1] / scale);
  const Eigen::Vector2d across(-along.y(), along.x());
  const Eigen::Matrix2d C = covariance.topLeftCorner<2, 2>();
  fit.pixel_length_sigma_um = std::sqrt(along.dot(C * along)) / (scale * scale);
  fit.tilt_sigma_rad = std::sqrt(across.dot(C * across)) / scale;
  if (fit_distortion) fit.k1_sigma_per_px2 = std::sqrt(covariance(4, 4)) * k1_unit;
  fit.status = FitStatus::Converged;
  return fit;
}

}  // namespace spindrift::decoding
