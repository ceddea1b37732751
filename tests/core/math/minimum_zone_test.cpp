// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/minimum_zone.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/base/random.h"

namespace spindrift {
namespace {

Eigen::MatrixXd lineShape(int n) {
  Eigen::MatrixXd shape(n, 2);
  for (int i = 0; i < n; ++i) shape.row(i) << 1.0, 10.0 * i;
  return shape;
}

TEST(MinimumZone, AnArcBesideALineIsHalfItsHeight) {
  // Chebyshev: 1 - x^2 on [-1, 1] is nearest to 1/2 with an error of 1/2.
  constexpr int n = 41;
  Eigen::VectorXd d(n);
  for (int i = 0; i < n; ++i) {
    const double x = -1.0 + 2.0 * i / (n - 1);
    d[i] = 6.0 * (1.0 - x * x) + 0.3 + 0.02 * 10.0 * i;
  }
  const MinimumZone zone = minimumZone(lineShape(n), d);
  EXPECT_NEAR(zone.width(), 6.0, 1e-9);
  EXPECT_NEAR(zone.parameters[1], 0.02, 1e-9);
}

TEST(MinimumZone, NeverWiderThanLeastSquaresAndHeldByKPlusOnePoints) {
  Random random(3);
  for (int run = 0; run < 200; ++run) {
    const int n = 5 + static_cast<int>(random.index(60));
    const int k = 1 + static_cast<int>(random.index(3));
    Eigen::MatrixXd shape(n, k);
    Eigen::VectorXd d(n);
    for (int i = 0; i < n; ++i) {
      const double angle = 6.283185307 * i / n;
      const double row[3] = {1.0, std::cos(angle), std::sin(angle)};
      for (int c = 0; c < k; ++c) shape(i, c) = 1e3 * row[c];
      d[i] = random.normal(5.0, 2.0);
    }
    const MinimumZone zone = minimumZone(shape, d);
    const Eigen::VectorXd least = shape.colPivHouseholderQr().solve(d);
    EXPECT_LE(zone.half_width, (d - shape * least).cwiseAbs().maxCoeff() + 1e-12);
    // Optimal: at least k + 1 deviations touch the borders of the zone.
    const Eigen::VectorXd r = (d - shape * zone.parameters).cwiseAbs();
    EXPECT_GE((r.array() > zone.half_width - 1e-9).count(), k + 1) << "run " << run;
  }
}

TEST(MinimumZone, NothingAndShapesOfLowerRank) {
  const MinimumZone none = minimumZone(lineShape(7), Eigen::VectorXd::Zero(7));
  EXPECT_EQ(none.width(), 0.0);
  Eigen::MatrixXd twice(6, 2);
  twice.col(0).setOnes();
  twice.col(1).setConstant(3.0);
  const Eigen::VectorXd d = Eigen::VectorXd::LinSpaced(6, -1.0, 4.0);
  EXPECT_NEAR(minimumZone(twice, d).width(), 5.0, 1e-9);
  EXPECT_NEAR(minimumZone(lineShape(9), lineShape(9) * Eigen::Vector2d(4.0, -0.7)).width(), 0.0, 1e-9);
}

TEST(MinimumZone, SmallestCircle) {
  Eigen::Matrix2Xd points(2, 4);
  points << 0, 4, 2, 1, 0, 0, 0.5, -0.3;
  EXPECT_NEAR(smallestCircleDiameter(points), 4.0, 1e-9);
  points << 0, 2, 1, 1, 0, 0, std::sqrt(3.0), 0.5;  // a triangle of equal sides
  EXPECT_NEAR(smallestCircleDiameter(points), 4.0 / std::sqrt(3.0), 1e-9);
  points.setConstant(7.0);
  EXPECT_EQ(smallestCircleDiameter(points), 0.0);
}

}  // namespace
}  // namespace spindrift
