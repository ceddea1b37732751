// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/lack_of_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "core/base/random.h"

namespace spindrift {
namespace {

/// Mean over many draws of s_g^2 for a straight line per group of twelve values with noise 0.3 in common pairs.
Eigen::Vector2d meanVariance(double scatter_of_first, double scatter_of_second) {
  constexpr Eigen::Index each = 12;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * each, 4);
  std::vector<int> group;
  for (Eigen::Index i = 0; i < 2 * each; ++i) {
    const Eigen::Index g = i / each;
    A(i, 2 * g) = 1.0;
    A(i, 2 * g + 1) = static_cast<double>(i % each);
    group.push_back(static_cast<int>(g));
  }
  Eigen::MatrixXd V = 0.09 * Eigen::MatrixXd::Identity(2 * each, 2 * each);
  for (Eigen::Index i = 0; i + 1 < 2 * each; i += 2) V(i, i + 1) = V(i + 1, i) = 0.045;
  const Eigen::LLT<Eigen::MatrixXd> root(V);
  const Eigen::MatrixXd W = root.solve(A);
  const Eigen::MatrixXd gain = (A.transpose() * W).ldlt().solve(W.transpose());
  Random random(4);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  constexpr int draws = 2000;
  for (int n = 0; n < draws; ++n) {
    Eigen::VectorXd e(2 * each);
    for (Eigen::Index i = 0; i < 2 * each; ++i) e(i) = random.normal(0.0, 1.0);
    Eigen::VectorXd y = root.matrixL() * e;
    for (Eigen::Index i = 0; i < 2 * each; ++i)
      y(i) += 5.0 + 0.7 * static_cast<double>(i) + random.normal(0.0, i < each ? scatter_of_first : scatter_of_second);
    sum += lackOfFitVariance(A, y, V, gain, group, 2);
  }
  return sum / draws;
}

TEST(LackOfFit, IsTheVarianceBeyondTheStatedNoisePerGroup) {
  const Eigen::Vector2d both = meanVariance(2.0, 1.0);
  EXPECT_NEAR(both(0), 4.0, 0.15);
  EXPECT_NEAR(both(1), 1.0, 0.05);
  const Eigen::Vector2d one = meanVariance(2.0, 0.0);
  EXPECT_NEAR(one(0), 4.0, 0.15);
  EXPECT_LT(one(1), 0.03) << "bounded by zero, so a little above it";
}

TEST(LackOfFit, IsZeroWhereNothingTellsIt) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(3, 3);
  const Eigen::VectorXd v = lackOfFitVariance(A, Eigen::Vector3d(1, 2, 3), 0.01 * A, A, {0, 0, -1}, 1);
  ASSERT_EQ(v.size(), 1);
  EXPECT_EQ(v(0), 0.0);
}

}  // namespace
}  // namespace spindrift
