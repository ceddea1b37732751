// SPDX-License-Identifier: GPL-3.0-or-later
// Products of dynamic matrices (resources/precompiled/eigen.h) against sums written out.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <limits>

#include "core/base/random.h"

namespace spindrift {
namespace {

using Eigen::Index, Eigen::MatrixXd;
using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

MatrixXd drawn(Random& random, Index rows, Index cols) {
  return MatrixXd::NullaryExpr(rows, cols, [&] { return random.normal(); });
}

MatrixXd writtenOut(const MatrixXd& a, const MatrixXd& b) {
  MatrixXd out = MatrixXd::Zero(a.rows(), b.cols());
  for (Index i = 0; i < a.rows(); ++i)
    for (Index j = 0; j < b.cols(); ++j)
      for (Index k = 0; k < a.cols(); ++k) out(i, j) += a(i, k) * b(k, j);
  return out;
}

TEST(EigenProduct, IsTheSumOfTheProductsInEveryOrder) {
  Random random(41);
  for (const auto& [m, k, n] : {std::array<Index, 3>{25, 30, 20},
                                {1, 40, 9},
                                {40, 1, 40},
                                {3, 100, 2},
                                {39, 39, 39},
                                {40, 40, 40},
                                {130, 70, 260}}) {
    const MatrixXd a = drawn(random, m, k), b = drawn(random, k, n), expected = writtenOut(a, b);
    const MatrixXd at = a.transpose(), bt = b.transpose();
    const ByRows a_rows = a, b_rows = b;
    const double close = 1e-13 * static_cast<double>(k);
    EXPECT_LT((a * b - expected).cwiseAbs().maxCoeff(), close) << m << " " << k << " " << n;
    EXPECT_LT((at.transpose() * b - expected).cwiseAbs().maxCoeff(), close);
    EXPECT_LT((a * bt.transpose() - expected).cwiseAbs().maxCoeff(), close);
    EXPECT_LT((at.transpose() * bt.transpose() - expected).cwiseAbs().maxCoeff(), close);
    EXPECT_LT((a_rows * b - expected).cwiseAbs().maxCoeff(), close);
    EXPECT_LT((a * b_rows - expected).cwiseAbs().maxCoeff(), close);
    const ByRows into = a_rows * b_rows;
    EXPECT_LT((into - expected).cwiseAbs().maxCoeff(), close);
  }
}

TEST(EigenProduct, AddsToPartsOfAMatrixAndTouchesNothingElse) {
  Random random(42);
  const MatrixXd a = drawn(random, 60, 50), b = drawn(random, 50, 70), start = drawn(random, 100, 100);
  MatrixXd result = start;
  result.block(5, 7, 40, 30).noalias() -= 2.0 * a.block(3, 2, 40, 45) * b.block(1, 4, 45, 30);
  MatrixXd expected = start;
  expected.block(5, 7, 40, 30) -= 2.0 * writtenOut(a.block(3, 2, 40, 45), b.block(1, 4, 45, 30));
  EXPECT_LT((result - expected).cwiseAbs().maxCoeff(), 1e-11);
  result.block(5, 7, 40, 30) = start.block(5, 7, 40, 30);
  EXPECT_EQ(result, start);
}

TEST(EigenProduct, OfNothingIsZero) {
  const MatrixXd none = MatrixXd::Ones(30, 0) * MatrixXd::Ones(0, 30);
  EXPECT_EQ(none, MatrixXd::Zero(30, 30));
  EXPECT_EQ((MatrixXd::Ones(0, 30) * MatrixXd::Ones(30, 40)).rows(), 0);
}

TEST(EigenProduct, KeepsWhatIsNoNumber) {
  MatrixXd a = MatrixXd::Zero(30, 30);
  a(4, 5) = std::numeric_limits<double>::quiet_NaN();
  const MatrixXd product = a * MatrixXd::Zero(30, 30);
  for (Index i = 0; i < 30; ++i) EXPECT_EQ(product.row(i).hasNaN(), i == 4);
}

}  // namespace
}  // namespace spindrift
