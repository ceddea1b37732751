// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/thermal/noise_inference.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/base/random.h"
#include "core/math/distributions.h"

namespace spindrift {
namespace {

Eigen::VectorXd coloured(Random& random, Eigen::Index samples, const Eigen::VectorXd& ar) {
  Eigen::VectorXd v = Eigen::VectorXd::Zero(samples + 500);
  for (Eigen::Index k = ar.size(); k < v.size(); ++k) {
    v[k] = random.normal(0.0, 1.0);
    for (Eigen::Index j = 0; j < ar.size(); ++j) v[k] += ar[j] * v[k - 1 - j];
  }
  return v.tail(samples);
}

Eigen::MatrixXd slowColumns(Eigen::Index samples) {
  Eigen::MatrixXd X(samples, 3);
  for (Eigen::Index k = 0; k < samples; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(samples);
    X.row(k) << 1.0, 100.0 * std::sin(9.0 * t), 1e-3 * std::cos(23.0 * t);
  }
  return X;
}

TEST(Autoregression, WhitensExactlyFromTheFirstSample) {
  const Autoregression noise(Eigen::Vector2d(0.9, -0.5));
  // Stationary autocovariance by its defining equations, against W' W = V^-1.
  const Eigen::Index n = 12;
  Eigen::MatrixXd W = Eigen::MatrixXd::Identity(n, n);
  noise.whiten(W);
  const Eigen::MatrixXd V = (W.transpose() * W).inverse();
  for (Eigen::Index i = 0; i + 1 < n; ++i) EXPECT_NEAR(V(i, i), V(i + 1, i + 1), 1e-9);
  for (Eigen::Index i = 3; i < n; ++i)
    EXPECT_NEAR(V(i, 0), noise.ar[0] * V(i - 1, 0) + noise.ar[1] * V(i - 2, 0), 1e-9);
  EXPECT_NEAR(std::sqrt(V(0, 0)), noise.amplification(), 1e-9);
}

TEST(NoiseInference, WhiteNoiseGivesTheTextbookCovariance) {
  Random random(3);
  const Eigen::MatrixXd X = slowColumns(80);
  const Eigen::VectorXd v = coloured(random, 80, Eigen::VectorXd());
  const NoiseInference r = inferNoise(X, v, 0);
  const Eigen::VectorXd left = v - X * (X.transpose() * X).ldlt().solve(X.transpose() * v);
  const Eigen::MatrixXd expected = left.squaredNorm() / 77.0 * (X.transpose() * X).inverse();
  EXPECT_LT((r.covariance - expected).cwiseQuotient(expected).norm(), 1e-8);
  EXPECT_EQ(r.degrees_of_freedom[1], 77.0);
}

TEST(NoiseInference, IntervalsHoldAlthoughTheColourComesFromTheSameFewSamples) {
  for (const Eigen::Vector2d& ar : {Eigen::Vector2d(0.9, 0.0), Eigen::Vector2d(1.5, -0.6), Eigen::Vector2d(0.0, 0.0)}) {
    int inside = 0;
    int naive = 0;
    const int runs = 600;
    const Eigen::MatrixXd X = slowColumns(250);
    for (int run = 0; run < runs; ++run) {
      Random random(100 + static_cast<std::uint64_t>(run));
      const Eigen::VectorXd v = coloured(random, 250, ar);
      const NoiseInference r = inferNoise(X, v, 2);
      // Truth is zero; the best estimate under the colour found.
      Eigen::MatrixXd J = X;
      Eigen::VectorXd w = v;
      r.noise.whiten(J);
      r.noise.whiten(w);
      const Eigen::VectorXd d = (J.transpose() * J).ldlt().solve(J.transpose() * w);
      const double sigma = std::sqrt(r.covariance(1, 1));
      inside += std::abs(d[1]) < studentQuantile(0.975, r.degrees_of_freedom[1]) * sigma;
      naive += std::abs(d[1]) < 1.96 * r.innovation_sigma * std::sqrt((J.transpose() * J).inverse()(1, 1));
    }
    EXPECT_NEAR(inside / static_cast<double>(runs), 0.95, 0.022) << ar.transpose();
    EXPECT_GE(inside, naive);
  }
}

TEST(NoiseInference, FindsTheColour) {
  Random random(8);
  const Eigen::MatrixXd X = slowColumns(5000);
  const NoiseInference r = inferNoise(X, coloured(random, 5000, Eigen::Vector2d(1.5, -0.6)), 2);
  EXPECT_NEAR(r.noise.ar[0], 1.5, 0.05);
  EXPECT_NEAR(r.noise.ar[1], -0.6, 0.05);
  EXPECT_NEAR(r.innovation_sigma, 1.0, 0.03);
}

TEST(NoiseInference, AColumnWithoutEffectIsNotHidden) {
  Random random(9);
  Eigen::MatrixXd X = slowColumns(100);
  X.col(2).setZero();
  EXPECT_FALSE(inferNoise(X, coloured(random, 100, Eigen::Vector2d(0.5, 0.0)), 2).covariance.allFinite());
}

}  // namespace
}  // namespace spindrift
