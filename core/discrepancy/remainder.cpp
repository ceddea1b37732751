// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/discrepancy/effect_posterior.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// Hats in time over the units of `series`.
Eigen::MatrixXd smoothColumns(const ResidualProblem& problem, const std::vector<int>& series) {
  const int hats = std::clamp(problem.epoch_count / 3, 2, 14);
  const double start = problem.node_time_s.front();
  const double span = std::max(1.0, problem.node_time_s.back() - start);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(problem.size(), hats);
  for (const int s : series) {
    const auto at = static_cast<std::size_t>(s);
    for (Index u = problem.series_begin[at]; u < problem.series_begin[at + 1]; ++u) {
      const double position = (problem.time_s[static_cast<std::size_t>(u)] - start) / span * (hats - 1);
      for (int h = 0; h < hats; ++h) out(u, h) = std::max(0.0, 1.0 - std::abs(position - h));
    }
  }
  return out;
}

struct Course {
  Eigen::VectorXd values;  // um or urad
  double evidence = 0.0;
  double power = 0.0;
};

/// The smooth course of `series` together, its size at the maximum of the marginal likelihood.
Course courseOf(const ResidualProblem& problem, const CandidateLibrary::Given& given, const Eigen::VectorXd& residual,
                const std::vector<int>& series) {
  Course out;
  out.values = Eigen::VectorXd::Zero(problem.size());
  const Eigen::MatrixXd raw = smoothColumns(problem, series);
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(residual.size(), raw.cols());
  const Eigen::MatrixXd projected = problem.projected(raw);
  u.topRows(projected.rows()) = projected;
  if (given.basis.cols() > 0) u -= given.basis * (given.basis.transpose() * u);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(u.transpose() * u);
  const Eigen::VectorXd lambda = eigen.eigenvalues().cwiseMax(0.0);
  const Eigen::VectorXd beta = eigen.eigenvectors().transpose() * (u.transpose() * residual);
  double width = 0.0;
  for (int step = 0; step < 28; ++step) {
    const double w = 0.02 * std::pow(1.35, step);  // um: from far below any noise to 100 times it
    double value = 0.0;
    for (Index i = 0; i < lambda.size(); ++i) {
      const double v = 1.0 + lambda[i] * w * w;
      value += beta[i] * beta[i] * w * w / v - std::log(v);
    }
    if (value > out.evidence) {
      out.evidence = value;
      width = w;
    }
  }
  if (!(out.evidence > 0.0)) return out;
  const Eigen::VectorXd coefficient = (beta.array() * width * width / (1.0 + lambda.array() * width * width)).matrix();
  const Eigen::VectorXd weights = eigen.eigenvectors() * coefficient;
  out.values = raw * weights;
  out.power = (u * weights).squaredNorm();
  // Deviation from the constant of the series, which is free.
  for (const int s : series) {
    if (!problem.free_constants) continue;
    const Index from = problem.series_begin[static_cast<std::size_t>(s)];
    const Index count = problem.series_begin[static_cast<std::size_t>(s) + 1] - from;
    out.values.segment(from, count).array() -= out.values.segment(from, count).mean();
  }
  return out;
}

}  // namespace

Remainder remainderOf(const ResidualProblem& problem, const CandidateLibrary::Given& given) {
  Remainder out;
  out.values = Eigen::VectorXd::Zero(problem.size());
  out.series_evidence.assign(static_cast<std::size_t>(problem.seriesCount()), 0.0);
  for (const Component c : all_components) {
    std::vector<int> series;
    double count = 0.0;
    for (int s = 0; s < problem.seriesCount(); ++s) {
      const Index from = problem.series_begin[static_cast<std::size_t>(s)];
      if (problem.component[static_cast<std::size_t>(from)] != c) continue;
      series.push_back(s);
      count += static_cast<double>(problem.series_begin[static_cast<std::size_t>(s) + 1] - from);
    }
    if (series.empty()) continue;
    const Course together = courseOf(problem, given, given.residual, series);
    Eigen::VectorXd values = together.values;
    double evidence = together.evidence;
    double power = together.power;
    // A point that was measured a few times has no course of its own.
    const bool alone = series.size() > 1 && problem.epoch_count >= 6 && series.size() <= 60;
    for (const int s : alone ? series : std::vector<int>{}) {
      const Course own = courseOf(problem, given, given.residual, {s});
      // The best of so many series.
      const double told = own.evidence - 2.0 * std::log(static_cast<double>(series.size()));
      out.series_evidence[static_cast<std::size_t>(s)] = told;
      if (!(told > std::max(10.0, together.evidence))) continue;
      const Index from = problem.series_begin[static_cast<std::size_t>(s)];
      const Index size = problem.series_begin[static_cast<std::size_t>(s) + 1] - from;
      values.segment(from, size) = own.values.segment(from, size);
      power += own.power;
      evidence = std::max(evidence, told);
    }
    if (!(evidence > 0.0)) continue;
    out.components.push_back({c, std::sqrt(values.squaredNorm() / count), evidence, power});
    out.values += values;
  }
  return out;
}

}  // namespace spindrift
