// SPDX-License-Identifier: Apache-2.0
#include "core/probing/artefact_place.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace spindrift {
namespace {

constexpr double largest_turn_rad = 0.1;

Eigen::Matrix3d turnedBy(double c_deg, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(c_deg * rad_per_deg, axis).toRotationMatrix();
}

}  // namespace

Eigen::Vector3d ArtefactPlace::offset_mm(const Eigen::Vector3d& nominal_mm, double c_deg) const {
  return turnedBy(c_deg, axis) * on_table_mm + centre_offset_mm + turn_rad * axis.cross(nominal_mm - centre_mm);
}

ArtefactPlace registerArtefact(const std::vector<FoundFeature>& features, const Eigen::Vector3d& axis,
                               const Eigen::Vector3d& centre_mm) {
  ArtefactPlace place;
  place.axis = axis;
  place.centre_mm = centre_mm;
  if (features.empty()) return place;
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = axis.unitOrthogonal();
  across.col(1) = axis.cross(across.col(0));
  const auto n = static_cast<Eigen::Index>(features.size());
  Eigen::MatrixXd A(2 * n, 5);
  Eigen::VectorXd y(2 * n);
  double reach_mm = 1.0;  // makes the column of the turn as large as the others
  for (const FoundFeature& f : features) reach_mm = std::max(reach_mm, (f.nominal_mm - centre_mm).norm());
  for (Eigen::Index i = 0; i < n; ++i) {
    const FoundFeature& f = features[static_cast<std::size_t>(i)];
    A.block<2, 2>(2 * i, 0) = across.transpose() * turnedBy(f.c_deg, axis) * across;
    A.block<2, 2>(2 * i, 2).setIdentity();
    A.block<2, 1>(2 * i, 4) = across.transpose() * axis.cross(f.nominal_mm - centre_mm) / reach_mm;
    y.segment<2>(2 * i) = across.transpose() * (f.found_mm - f.nominal_mm);
  }
  constexpr double near_mm = 0.05;  // a feature that fits so well has weight enough
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(2 * n);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(5);
  for (int iteration = 0; iteration < 50; ++iteration) {
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(1e-6);
    solver.compute(weight.asDiagonal() * A);
    x = solver.solve(weight.cwiseProduct(y));
    const Eigen::VectorXd residual = y - A * x;
    for (Eigen::Index i = 0; i < n; ++i)
      weight.segment<2>(2 * i).setConstant(1.0 / std::sqrt(std::max(near_mm, residual.segment<2>(2 * i).norm())));
  }
  if (std::abs(x(4) / reach_mm) > largest_turn_rad) return place;
  place.on_table_mm = across * x.head<2>();
  place.centre_offset_mm = across * x.segment<2>(2);
  place.turn_rad = x(4) / reach_mm;
  for (const FoundFeature& f : features)
    place.largest_mm = std::max(place.largest_mm, place.offset_mm(f.nominal_mm, f.c_deg).norm());
  return place;
}

}  // namespace spindrift
