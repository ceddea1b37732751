// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/machine/shared_noise.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/base/error.h"

namespace spindrift {
namespace {

SharedNoise exampleNoise() {
  SharedNoise shared;
  shared.addFactor({{3, 0.2}, {0, 0.5}, {1, -0.3}});
  shared.addFactor({{1, 0.4}, {2, 0.1}});
  return shared;
}

TEST(SharedNoise, CovariancesAreProductsOfLoads) {
  const SharedNoise shared = exampleNoise();
  EXPECT_DOUBLE_EQ(shared.covariance(0, 1), -0.15);
  EXPECT_DOUBLE_EQ(shared.covariance(1, 0), -0.15);
  EXPECT_DOUBLE_EQ(shared.covariance(1, 2), 0.04);
  EXPECT_EQ(shared.covariance(0, 2), 0.0);
  EXPECT_EQ(shared.covariance(0, 99), 0.0);
  EXPECT_DOUBLE_EQ(shared.variance(1), 0.25);
  EXPECT_DOUBLE_EQ(shared.ownVariance(1, 1.3), 1.69 - 0.25);
  EXPECT_DOUBLE_EQ(shared.ownVariance(7, 1.3), 1.69);
  EXPECT_EQ(shared.ownVariance(1, 0.4), 0.0) << "never negative";
}

TEST(SharedNoise, LoadsOfARowAddUpAndNothingIsNoCause) {
  SharedNoise shared;
  shared.addFactor({{1, 0.25}, {0, 1.0}, {1, 0.5}, {2, 0.0}});
  ASSERT_EQ(shared.factors().size(), 1U);
  ASSERT_EQ(shared.factors()[0].size(), 2U);
  EXPECT_EQ(shared.factors()[0][1].row, 1U);
  EXPECT_EQ(shared.factors()[0][1].load, 0.75);
  shared.addFactor({});
  shared.addFactor({{4, 0.0}});
  EXPECT_EQ(shared.factors().size(), 1U);
  EXPECT_THROW(shared.addFactor({{0, std::numeric_limits<double>::quiet_NaN()}}), InternalError);
  shared.clear();
  EXPECT_TRUE(shared.empty());
  EXPECT_EQ(shared.covariance(0, 1), 0.0);
}

TEST(SharedNoise, IsAppendedAndRestrictedByRows) {
  SharedNoise both = exampleNoise();
  both.append(exampleNoise(), 4);
  EXPECT_EQ(both.factors().size(), 4U);
  EXPECT_DOUBLE_EQ(both.covariance(4, 5), -0.15);
  EXPECT_EQ(both.covariance(0, 4), 0.0);
  const SharedNoise part = both.restrictedTo({5, 4, 2});
  EXPECT_DOUBLE_EQ(part.covariance(0, 1), -0.15);
  EXPECT_DOUBLE_EQ(part.variance(0), 0.25);
  EXPECT_DOUBLE_EQ(part.variance(2), 0.01);
  EXPECT_EQ(part.covariance(0, 2), 0.0);
  EXPECT_THROW((void)both.restrictedTo({1, 1}), InternalError);
}

TEST(SharedNoise, VarianceOfACombinationKnowsWhatCancels) {
  SharedNoise shared;
  shared.addFactor({{0, 0.6}, {1, 0.6}, {2, -0.6}});
  const std::array<SharedNoise::Load, 2> difference{{{0, 1.0}, {1, -1.0}}};
  EXPECT_NEAR(shared.varianceOf(difference), 0.0, 1e-15);
  const std::array<SharedNoise::Load, 2> against{{{0, 1.0}, {2, -1.0}}};
  EXPECT_NEAR(shared.varianceOf(against), 1.44, 1e-15);
  const Eigen::MatrixXd loads(exampleNoise().loads({1, 3}));
  EXPECT_EQ(loads, (Eigen::Matrix2d() << -0.3, 0.4, 0.2, 0.0).finished());
}

TEST(SharedNoise, CovariancesOfPairsAreListedOnceInOrder) {
  SharedNoise shared = exampleNoise();
  shared.addFactor({{0, 1e-9}, {2, 1e-9}});  // far below what counts
  const std::vector<CovarianceEntry> entries = shared.covariances({1.0, 1.0, 1.0, 1.0});
  ASSERT_EQ(entries.size(), 4U);
  const std::array<std::array<double, 3>, 4> expected{{{0, 1, -0.15}, {0, 3, 0.1}, {1, 2, 0.04}, {1, 3, -0.06}}};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(static_cast<double>(entries[k].row), expected[k][0]);
    EXPECT_EQ(static_cast<double>(entries[k].column), expected[k][1]);
    EXPECT_NEAR(entries[k].covariance, expected[k][2], 1e-15);
  }
}

}  // namespace
}  // namespace spindrift
