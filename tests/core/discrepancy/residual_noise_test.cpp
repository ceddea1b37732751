// SPDX-License-Identifier: GPL-3.0-or-later
// Shared noise of the observations in the whitening of the residual problem, against the covariance written out.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/discrepancy/residual_problem.h"

namespace spindrift {
namespace {

constexpr std::size_t points = 8;
constexpr std::size_t states = 5;

DiscrepancyInput input() {
  DiscrepancyInput in;
  in.absolute = true;
  Random random(3);
  for (std::size_t k = 0; k < states; ++k) {
    for (std::size_t p = 0; p < points; ++p) {
      for (const Component c : {Component::EX, Component::EZ}) {
        Observation o;
        o.time_s = 600.0 * static_cast<double>(k) + static_cast<double>(p);
        o.state = "M" + std::to_string(k);
        o.point = "P" + std::to_string(p);
        o.position_mm = {10.0 * static_cast<double>(p), 5.0, 0.0};
        o.component = c;
        o.sigma = random.uniform(0.5, 0.9);
        o.value = random.normal();
        in.observations.rows.push_back(o);
      }
    }
  }
  in.predicted.assign(in.observations.rows.size(), 0.0);
  return in;
}

ResidualProblem problemOf(const DiscrepancyInput& in, std::size_t units = 3000) {
  std::vector<std::size_t> rows(in.observations.rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  return ResidualProblem(in, rows, units);
}

/// The model of residual_problem.h over the units, one observation each.
Eigen::MatrixXd covarianceOf(const DiscrepancyInput& in, const ResidualProblem& problem, const NoiseModel& noise) {
  const Eigen::Index n = problem.size();
  Eigen::MatrixXd c(n, n);
  for (Eigen::Index u = 0; u < n; ++u) {
    for (Eigen::Index v = 0; v < n; ++v) {
      const auto a = static_cast<std::size_t>(u), b = static_cast<std::size_t>(v);
      const std::size_t i = problem.unit_rows[a].front(), j = problem.unit_rows[b].front();
      const ComponentNoise& na = noise.of(problem.component[a]);
      const ComponentNoise& nb = noise.of(problem.component[b]);
      const double sigma2 = in.observations.rows[i].sigma * in.observations.rows[j].sigma;
      const double weight = noise.weight.size() == 0 ? 1.0 : noise.weight[u];
      double value = u == v ? sigma2 / weight : in.observations.shared.covariance(i, j);
      value *= std::sqrt((1.0 - na.correlated_part) * (1.0 - nb.correlated_part));
      if (problem.series[a] == problem.series[b] && na.correlated_part > 0.0)
        value += sigma2 * na.correlated_part *
                 std::exp(-std::abs(problem.time_s[a] - problem.time_s[b]) / na.correlation_time_s);
      c(u, v) = na.scale * nb.scale * value;
      if (problem.component[a] == problem.component[b] && problem.epoch[a] == problem.epoch[b])
        c(u, v) += na.common * nb.common;
    }
  }
  return c;
}

void expectWhite(const DiscrepancyInput& in, ResidualProblem& problem, const NoiseModel& noise) {
  problem.setNoise(noise);
  const Eigen::MatrixXd c = covarianceOf(in, problem, noise);
  const Eigen::MatrixXd w = problem.whitened(Eigen::MatrixXd::Identity(problem.size(), problem.size()));
  const Eigen::MatrixXd white = w * c * w.transpose();
  EXPECT_LT((white - Eigen::MatrixXd::Identity(white.rows(), white.cols())).cwiseAbs().maxCoeff(), 1e-7);
}

std::vector<NoiseModel> someNoise(Eigen::Index units) {
  Random random(5);
  std::vector<NoiseModel> out(4);
  out[1].of(Component::EX).scale = 1.7;
  out[1].of(Component::EZ).common = 0.4;
  out[2].of(Component::EX).correlated_part = 0.4;
  out[2].of(Component::EX).correlation_time_s = 900.0;
  out[3] = out[2];
  out[3].of(Component::EX).common = 0.3;
  out[3].weight = Eigen::VectorXd::Ones(units);
  for (Eigen::Index u = 0; u < units; u += 3) out[3].weight[u] = random.uniform(0.05, 1.0);
  return out;
}

TEST(ResidualNoise, FactorsOfFewAndOfManySeriesAreWhitened) {
  DiscrepancyInput in = input();
  const std::size_t n = in.observations.rows.size();
  // One of everything, one of a state, one of each series, one of single rows.
  SharedNoise::Factor all, state;
  for (std::size_t i = 0; i < n; ++i) {
    all.push_back({i, 0.1 + 0.001 * static_cast<double>(i)});
    if (in.observations.rows[i].state == "M2") state.push_back({i, i % 2 == 0 ? 0.2 : -0.2});
  }
  in.observations.shared.addFactor(all);
  in.observations.shared.addFactor(state);
  for (std::size_t s = 0; s < 2 * points; ++s) {
    SharedNoise::Factor series;
    for (std::size_t k = 0; k < states; ++k) series.push_back({s + 2 * points * k, 0.25});
    in.observations.shared.addFactor(series);
  }
  in.observations.shared.addFactor({{0, 0.1}, {3, 0.1}});
  in.observations.shared.addFactor({{7, 0.2}});
  ResidualProblem problem = problemOf(in);
  ASSERT_EQ(problem.domains().size(), 1U) << "components that share noise stand together";
  for (const NoiseModel& noise : someNoise(problem.size())) expectWhite(in, problem, noise);
}

TEST(ResidualNoise, RowsWithoutNoiseOfTheirOwnAreNoTrouble) {
  DiscrepancyInput in = input();
  for (std::size_t i = 0; i + 1 < in.observations.rows.size(); i += 2) {
    // Two causes for two rows: all that there is.
    const double a = in.observations.rows[i].sigma, b = in.observations.rows[i + 1].sigma;
    in.observations.shared.addFactor({{i, 0.8 * a}, {i + 1, 0.6 * b}});
    in.observations.shared.addFactor({{i, 0.6 * a}, {i + 1, 0.8 * b}});
  }
  ResidualProblem problem = problemOf(in);
  for (const NoiseModel& noise : someNoise(problem.size())) expectWhite(in, problem, noise);
}

TEST(ResidualNoise, MeansOfReadingsKeepWhatTheyShare) {
  DiscrepancyInput in = input();
  in.observations.rows.resize(0);
  for (std::size_t k = 0; k < 40; ++k) {
    Observation o;
    o.time_s = static_cast<double>(k);
    o.state = "M0";
    o.point = "P";
    o.sigma = 0.5;
    in.observations.rows.push_back(o);
  }
  in.predicted.assign(40, 0.0);
  SharedNoise::Factor all;
  for (std::size_t k = 0; k < 40; ++k) all.push_back({k, 0.3});
  in.observations.shared.addFactor(all);
  // Readings that follow each other in time have three times the units of merged points.
  const ResidualProblem problem = problemOf(in, 4);
  ASSERT_EQ(problem.size(), 10);
  for (Eigen::Index u = 0; u < 10; ++u) EXPECT_NEAR(problem.sigma[u], std::sqrt(0.16 / 4.0 + 0.09), 1e-12);
}

}  // namespace
}  // namespace spindrift
