// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "core/discrepancy/discrepancy_search.h"
#include "core/math/distributions.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// - ln of the p-value of chi-squared, far out in the tail, where it is too small for a double.
double farTail(double chi2, double dof) {
  const double x = 0.5 * std::max(chi2, dof);
  return x - (0.5 * dof - 1.0) * std::log(x) + std::lgamma(0.5 * dof);
}

}  // namespace

StructureTest testStructure(const ResidualProblem& problem, const Eigen::VectorXd& z) {
  struct Candidate {
    double p = 1.0;
    double far_tail = 0.0;
    std::string text;
    Component component = Component::EX;
  };
  std::vector<Candidate> tests;
  const auto add = [&](double statistic, double dof, std::string text, Component c) {
    tests.push_back({chiSquaredTail(statistic, dof), farTail(statistic, dof), std::move(text), c});
  };
  const int epochs = problem.epoch_count;
  const double dof_part = std::max(
      0.3, static_cast<double>(problem.degreesOfFreedom()) / std::max<double>(1.0, static_cast<double>(z.size())));
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d high = -low;
  for (const DeviationQuery& q : problem.place) {
    low = low.cwiseMin(q.position_mm);
    high = high.cwiseMax(q.position_mm);
  }
  for (const Component c : all_components) {
    double sum = 0.0;
    double rows = 0.0;
    for (Index u = 0; u < z.size(); ++u) {
      if (problem.component[static_cast<std::size_t>(u)] != c) continue;
      sum += z[u] * z[u];
      rows += 1.0;
    }
    if (rows < 4.0) continue;
    add(sum, std::max(1.0, rows * dof_part), fmt::format("{} scatters more than its noise", toString(c)), c);
    // A course in time common to all points (kind 0) or growing along x, y, z (1..3): dof = epochs - 1.
    for (int kind = 0; kind < 4; ++kind) {
      if (kind > 0 && !(high[kind - 1] - low[kind - 1] > 1.0)) continue;
      Eigen::VectorXd num = Eigen::VectorXd::Zero(epochs);
      Eigen::VectorXd den = Eigen::VectorXd::Zero(epochs);
      for (Index u = 0; u < z.size(); ++u) {
        const auto i = static_cast<std::size_t>(u);
        if (problem.component[i] != c) continue;
        const double w = kind == 0 ? 1.0
                                   : (problem.place[i].position_mm[kind - 1] - 0.5 * (low[kind - 1] + high[kind - 1])) /
                                         (0.5 * (high[kind - 1] - low[kind - 1]));
        num[problem.epoch[i]] += w * z[u];
        den[problem.epoch[i]] += w * w;
      }
      double statistic = 0.0;
      int used = 0;
      for (int e = 0; e < epochs; ++e) {
        if (!(den[e] > 0.0)) continue;
        statistic += num[e] * num[e] / den[e];
        ++used;
      }
      if (used < 3) continue;
      std::string text = kind == 0 ? fmt::format("{} of all points follows a common course in time", toString(c))
                                   : fmt::format("{} follows a course in time that grows along {}", toString(c),
                                                 std::string(1, static_cast<char>('x' + kind - 1)));
      // Its period, if one frequency holds much of it.
      if (used >= 12) {
        const double start = problem.epoch_time_s.front();
        const double span = problem.epoch_time_s.back() - start;
        double best = 0.0;
        double total = 0.0;
        double period = 0.0;
        for (int e = 0; e < epochs; ++e) {
          if (den[e] > 0.0) total += num[e] * num[e] / den[e];
        }
        for (int k = 3; k <= epochs - 1; ++k) {
          const double omega = 3.14159265358979323846 * k / span;
          double cc = 0.0;
          double ss = 0.0;
          double cs = 0.0;
          double cy = 0.0;
          double sy = 0.0;
          for (int e = 0; e < epochs; ++e) {
            if (!(den[e] > 0.0)) continue;
            const double t = omega * (problem.epoch_time_s[static_cast<std::size_t>(e)] - start);
            const double v = num[e] / den[e];
            cc += den[e] * std::cos(t) * std::cos(t);
            ss += den[e] * std::sin(t) * std::sin(t);
            cs += den[e] * std::cos(t) * std::sin(t);
            cy += den[e] * std::cos(t) * v;
            sy += den[e] * std::sin(t) * v;
          }
          const double det = cc * ss - cs * cs;
          if (!(det > 1e-9)) continue;
          const double power = (ss * cy * cy - 2.0 * cs * cy * sy + cc * sy * sy) / det;
          if (power > best) {
            best = power;
            period = 2.0 * span / k;
          }
        }
        if (total > 0.0 && best > 0.6 * total) text += fmt::format(", with a period of about {:.0f} s", period);
      }
      add(statistic, std::max(1.0, (used - 1) * std::max(dof_part, 0.8)), text, c);
    }
  }
  for (int s = 0; s < problem.seriesCount(); ++s) {
    const Index from = problem.series_begin[static_cast<std::size_t>(s)];
    const Index count = problem.series_begin[static_cast<std::size_t>(s) + 1] - from;
    if (count < 4) continue;
    const Component c = problem.component[static_cast<std::size_t>(from)];
    add(z.segment(from, count).squaredNorm(), static_cast<double>(count - 1),
        fmt::format("{} of point {} deviates by itself", toString(c),
                    problem.series_point[static_cast<std::size_t>(s)]),
        c);
  }
  StructureTest out;
  double farthest = -1e300;
  for (const Candidate& test : tests) {
    const double p = std::min(1.0, test.p * static_cast<double>(tests.size()));
    if (p < out.p_value || (p == 0.0 && test.far_tail > farthest)) {
      out.p_value = p;
      farthest = test.far_tail;
      out.description = test.text;
      out.component = test.component;
    }
  }
  return out;
}

UnknownCourse testUnknownCourse(const ResidualProblem& problem, const Eigen::VectorXd& z,
                                const std::vector<NamedPart>& parts, double model_error, double log_n) {
  UnknownCourse out;
  out.advantage = -1e9;
  const auto epochs = static_cast<Index>(problem.epoch_count);
  for (const Component c : all_components) {
    std::vector<int> members;
    for (int s = 0; s < problem.seriesCount(); ++s) {
      const auto from = static_cast<std::size_t>(problem.series_begin[static_cast<std::size_t>(s)]);
      if (problem.component[from] == c) members.push_back(s);
    }
    const auto points = static_cast<Index>(members.size());
    if (points == 0) continue;
    // Whitened residual by point and epoch; cells of several readings hold their sum over the root of their number.
    Eigen::MatrixXd table = Eigen::MatrixXd::Zero(points, epochs);
    Eigen::MatrixXd count = Eigen::MatrixXd::Zero(points, epochs);
    std::vector<double> power(parts.size(), 0.0);
    double explained = 0.0;
    double left = 0.0;
    double rows = 0.0;
    for (Index p = 0; p < points; ++p) {
      const auto s = static_cast<std::size_t>(members[static_cast<std::size_t>(p)]);
      for (Index u = problem.series_begin[s]; u < problem.series_begin[s + 1]; ++u) {
        const Index e = problem.epoch[static_cast<std::size_t>(u)];
        table(p, e) += z[u];
        count(p, e) += 1.0;
        left += z[u] * z[u] - 1.0;
        rows += 1.0;
        double sum = 0.0;
        for (std::size_t k = 0; k < parts.size(); ++k) {
          power[k] += parts[k].explained[u] * parts[k].explained[u];
          sum += parts[k].explained[u];
        }
        explained += sum * sum;
      }
    }
    left += static_cast<double>(points);
    table = table.array() / count.array().sqrt().max(1.0);
    Index used = 0;
    double common = 0.0;
    for (Index e = 0; e < epochs; ++e) {
      const double cells = (count.col(e).array() > 0.0).cast<double>().sum();
      if (cells == 0.0) continue;
      const double sum = table.col(e).sum();
      common += sum * sum / cells;
      ++used;
    }
    if (used < 4) continue;
    int parameters = 0;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const double whole = parts[k].explained.squaredNorm();
      if (!(power[k] > 0.2 * whole)) continue;
      parameters += parts[k].parameter_count;
      // Large effects that cancel each other imitate what neither of them is.
      out.cancelling = out.cancelling || power[k] > 4.0 * explained;
      out.smallest_part = std::min(out.smallest_part, power[k] / std::max(left, 3.0 * std::sqrt(2.0 * rows)));
    }
    if (parameters == 0) continue;
    const double allowed = model_error * model_error * explained;
    const auto consider = [&](double statistic, double cost) {
      const double advantage = statistic - allowed - (cost - parameters) * log_n;
      if (advantage > out.advantage) {
        out.advantage = advantage;
        out.component = c;
      }
    };
    consider(common, static_cast<double>(used - 1));
    if (points > 1) {
      const Eigen::BDCSVD<Eigen::MatrixXd> svd(table);
      consider(svd.singularValues()[0] * svd.singularValues()[0], static_cast<double>(used + points - 2));
    }
  }
  return out;
}

}  // namespace spindrift
