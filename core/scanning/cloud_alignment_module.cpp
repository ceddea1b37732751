// SPDX-License-Identifier: Apache-2.0
// The module behind core/scanning/cloud_alignment.h, and the only file that sees PCL.
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/registration/gicp.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/ndt.h>
#include <pcl/search/kdtree.h>

#include <Eigen/Eigenvalues>
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

/// How far the points of `from`, moved by `onto_from_from`, are from the planes that their neighbours in `onto` make.
void compare(const PclCloud& from, const PclCloud::Ptr& onto, CloudAlignment& result) {
  constexpr std::size_t most_compared = 20000;
  constexpr int neighbours = 12;
  constexpr double within = 4.0;  // times what neighbours leave of their plane, the median of all places
  constexpr double beside = 3.0;  // times their distance: further away there is no neighbour
  PatientTree tree;
  tree.setInputCloud(onto);
  struct Compared {
    double distance_mm = 0.0;
    bool beside = false;
  };
  std::vector<Compared> compared;
  std::vector<double> roughness;
  std::vector<double> distances;
  const Eigen::Matrix3f rotation = result.onto_from_from.topLeftCorner<3, 3>();
  const Eigen::Vector3f shift = result.onto_from_from.topRightCorner<3, 1>();
  const std::size_t step = std::max<std::size_t>(1, from.size() / most_compared);
  pcl::Indices indices;
  std::vector<float> squares;
  for (std::size_t i = 0; i < from.size(); i += step) {
    const Eigen::Vector3f place = rotation * from[i].getVector3fMap() + shift;
    if (!place.allFinite()) continue;
    if (tree.nearestKSearch(pcl::PointXYZ(place.x(), place.y(), place.z()), neighbours, indices, squares) < neighbours)
      continue;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const auto k : indices) mean += (*onto)[static_cast<std::size_t>(k)].getVector3fMap().cast<double>();
    mean /= neighbours;
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const auto k : indices) {
      const Eigen::Vector3d d = (*onto)[static_cast<std::size_t>(k)].getVector3fMap().cast<double>() - mean;
      scatter += d * d.transpose() / neighbours;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(scatter);
    const double distance = std::abs(axes.eigenvectors().col(0).dot(place.cast<double>() - mean));
    const double width = std::sqrt(std::max(0.0, axes.eigenvalues()[2]));
    compared.push_back({distance, (place.cast<double>() - mean).norm() < beside * width});
    roughness.push_back(std::sqrt(std::max(0.0, axes.eigenvalues()[0])));
    distances.push_back(distance);
  }
  if (compared.empty()) return;
  const auto medianOf = [](std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  result.median_mm = medianOf(distances);
  // Coordinates are of single precision.
  const double limit = within * std::max(medianOf(roughness), 1e-4);
  double agreeing = 0.0;
  double sum = 0.0;
  for (const Compared& c : compared) {
    if (!c.beside || c.distance_mm > limit) continue;
    agreeing += 1.0;
    sum += c.distance_mm * c.distance_mm;
  }
  result.agreeing_part = agreeing / static_cast<double>(compared.size());
  result.rms_mm = agreeing > 0.0 ? std::sqrt(sum / agreeing) : 0.0;
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
  }
  if (result.onto_from_from.allFinite()) compare(*few_from, few_onto, result);
  return result;
}

}  // namespace
}  // namespace spindrift

extern "C" {
extern __attribute__((visibility("default"))) const spindrift::CloudAligner spindrift_cloud_aligner;
const spindrift::CloudAligner spindrift_cloud_aligner{spindrift::align};
}
