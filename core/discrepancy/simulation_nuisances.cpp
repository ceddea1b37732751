// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/discrepancy/residual_problem.h"
#include "core/math/singular_values.h"

namespace spindrift {
namespace {

using Eigen::Index;

}  // namespace

Eigen::VectorXd ResidualProblem::ratePerSecond(const Eigen::VectorXd& values) const {
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(size());
  for (int s = 0; s < seriesCount(); ++s) {
    const Index from = series_begin[static_cast<std::size_t>(s)];
    const Index to = series_begin[static_cast<std::size_t>(s) + 1];
    for (Index u = from; u < to; ++u) {
      const Index before = std::max(from, u - 1);
      const Index after = std::min(to - 1, u + 1);
      const double dt = time_s[static_cast<std::size_t>(after)] - time_s[static_cast<std::size_t>(before)];
      if (dt > 0.0) rate[u] = (values[after] - values[before]) / dt;
    }
  }
  return rate;
}

std::vector<NuisanceColumn> ResidualProblem::simulationNuisances(double gain_uncertainty) const {
  std::vector<NuisanceColumn> out;
  if (!(gain_uncertainty > 0.0)) return out;
  const Index n = size();
  for (const Component c : all_components) {
    // Series means removed; epochs as columns.
    std::vector<int> members;
    for (int s = 0; s < seriesCount(); ++s) {
      if (component[static_cast<std::size_t>(series_begin[static_cast<std::size_t>(s)])] == c) members.push_back(s);
    }
    if (members.empty()) continue;
    Eigen::VectorXd centred = Eigen::VectorXd::Zero(n);
    for (const int s : members) {
      const Index from = series_begin[static_cast<std::size_t>(s)];
      const Index count = series_begin[static_cast<std::size_t>(s) + 1] - from;
      centred.segment(from, count) = simulated.segment(from, count);
      if (free_constants) centred.segment(from, count).array() -= simulated.segment(from, count).mean();
    }
    const double size_um = centred.cwiseAbs().maxCoeff();
    if (!(size_um > 1e-9)) continue;
    out.push_back({centred, gain_uncertainty, true});
    // Lags of the simulation a little off: the difference to itself after a lag.
    for (const double tau : {900.0, 3600.0}) {
      Eigen::VectorXd lagged = Eigen::VectorXd::Zero(n);
      for (const int s : members) {
        const Index from = series_begin[static_cast<std::size_t>(s)];
        const Index to = series_begin[static_cast<std::size_t>(s) + 1];
        double state = centred[from];
        for (Index u = from; u < to; ++u) {
          if (u > from) {
            const double dt = time_s[static_cast<std::size_t>(u)] - time_s[static_cast<std::size_t>(u - 1)];
            const double decay = std::exp(-dt / tau);
            const double slope = dt > 0.0 ? (centred[u] - centred[u - 1]) / dt : 0.0;
            state = centred[u] - slope * tau + (state - centred[u - 1] + slope * tau) * decay;
          }
          lagged[u] = centred[u] - state;
        }
      }
      out.push_back({lagged, 2.0 * gain_uncertainty, false});
    }
    // The parts it is made of: every pair of a pattern in space and one in time.
    const auto points = static_cast<Index>(members.size());
    if (points < 2 || epoch_count < 3) continue;
    Eigen::MatrixXd table = Eigen::MatrixXd::Zero(points, epoch_count);
    Eigen::MatrixXd count = Eigen::MatrixXd::Zero(points, epoch_count);
    for (Index p = 0; p < points; ++p) {
      const auto s = static_cast<std::size_t>(members[static_cast<std::size_t>(p)]);
      for (Index u = series_begin[s]; u < series_begin[s + 1]; ++u) {
        table(p, epoch[static_cast<std::size_t>(u)]) += centred[u];
        count(p, epoch[static_cast<std::size_t>(u)]) += 1.0;
      }
    }
    // A cell that was not measured takes the mean of its epoch.
    for (Index e = 0; e < epoch_count; ++e) {
      const double total = count.col(e).sum();
      const double average = total > 0.0 ? table.col(e).sum() / total : 0.0;
      for (Index p = 0; p < points; ++p) table(p, e) = count(p, e) > 0.0 ? table(p, e) / count(p, e) : average;
    }
    const SingularValues svd = singularValues(table);
    const Index rank = std::min<Index>(3, svd.rank(0.01));
    if (rank < 2) continue;
    for (Index a = 0; a < rank; ++a) {
      for (Index b = 0; b < rank; ++b) {
        const double amplitude = std::sqrt(svd.values[a] * svd.values[b]);
        Eigen::VectorXd column = Eigen::VectorXd::Zero(n);
        for (Index p = 0; p < points; ++p) {
          const auto s = static_cast<std::size_t>(members[static_cast<std::size_t>(p)]);
          for (Index u = series_begin[s]; u < series_begin[s + 1]; ++u) {
            column[u] = amplitude * svd.left(p, a) * svd.right(epoch[static_cast<std::size_t>(u)], b);
          }
        }
        out.push_back({column, gain_uncertainty, true});
      }
    }
  }
  return out;
}

}  // namespace spindrift
