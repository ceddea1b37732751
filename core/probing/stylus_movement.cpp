// SPDX-License-Identifier: Apache-2.0
#include "core/probing/stylus_movement.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"

namespace spindrift {
namespace {

constexpr double decisive_bic = 10.0;

struct CourseFit {
  double bic = std::numeric_limits<double>::infinity();
  double rms = 0.0;
  Eigen::RowVector3d step = Eigen::RowVector3d::Zero();
  int after = -1;
};

/// Least squares of all three coordinates on the same columns. `shape_parameters`: tau, place of a step.
CourseFit fitCourse(const Eigen::MatrixXd& columns, const Eigen::MatrixX3d& centres, int shape_parameters,
                    double noise_um) {
  CourseFit fit;
  const auto n = static_cast<double>(centres.size());
  const double parameters = 3.0 * static_cast<double>(columns.cols()) + shape_parameters;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  if (parameters >= n || qr.rank() < columns.cols()) return fit;
  const Eigen::MatrixXd coefficients = qr.solve(centres);
  const double squares = (centres - columns * coefficients).squaredNorm();
  fit.rms = std::sqrt(squares / n);
  fit.bic = n * std::log(squares / n + noise_um * noise_um) + parameters * std::log(n);
  fit.step = coefficients.row(coefficients.rows() - 1);
  return fit;
}

std::vector<Eigen::VectorXd> smoothShapes(const Eigen::VectorXd& time) {
  std::vector<Eigen::VectorXd> shapes{time};
  const double record = time(time.size() - 1);
  const double interval = record / static_cast<double>(time.size() - 1);
  for (double tau = 0.5 * interval; tau < 10.0 * record; tau *= 1.3) {
    shapes.emplace_back(1.0 - (-time.array() / tau).exp());
  }
  return shapes;
}

CourseFit bestCourse(const Eigen::VectorXd& time, const Eigen::MatrixX3d& centres, double noise_um, bool smooth,
                     bool step) {
  CourseFit best;
  const Eigen::Index count = time.size();
  std::vector<Eigen::VectorXd> shapes{Eigen::VectorXd()};
  if (smooth) shapes = smoothShapes(time);
  for (const Eigen::VectorXd& shape : shapes) {
    for (Eigen::Index j = 0; j < (step ? count - 1 : 1); ++j) {
      Eigen::MatrixXd columns(count, 1 + (smooth ? 1 : 0) + (step ? 1 : 0));
      columns.col(0).setOnes();
      if (smooth) columns.col(1) = shape;
      if (step) {
        auto last = columns.col(columns.cols() - 1);
        last.setZero();
        last.tail(count - 1 - j).setOnes();
      }
      CourseFit fit = fitCourse(columns, centres, (smooth ? 1 : 0) + (step ? 1 : 0), noise_um);
      if (fit.bic < best.bic) {
        best = fit;
        best.after = step ? static_cast<int>(j) : -1;
      }
    }
  }
  return best;
}

}  // namespace

std::string toString(MovementKind kind) {
  switch (kind) {
    case MovementKind::Still:
      return "still";
    case MovementKind::Warming:
      return "warming";
    case MovementKind::Jump:
      return "jump";
    case MovementKind::Scatter:
      return "scatter";
    case MovementKind::Undecided:
      return "undecided";
  }
  return "still";
}

StylusMovement judgeMovement(const std::vector<double>& time_s, const std::vector<Eigen::Vector3d>& centre_um,
                             double noise_um, double limit_um) {
  SPINDRIFT_ASSERT(time_s.size() == centre_um.size(), "one time per pass");
  StylusMovement movement;
  const auto count = static_cast<Eigen::Index>(centre_um.size());
  Eigen::MatrixX3d centres(count, 3);
  Eigen::VectorXd time(count);
  double largest_from_first = 0.0;
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    centres.row(k) = (centre_um[at] - centre_um.front()).transpose();
    time(k) = time_s[at] - time_s.front();
    largest_from_first = std::max(largest_from_first, centres.row(k).norm());
    if (k == 0) continue;
    const Eigen::Vector3d d = centre_um[at] - centre_um[at - 1];
    if (d.norm() > movement.largest_um) {
      movement.largest_um = d.norm();
      movement.direction = d.normalized();
    }
  }
  if (std::max(movement.largest_um, largest_from_first) <= limit_um) return movement;
  movement.kind = MovementKind::Undecided;
  if (count < 4) return movement;  // three passes fit everything
  const CourseFit smooth = bestCourse(time, centres, noise_um, true, false);
  const CourseFit step = bestCourse(time, centres, noise_um, false, true);
  const CourseFit both = bestCourse(time, centres, noise_um, true, true);
  const CourseFit& sudden = step.bic <= both.bic ? step : both;
  movement.scatter_um = smooth.rms;
  movement.bic_smooth = smooth.bic;
  movement.bic_step = sudden.bic;
  const bool jumps = smooth.bic - sudden.bic > decisive_bic && sudden.step.norm() > limit_um;
  const double left = std::min(smooth.rms, sudden.rms);
  // What no course explains is scatter: well above the noise of a centre and above the limit of one coordinate.
  if (left > 4.0 * noise_um && left * std::sqrt(3.0) > 0.5 * limit_um && count >= 5) {
    movement.kind = MovementKind::Scatter;
  } else if (jumps) {
    movement.kind = MovementKind::Jump;
    movement.jump_um = sudden.step.norm();
    movement.jump_after = sudden.after;
    movement.direction = sudden.step.transpose().normalized();
  } else if (sudden.bic - smooth.bic > 2.0) {
    movement.kind = MovementKind::Warming;
  }
  return movement;
}

}  // namespace spindrift
