// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geometry/shape_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/random.h"

namespace spindrift {
namespace {

constexpr double pi = std::numbers::pi;

Eigen::Vector3d randomUnit(Random& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

/// Points whose best-fit circle is known exactly: pairs of opposite points moved by +e and -e along the radius cancel
/// in the normal equations when the pattern repeats at 90 degrees.
TEST(ShapeFit, CircleAgreesWithAnExactConstruction) {
  const Eigen::Vector2d centre(412.123456789, -87.987654321);
  const double radius = 5.0;
  const double e = 0.003;
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k < 8; ++k) {
    const double angle = k * pi / 4.0 + 0.2;
    const double r = radius + (k % 2 == 0 ? e : -e);  // orthogonal to 1, cos and sin: the least-squares circle stays
    points.push_back(centre + r * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  const CircleFit fit = fitCircle(points);
  ASSERT_TRUE(fit.usable()) << fit.message;
  EXPECT_LT((fit.centre_mm - centre).norm(), 1e-9);
  EXPECT_NEAR(fit.radius_mm, radius, 1e-9);
  EXPECT_NEAR(fit.rms_mm, e, 1e-9);
  EXPECT_NEAR(fit.form_mm, 2.0 * e, 1e-9);
}

TEST(ShapeFit, SphereAgreesWithAnExactConstruction) {
  const Eigen::Vector3d centre(380.010031, 119.973465, -140.022155);
  const double radius = 12.7;
  const double e = 0.002;
  std::vector<Eigen::Vector3d> points;
  // Corners of a cube: the sign pattern x*y*z is orthogonal to 1, x, y and z, so it leaves the sphere where it is.
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d s((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
    points.push_back(centre + (radius + e * s.prod()) * s.normalized());
  }
  const SphereFit fit = fitSphere(points);
  ASSERT_TRUE(fit.usable()) << fit.message;
  EXPECT_LT((fit.centre_mm - centre).norm(), 1e-9);
  EXPECT_NEAR(fit.radius_mm, radius, 1e-9);
  EXPECT_NEAR(fit.rms_mm, e, 1e-9);
}

TEST(ShapeFit, PointsWithoutNoiseGiveTheShapeBack) {
  Random random(11);
  for (int run = 0; run < 300; ++run) {
    const Eigen::Vector3d centre(random.uniform(-500, 500), random.uniform(-500, 500), random.uniform(-500, 500));
    const double radius = random.uniform(1.0, 50.0);
    std::vector<Eigen::Vector3d> sphere;
    std::vector<Eigen::Vector2d> circle;
    for (int i = 0; i < 6; ++i) {
      sphere.push_back(centre + radius * randomUnit(random));
      const double angle = random.uniform(0.0, 2.0 * pi);
      circle.push_back(centre.head<2>() + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    const SphereFit s = fitSphere(sphere);
    const CircleFit c = fitCircle(circle);
    if (s.usable() && s.amplification < 20.0) {
      EXPECT_LT((s.centre_mm - centre).norm(), 1e-9);
      EXPECT_NEAR(s.radius_mm, radius, 1e-9);
    }
    if (c.usable() && c.amplification < 20.0) {
      EXPECT_LT((c.centre_mm - centre.head<2>()).norm(), 1e-9);
      EXPECT_NEAR(c.radius_mm, radius, 1e-9);
    }
  }
}

/// The gradient of the sum of squares vanishes at the geometric optimum; an algebraic fit does not have this property.
TEST(ShapeFit, ShortNoisyArcReachesTheGeometricOptimum) {
  Random random(5);
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 40; ++i) {
    const double angle = 0.6 * i / 39.0;
    points.emplace_back(20.0 * std::cos(angle) + random.normal(0, 0.01),
                        20.0 * std::sin(angle) + random.normal(0, 0.01));
  }
  const CircleFit fit = fitCircle(points);
  ASSERT_TRUE(fit.usable()) << fit.message;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (const Eigen::Vector2d& p : points) {
    const Eigen::Vector2d u = (p - fit.centre_mm).normalized();
    const double residual = (p - fit.centre_mm).norm() - fit.radius_mm;
    gradient += residual * Eigen::Vector3d(u.x(), u.y(), 1.0);
  }
  EXPECT_LT(gradient.norm(), 1e-10);
}

TEST(ShapeFit, StatedUncertaintyCoversTheTruth) {
  Random random(77);
  const double sigma = 0.0005;
  int inside = 0;
  int total = 0;
  double chi2_plane = 0.0;
  double chi2_line = 0.0;
  const int runs = 3000;
  const Eigen::Vector3d centre(100.0, -50.0, 30.0);
  const Eigen::Vector3d normal = Eigen::Vector3d(0.1, -0.2, 1.0).normalized();
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  for (int run = 0; run < runs; ++run) {
    std::vector<Eigen::Vector3d> points;
    for (const Eigen::Vector3d& n : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0, 1, 0),
                                     Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0, 0, 1)}) {
      points.push_back(centre + (15.2 + random.normal(0, sigma)) * n);
    }
    ShapeFitOptions options;
    options.sigma_mm = sigma;
    const SphereFit fit = fitSphere(points, options);
    ASSERT_TRUE(fit.usable());
    for (int k = 0; k < 3; ++k) {
      ++total;
      if (std::abs(fit.centre_mm(k) - centre(k)) < 1.959964 * std::sqrt(fit.covariance(k, k))) ++inside;
    }
    std::vector<Eigen::Vector3d> plane;
    std::vector<Eigen::Vector3d> line;
    for (int i = 0; i < 9; ++i) {
      plane.push_back(centre + 10.0 * (i % 3) * u + 7.0 * (i / 3) * v + random.normal(0, sigma) * normal);
      line.push_back(centre + 10.0 * i * u + random.normal(0, sigma) * v + random.normal(0, sigma) * normal);
    }
    const PlaneFit p = fitPlane(plane, options);
    const LineFit l = fitLine(line, options);
    ASSERT_TRUE(p.usable() && l.usable());
    chi2_plane += std::pow(p.normal.dot(u), 2) / (u.dot(p.normal_covariance * u));
    chi2_line += std::pow(l.direction.dot(v), 2) / (v.dot(l.direction_covariance * v));
  }
  EXPECT_NEAR(static_cast<double>(inside) / total, 0.95, 0.01);
  EXPECT_NEAR(chi2_plane / runs, 1.0, 0.1);
  EXPECT_NEAR(chi2_line / runs, 1.0, 0.1);
}

TEST(ShapeFit, OneBadPointIsFoundAndLeftOut) {
  Random random(3);
  ShapeFitOptions options;
  options.sigma_mm = 0.0005;
  options.tolerate_one_bad_point = true;
  for (int run = 0; run < 200; ++run) {
    const Eigen::Vector3d centre(10, 20, 30);
    std::vector<Eigen::Vector3d> sphere;
    std::vector<Eigen::Vector2d> circle;
    std::vector<Eigen::Vector3d> plane;
    for (int i = 0; i < 9; ++i) {
      sphere.push_back(centre + (12.7 + random.normal(0, 0.0005)) * randomUnit(random));
      const double angle = 2.0 * pi * i / 9.0;
      circle.push_back((5.0 + random.normal(0, 0.0005)) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      plane.emplace_back(10.0 * (i % 3), 10.0 * (i / 3), random.normal(0, 0.0005));
    }
    const auto bad = static_cast<int>(random.index(9));
    sphere[bad] += 0.05 * (sphere[bad] - centre).normalized();
    circle[bad] *= 1.01;
    plane[bad].z() += 0.05;
    EXPECT_EQ(fitCircle(circle, options).rejected, bad);
    EXPECT_EQ(fitPlane(plane, options).rejected, bad);
    const SphereFit s = fitSphere(sphere, options);
    if (s.amplification < 1.5) {
      EXPECT_EQ(s.rejected, bad);
    }
  }
}

TEST(ShapeFit, ContradictionWithoutACulpritIsRejected) {
  ShapeFitOptions options;
  options.sigma_mm = 0.0005;
  options.tolerate_one_bad_point = true;
  // Four touches leave one degree of freedom: the contradiction shows, the culprit does not.
  const std::vector<Eigen::Vector2d> points{{3.05, 0}, {-3, 0}, {0, 3}, {0, -3}};
  const CircleFit fit = fitCircle(points, options);
  EXPECT_EQ(fit.status, FitStatus::Rejected);
  EXPECT_EQ(fit.rejected, -1);
}

TEST(ShapeFit, DegeneratePointsNameTheWeakDirection) {
  std::vector<Eigen::Vector3d> equator;
  for (int k = 0; k < 6; ++k) equator.emplace_back(12.7 * std::cos(k), 12.7 * std::sin(k), 4.0);
  const SphereFit sphere = fitSphere(equator);
  EXPECT_EQ(sphere.status, FitStatus::Degenerate);
  EXPECT_NEAR(std::abs(sphere.weak.z()), 1.0, 1e-6);
  EXPECT_NE(sphere.message.find("along z"), std::string::npos) << sphere.message;

  const std::vector<Eigen::Vector2d> row{{0, 0}, {1, 0}, {2, 0}, {3, 0}};
  EXPECT_FALSE(fitCircle(row).usable());

  const std::vector<Eigen::Vector3d> thin{{0, 0, 0}, {10, 0, 0}, {20, 0, 0}, {30, 0, 0}};
  const PlaneFit plane = fitPlane(thin);
  EXPECT_EQ(plane.status, FitStatus::Degenerate);

  const std::vector<Eigen::Vector3d> same{{1, 1, 1}, {1, 1, 1}};
  EXPECT_EQ(fitLine(same).status, FitStatus::Degenerate);
  EXPECT_EQ(fitSphere(std::span(equator).first(3)).status, FitStatus::Degenerate);
  EXPECT_EQ(fitSphere({}).status, FitStatus::Degenerate);
  EXPECT_EQ(fitPlane({}).status, FitStatus::Degenerate);
}

TEST(ShapeFit, KnownRadiusNeedsFewerPointsAndAStart) {
  const Eigen::Vector3d centre(1, 2, 3);
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k < 3; ++k) {
    const double angle = 2.0 * pi * k / 3.0;
    points.push_back(centre + 10.0 * Eigen::Vector3d(0.8 * std::cos(angle), 0.8 * std::sin(angle), 0.6));
  }
  ShapeFitOptions options;
  options.known_radius_mm = 10.0;
  options.start_mm = centre + Eigen::Vector3d(0.1, 0.1, -0.5);
  const SphereFit fit = fitSphere(points, options);
  ASSERT_TRUE(fit.usable()) << fit.message;
  EXPECT_LT((fit.centre_mm - centre).norm(), 1e-9);
  EXPECT_DOUBLE_EQ(fit.radius_mm, 10.0);
  EXPECT_EQ(fit.cofactor(3, 3), 0.0);
}

}  // namespace
}  // namespace spindrift
