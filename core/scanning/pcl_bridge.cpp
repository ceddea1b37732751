// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/pcl_bridge.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/scanning/cloud_alignment.h"
#include "core/scanning/registration_solver.h"

namespace spindrift {
namespace {

std::vector<Eigen::Vector3f> seenFrom(const Eigen::Vector3d& origin, const PointCloud& cloud) {
  std::vector<Eigen::Vector3f> out;
  out.reserve(cloud.size());
  for (const Eigen::Vector3d& p : cloud.points_mm) out.push_back((p - origin).cast<float>());
  return out;
}

}  // namespace

RegistrationResult registerWithPcl(const PointCloud& source, const PointCloud& target,
                                   const RegistrationOptions& options, const PclSettings& settings) {
  if (options.scan_model != ScanModel::Rigid)
    throw InputError("NDT, ICP and generalised ICP know only rigid clouds; allowed scan model: rigid.");
  SPINDRIFT_ASSERT(options.method != RegistrationMethod::Surface, "PCL does not do this method");
  const bool ndt = options.method == RegistrationMethod::NdtIcp;
  const auto begin = std::chrono::steady_clock::now();
  RegistrationResult result;
  result.method = ndt ? "ndt-icp" : "gicp";
  result.covariance.diagonal().setConstant(std::numeric_limits<double>::infinity());
  result.white_covariance = result.covariance;
  const PointCloud source_clean = masked(source, filterCloud(source).keep);
  const PointCloud target_clean = masked(target, filterCloud(target).keep);
  if (source_clean.size() < 100 || target_clean.size() < 100) {
    result.status = FitStatus::Rejected;
    result.message = "Fewer than 100 points are left after edges and outliers have been removed.";
    return result;
  }
  const Eigen::Vector3d centre = target_clean.centroid_mm();
  const auto rejected = [&](std::string message) {
    result.status = FitStatus::Rejected;
    result.message = std::move(message);
    return result;
  };
  Eigen::Matrix4f guess = Eigen::Matrix4f::Identity();
  guess.topLeftCorner<3, 3>() =
      RigidTransform::fromRotationVector(options.start_rotation_rad, Eigen::Vector3d::Zero()).rotation().cast<float>();
  guess.topRightCorner<3, 1>() = options.start_translation_mm.cast<float>();
  const CloudAlignment motion_found =
      cloudAligner().align(seenFrom(centre, source_clean), seenFrom(centre, target_clean), ndt, guess, settings);
  switch (motion_found.outcome) {
    case CloudAlignmentOutcome::TooFewPoints:
      throw InputError(
          fmt::format("Only {} points of the scan and {} of the reference lie apart; at least {} are needed.",
                      motion_found.used_from, motion_found.used_onto, motion_found.least));
    case CloudAlignmentOutcome::CellsTooEmpty:
      return rejected(fmt::format("The points of the reference lie too far apart: cells of {:.3g} mm hold too few.",
                                  settings.ndt_resolution_mm));
    case CloudAlignmentOutcome::NoMotion:
      return rejected("The normal distributions transform found no motion.");
    case CloudAlignmentOutcome::Done:
      break;
  }
  const Eigen::Matrix4f& found = motion_found.onto_from_from;
  if (!found.allFinite() || std::abs(found.topLeftCorner<3, 3>().determinant() - 1.0F) > 0.1F)
    return rejected("The two clouds do not determine a motion between them.");
  // PCL works in float: make the rotation proper again.
  const Eigen::Matrix3d raw = found.topLeftCorner<3, 3>().cast<double>();
  const Eigen::Quaterniond q(raw);
  const Eigen::Matrix3d rotation = q.normalized().toRotationMatrix();
  const Eigen::Vector3d shift = found.topRightCorner<3, 1>().cast<double>();
  const Eigen::Matrix3d& turn = options.machine_from_profiler;
  result.centroid_mm = centre;
  result.target_from_source = RigidTransform(rotation, centre + shift - rotation * centre);
  result.translation_mm = turn * shift;
  result.rotation_rad = turn * result.target_from_source.rotationVector_rad();
  result.rms_mm = motion_found.rms_mm;
  result.points_used = source_clean.size();
  result.overlap = 1.0;
  result.inliers = motion_found.agreeing_part;
  result.status =
      motion_found.converged && result.inliers >= options.least_inliers ? FitStatus::Converged : FitStatus::Rejected;
  if (!motion_found.converged)
    result.message = "PCL reports no convergence.";
  else if (!result.usable())
    result.message = fmt::format(
        "The clouds do not fit: {:.0f} % of the points lie on the surface of the reference, half of all "
        "less than {:.3g} mm from it; at least {:.0f} % are needed.",
        100.0 * result.inliers, motion_found.median_mm, 100.0 * options.least_inliers);
  if (result.usable()) {
    try {  // the uncertainty of a point-to-plane fit at this place, where the target is a height map
      const RegistrationTarget surface(target_clean);
      const CellGrid cells = compressCloud(source_clean);
      const RegistrationSolver solver(cells, surface, options);
      ScanMotion motion = solver.start();
      motion.centre = centre;
      motion.shift = result.translation_mm;
      motion.rotation = turn * rotation * turn.transpose();
      std::vector<CellResidual> residuals;
      solver.residuals(motion, solver.allCells(), residuals);
      Matrix6 normal = Matrix6::Zero();
      Vector6 gradient = Vector6::Zero();
      double squares = 0.0;
      for (const CellResidual& r : residuals) {
        gradient += r.weight * r.residual * r.jacobian;
        normal += r.weight * r.jacobian * r.jacobian.transpose();
        squares += r.weight * r.residual * r.residual;
      }
      const Eigen::LDLT<Matrix6> ldlt(normal);
      if (residuals.size() > 12 && ldlt.info() == Eigen::Success) {
        const double variance = squares / static_cast<double>(residuals.size() - 6);
        result.covariance = variance * ldlt.solve(Matrix6::Identity());
        result.white_covariance = result.covariance;
        // PCL stops short of the minimum, by what the next step of this fit would be.
        const Vector6 short_by = ldlt.solve(gradient);
        result.covariance += short_by * short_by.transpose();
      }
    } catch (const InputError&) {
      // A free-form cloud: no uncertainty is stated.
      result.message = "No uncertainty is stated: the target is not a height map.";
    }
  }
  result.elapsed_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace spindrift
