// SPDX-License-Identifier: Apache-2.0
// Noise from a residual that still holds signal. Effects of a machine are sums of few patterns over the points times
// few courses in time, so per component the table (points x epochs) is freed of its largest singular components; what
// is left is noise, and its variance and correlations from epoch to epoch are compared with those of simulated noise
// that went through the same (indirect inference: Gourieroux, Monfort, Renault 1993), which takes account of what the
// singular components and the means took away.
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/base/random.h"
#include "core/discrepancy/residual_problem.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// What is left of a table: sum of squares and correlations from one epoch to the next and the one after.
struct TableMoments {
  double power = 0.0;
  double r1 = 0.0;
  double r2 = 0.0;
};

using Mask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

void removeRowMeans(Eigen::MatrixXd& table, const Mask& known) {
  for (Index p = 0; p < table.rows(); ++p) {
    double sum = 0.0;
    double count = 0.0;
    for (Index e = 0; e < table.cols(); ++e) {
      if (!known(p, e)) continue;
      sum += table(p, e);
      count += 1.0;
    }
    if (count > 0.0) table.row(p).array() -= sum / count;
  }
}

/// Removes the mean of every row and `rank` singular components; cells that are not known take what these predict.
TableMoments freedMoments(Eigen::MatrixXd table, const Mask& known, int rank) {
  const bool complete = known.all();
  removeRowMeans(table, known);
  Eigen::MatrixXd left = table;
  if (rank > 0) {
    Eigen::MatrixXd filled = known.select(table.array(), 0.0).matrix();
    for (int pass = 0; pass < (complete ? 1 : 5); ++pass) {
      const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::HouseholderQRPreconditioner> svd(
          filled.transpose(), Eigen::ComputeThinU | Eigen::ComputeThinV);
      const Eigen::MatrixXd low = svd.matrixV().leftCols(rank) * svd.singularValues().head(rank).asDiagonal() *
                                  svd.matrixU().leftCols(rank).transpose();
      left = table - low;
      if (!complete) filled = known.select(table.array(), low.array()).matrix();
    }
  }
  TableMoments m;
  double c1 = 0.0;
  double c2 = 0.0;
  double pairs1 = 0.0;
  double pairs2 = 0.0;
  for (Index p = 0; p < left.rows(); ++p) {
    for (Index e = 0; e < left.cols(); ++e) {
      if (!known(p, e)) continue;
      m.power += left(p, e) * left(p, e);
      if (e + 1 < left.cols() && known(p, e + 1)) {
        c1 += left(p, e) * left(p, e + 1);
        pairs1 += 1.0;
      }
      if (e + 2 < left.cols() && known(p, e + 2)) {
        c2 += left(p, e) * left(p, e + 2);
        pairs2 += 1.0;
      }
    }
  }
  // By the pairs that are there: cells that are missing make no correlation smaller.
  const double variance = m.power / std::max(1.0, static_cast<double>(known.count()));
  if (variance > 0.0 && pairs1 > 0.0 && pairs2 > 0.0) {
    m.r1 = c1 / pairs1 / variance;
    m.r2 = c2 / pairs2 / variance;
  }
  return m;
}

struct NoiseKind {
  double part = 0.0;  // of the variance that is correlated
  double phi = 0.0;   // from one epoch to the next
};

struct SimulatedKind {
  NoiseKind kind;
  TableMoments mean;
  TableMoments spread;
};

/// Moments of simulated noise of unit variance for every kind of noise on a small grid.
std::vector<SimulatedKind> simulatedKinds(const Mask& known, int rank) {
  std::vector<NoiseKind> kinds{{0.0, 0.0}};
  for (const double part : {0.5, 1.0}) {
    for (const double phi : {0.2, 0.4, 0.6, 0.75, 0.85, 0.9, 0.95}) kinds.push_back({part, phi});
  }
  const int repeats = known.all() ? 16 : 8;
  std::vector<SimulatedKind> out;
  for (const NoiseKind& kind : kinds) {
    Random random(4711);
    std::array<std::vector<double>, 3> values;
    for (int repeat = 0; repeat < repeats; ++repeat) {
      Eigen::MatrixXd table(known.rows(), known.cols());
      for (Index p = 0; p < table.rows(); ++p) {
        double slow = random.normal(0.0, 1.0);
        for (Index e = 0; e < table.cols(); ++e) {
          if (e > 0) slow = kind.phi * slow + std::sqrt(1.0 - kind.phi * kind.phi) * random.normal(0.0, 1.0);
          table(p, e) = std::sqrt(kind.part) * slow + std::sqrt(1.0 - kind.part) * random.normal(0.0, 1.0);
        }
      }
      const TableMoments m = freedMoments(std::move(table), known, rank);
      values[0].push_back(m.power);
      values[1].push_back(m.r1);
      values[2].push_back(m.r2);
    }
    SimulatedKind simulated;
    simulated.kind = kind;
    const auto moments = [](const std::vector<double>& v) {
      double mean = 0.0;
      double square = 0.0;
      for (const double x : v) mean += x / static_cast<double>(v.size());
      for (const double x : v) square += (x - mean) * (x - mean) / static_cast<double>(v.size() - 1);
      return std::pair{mean, std::sqrt(square)};
    };
    std::tie(simulated.mean.power, simulated.spread.power) = moments(values[0]);
    std::tie(simulated.mean.r1, simulated.spread.r1) = moments(values[1]);
    std::tie(simulated.mean.r2, simulated.spread.r2) = moments(values[2]);
    out.push_back(simulated);
  }
  return out;
}

struct ComponentTable {
  Eigen::MatrixXd values;
  Mask known;
};

/// Residual over sigma by point and epoch; series of fewer than four units are left out.
ComponentTable componentTable(const ResidualProblem& problem, const Eigen::VectorXd& residual, Component c) {
  std::vector<std::size_t> members;
  for (std::size_t s = 0; s + 1 < problem.series_begin.size(); ++s) {
    if (problem.component[static_cast<std::size_t>(problem.series_begin[s])] == c &&
        problem.series_begin[s + 1] - problem.series_begin[s] >= 4) {
      members.push_back(s);
    }
  }
  // Two dozen points say enough.
  constexpr std::size_t most_points = 24;
  if (members.size() > most_points) {
    std::vector<std::size_t> thinned;
    for (std::size_t i = 0; i < most_points; ++i) thinned.push_back(members[i * members.size() / most_points]);
    members = std::move(thinned);
  }
  ComponentTable out;
  const auto points = static_cast<Index>(members.size());
  out.values = Eigen::MatrixXd::Zero(points, problem.epoch_count);
  Eigen::MatrixXd weight = out.values;
  for (Index p = 0; p < points; ++p) {
    const std::size_t s = members[static_cast<std::size_t>(p)];
    for (Index u = problem.series_begin[s]; u < problem.series_begin[s + 1]; ++u) {
      const Index e = problem.epoch[static_cast<std::size_t>(u)];
      out.values(p, e) += residual[u] / problem.sigma[u];
      weight(p, e) += 1.0;
    }
  }
  out.known = weight.array() > 0.0;
  out.values = (out.values.array() / weight.array().max(1.0).sqrt()).matrix();
  return out;
}

}  // namespace

NoiseModel estimateNoise(const ResidualProblem& problem, const Eigen::VectorXd& residual, bool fitted) {
  struct Estimate {
    TableMoments moments;
    double scale2 = 1.0;  // as if it were white
    int rank = 0;
    const std::vector<SimulatedKind>* kinds = nullptr;
  };
  // Tables of one size that lack about as many cells are simulated once.
  std::map<std::tuple<Index, Index, int, Index>, std::vector<SimulatedKind>> simulated;
  std::vector<Estimate> estimates;
  for (const Component c : all_components) {
    const ComponentTable table = componentTable(problem, residual, c);
    const Index points = table.values.rows();
    const Index smaller = std::min(points, table.values.cols());
    const int rank = smaller >= 9 ? (fitted ? 2 : 3) : smaller >= 6 ? (fitted ? 1 : 2) : smaller >= 3 ? 1 : 0;
    if ((rank == 0 && !fitted) || table.known.count() < 24 || table.values.cols() < 6) continue;
    Estimate e;
    e.rank = rank;
    e.moments = freedMoments(table.values, table.known, rank);
    const Index lacking = (20 * (table.known.size() - table.known.count())) / table.known.size();
    auto& kinds = simulated[{points, table.values.cols(), rank, table.known.all() ? -1 : lacking}];
    if (kinds.empty()) kinds = simulatedKinds(table.known, rank);
    e.kinds = &kinds;
    e.scale2 = e.moments.power / std::max(1e-9, kinds.front().mean.power);
    estimates.push_back(e);
  }
  NoiseModel best;
  if (estimates.empty()) return best;
  // What is not of low rank (backlash, whose sign changes from reading to reading) stays in; noise is in all components
  // alike, so those that scatter least speak for it.
  double least = 1e300;
  for (const Estimate& e : estimates) least = std::min(least, e.scale2);
  std::erase_if(estimates, [&](const Estimate& e) {
    const double by_chance = 4.0 * e.kinds->front().spread.power / e.kinds->front().mean.power;
    return e.scale2 > least * (1.0 + std::max(0.4, by_chance));
  });
  const auto scaleAs = [&](std::size_t k) {
    double scale2 = 0.0;
    for (const Estimate& e : estimates) {
      scale2 += e.moments.power / (*e.kinds)[k].mean.power / static_cast<double>(estimates.size());
    }
    return scale2;
  };
  const std::size_t kind_count = estimates.front().kinds->size();
  std::size_t chosen = 0;
  double chosen_distance = 1e300;
  double white_distance = 0.0;
  for (std::size_t k = 0; k < kind_count; ++k) {
    double distance = 0.0;
    for (const Estimate& e : estimates) {
      const SimulatedKind& s = (*e.kinds)[k];
      const double d1 = (e.moments.r1 - s.mean.r1) / std::max(1e-3, s.spread.r1);
      const double d2 = (e.moments.r2 - s.mean.r2) / std::max(1e-3, s.spread.r2);
      distance += d1 * d1 + d2 * d2;
    }
    // What is left of a slow noise looks much like a smaller, quicker one; the stated sigma tells them apart.
    const double log_scale = 0.5 * std::log(std::max(1e-6, scaleAs(k))) / 0.15;
    distance += log_scale * log_scale;
    if (k == 0) white_distance = distance;
    if (distance < chosen_distance) {
      chosen_distance = distance;
      chosen = k;
    }
  }
  // White noise unless the correlations say clearly that it is not.
  const double moments_used = 2.0 * static_cast<double>(estimates.size());
  if (white_distance < moments_used + 3.0 * std::sqrt(2.0 * moments_used)) chosen = 0;
  const double scale2 = scaleAs(chosen);
  const NoiseKind kind = (*estimates.front().kinds)[chosen].kind;
  if (kind.part > 0.0) {
    std::vector<double> steps;
    for (std::size_t e = 1; e < problem.epoch_time_s.size(); ++e) {
      steps.push_back(problem.epoch_time_s[e] - problem.epoch_time_s[e - 1]);
    }
    best.correlated_part = std::min(kind.part, 0.98);
    best.correlation_time_s = -std::max(1e-3, median(steps)) / std::log(kind.phi);
  }
  const double scale = std::sqrt(scale2);
  best.scale = scale > 0.75 && scale < 1.25 ? 1.0 : std::clamp(scale, 0.2, 20.0);
  return best;
}

}  // namespace spindrift
