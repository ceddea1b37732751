// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/discrepancy/bordered_gram.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "core/base/random.h"

namespace spindrift {
namespace {

using Matrix = Eigen::MatrixXd;

Matrix randomMatrix(Random& random, Eigen::Index rows, Eigen::Index cols) {
  Matrix m(rows, cols);
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < cols; ++j) m(i, j) = random.normal();
  }
  return m;
}

/// The covariance of r written out: scale^2 + shift^2 S S' + smooth^2 X X', over scale^2, and r beside it.
double writtenOut(const Matrix& S, const Matrix& X, const Eigen::VectorXd& r, double scale, double shift,
                  double smooth) {
  const Matrix covariance = Matrix::Identity(r.size(), r.size()) +
                            (shift * shift * S * S.transpose() + smooth * smooth * X * X.transpose()) / (scale * scale);
  const Eigen::LLT<Matrix> llt(covariance);
  return 2.0 * llt.matrixLLT().diagonal().array().log().sum() + r.dot(llt.solve(r)) / (scale * scale);
}

TEST(BorderedGram, IsTheLikelihoodWrittenOut) {
  Random random(11);
  for (const auto& [shifts, smooth] : {std::pair{0, 0}, {0, 7}, {1, 0}, {1, 3}, {2, 5}, {40, 0}, {40, 12}, {90, 30}}) {
    const Matrix S = randomMatrix(random, 120, shifts);
    const Matrix X = randomMatrix(random, 120, smooth);
    const Eigen::VectorXd r = randomMatrix(random, 120, 1);
    Matrix all(120, shifts + smooth + 1);
    all << S, X, r;
    const BorderedGram gram(all.transpose() * all, shifts);
    for (const double scale : {0.3, 1.0, 20.0}) {
      for (const double shift : {0.0, 1e-4, 0.7, 30.0}) {
        for (const double size : {0.0, 0.2, 5.0}) {
          const double expected = writtenOut(S, X, r, scale, shift, size);
          EXPECT_NEAR(gram.deviance(scale, shift, size), expected, 1e-6 + 1e-8 * std::abs(expected))
              << shifts << " shifts " << smooth << " smooth, " << scale << " " << shift << " " << size;
        }
      }
    }
  }
}

TEST(BorderedGram, DependentColumnsAreNoTrouble) {
  Random random(12);
  // More shifts than readings, some of nothing: as in a component that was measured in few of the states.
  Matrix S = randomMatrix(random, 20, 50);
  S.rightCols(10).setZero();
  const Matrix X = S.leftCols(4);
  const Eigen::VectorXd r = randomMatrix(random, 20, 1);
  Matrix all(20, 55);
  all << S, X, r;
  EXPECT_NEAR(BorderedGram(all.transpose() * all, 50).deviance(0.5, 2.0, 1.0), writtenOut(S, X, r, 0.5, 2.0, 1.0),
              1e-6);
  EXPECT_TRUE(std::isfinite(BorderedGram(Matrix::Zero(5, 5), 3).deviance(1.0, 1.0, 1.0)));
}

}  // namespace
}  // namespace spindrift
