// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/distributions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace spindrift {
namespace {

// Reference values from the tables in Abramowitz and Stegun, chapter 26, and closed forms.
TEST(Distributions, AgreeWithTables) {
  EXPECT_NEAR(normalCdf(1.959963984540054), 0.975, 1e-12);
  EXPECT_NEAR(normalQuantile(0.975), 1.959963984540054, 1e-10);
  EXPECT_NEAR(chiSquaredQuantile(0.95, 1.0), 3.841458820694124, 1e-9);
  EXPECT_NEAR(chiSquaredQuantile(0.99, 10.0), 23.209251158954356, 1e-8);
  EXPECT_NEAR(studentQuantile(0.975, 4.0), 2.7764451051977987, 1e-9);
  EXPECT_NEAR(studentQuantile(0.975, 1.0), std::tan(0.475 * M_PI), 1e-8);  // Cauchy
}

TEST(Distributions, HoldFarOutAndForManyDegreesOfFreedom) {
  // P(a, a) = 1/2 + 1 / (3 sqrt(2 pi a)) + ..., a = dof / 2.
  EXPECT_NEAR(chiSquaredCdf(1e10, 1e10), 0.5 + 1.0 / (3.0 * std::sqrt(std::numbers::pi * 1e10)), 1e-9);
  // The quantile brings the probability back, also where it is tiny.
  for (const double p : {1e-12, 1e-6, 0.3, 0.999}) {
    EXPECT_NEAR(normalCdf(normalQuantile(p)) / p, 1.0, 1e-9) << p;
    for (const double dof : {0.7, 3.0, 400.0}) {
      EXPECT_NEAR(chiSquaredCdf(chiSquaredQuantile(p, dof), dof) / p, 1.0, 1e-9) << p << " " << dof;
      EXPECT_NEAR(studentCdf(studentQuantile(p, dof), dof) / p, 1.0, 1e-9) << p << " " << dof;
    }
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(chiSquaredTail(infinity, 3.0), 0.0);
  EXPECT_EQ(fisherTail(infinity, 3.0, 5.0), 0.0);
  EXPECT_EQ(studentCdf(-infinity, 3.0), 0.0);
  EXPECT_TRUE(std::isnan(chiSquaredTail(std::nan(""), 3.0)));
}

TEST(Distributions, ClosedForms) {
  for (const double x : {0.1, 1.0, 5.0, 40.0}) {
    EXPECT_NEAR(chiSquaredTail(x, 2.0), std::exp(-0.5 * x), 1e-13 * (1.0 + std::exp(-0.5 * x)));
    EXPECT_NEAR(chiSquaredTail(x, 2.0) / std::exp(-0.5 * x), 1.0, 1e-11);
    EXPECT_NEAR(fisherTail(x, 2.0, 6.0), std::pow(1.0 + x / 3.0, -3.0), 1e-12);
    EXPECT_NEAR(chiSquaredCdf(x, 3.0) + chiSquaredTail(x, 3.0), 1.0, 1e-13);
  }
}

}  // namespace
}  // namespace spindrift
