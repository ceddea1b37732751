// SPDX-License-Identifier: GPL-3.0-or-later
// Registration of two scans of the paper's surface, 640,000 points each, white noise 0.5 um: errors, Cramer-Rao bound
// and time of ours, PCL's generalised ICP and NDT + ICP in one run. Then the coverage of the stated covariance.
//   scanning_benchmark [full runs] [small runs] [no-pcl]
#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <string_view>

#include "core/math/distributions.h"
#include "core/scanning/registration.h"
#include "core/simulation/virtual_profiler.h"

namespace {

using namespace spindrift;
using Vector6 = Eigen::Matrix<double, 6, 1>;

double cpu_ms() {
  return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
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

void row(std::string_view name, const Vector6& squares, const Vector6& bound_squares, double ms, int runs) {
  const Vector6 rms = (squares / runs).cwiseSqrt();
  fmt::print("{:9} translation {:.5f} um, rotation {:.4f} urad, {:.2f} x bound, {:.1f} ms CPU\n", name,
             1e3 * rms.head<3>().norm(), 1e6 * rms.tail<3>().norm(),
             std::sqrt((squares.cwiseQuotient(bound_squares)).sum() / 6.0), ms / runs);
}

}  // namespace

int main(int argc, char** argv) {
  const int full = argc > 1 ? std::atoi(argv[1]) : 5;
  const int small = argc > 2 ? std::atoi(argv[2]) : 500;
  const bool pcl = argc < 4;
  Random random(1);
  Vector6 ours = Vector6::Zero(), gicp = ours, ndt = ours, bound = ours;
  double ours_ms = 0.0, gicp_ms = 0.0, ndt_ms = 0.0, inside_full = 0.0;
  int peers = 0;
  for (int run = 0; run < full; ++run) {
    const Pair pair = makePair(1300, 0.01, 0.0704, random);
    double start = cpu_ms();
    const RegistrationResult r = registerClouds(pair.source, pair.target);
    ours_ms += cpu_ms() - start;
    ours += errorOf(r).cwiseAbs2();
    bound += boundOf(pair, r.centroid_mm).cwiseAbs2();
    for (int i = 0; i < 6; ++i) inside_full += std::abs(errorOf(r)[i]) < 1.96 * r.standardUncertainty(i) ? 1.0 : 0.0;
    if (run == 0) fmt::print("{} and {} points\n", pair.source.size(), pair.target.size());
    if (!pcl || run >= 2) continue;
    ++peers;
    RegistrationOptions options;
    options.method = RegistrationMethod::Gicp;
    start = cpu_ms();
    gicp += errorOf(registerClouds(pair.source, pair.target, options)).cwiseAbs2();
    gicp_ms += cpu_ms() - start;
    options.method = RegistrationMethod::NdtIcp;
    start = cpu_ms();
    ndt += errorOf(registerClouds(pair.source, pair.target, options)).cwiseAbs2();
    ndt_ms += cpu_ms() - start;
  }
  row("ours", ours, bound, ours_ms, full);
  if (peers > 0) {
    row("gicp", gicp, bound / full * peers, gicp_ms, peers);
    row("ndt-icp", ndt, bound / full * peers, ndt_ms, peers);
    fmt::print("times faster: {:.1f} (gicp), {:.1f} (ndt-icp)\n", gicp_ms / peers / (ours_ms / full),
               ndt_ms / peers / (ours_ms / full));
  }
  fmt::print("full clouds: {:.1f} % of the components inside 95 %\n", 100.0 * inside_full / (6.0 * full));
  double inside = 0.0, joint = 0.0;
  for (int run = 0; run < small; ++run) {
    const Pair pair = makePair(130, 0.1, 0.5, random);
    const RegistrationResult r = registerClouds(pair.source, pair.target);
    const Vector6 e = errorOf(r);
    for (int i = 0; i < 6; ++i) inside += std::abs(e[i]) < 1.96 * r.standardUncertainty(i) ? 1.0 : 0.0;
    joint += e.dot(r.covariance.inverse() * e) < chiSquaredQuantile(0.95, 6.0) ? 1.0 : 0.0;
  }
  if (small > 0)
    fmt::print("small clouds, {} runs: {:.2f} % of the components, {:.2f} % of the runs (joint) inside 95 %\n", small,
               100.0 * inside / (6.0 * small), 100.0 * joint / small);
  return 0;
}
