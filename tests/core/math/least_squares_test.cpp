// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/least_squares.h"

#include <gmock/gmock.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>

#include "core/base/random.h"
#include "core/math/basic_solution.h"

namespace spindrift {
namespace {

Eigen::MatrixXd randomMatrix(Random& random, int rows, int cols) {
  Eigen::MatrixXd m(rows, cols);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < cols; ++j) m(i, j) = random.normal();
  }
  return m;
}

TEST(LeastSquares, RecoversExactSolution) {
  Random random(1);
  const Eigen::MatrixXd A = randomMatrix(random, 20, 5);
  const Eigen::VectorXd truth = randomMatrix(random, 5, 1);
  const LinearFitResult fit = solveLinear(A, A * truth, Eigen::VectorXd::Constant(20, 0.1));
  ASSERT_EQ(fit.status, FitStatus::Converged);
  EXPECT_LT((fit.x - truth).norm(), 1e-12);
  EXPECT_EQ(fit.degrees_of_freedom, 15);
}

TEST(LeastSquares, StatedUncertaintyIsTheRealOne) {
  Random random(2);
  const Eigen::MatrixXd A = randomMatrix(random, 12, 3);
  const Eigen::Vector3d truth(1.0, -2.0, 3.0);
  Eigen::VectorXd sigma(12);
  for (int i = 0; i < 12; ++i) sigma(i) = 0.1 + 0.1 * i;
  int inside = 0;
  constexpr int runs = 4000;
  for (int run = 0; run < runs; ++run) {
    Eigen::VectorXd y = A * truth;
    for (int i = 0; i < 12; ++i) y(i) += sigma(i) * random.normal();
    const LinearFitResult fit = solveLinear(A, y, sigma);
    for (int k = 0; k < 3; ++k) {
      inside += std::abs(fit.x(k) - truth(k)) < 1.959963984540054 * fit.standardUncertainty(k) ? 1 : 0;
    }
  }
  EXPECT_NEAR(inside / (3.0 * runs), 0.95, 0.01);
}

TEST(LeastSquares, CorrelatedNoiseIsWhitened) {
  Random random(3);
  const int n = 10;
  const Eigen::MatrixXd A = randomMatrix(random, n, 2);
  Eigen::MatrixXd C(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) C(i, j) = std::pow(0.9, std::abs(i - j));
  }
  const Eigen::MatrixXd L = C.llt().matrixL();
  const Eigen::Vector2d truth(2.0, -1.0);
  double chi2 = 0.0;
  int inside = 0;
  constexpr int runs = 2000;
  for (int run = 0; run < runs; ++run) {
    const LinearFitResult fit = solveLinearCorrelated(A, A * truth + L * randomMatrix(random, n, 1), C);
    chi2 += fit.chi2;
    inside += std::abs(fit.x(0) - truth(0)) < 1.959963984540054 * fit.standardUncertainty(0) ? 1 : 0;
  }
  EXPECT_NEAR(chi2 / runs, n - 2.0, 0.3);
  EXPECT_NEAR(inside / double(runs), 0.95, 0.02);
}

TEST(LeastSquares, NamesWhatTheDataDoNotDetermine) {
  // Columns 1 and 2 are seen only as their sum.
  Random random(4);
  Eigen::MatrixXd A = randomMatrix(random, 10, 3);
  A.col(2) = A.col(1);
  const Eigen::VectorXd y = A * Eigen::Vector3d(1.0, 2.0, 3.0);
  const LinearFitResult fit = solveLinear(A, y, Eigen::VectorXd::Ones(10));
  EXPECT_EQ(fit.status, FitStatus::Degenerate);
  EXPECT_THAT(fit.undetermined, ::testing::ElementsAre(1, 2));
  EXPECT_EQ(fit.rank, 2);
  EXPECT_NEAR(fit.x(0), 1.0, 1e-10);
  EXPECT_TRUE(std::isinf(fit.covariance(1, 1)));
  EXPECT_TRUE(std::isfinite(fit.covariance(0, 0)));
  ASSERT_EQ(fit.null_space.cols(), 1);
  EXPECT_NEAR(std::abs(fit.null_space(1, 0)), std::sqrt(0.5), 1e-9);
}

TEST(LeastSquares, FewerRowsThanColumnsIsDegenerate) {
  const LinearFitResult fit =
      solveLinear(Eigen::MatrixXd::Identity(2, 3), Eigen::Vector2d(1.0, 2.0), Eigen::Vector2d::Ones());
  EXPECT_EQ(fit.status, FitStatus::Degenerate);
  EXPECT_THAT(fit.undetermined, ::testing::ElementsAre(2));
  EXPECT_NEAR(fit.x(0), 1.0, 1e-12);
}

TEST(LeastSquares, BadlyScaledColumnsAreNotTakenForMissing) {
  Eigen::MatrixXd A(4, 2);
  A << 1, 1e-9, 1, 2e-9, 1, 3e-9, 1, 4.5e-9;
  const LinearFitResult fit = solveLinear(A, A * Eigen::Vector2d(1.0, 1e6), Eigen::VectorXd::Ones(4));
  ASSERT_EQ(fit.status, FitStatus::Converged);
  EXPECT_NEAR(fit.x(1) / 1e6, 1.0, 1e-6);
}

TEST(BasicSolution, ColumnsThatDependOnOthersGetNothing) {
  Eigen::MatrixXd columns(40, 3);
  Eigen::VectorXd y(40);
  for (Eigen::Index i = 0; i < 40; ++i) {
    const double t = static_cast<double>(i);
    columns.row(i) << std::sin(0.3 * t), 0.37 * std::sin(0.3 * t) * (1.0 + 1e-9 * t), std::cos(0.2 * t);
    y[i] = 2.0 * std::sin(0.3 * t) - std::cos(0.2 * t);
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  qr.setThreshold(1e-6);
  const Eigen::VectorXd x = basicSolution(qr, y);
  EXPECT_EQ(x[1], 0.0);
  EXPECT_NEAR(x[0], 2.0, 1e-7);
  EXPECT_NEAR(x[2], -1.0, 1e-7);
}

TEST(BasicSolution, OfFullRankIsTheLeastSquaresSolution) {
  Eigen::MatrixXd columns(12, 4);
  Eigen::VectorXd y(12);
  for (Eigen::Index i = 0; i < 12; ++i) {
    for (Eigen::Index c = 0; c < 4; ++c) columns(i, c) = std::cos(1.0 + 0.7 * static_cast<double>(i * (c + 1)));
    y[i] = std::sin(static_cast<double>(i));
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  EXPECT_LT((basicSolution(qr, y) - (columns.transpose() * columns).ldlt().solve(columns.transpose() * y)).norm(),
            1e-10);
  EXPECT_EQ(basicSolution(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(Eigen::MatrixXd::Zero(5, 2)), y.head(5)).norm(),
            0.0);
}

TEST(LeastSquares, ASingularCovarianceIsRefusedHoweverItIsRounded) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Ones(3, 1);
  for (const double rounding : {0.0, 1e-16, 4e-16, -4e-16}) {
    Eigen::Matrix3d C = Eigen::Matrix3d::Identity();
    C(0, 1) = C(1, 0) = 1.0 - rounding;
    EXPECT_EQ(solveLinearCorrelated(A, Eigen::Vector3d(1.0, 2.0, 3.0), C).status, FitStatus::Rejected) << rounding;
  }
  Eigen::Matrix3d C = Eigen::Matrix3d::Identity();
  C(0, 1) = C(1, 0) = 1.0 - 1e-9;
  EXPECT_EQ(solveLinearCorrelated(A, Eigen::Vector3d(1.0, 2.0, 3.0), C).status, FitStatus::Converged);
}

}  // namespace
}  // namespace spindrift
