// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/split_covariance.h"

#include <gmock/gmock.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/random.h"

namespace spindrift {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Covariance that a split stands for: the larger of sigma^2 and the loads on the diagonal.
Eigen::MatrixXd covarianceOf(const CovarianceSplit& split) {
  const auto n = static_cast<Eigen::Index>(split.sigma.size());
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(split.factors.size()));
  for (std::size_t f = 0; f < split.factors.size(); ++f)
    for (const NoiseLoad& l : split.factors[f])
      loads(static_cast<Eigen::Index>(l.row), static_cast<Eigen::Index>(f)) = l.load;
  Eigen::MatrixXd out = loads * loads.transpose();
  for (Eigen::Index i = 0; i < n; ++i)
    out(i, i) = std::max(out(i, i), std::pow(split.sigma[static_cast<std::size_t>(i)], 2));
  return out;
}

double smallestEigenvalue(const Eigen::MatrixXd& m) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m).eigenvalues()(0);
}

/// Random correlated block: `rank` causes and own noise, in units that differ by a factor of 1000.
Eigen::MatrixXd someCovariance(Random& random, Eigen::Index n, Eigen::Index rank, double own) {
  Eigen::MatrixXd causes(n, rank);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < rank; ++k) causes(i, k) = random.normal();
  Eigen::MatrixXd c = causes * causes.transpose();
  c.diagonal().array() += own;
  Eigen::VectorXd scale(n);
  for (Eigen::Index i = 0; i < n; ++i) scale(i) = i % 2 == 0 ? 1.0 : 1e-3;
  return scale.asDiagonal() * c * scale.asDiagonal();
}

std::vector<CovarianceEntry> entriesOf(const Eigen::MatrixXd& c, std::size_t first, std::vector<double>& sigma) {
  std::vector<CovarianceEntry> out;
  for (Eigen::Index i = 0; i < c.rows(); ++i) {
    sigma.push_back(std::sqrt(c(i, i)));
    for (Eigen::Index j = i + 1; j < c.cols(); ++j)
      out.push_back({first + static_cast<std::size_t>(i), first + static_cast<std::size_t>(j), c(i, j)});
  }
  return out;
}

TEST(SplitCovariance, GivesBackEveryBlockToRounding) {
  Random random(1);
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<double> sigma;
    std::vector<CovarianceEntry> entries;
    std::vector<Eigen::MatrixXd> blocks;
    for (const Eigen::Index n : {2, 5, 17}) {
      blocks.push_back(someCovariance(random, n, 1 + trial % 4, trial % 3 == 0 ? 0.0 : 0.3));
      const auto block = entriesOf(blocks.back(), sigma.size(), sigma);
      entries.insert(entries.end(), block.begin(), block.end());
      sigma.push_back(0.7);  // a row for itself between them
    }
    const CovarianceSplit split = splitCovariance(sigma, entries);
    EXPECT_THAT(split.indefinite, IsEmpty());
    const Eigen::MatrixXd c = covarianceOf(split);
    Eigen::Index first = 0;
    for (const Eigen::MatrixXd& block : blocks) {
      const auto n = block.rows();
      const Eigen::VectorXd size = block.diagonal().cwiseSqrt().cwiseInverse();
      const Eigen::MatrixXd off = size.asDiagonal() * (c.block(first, first, n, n) - block) * size.asDiagonal();
      EXPECT_LT(off.cwiseAbs().maxCoeff(), 1e-13);
      first += n;
      EXPECT_DOUBLE_EQ(c(first, first), 0.49);
      EXPECT_DOUBLE_EQ(c.row(first).cwiseAbs().sum(), 0.49);
      ++first;
    }
  }
}

TEST(SplitCovariance, TakesAsMuchOwnNoiseAndAsFewFactorsAsThereCanBe) {
  // One cause of all rows beside equal own noise.
  std::vector<double> sigma(12, std::sqrt(0.25 + 0.04));
  std::vector<CovarianceEntry> entries;
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = i + 1; j < 12; ++j) entries.push_back({j, i, 0.25});
  const CovarianceSplit split = splitCovariance(sigma, entries);
  ASSERT_EQ(split.factors.size(), 1U);
  ASSERT_EQ(split.factors[0].size(), 12U);
  for (const NoiseLoad& l : split.factors[0]) EXPECT_NEAR(std::abs(l.load), 0.5, 1e-12);
  EXPECT_THAT(splitCovariance(sigma, {}).factors, IsEmpty());
}

TEST(SplitCovariance, DiagonalEntriesReplaceTheVarianceAndOfMirroredOnesTheFirstCounts) {
  const CovarianceSplit split = splitCovariance({1.0, 1.0, 1.0}, {{0, 0, 4.0}, {0, 1, 1.0}, {1, 0, 0.5}, {2, 2, 9.0}});
  EXPECT_THAT(split.sigma, ElementsAre(2.0, 1.0, 3.0));
  const Eigen::MatrixXd c = covarianceOf(split);
  EXPECT_NEAR(c(0, 0), 4.0, 1e-13);
  EXPECT_NEAR(c(0, 1), 1.0, 1e-13);
  EXPECT_NEAR(c(1, 1), 1.0, 1e-13);
  EXPECT_EQ(c(2, 2), 9.0);
  EXPECT_THROW((void)splitCovariance({1.0}, {{0, 0, 0.0}}), InternalError);
  EXPECT_THROW((void)splitCovariance({1.0}, {{0, 1, 0.5}}), InternalError);
  EXPECT_THROW((void)splitCovariance({0.0}, {}), InternalError);
}

TEST(SplitCovariance, FullyCorrelatedRowsHaveNothingOfTheirOwn) {
  const CovarianceSplit split = splitCovariance({0.3, 0.5, 0.1}, {{0, 1, 0.15}, {0, 2, -0.03}, {1, 2, -0.05}});
  EXPECT_THAT(split.indefinite, IsEmpty());
  ASSERT_EQ(split.factors.size(), 1U);
  for (const NoiseLoad& l : split.factors[0]) EXPECT_NEAR(std::abs(l.load), split.sigma[l.row], 1e-14);
}

TEST(SplitCovariance, WhatIsNoCovarianceIsToldAndItsPairsStayAsTheyWere) {
  // Three rows, each against both others: impossible beyond -1/2. The pair beside them is sound.
  const std::vector<CovarianceEntry> entries{{0, 1, -0.8}, {0, 2, -0.8}, {1, 2, -0.8}, {3, 4, 0.5}};
  const CovarianceSplit split = splitCovariance({1.0, 1.0, 1.0, 1.0, 1.0}, entries);
  EXPECT_THAT(split.indefinite, ElementsAre(0, 1, 2));
  const Eigen::MatrixXd c = covarianceOf(split);
  for (const CovarianceEntry& e : entries)
    EXPECT_NEAR(c(static_cast<Eigen::Index>(e.row), static_cast<Eigen::Index>(e.column)), e.covariance, 1e-13);
  EXPECT_NEAR(smallestEigenvalue(c.topLeftCorner<3, 3>()), 0.0, 1e-13);
  EXPECT_NEAR(c(0, 0), 1.6, 1e-13) << "the least that makes it a covariance";
  EXPECT_NEAR(c(3, 3), 1.0, 1e-13);
  // Numbers that are none of this world stay numbers.
  const CovarianceSplit absurd = splitCovariance({1e-300, 1.0}, {{0, 1, 1e300}});
  EXPECT_THAT(absurd.indefinite, ElementsAre(0, 1));
  EXPECT_TRUE(covarianceOf(absurd).allFinite());
}

TEST(SplitCovariance, LargeBlocksAreSplitWithoutTheirEigenvalues) {
  constexpr std::size_t n = 1100;
  const std::vector<double> sigma(n, 2.0);
  const auto chain = [](double correlation) {
    std::vector<CovarianceEntry> entries;
    for (std::size_t i = 0; i + 1 < n; ++i) entries.push_back({i, i + 1, 4.0 * correlation});
    return entries;
  };
  const CovarianceSplit split = splitCovariance(sigma, chain(0.3));
  EXPECT_THAT(split.indefinite, IsEmpty());
  const Eigen::MatrixXd c = covarianceOf(split);
  double loads = 0.0;
  for (const NoiseFactor& f : split.factors)
    for (const NoiseLoad& l : f) loads += l.row == 500 ? l.load * l.load : 0.0;
  EXPECT_LT(loads, 3.1) << "a quarter is own";
  for (Eigen::Index i = 0; i + 2 < c.rows(); ++i) {
    ASSERT_NEAR(c(i, i), 4.0, 1e-12);
    ASSERT_NEAR(c(i, i + 1), 1.2, 1e-12);
    ASSERT_NEAR(c(i, i + 2), 0.0, 1e-12);
  }
  EXPECT_EQ(splitCovariance(sigma, chain(0.6)).indefinite.size(), n);
}

TEST(SharedLoads, AreThoseOfADenseCovariance) {
  Random random(4);
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::MatrixXd c = someCovariance(random, 6, 3, 0.2);
    c.row(2).setZero();  // a row without noise
    c.col(2).setZero();
    const Eigen::MatrixXd loads = sharedLoads(c);
    Eigen::MatrixXd off = loads * loads.transpose() - c;
    for (Eigen::Index i = 0; i < 6; ++i) {
      EXPECT_LE(off(i, i), 1e-15);
      off(i, i) = 0.0;
    }
    EXPECT_LT(off.cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_EQ(loads.row(2).norm(), 0.0);
  }
  EXPECT_EQ(sharedLoads(Eigen::Vector3d(1.0, 4.0, 9.0).asDiagonal()).cols(), 0);
}

TEST(CovarianceRoot, HasAColumnForEachDirectionOfABlock) {
  Random random(5);
  Eigen::MatrixXd causes = Eigen::MatrixXd::Zero(9, 3);
  for (Eigen::Index i = 0; i < 9; ++i)
    for (Eigen::Index k = 0; k < 3; ++k)
      if (i < 5 ? k < 2 : k == 2) causes(i, k) = random.normal();
  const Eigen::MatrixXd c = causes * causes.transpose();
  const Eigen::MatrixXd root = covarianceRoot(c, 1e-12);
  ASSERT_EQ(root.cols(), 3);
  EXPECT_LT((root * root.transpose() - c).cwiseAbs().maxCoeff(), 1e-13);
  for (Eigen::Index k = 0; k < 3; ++k)
    EXPECT_TRUE(root.col(k).head(5).isZero(0.0) || root.col(k).tail(4).isZero(0.0)) << "blocks stay apart";
  EXPECT_EQ(covarianceRoot(Eigen::MatrixXd(0, 0), 1e-12).size(), 0);
}

}  // namespace
}  // namespace spindrift
