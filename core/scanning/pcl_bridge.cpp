// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/pcl_bridge.h"

#include <fmt/format.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/ndt.h>

#include <Eigen/Cholesky>
#include <chrono>
#include <limits>

#include "core/scanning/registration_solver.h"

namespace spindrift {
namespace {

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

PclCloud::Ptr toPcl(const PointCloud& cloud, const Eigen::Vector3d& origin) {
  PclCloud::Ptr out(new PclCloud);
  out->reserve(cloud.size());
  for (const Eigen::Vector3d& p : cloud.points_mm) {
    const Eigen::Vector3f q = (p - origin).cast<float>();
    out->emplace_back(q.x(), q.y(), q.z());
  }
  return out;
}

PclCloud::Ptr thinned(const PclCloud::Ptr& cloud, float leaf_mm) {
  if (!(leaf_mm > 0.0F)) return cloud;
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setLeafSize(leaf_mm, leaf_mm, leaf_mm);
  grid.setInputCloud(cloud);
  PclCloud::Ptr out(new PclCloud);
  grid.filter(*out);
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
  const PclCloud::Ptr from = toPcl(source_clean, centre);
  const PclCloud::Ptr onto = toPcl(target_clean, centre);
  Eigen::Matrix4f guess = Eigen::Matrix4f::Identity();
  guess.topLeftCorner<3, 3>() =
      RigidTransform::fromRotationVector(options.start_rotation_rad, Eigen::Vector3d::Zero()).rotation().cast<float>();
  guess.topRightCorner<3, 1>() = options.start_translation_mm.cast<float>();
  PclCloud aligned;
  bool converged = false;
  Eigen::Matrix4f found = guess;
  double fitness = 0.0;
  if (ndt) {
    pcl::NormalDistributionsTransform<pcl::PointXYZ, pcl::PointXYZ> first;
    first.setResolution(settings.ndt_resolution_mm);
    first.setStepSize(0.1);
    first.setTransformationEpsilon(1e-6);
    first.setMaximumIterations(40);
    first.setInputSource(thinned(from, settings.ndt_leaf_mm));
    first.setInputTarget(onto);
    first.align(aligned, guess);
    pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
    icp.setMaxCorrespondenceDistance(settings.icp_distance_mm);
    icp.setTransformationEpsilon(1e-12);
    icp.setEuclideanFitnessEpsilon(1e-12);
    icp.setMaximumIterations(settings.icp_iterations);
    icp.setInputSource(thinned(from, settings.icp_leaf_mm));
    icp.setInputTarget(onto);
    icp.align(aligned, first.getFinalTransformation());
    converged = icp.hasConverged();
    found = icp.getFinalTransformation();
    fitness = icp.getFitnessScore(1.0);
  } else {
    pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> gicp;
    gicp.setMaxCorrespondenceDistance(settings.gicp_distance_mm);
    gicp.setCorrespondenceRandomness(settings.gicp_neighbours);
    gicp.setTransformationEpsilon(1e-9);
    gicp.setRotationEpsilon(1e-9);
    gicp.setMaximumIterations(settings.gicp_iterations);
    const PclCloud::Ptr few_from = thinned(from, settings.gicp_leaf_mm);
    const PclCloud::Ptr few_onto = thinned(onto, settings.gicp_leaf_mm);
    gicp.setInputSource(few_from);
    gicp.setInputTarget(few_onto);
    gicp.align(aligned, guess);
    converged = gicp.hasConverged();
    found = gicp.getFinalTransformation();
    fitness = gicp.getFitnessScore(1.0);
  }
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
  result.rms_mm = std::sqrt(std::max(fitness, 0.0));
  result.points_used = source_clean.size();
  result.overlap = 1.0;
  result.inliers = 1.0;
  const double size = (target_clean.points_mm.front() - target_clean.points_mm.back()).norm();
  result.status = converged && result.rms_mm < 0.05 * size ? FitStatus::Converged : FitStatus::Rejected;
  if (!converged)
    result.message = "PCL reports no convergence.";
  else if (!result.usable())
    result.message = fmt::format("The clouds do not fit: root mean square distance {:.3g} mm.", result.rms_mm);
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
      double squares = 0.0;
      for (const CellResidual& r : residuals) {
        normal += r.weight * r.jacobian * r.jacobian.transpose();
        squares += r.weight * r.residual * r.residual;
      }
      const Eigen::LDLT<Matrix6> ldlt(normal);
      if (residuals.size() > 12 && ldlt.info() == Eigen::Success) {
        const double variance = squares / static_cast<double>(residuals.size() - 6);
        result.covariance = variance * ldlt.solve(Matrix6::Identity());
        result.white_covariance = result.covariance;
      }
    } catch (const InputError&) {
      // A free-form cloud: no uncertainty is stated.
      result.message = "No uncertainty is stated: the target is no height map.";
    }
  }
  result.elapsed_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace spindrift
