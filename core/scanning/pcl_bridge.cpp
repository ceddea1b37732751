// SPDX-License-Identifier: Apache-2.0
#include "core/scanning/pcl_bridge.h"

#include <fmt/format.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/ndt.h>
#include <pcl/search/kdtree.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "core/scanning/registration_solver.h"

namespace spindrift {
namespace {

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

/// PCL ends the process where a place that is asked for is not finite; this tree says that nothing is near it.
class PatientTree : public pcl::search::KdTree<pcl::PointXYZ> {
 public:
  using pcl::search::KdTree<pcl::PointXYZ>::nearestKSearch;
  int nearestKSearch(const pcl::PointXYZ& point, int k, pcl::Indices& indices,
                     std::vector<float>& square_distances) const override {
    if (point.getVector3fMap().allFinite())
      return pcl::search::KdTree<pcl::PointXYZ>::nearestKSearch(point, k, indices, square_distances);
    indices.assign(static_cast<std::size_t>(k), 0);
    square_distances.assign(static_cast<std::size_t>(k), std::numeric_limits<float>::max());
    return 0;
  }
};

PclCloud::Ptr toPcl(const PointCloud& cloud, const Eigen::Vector3d& origin) {
  PclCloud::Ptr out(new PclCloud);
  out->reserve(cloud.size());
  for (const Eigen::Vector3d& p : cloud.points_mm) {
    const Eigen::Vector3f q = (p - origin).cast<float>();
    // Squares of distances must be numbers in float as well.
    if (q.allFinite() && q.cwiseAbs().maxCoeff() < 1e6F) out->emplace_back(q.x(), q.y(), q.z());
  }
  return out;
}

/// The normal distributions transform needs cells of that width that hold a distribution (PCL: six points).
bool holdsDistributions(const PclCloud& cloud, float width_mm) {
  std::map<std::array<std::int64_t, 3>, int> cells;
  const auto index = [&](float v) { return static_cast<std::int64_t>(std::floor(v / width_mm)); };
  int full = 0;
  for (const pcl::PointXYZ& p : cloud)
    if (++cells[{index(p.x), index(p.y), index(p.z)}] == 6) ++full;
  return full >= 3;
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
  const auto rejected = [&](std::string message) {
    result.status = FitStatus::Rejected;
    result.message = std::move(message);
    return result;
  };
  const PclCloud::Ptr few_from = thinned(from, ndt ? settings.icp_leaf_mm : settings.gicp_leaf_mm);
  const PclCloud::Ptr few_onto = ndt ? onto : thinned(onto, settings.gicp_leaf_mm);
  const auto least = static_cast<std::size_t>(std::max(settings.gicp_neighbours, 20));
  if (few_from->size() < least || few_onto->size() < least)
    throw InputError(
        fmt::format("Only {} points of the scan and {} of the reference lie apart; at least {} are needed.",
                    few_from->size(), few_onto->size(), least));
  if (ndt && !holdsDistributions(*onto, settings.ndt_resolution_mm))
    return rejected(fmt::format("The points of the reference lie too far apart: cells of {:.3g} mm hold too few.",
                                settings.ndt_resolution_mm));
  const pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new PatientTree);
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
    const Eigen::Matrix4f near = first.getFinalTransformation();
    if (!near.allFinite()) return rejected("The normal distributions transform found no motion.");
    pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
    icp.setMaxCorrespondenceDistance(settings.icp_distance_mm);
    icp.setTransformationEpsilon(1e-12);
    icp.setEuclideanFitnessEpsilon(1e-12);
    icp.setMaximumIterations(settings.icp_iterations);
    icp.setSearchMethodTarget(tree);
    icp.setInputSource(few_from);
    icp.setInputTarget(few_onto);
    icp.align(aligned, near);
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
    gicp.setSearchMethodTarget(tree);
    gicp.setInputSource(few_from);
    gicp.setInputTarget(few_onto);
    gicp.align(aligned, guess);
    converged = gicp.hasConverged();
    found = gicp.getFinalTransformation();
    fitness = gicp.getFitnessScore(1.0);
  }
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
