// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/singular_values.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace spindrift {
namespace {

using Matrix = Eigen::MatrixXd;

Matrix normalMatrix(Random& random, Eigen::Index rows, Eigen::Index cols) {
  Matrix m(rows, cols);
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < cols; ++j) m(i, j) = random.normal();
  }
  return m;
}

double offOrthonormal(const Matrix& columns) {
  return (columns.transpose() * columns - Matrix::Identity(columns.cols(), columns.cols())).norm();
}

TEST(SingularValues, GiveTheMatrixBackInEveryShape) {
  Random random(3);
  // Small ones, larger than the switch from Jacobi to divide and conquer, tall, wide, and around the reduction to a
  // triangle.
  const std::vector<std::pair<int, int>> shapes = {{1, 1},    {1, 7},   {7, 1},   {9, 9},   {40, 40},
                                                   {15, 9},   {14, 9},  {500, 9}, {50, 30}, {49, 30},
                                                   {300, 40}, {30, 50}, {9, 500}, {2, 40},  {40, 2}};
  for (const auto& [rows, cols] : shapes) {
    const Matrix A = normalMatrix(random, rows, cols);
    for (const RightVectors right : {RightVectors::Thin, RightVectors::Full}) {
      const SingularValues svd = singularValues(A, right);
      const Eigen::Index least = std::min(rows, cols);
      ASSERT_EQ(svd.values.size(), least);
      ASSERT_EQ(svd.left.cols(), least);
      ASSERT_EQ(svd.left.rows(), rows);
      ASSERT_EQ(svd.right.rows(), cols);
      ASSERT_EQ(svd.right.cols(), right == RightVectors::Full ? cols : least);
      EXPECT_LT((svd.left * svd.values.asDiagonal() * svd.right.leftCols(least).transpose() - A).norm(),
                1e-13 * A.norm() * std::sqrt(static_cast<double>(least)))
          << rows << " x " << cols;
      EXPECT_LT(offOrthonormal(svd.left), 1e-12) << rows << " x " << cols;
      EXPECT_LT(offOrthonormal(svd.right), 1e-12) << rows << " x " << cols;
      for (Eigen::Index k = 1; k < least; ++k) EXPECT_GE(svd.values(k - 1), svd.values(k));
      EXPECT_EQ(svd.rank(1e-9), least) << rows << " x " << cols;
    }
  }
}

TEST(SingularValues, ThatLieCloseTogetherLoseNoDigits) {
  // Columns that are orthogonal, some leaning on their neighbour by 1e-9: divide and conquer took them for one.
  for (const int cols : {21, 39, 63}) {
    Matrix A = Matrix::Zero(2 * cols, cols);
    for (int i = 0; i < 2 * cols; ++i) A(i, i % cols) = 1.0;
    for (int j = 1; j < cols; j += 3) A.col(j) += 1e-9 * A.col(j - 1);
    const SingularValues svd = singularValues(A);
    EXPECT_LT((svd.left * svd.values.asDiagonal() * svd.right.transpose() - A).norm(), 1e-13 * A.norm()) << cols;
    EXPECT_LT(offOrthonormal(svd.left) + offOrthonormal(svd.right), 1e-12) << cols;
  }
}

TEST(SingularValues, TellTheRankAndSpanTheNullSpace) {
  Random random(4);
  for (const auto& [rows, cols, rank] : {std::tuple{200, 30, 21}, std::tuple{35, 30, 21}, std::tuple{20, 30, 12}}) {
    const Matrix A = normalMatrix(random, rows, rank) * normalMatrix(random, rank, cols);
    const SingularValues svd = singularValues(A, RightVectors::Full);
    EXPECT_EQ(svd.rank(1e-9), rank);
    EXPECT_LT((A * svd.right.rightCols(cols - rank)).norm(), 1e-12 * A.norm());
  }
}

TEST(SingularValues, SmallOnesSurviveBesideLargeOnes) {
  Random random(5);
  // 1 to 1e-10: a normal matrix would have lost everything below 1e-8.
  const Eigen::Index n = 24;
  Matrix A = singularValues(normalMatrix(random, 400, n)).left;
  Eigen::VectorXd truth(n);
  for (Eigen::Index k = 0; k < n; ++k) truth(k) = std::pow(10.0, -10.0 * static_cast<double>(k) / (n - 1));
  A = A * truth.asDiagonal() * singularValues(normalMatrix(random, n, n)).right.transpose();
  const SingularValues svd = singularValues(A);
  for (Eigen::Index k = 0; k < n; ++k) EXPECT_NEAR(svd.values(k) / truth(k), 1.0, 1e-4) << k;
  EXPECT_EQ(svd.rank(1e-5), 12);
}

TEST(SingularValues, NothingHasNoRank) {
  EXPECT_EQ(singularValues(Matrix::Zero(5, 3)).rank(0.0), 0);
  const SingularValues no_rows = singularValues(Matrix(0, 4), RightVectors::Full);
  EXPECT_EQ(no_rows.rank(0.0), 0);
  EXPECT_LT(offOrthonormal(no_rows.right), 1e-15);
  EXPECT_EQ(no_rows.right.cols(), 4);
  EXPECT_EQ(singularValues(Matrix(4, 0)).left.rows(), 4);
}

}  // namespace
}  // namespace spindrift
