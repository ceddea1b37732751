// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/discrepancy/effect_posterior.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// Patterns (constant, slopes along the axes where there are points enough) times hats in time, of one component.
Eigen::MatrixXd smoothColumns(const ResidualProblem& problem, Component c) {
  std::vector<Index> units;
  int series = 0;
  for (Index u = 0; u < problem.size(); ++u) {
    if (problem.component[static_cast<std::size_t>(u)] != c) continue;
    if (units.empty() || problem.series[static_cast<std::size_t>(u)] != problem.series[static_cast<std::size_t>(u - 1)]) ++series;
    units.push_back(u);
  }
  if (units.empty()) return {};
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d high = -low;
  for (const Index u : units) {
    low = low.cwiseMin(problem.place[static_cast<std::size_t>(u)].position_mm);
    high = high.cwiseMax(problem.place[static_cast<std::size_t>(u)].position_mm);
  }
  std::vector<Eigen::VectorXd> patterns{Eigen::VectorXd::Ones(static_cast<Index>(units.size()))};
  for (int axis = 0; axis < 3 && series >= 6; ++axis) {
    if (!(high[axis] - low[axis] > 1e-6)) continue;
    Eigen::VectorXd p(static_cast<Index>(units.size()));
    for (Index i = 0; i < p.size(); ++i) {
      const auto& q = problem.place[static_cast<std::size_t>(units[static_cast<std::size_t>(i)])];
      p[i] = 2.0 * (q.position_mm[axis] - low[axis]) / (high[axis] - low[axis]) - 1.0;
    }
    patterns.push_back(std::move(p));
  }
  const int hats = std::clamp(problem.epoch_count / 2, 2, 20);
  const double start = problem.node_time_s.front();
  const double span = std::max(1.0, problem.node_time_s.back() - start);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(problem.size(), static_cast<Index>(patterns.size()) * hats);
  Index at = 0;
  for (const Eigen::VectorXd& pattern : patterns) {
    for (int h = 0; h < hats; ++h, ++at) {
      for (Index i = 0; i < pattern.size(); ++i) {
        const Index u = units[static_cast<std::size_t>(i)];
        const double position = (problem.time_s[static_cast<std::size_t>(u)] - start) / span * (hats - 1);
        out(u, at) = pattern[i] * std::max(0.0, 1.0 - std::abs(position - h));
      }
    }
  }
  return out;
}

}  // namespace

Remainder remainderOf(const ResidualProblem& problem, const CandidateLibrary::Given& given) {
  Remainder out;
  out.values = Eigen::VectorXd::Zero(problem.size());
  for (const Component c : all_components) {
    const Eigen::MatrixXd raw = smoothColumns(problem, c);
    if (raw.cols() == 0) continue;
    Eigen::MatrixXd u = Eigen::MatrixXd::Zero(given.residual.size(), raw.cols());
    const Eigen::MatrixXd projected = problem.projected(raw);
    u.topRows(projected.rows()) = projected;
    if (given.basis.cols() > 0) u -= given.basis * (given.basis.transpose() * u);
    const Eigen::MatrixXd gram = u.transpose() * u;
    const Eigen::VectorXd b = u.transpose() * given.residual;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(gram);
    const Eigen::VectorXd lambda = eigen.eigenvalues().cwiseMax(0.0);
    const Eigen::VectorXd beta = eigen.eigenvectors().transpose() * b;
    double best = 0.0;
    double width = 0.0;
    for (int step = 0; step < 28; ++step) {
      const double w = 0.02 * std::pow(1.35, step);  // um: from far below any noise to 100 times it
      double value = 0.0;
      for (Index i = 0; i < lambda.size(); ++i) {
        const double v = 1.0 + lambda[i] * w * w;
        value += beta[i] * beta[i] * w * w / v - std::log(v);
      }
      if (value > best) {
        best = value;
        width = w;
      }
    }
    if (!(best > 0.0)) continue;
    Eigen::VectorXd coefficient(lambda.size());
    for (Index i = 0; i < lambda.size(); ++i) coefficient[i] = beta[i] * width * width / (1.0 + lambda[i] * width * width);
    const Eigen::VectorXd weights = eigen.eigenvectors() * coefficient;
    Eigen::VectorXd values = raw * weights;
    // Deviation from the constant of the series, which is free.
    for (int s = 0; s < problem.seriesCount() && problem.free_constants; ++s) {
      const Index from = problem.series_begin[static_cast<std::size_t>(s)];
      const Index count = problem.series_begin[static_cast<std::size_t>(s) + 1] - from;
      if (problem.component[static_cast<std::size_t>(from)] != c) continue;
      values.segment(from, count).array() -= values.segment(from, count).mean();
    }
    double count = 0.0;
    for (Index i = 0; i < problem.size(); ++i) count += problem.component[static_cast<std::size_t>(i)] == c ? 1.0 : 0.0;
    out.components.push_back({c, std::sqrt(values.squaredNorm() / count), best, (u * weights).squaredNorm()});
    out.values += values;
  }
  return out;
}

}  // namespace spindrift
