// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scanning/registration.h"
#include "core/scanning/artefact_surface.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <string>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/math/distributions.h"

namespace spindrift {
namespace {

using Height = std::function<double(double, double)>;

double paperSurface(double x, double y) {
  return std::sin(0.6 * x) + 2.5 * std::sin(y / 6.0);
}

struct Grid {
  int profiles = 80;
  int points = 100;
  double spacing_x = 0.11;
  double spacing_y = 0.5;
};

/// A scan of z = height(x, y) by a profiler that is off by the rigid motion `target_from_source`: the reading p stands
/// for the true point target_from_source * p. `correlated`: half of the variance is a moving average over three points.
PointCloud scan(const Height& height, const RigidTransform& motion, const Grid& grid, double noise_mm, Random& random,
                bool correlated = false, double jitter_mm = 0.0) {
  PointCloud cloud;
  const double phase = random.uniform() * grid.spacing_y;
  double a = random.normal(), b = random.normal();
  for (int k = 0; k < grid.profiles; ++k) {
    const double y = phase + grid.spacing_y * k;
    const double profile = jitter_mm * random.normal();
    cloud.profile_start.push_back(cloud.size());
    for (int i = 0; i < grid.points; ++i) {
      const double x = grid.spacing_x * i;
      double z = height(x, y);
      for (int iteration = 0; iteration < 6; ++iteration) {
        const Eigen::Vector3d p = motion * Eigen::Vector3d(x, y, z);
        z -= p.z() - height(p.x(), p.y());
      }
      const double c = random.normal();
      const double n = correlated ? noise_mm * (std::sqrt(0.5) * random.normal() + std::sqrt(0.5 / 3.0) * (a + b + c))
                                  : noise_mm * c;
      a = b;
      b = c;
      cloud.points_mm.emplace_back(x, y, z + n + profile);
    }
  }
  cloud.profile_start.push_back(cloud.size());
  return cloud;
}

/// Error of a registration at its centroid: (translation mm, rotation rad).
Eigen::Matrix<double, 6, 1> errorOf(const RegistrationResult& r, const RigidTransform& truth) {
  Eigen::Matrix<double, 6, 1> e;
  e.head<3>() = r.translation_mm - (truth * r.centroid_mm - r.centroid_mm);
  e.tail<3>() = r.rotation_rad - truth.rotationVector_rad();
  return e;
}

const RigidTransform small_motion = RigidTransform::fromRotationVector({20e-6, -30e-6, 25e-6}, {0.012, -0.035, 0.021});

struct Coverage {
  double components = 0.0;         ///< part of the single components inside 95 %
  double joint = 0.0;              ///< part of the runs inside the joint 95 % region
  double ratio = 0.0;              ///< root mean square error over the stated standard uncertainty
  std::array<double, 6> ratios{};  ///< the same of each component
};

Coverage coverage(int runs, bool correlated, double jitter_mm, std::uint64_t seed) {
  Random random(seed);
  Coverage out;
  double inside = 0.0, joint = 0.0, squares = 0.0;
  for (int run = 0; run < runs; ++run) {
    Random own = random.split();
    const PointCloud target = scan(paperSurface, RigidTransform(), {}, 0.5e-3, own, correlated, jitter_mm);
    const PointCloud source = scan(paperSurface, small_motion, {}, 0.5e-3, own, correlated, jitter_mm);
    const RegistrationResult r = registerClouds(source, target);
    if (!r.usable()) continue;
    const auto e = errorOf(r, small_motion);
    for (int i = 0; i < 6; ++i) {
      const double t = e[i] / r.standardUncertainty(i);
      inside += std::abs(t) < 1.96 ? 1.0 : 0.0;
      squares += t * t;
      out.ratios[static_cast<std::size_t>(i)] += t * t / runs;
    }
    joint += e.dot(r.covariance.inverse() * e) < chiSquaredQuantile(0.95, 6.0) ? 1.0 : 0.0;
  }
  out.components = inside / (6.0 * runs);
  out.joint = joint / runs;
  out.ratio = std::sqrt(squares / (6.0 * runs));
  for (double& r : out.ratios) r = std::sqrt(r);
  return out;
}

TEST(HeightSpline, FollowsTheSurfaceToItsRim) {
  // Noise-free paper surface, cut by the window, in cells as coarse as noise of 0.5 um makes them; the last column of
  // cells is only partly filled. A spline that bends at its rim tilts every scan that is registered onto it.
  const ArtefactSurface surface;
  PointCloud cloud;
  cloud.name = "window";
  for (int k = 0; k < 120; ++k) {
    cloud.profile_start.push_back(cloud.size());
    for (int i = 0; i < 400; ++i) {
      const double x = 3.0 + 0.0125 * i, y = 5.0 + 0.15 * k;
      cloud.points_mm.emplace_back(x, y, surface.height_mm(x, y));
    }
  }
  cloud.profile_start.push_back(cloud.size());
  CellGridOptions options;
  options.cell_mm = {0.175, 0.15};
  const HeightSpline spline(compressCloud(cloud, options));
  double worst = 0.0;
  int places = 0;
  for (double y = 5.1; y < 22.6; y += 0.31)
    for (double x = 3.05; x < 8.0; x += 0.037) {
      HeightSpline::Value h;
      if (!spline.evaluate(x, y, h)) continue;
      ++places;
      worst = std::max(worst, std::abs(h.z - surface.height_mm(x, y)));
    }
  EXPECT_GT(places, 7000);
  EXPECT_LT(1e3 * worst, 0.15) << "um; with straight lines beyond the rim it is 0.4";
}

TEST(Registration, StatedCovarianceHoldsForWhiteNoise) {
  const Coverage c = coverage(300, false, 0.0, 11);
  RecordProperty("components", std::to_string(c.components));
  EXPECT_NEAR(c.components, 0.95, 0.02);
  EXPECT_NEAR(c.joint, 0.95, 0.04);
  EXPECT_NEAR(c.ratio, 1.0, 0.08);
}

/// Half a millimetre from point to point on slopes up to 45 degrees: the relief within a cell is many times the noise.
TEST(Registration, CoarseScansOfSteepReliefPromiseNoMoreThanTheyHold) {
  const Height steep = [](double x, double y) {
    return 2.0 * std::sin(2.0 * M_PI * x / 15.0) * std::cos(2.0 * M_PI * y / 12.0);
  };
  Grid grid;
  grid.profiles = grid.points = 60;
  grid.spacing_x = 0.5;
  Random random(11);
  Eigen::Matrix<double, 6, 1> squares = Eigen::Matrix<double, 6, 1>::Zero();
  constexpr int runs = 16;
  for (int run = 0; run < runs; ++run) {
    Random own = random.split();
    const PointCloud target = scan(steep, RigidTransform(), grid, 1e-3, own);
    const PointCloud source = scan(steep, RigidTransform(), grid, 1e-3, own);
    const RegistrationResult r = registerClouds(source, target);
    ASSERT_TRUE(r.usable()) << r.message;
    const auto e = errorOf(r, RigidTransform());
    for (int i = 0; i < 6; ++i) squares[i] += std::pow(e[i] / r.standardUncertainty(i), 2) / runs;
  }
  for (int i = 0; i < 6; ++i) EXPECT_LT(std::sqrt(squares[i]), 1.5) << i;
}

TEST(Registration, StatedCovarianceHoldsForCorrelatedNoise) {
  const Coverage c = coverage(200, true, 0.0, 12);
  EXPECT_NEAR(c.components, 0.95, 0.03);
  EXPECT_NEAR(c.ratio, 1.0, 0.12);
}

TEST(Registration, StatedCovarianceHoldsForProfileNoise) {
  const Coverage c = coverage(200, false, 0.2e-3, 13);
  EXPECT_NEAR(c.components, 0.95, 0.04);
  EXPECT_NEAR(c.ratio, 1.0, 0.2);
}

/// Heights of profiles scatter four times as much as their points: what a profile does not blur is not blamed for it.
TEST(Registration, StatedCovarianceHoldsInEveryDirectionForStrongProfileNoise) {
  const Coverage c = coverage(200, false, 2e-3, 14);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_GT(c.ratios[i], 0.7) << i;
    EXPECT_LT(c.ratios[i], 1.25) << i;
  }
}

TEST(Registration, ACloudOntoItselfSettles) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    const PointCloud cloud = scan(paperSurface, RigidTransform(), {}, 0.5e-3 + 5e-5 * seed, random);
    const RegistrationResult r = registerClouds(cloud, cloud);
    EXPECT_TRUE(r.usable()) << seed << ' ' << r.message;
    EXPECT_LT(r.translation_mm.norm(), 1e-6) << seed;
  }
}

TEST(Registration, ReachesTheBoundOfWhiteNoise) {
  Random random(14);
  double squares = 0.0;
  constexpr int runs = 40;
  for (int run = 0; run < runs; ++run) {
    Random own = random.split();
    const Grid grid{150, 220, 0.05, 0.27};
    const PointCloud target = scan(paperSurface, RigidTransform(), grid, 0.5e-3, own);
    const PointCloud source = scan(paperSurface, small_motion, grid, 0.5e-3, own);
    const RegistrationResult r = registerClouds(source, target);
    ASSERT_TRUE(r.usable()) << r.message;
    EXPECT_NEAR(r.misfit_ratio, 1.0, 0.15);
    // Cramer-Rao bound of all points of both scans (the surface is as good as known to each from the other).
    Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
    for (const Eigen::Vector3d& p : source.points_mm) {
      Eigen::Matrix<double, 6, 1> j;
      j.head<3>() << -0.6 * std::cos(0.6 * p.x()), -2.5 / 6.0 * std::cos(p.y() / 6.0), 1.0;
      j.tail<3>() = (p - r.centroid_mm).cross(Eigen::Vector3d(j.head<3>()));
      information += j * j.transpose() / (2.0 * 0.25e-6);
    }
    const Eigen::Matrix<double, 6, 6> bound = information.inverse();
    const auto e = errorOf(r, small_motion);
    for (int i = 0; i < 6; ++i) squares += e[i] * e[i] / bound(i, i);
  }
  EXPECT_LT(std::sqrt(squares / (6.0 * runs)), 1.2);
}

TEST(Registration, CloudsAreCompressedSideBySideAndTheNumbersStay) {
  Random random(41);
  const Grid grid;
  const PointCloud target = scan(paperSurface, RigidTransform(), grid, 0.5e-3, random);
  const PointCloud source = scan(paperSurface, small_motion, grid, 0.5e-3, random);
  const RegistrationResult together = registerClouds(source, target);
  ASSERT_TRUE(together.usable()) << together.message;
  const RegistrationResult prepared = registerToSurface(source, RegistrationTarget(target));
  EXPECT_EQ(together.translation_mm, prepared.translation_mm);
  EXPECT_EQ(together.rotation_rad, prepared.rotation_rad);
  EXPECT_EQ(together.covariance, prepared.covariance);
  // What is wrong with both is said of the source, whichever thread comes first.
  PointCloud few;
  few.name = "few.pcd";
  few.points_mm.assign(10, Eigen::Vector3d::Zero());
  PointCloud none;
  none.name = "none.pcd";
  for (int round = 0; round < 20; ++round) {
    try {
      (void)registerClouds(few, none);
      FAIL() << "accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("few.pcd"), std::string::npos) << error.what();
    }
  }
}

TEST(Registration, IsNotStuckFromFarStarts) {
  Random random(15);
  const Grid grid{100, 150, 0.073, 0.41};
  for (int run = 0; run < 12; ++run) {
    Random own = random.split();
    Eigen::Vector3d turn(own.uniform(-1, 1), own.uniform(-1, 1), own.uniform(-1, 1));
    Eigen::Vector3d shift(own.uniform(-2, 2), own.uniform(-2, 2), own.uniform(-2, 2));
    // About the middle of the artefact: two degrees, two millimetres.
    const RigidTransform middle(Eigen::Vector3d(5.5, 20.5, 0.0));
    const RigidTransform truth = middle * RigidTransform::fromRotationVector(0.035 * turn, shift) * middle.inverse();
    const PointCloud target = scan(paperSurface, RigidTransform(), grid, 0.5e-3, own);
    const PointCloud source = scan(paperSurface, truth, grid, 0.5e-3, own);
    const RegistrationResult r = registerClouds(source, target);
    ASSERT_TRUE(r.usable()) << run << ": " << r.message;
    const Eigen::Vector3d e = r.target_from_source * r.centroid_mm - truth * r.centroid_mm;
    EXPECT_LT(e.norm(), 1e-3) << run;
  }
}

TEST(Registration, NamesFreeDirections) {
  Random random(16);
  const auto run = [&](const Height& height) {
    const PointCloud target = scan(height, RigidTransform(), {}, 0.5e-3, random);
    const PointCloud source = scan(height, RigidTransform(), {}, 0.5e-3, random);
    return registerClouds(source, target);
  };
  const RegistrationResult plane = run([](double, double) { return 0.0; });
  EXPECT_EQ(plane.status, FitStatus::Degenerate);
  EXPECT_EQ(plane.free_directions.size(), 3U);
  const RegistrationResult cylinder = run([](double x, double) { return std::sqrt(400.0 - (x - 5.5) * (x - 5.5)); });
  EXPECT_EQ(cylinder.status, FitStatus::Degenerate);
  EXPECT_EQ(cylinder.free_directions.size(), 2U);
  EXPECT_NE(cylinder.message.find("shift along Y"), std::string::npos) << cylinder.message;
  EXPECT_FALSE(std::isfinite(cylinder.covariance(1, 1)));
  EXPECT_TRUE(std::isfinite(cylinder.covariance(2, 2)));
  const RegistrationResult sphere =
      run([](double x, double y) { return std::sqrt(2500.0 - (x - 5.5) * (x - 5.5) - (y - 20.5) * (y - 20.5)); });
  EXPECT_EQ(sphere.status, FitStatus::Degenerate);
  EXPECT_EQ(sphere.free_directions.size(), 3U);
  EXPECT_NE(sphere.message.find("rotation about"), std::string::npos);
}

TEST(Registration, RejectsWhatDoesNotFitAndSaysWhy) {
  Random random(17);
  const auto bumpy = [](double x, double y) {
    return paperSurface(x, y) + 0.02 * x * x + 0.001 * y * y +
           0.8 * std::exp(-((x - 3) * (x - 3) + (y - 10) * (y - 10)) / 8.0) +
           0.6 * std::exp(-((x - 8) * (x - 8) + (y - 33) * (y - 33)) / 10.0);
  };
  const PointCloud target = scan(bumpy, RigidTransform(), {}, 0.5e-3, random);
  const PointCloud other =
      scan([](double x, double y) { return 0.7 * std::sin(0.9 * x + 0.3 * y) + std::sin(0.45 * y); }, RigidTransform(),
           {}, 0.5e-3, random);
  const RegistrationResult different = registerClouds(other, target);
  EXPECT_EQ(different.status, FitStatus::Rejected);
  EXPECT_NE(different.message.find("same surface"), std::string::npos) << different.message;
  PointCloud mirror = scan(bumpy, RigidTransform(), {}, 0.5e-3, random);
  for (auto& p : mirror.points_mm) p.x() = 10.9 - p.x();
  const RegistrationResult mirrored = registerClouds(mirror, target);
  EXPECT_EQ(mirrored.status, FitStatus::Rejected);
  EXPECT_NE(mirrored.message.find("mirrored in x"), std::string::npos) << mirrored.message;
}

TEST(Registration, UsesWhatIsThereOfAHiddenOrShortScan) {
  Random random(18);
  const PointCloud target = scan(paperSurface, RigidTransform(), {}, 0.5e-3, random);
  PointCloud hand = scan(paperSurface, small_motion, {}, 0.5e-3, random);
  for (auto& p : hand.points_mm)
    if (std::hypot(p.x() - 9.0, p.y() - 12.0) < 5.0) p.z() += 15.0 - 0.1 * p.x();
  const RegistrationResult covered = registerClouds(hand, target);
  ASSERT_TRUE(covered.usable()) << covered.message;
  EXPECT_LT(errorOf(covered, small_motion).head<3>().norm(), 2e-4);
  EXPECT_LT(covered.inliers * covered.overlap, 0.95);
  const PointCloud half = scan(paperSurface, small_motion, {40, 100, 0.11, 0.5}, 0.5e-3, random);
  const RegistrationResult cut = registerClouds(half, target);
  ASSERT_TRUE(cut.usable()) << cut.message;
  EXPECT_LT(cut.overlap, 0.6);
  EXPECT_LT((errorOf(cut, small_motion).array() / cut.covariance.diagonal().array().sqrt()).abs().maxCoeff(), 4.0);
}

TEST(Registration, OutliersDoNotMatter) {
  Random random(19);
  PointCloud target = scan(paperSurface, RigidTransform(), {}, 0.5e-3, random);
  PointCloud source = scan(paperSurface, small_motion, {}, 0.5e-3, random);
  for (PointCloud* cloud : {&target, &source})
    for (auto& p : cloud->points_mm)
      if (random.uniform() < 0.01) p.z() += random.normal(0.0, 1.0);
  const RegistrationResult r = registerClouds(source, target);
  ASSERT_TRUE(r.usable()) << r.message;
  EXPECT_LT((errorOf(r, small_motion).array() / r.covariance.diagonal().array().sqrt()).abs().maxCoeff(), 4.0);
  EXPECT_LT(errorOf(r, small_motion).head<3>().norm(), 3e-4);
}

/// A code for "no value", a reflection far away: the height map of the others is what it was.
TEST(Registration, StrayPointsAreLeftOutAndCounted) {
  for (const double far_mm : {400.0, 1e5, 1e6, -1e30}) {
    Random random(19);
    PointCloud target = scan(paperSurface, RigidTransform(), {}, 0.5e-3, random);
    PointCloud source = scan(paperSurface, small_motion, {}, 0.5e-3, random);
    const RegistrationResult clean = registerClouds(source, target);
    for (PointCloud* cloud : {&source, &target}) {
      PointCloud& c = *cloud;
      const Eigen::Vector3d kept = c.points_mm[7];
      for (const int axis : {0, 1}) {
        c.points_mm[7] = kept;
        c.points_mm[7](axis) = far_mm;
        const RegistrationResult r = registerClouds(source, target);
        ASSERT_EQ(r.status, FitStatus::Converged) << r.message;
        EXPECT_EQ(r.method, clean.method);
        EXPECT_LT((r.translation_mm - clean.translation_mm).norm(), 2e-5);
        EXPECT_LT((errorOf(r, small_motion).array() / r.covariance.diagonal().array().sqrt()).abs().maxCoeff(), 4.0);
        if (cloud == &source) {
          EXPECT_NE(r.message.find("1 point far outside"), std::string::npos) << r.message;
        }
      }
      c.points_mm[7] = kept;
    }
  }
}

TEST(Registration, UnorderedPointsAreAHeightMapToo) {
  Random random(20);
  PointCloud target = scan(paperSurface, RigidTransform(), {}, 0.5e-3, random);
  PointCloud source = scan(paperSurface, small_motion, {}, 0.5e-3, random);
  for (PointCloud* cloud : {&target, &source}) {
    for (std::size_t i = cloud->size() - 1; i > 0; --i)
      std::swap(cloud->points_mm[i], cloud->points_mm[random.index(i + 1)]);
    cloud->profile_start.clear();
  }
  const RegistrationResult r = registerClouds(source, target);
  ASSERT_TRUE(r.usable()) << r.message;
  EXPECT_LT(errorOf(r, small_motion).head<3>().norm(), 3e-4);
}

TEST(Registration, GicpOfPclIsThereAsReference) {
  Random random(21);
  const Grid grid{60, 60, 0.18, 0.68};
  const PointCloud target = scan(paperSurface, RigidTransform(), grid, 0.5e-3, random);
  const PointCloud source = scan(paperSurface, small_motion, grid, 0.5e-3, random);
  RegistrationOptions options;
  options.method = RegistrationMethod::Gicp;
  const RegistrationResult r = registerClouds(source, target, options);
  EXPECT_EQ(r.method, "gicp");
  EXPECT_LT(errorOf(r, small_motion).head<3>().norm(), 0.1);
  // It stops micrometres short of the minimum, and says so.
  EXPECT_LT((errorOf(r, small_motion).array() / r.covariance.diagonal().array().sqrt()).abs().maxCoeff(), 4.0);
  options.scan_model = ScanModel::PushBroom;
  EXPECT_THROW(static_cast<void>(registerClouds(source, target, options)), InputError);
}

TEST(Registration, OtherSurfacesAreNoneOfTheReferenceByAnyMethod) {
  Random random(23);
  const Grid grid{100, 100, 0.25, 0.25};
  const auto waves = [](double x, double y) {
    return std::sin(0.48 * x) + 0.8 * std::sin(0.57 * y) + 0.6 * std::sin(0.37 * x + 0.33 * y);
  };
  const auto other = [](double x, double y) { return 0.9 * std::cos(0.7 * x + 1.0) * std::sin(0.42 * y); };
  const auto flat = [](double, double) { return 0.0; };
  const PointCloud target = scan(waves, RigidTransform(), grid, 2e-3, random);
  const PointCloud same = scan(waves, small_motion, grid, 2e-3, random);
  const PointCloud of_another = scan(other, RigidTransform(), grid, 2e-3, random);
  const PointCloud plate = scan(flat, RigidTransform(), grid, 2e-3, random);
  for (const RegistrationMethod method :
       {RegistrationMethod::Surface, RegistrationMethod::NdtIcp, RegistrationMethod::Gicp}) {
    RegistrationOptions options;
    options.method = method;
    options.fall_back = method == RegistrationMethod::Surface;
    const RegistrationResult fitting = registerClouds(same, target, options);
    EXPECT_TRUE(fitting.usable()) << fitting.message;
    // The distance from the surface, not that of one point from the next.
    EXPECT_LT(fitting.rms_mm, 0.02) << fitting.method;
    for (const PointCloud* cloud : {&of_another, &plate}) {
      const RegistrationResult r = registerClouds(*cloud, target, options);
      EXPECT_FALSE(r.usable()) << r.method << ": " << r.message;
      EXPECT_EQ(r.message.find("100 %"), std::string::npos) << r.message;
    }
  }
}

/// What becomes of a pair: a complaint about the input, a status, but never an end of the process.
std::string outcome(const PointCloud& source, const PointCloud& target, RegistrationMethod method, bool fall_back) {
  RegistrationOptions options;
  options.method = method;
  options.fall_back = fall_back;
  try {
    const RegistrationResult r = registerClouds(source, target, options);
    if (r.usable()) {
      EXPECT_TRUE(r.translation_mm.allFinite());
      EXPECT_TRUE(r.rotation_rad.allFinite());
      return "used";
    }
    EXPECT_FALSE(r.message.empty());
    return std::string(toString(r.status));
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()), "");
    return "input";
  }
}

TEST(Registration, SurvivesCloudsThatHoldNoSurface) {
  Random random(22);
  std::vector<std::pair<std::string, PointCloud>> clouds;
  const auto add = [&](const std::string& name, std::size_t count, const std::function<Eigen::Vector3d()>& point) {
    PointCloud cloud;
    cloud.name = name;
    for (std::size_t i = 0; i < count; ++i) cloud.points_mm.push_back(point());
    clouds.emplace_back(name, std::move(cloud));
  };
  const auto u = [&] { return random.uniform(); };
  clouds.emplace_back("surface", scan(paperSurface, RigidTransform(), {60, 60, 0.18, 0.68}, 0.5e-3, random));
  add("one point", 1, [] { return Eigen::Vector3d(1.0, 2.0, 3.0); });
  add("one point often", 500, [] { return Eigen::Vector3d(1.0, 2.0, 3.0); });
  add("oblique line", 500, [&] {
    const double part = 50.0 * u();
    return Eigen::Vector3d(1.0 + 0.6 * part, 2.0 + 0.7 * part, 3.0 + 0.3 * part);
  });
  add("few places", 500, [&] { return Eigen::Vector3d(1.0 * random.index(3), 1.0 * random.index(3), 0.0); });
  add("line", 500, [&] { return Eigen::Vector3d(10.0 * u(), 0.0, 0.0); });
  add("plane", 4000, [&] { return Eigen::Vector3d(10.0 * u(), 10.0 * u(), 0.0); });
  add("two planes", 4000, [&] { return Eigen::Vector3d(10.0 * u(), 10.0 * u(), u() < 0.5 ? 0.0 : 5.0); });
  add("wall", 4000, [&] { return Eigen::Vector3d(2.0, 10.0 * u(), 10.0 * u()); });
  add("sparse", 120, [&] { return Eigen::Vector3d(1000.0 * u(), 1000.0 * u(), 100.0 * u()); });
  add("far", 500, [&] {
    return u() < 0.002 ? Eigen::Vector3d(1e300, -1e300, 1e300) : Eigen::Vector3d(10.0 * u(), 10.0 * u(), u());
  });
  add("with NaN", 500, [&] { return Eigen::Vector3d(10.0 * u(), 10.0 * u(), u() < 0.1 ? std::nan("") : u()); });
  for (const auto& [source_name, source] : clouds)
    for (const auto& [target_name, target] : clouds) {
      if (source_name == target_name && source_name == "surface") continue;
      SCOPED_TRACE(source_name + " onto " + target_name);
      for (const RegistrationMethod method :
           {RegistrationMethod::Surface, RegistrationMethod::NdtIcp, RegistrationMethod::Gicp}) {
        const std::string got = outcome(source, target, method, method == RegistrationMethod::Surface);
        if (method == RegistrationMethod::Gicp && (source_name == "few places" || target_name == "few places")) {
          EXPECT_EQ(got, "input");
        }
        const bool unusable = source_name.starts_with("one point") || target_name.starts_with("one point") ||
                              source_name == "with NaN" || target_name == "with NaN" || source_name.ends_with("line") ||
                              target_name.ends_with("line");
        if (unusable) {
          EXPECT_EQ(got, "input");
        }
      }
    }
}

}  // namespace
}  // namespace spindrift
