// SPDX-License-Identifier: GPL-3.0-or-later
// Registration of two scans of the paper's surface, 640,000 points each, white noise 0.5 um: errors, Cramer-Rao bound
// and time of ours, PCL's generalised ICP and NDT + ICP in one run, these two with several settings each, of which the
// most accurate and the fastest usable one are compared with ours. Then the coverage of the stated covariance.
//   scanning_benchmark [full runs] [small runs] [no-pcl]
#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/job_context.h"
#include "core/math/distributions.h"
#include "core/scanning/pcl_bridge.h"
#include "core/scanning/registration.h"
#include "core/simulation/virtual_profiler.h"

namespace {

using namespace spindrift;
using Vector6 = Eigen::Matrix<double, 6, 1>;

double cpu_ms() {
  return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Median time (ms, processor time of all threads and by the clock on the wall) of a registration, and of reading both
/// clouds once, which no method can do without: the ratio does not depend on the machine.
void timeOf(const PointCloud& source, const PointCloud& target) {
  std::vector<double> processor, wall, reading;
  for (int k = 0; k < 15; ++k) {
    double start = cpu_ms();
    volatile double sum = 0.0;
    for (const PointCloud* cloud : {&source, &target}) {
      Eigen::Vector3d low = cloud->points_mm.front(), high = low;
      for (const Eigen::Vector3d& p : cloud->points_mm) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
      sum = sum + (high - low).norm();
    }
    reading.push_back(cpu_ms() - start);
    start = cpu_ms();
    const RegistrationResult r = registerClouds(source, target);
    processor.push_back(cpu_ms() - start);
    wall.push_back(r.elapsed_ms);
  }
  for (std::vector<double>* v : {&processor, &wall, &reading}) std::sort(v->begin(), v->end());
  const std::size_t middle = processor.size() / 2;
  fmt::print(
      "{} points registered in {:.1f} ms on {} threads, least {:.1f} ms ({:.1f} ms of processor); smallest box "
      "around both {:.2f} ms, ratio {:.1f}\n",
      source.size() + target.size(), wall[middle], threadCount(), wall.front(), processor[middle], reading[middle],
      processor[middle] / reading[middle]);
}

SmallError motion() {
  return {{0.012, -0.035, 0.021}, {20e-6, -30e-6, 25e-6}};
}

struct Pair {
  PointCloud source, target;
};

Pair makePair(int points, double interval, double spacing, Random& random) {
  VirtualProfilerMounting mounting;
  mounting.lever_mm.setZero();
  mounting.lift_mm = 0.0;
  VirtualOptics optics;
  optics.profile_points = points;
  optics.profile_interval_mm = interval;
  optics.profile_spacing_mm = spacing;
  optics.speckle_noise_um = optics.position_error_um = 0.0;
  optics.outlier_rate = optics.edge_outlier_rate = optics.lost_rate = 0.0;
  const VirtualArtefact artefact;
  Pair pair;
  pair.target = virtualScan(artefact, mounting, optics, {}, random);
  pair.source = virtualScan(
      artefact, mounting, optics, [](double) { return motion(); }, random);
  return pair;
}

Vector6 errorOf(const RegistrationResult& r) {
  const SmallError truth = motion().at(r.centroid_mm);
  Vector6 e;
  e << r.translation_mm - truth.translation_mm, r.rotation_rad - truth.rotation_rad;
  return e;
}

/// Cramer-Rao bound of all points of the source, noise of both scans.
Vector6 boundOf(const Pair& pair, const Eigen::Vector3d& centre) {
  const VirtualArtefact a;
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  for (const Eigen::Vector3d& p : pair.source.points_mm) {
    const Eigen::Vector2d g = a.surface.gradient(p.x() - a.centre_mm.x() + 0.5 * a.surface.size_mm.x(),
                                                 p.y() - a.centre_mm.y() + 0.5 * a.surface.size_mm.y());
    Vector6 j;
    j.head<3>() << -g.x(), -g.y(), 1.0;
    j.tail<3>() = (p - centre).cross(Eigen::Vector3d(j.head<3>()));
    information += j * j.transpose() / (2.0 * 0.25e-6);
  }
  return information.inverse().diagonal().cwiseSqrt();
}

/// A part of `runs` with its 95 % interval (Wilson 1927).
std::string partWithInterval(double inside, double runs) {
  const double p = inside / runs, z2 = 1.96 * 1.96;
  const double middle = (p + z2 / (2.0 * runs)) / (1.0 + z2 / runs);
  const double half = 1.96 * std::sqrt(p * (1.0 - p) / runs + z2 / (4.0 * runs * runs)) / (1.0 + z2 / runs);
  return fmt::format("{:.2f} % [{:.2f}, {:.2f}]", 100.0 * p, 100.0 * (middle - half), 100.0 * (middle + half));
}

void row(std::string_view name, const Vector6& squares, const Vector6& bound_squares, double ms, int runs) {
  const Vector6 rms = (squares / runs).cwiseSqrt();
  fmt::print("{:9} translation {:.5f} um, rotation {:.4f} urad, {:.2f} x bound, {:.1f} ms CPU\n", name,
             1e3 * rms.head<3>().norm(), 1e6 * rms.tail<3>().norm(),
             std::sqrt((squares.cwiseQuotient(bound_squares)).sum() / 6.0), ms / runs);
}

/// A way to use PCL, with its errors and time on one pair of scans.
struct Peer {
  RegistrationMethod method = RegistrationMethod::Gicp;
  std::string settings;
  PclSettings pcl;
  double translation_um = 0.0, rotation_urad = 0.0, ms = 0.0;
};

std::vector<Peer> peersToTry() {
  std::vector<Peer> peers;
  for (const float leaf : {0.05F, 0.1F, 0.2F})
    for (const double distance : {0.3, 1.0}) {
      Peer p{RegistrationMethod::Gicp, fmt::format("leaf {} mm, pairs within {} mm", leaf, distance), {}};
      p.pcl.gicp_leaf_mm = leaf;
      p.pcl.gicp_distance_mm = distance;
      peers.push_back(p);
    }
  for (const float resolution : {0.5F, 1.0F, 2.0F})
    for (const float leaf : {0.2F, 0.0F}) {
      if (leaf == 0.0F && resolution != 1.0F) continue;  // every point: slow, the start hardly matters
      Peer p{RegistrationMethod::NdtIcp,
             fmt::format("NDT {} mm, ICP {}, pairs within 0.2 mm", resolution,
                         leaf > 0.0F ? fmt::format("leaf {} mm", leaf) : "every point"),
             {}};
      p.pcl.ndt_resolution_mm = resolution;
      p.pcl.icp_leaf_mm = leaf;
      p.pcl.icp_distance_mm = 0.2;
      p.pcl.icp_iterations = 100;
      peers.push_back(p);
    }
  Peer plain{RegistrationMethod::NdtIcp, "NDT 1 mm, ICP every point, pairs within 0.5 mm", {}};
  peers.push_back(plain);
  return peers;
}

void compareWithPeers(const Pair& pair, double ours_ms) {
  std::vector<Peer> peers = peersToTry();
  for (Peer& p : peers) {
    RegistrationOptions options;
    options.method = p.method;
    const double start = cpu_ms();
    const RegistrationResult r = registerWithPcl(pair.source, pair.target, options, p.pcl);
    p.ms = cpu_ms() - start;
    const Vector6 e = errorOf(r);
    p.translation_um = 1e3 * e.head<3>().norm();
    p.rotation_urad = 1e6 * e.tail<3>().norm();
    fmt::print("  {:8} {:44} {:9.4f} um {:9.3f} urad {:8.0f} ms CPU\n",
               p.method == RegistrationMethod::Gicp ? "gicp" : "ndt-icp", p.settings, p.translation_um, p.rotation_urad,
               p.ms);
  }
  for (const RegistrationMethod method : {RegistrationMethod::Gicp, RegistrationMethod::NdtIcp}) {
    const Peer *best = nullptr, *fastest = nullptr;
    for (const Peer& p : peers) {
      if (p.method != method) continue;
      const auto score = [](const Peer& q) { return q.translation_um / 0.1 + q.rotation_urad / 6.0; };
      if (best == nullptr || score(p) < score(*best)) best = &p;
      if (fastest == nullptr || p.ms < fastest->ms) fastest = &p;
    }
    fmt::print(
        "{}: most accurate ({}) {:.4f} um, {:.3f} urad, ours is {:.1f} times faster; fastest ({}) {:.4f} um, "
        "{:.3f} urad, ours is {:.1f} times faster\n",
        method == RegistrationMethod::Gicp ? "gicp" : "ndt-icp", best->settings, best->translation_um,
        best->rotation_urad, best->ms / ours_ms, fastest->settings, fastest->translation_um, fastest->rotation_urad,
        fastest->ms / ours_ms);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int full = argc > 1 ? std::atoi(argv[1]) : 5;
  const int small = argc > 2 ? std::atoi(argv[2]) : 500;
  const bool pcl = argc < 4;
  Random random(1);
  Vector6 ours = Vector6::Zero(), bound = ours;
  double ours_ms = 0.0;
  Vector6 inside_full = Vector6::Zero();
  double joint_full = 0.0;
  Pair first;
  for (int run = 0; run < full; ++run) {
    const Pair pair = makePair(1300, 0.01, 0.0704, random);
    double start = cpu_ms();
    const RegistrationResult r = registerClouds(pair.source, pair.target);
    ours_ms += cpu_ms() - start;
    ours += errorOf(r).cwiseAbs2();
    bound += boundOf(pair, r.centroid_mm).cwiseAbs2();
    const Vector6 e = errorOf(r);
    for (int i = 0; i < 6; ++i) inside_full[i] += std::abs(e[i]) < 1.96 * r.standardUncertainty(i) ? 1.0 : 0.0;
    joint_full += e.dot(r.covariance.inverse() * e) < chiSquaredQuantile(0.95, 6.0) ? 1.0 : 0.0;
    if (run == 0) fmt::print("{} and {} points\n", pair.source.size(), pair.target.size());
    if (run == 0) first = pair;
    if (run == 0) timeOf(pair.source, pair.target);
  }
  row("ours", ours, bound, ours_ms, full);
  if (pcl) compareWithPeers(first, ours_ms / full);
  const auto coverage = [](std::string_view what, const Vector6& inside, double joint, int runs) {
    if (runs < 1) return;
    const char* const names[] = {"EX", "EY", "EZ", "EA", "EB", "EC"};
    fmt::print("{}, {} runs, truth inside the stated 95 % [95 % interval of that]\n", what, runs);
    for (int i = 0; i < 6; ++i) fmt::print("  {}          {}\n", names[i], partWithInterval(inside[i], runs));
    fmt::print("  components  {} (taken as independent)\n", partWithInterval(inside.sum(), 6.0 * runs));
    fmt::print("  joint       {}\n", partWithInterval(joint, runs));
  };
  coverage("full clouds", inside_full, joint_full, full);
  Vector6 inside = Vector6::Zero();
  double joint = 0.0;
  for (int run = 0; run < small; ++run) {
    const Pair pair = makePair(130, 0.1, 0.5, random);
    const RegistrationResult r = registerClouds(pair.source, pair.target);
    const Vector6 e = errorOf(r);
    for (int i = 0; i < 6; ++i) inside[i] += std::abs(e[i]) < 1.96 * r.standardUncertainty(i) ? 1.0 : 0.0;
    joint += e.dot(r.covariance.inverse() * e) < chiSquaredQuantile(0.95, 6.0) ? 1.0 : 0.0;
  }
  coverage("small clouds", inside, joint, small);
  return 0;
}
