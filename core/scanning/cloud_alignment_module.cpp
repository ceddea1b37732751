// SPDX-License-Identifier: Apache-2.0
// The module behind core/scanning/cloud_alignment.h, and the only file that sees PCL.
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/ndt.h>
#include <pcl/search/kdtree.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "core/scanning/cloud_alignment.h"

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

PclCloud::Ptr toPcl(const std::vector<Eigen::Vector3f>& points) {
  PclCloud::Ptr out(new PclCloud);
  out->reserve(points.size());
  for (const Eigen::Vector3f& q : points)
    // Squares of distances must be numbers in float as well.
    if (q.allFinite() && q.cwiseAbs().maxCoeff() < 1e6F) out->emplace_back(q.x(), q.y(), q.z());
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

CloudAlignment align(const std::vector<Eigen::Vector3f>& source, const std::vector<Eigen::Vector3f>& target, bool ndt,
                     const Eigen::Matrix4f& guess, const PclSettings& settings) {
  CloudAlignment result;
  const PclCloud::Ptr from = toPcl(source);
  const PclCloud::Ptr onto = toPcl(target);
  const PclCloud::Ptr few_from = thinned(from, ndt ? settings.icp_leaf_mm : settings.gicp_leaf_mm);
  const PclCloud::Ptr few_onto = ndt ? onto : thinned(onto, settings.gicp_leaf_mm);
  result.used_from = few_from->size();
  result.used_onto = few_onto->size();
  result.least = static_cast<std::size_t>(std::max(settings.gicp_neighbours, 20));
  if (result.used_from < result.least || result.used_onto < result.least) {
    result.outcome = CloudAlignmentOutcome::TooFewPoints;
    return result;
  }
  if (ndt && !holdsDistributions(*onto, settings.ndt_resolution_mm)) {
    result.outcome = CloudAlignmentOutcome::CellsTooEmpty;
    return result;
  }
  const pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new PatientTree);
  PclCloud aligned;
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
    if (!near.allFinite()) {
      result.outcome = CloudAlignmentOutcome::NoMotion;
      return result;
    }
    pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
    icp.setMaxCorrespondenceDistance(settings.icp_distance_mm);
    icp.setTransformationEpsilon(1e-12);
    icp.setEuclideanFitnessEpsilon(1e-12);
    icp.setMaximumIterations(settings.icp_iterations);
    icp.setSearchMethodTarget(tree);
    icp.setInputSource(few_from);
    icp.setInputTarget(few_onto);
    icp.align(aligned, near);
    result.converged = icp.hasConverged();
    result.onto_from_from = icp.getFinalTransformation();
    result.mean_square_mm2 = icp.getFitnessScore(1.0);
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
    result.converged = gicp.hasConverged();
    result.onto_from_from = gicp.getFinalTransformation();
    result.mean_square_mm2 = gicp.getFitnessScore(1.0);
  }
  return result;
}

}  // namespace
}  // namespace spindrift

extern "C" {
extern __attribute__((visibility("default"))) const spindrift::CloudAligner spindrift_cloud_aligner;
const spindrift::CloudAligner spindrift_cloud_aligner{spindrift::align};
}
