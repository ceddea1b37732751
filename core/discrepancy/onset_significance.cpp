// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/discrepancy/discrepancy_search.h"

namespace spindrift {
namespace {

using Eigen::Index;

constexpr int replicates = 120;

/// Gains of one lag of an onset effect for every replicate: b are the products of its columns with the residuals.
void raiseMaxima(const Eigen::MatrixXd& gram, const Eigen::MatrixXd& b, Index k, bool pulse,
                 std::vector<double>& maxima) {
  const Index onsets = gram.cols() / k;
  if (!pulse) {
    for (Index o = 0; o < onsets; ++o) {
      Eigen::MatrixXd g = gram.block(o * k, o * k, k, k);
      const double size = g.trace();
      if (!(size > 0.0)) continue;
      g.diagonal().array() += 1e-9 * size;
      const Eigen::LLT<Eigen::MatrixXd> llt(g);
      const Eigen::MatrixXd z = llt.matrixL().solve(b.middleRows(o * k, k));
      for (Index r = 0; r < b.cols(); ++r) {
        double& largest = maxima[static_cast<std::size_t>(r)];
        largest = std::max(largest, z.col(r).squaredNorm());
      }
    }
    return;
  }
  for (Index i = 0; i < onsets; ++i) {
    for (Index j = i + 1; j <= onsets; ++j) {
      const double g = gram(i, i) + (j < onsets ? gram(j, j) - 2.0 * gram(i, j) : 0.0);
      if (!(g > 1e-5 * gram(i, i)) || !(g > 0.0)) continue;
      for (Index r = 0; r < b.cols(); ++r) {
        const double dot = b(i, r) - (j < onsets ? b(j, r) : 0.0);
        double& largest = maxima[static_cast<std::size_t>(r)];
        largest = std::max(largest, dot * dot / g);
      }
    }
  }
}

}  // namespace

double onsetPValue(const EffectSearch& search, const ResidualProblem& problem, const CandidateFit& candidate) {
  const EffectVariant& variant = candidate.term.variant;
  const bool pulse = variant.inputs[0].dynamics == Dynamics::Pulse;
  const Index k = search.shape(*candidate.term.effect).cols();
  // White noise in the whitened problem, no smaller than what the candidate leaves.
  Eigen::VectorXd left = problem.projectedResidual();
  {
    const Eigen::MatrixXd x = problem.projected(search.columns(candidate.term));
    Eigen::MatrixXd gram = x.transpose() * x;
    gram.diagonal().array() += 1e-9 * std::max(1e-12, gram.trace());
    left -= x * gram.ldlt().solve(x.transpose() * left);
  }
  const double degrees = std::max(1.0, static_cast<double>(problem.degreesOfFreedom() - candidate.parameter_count));
  const double size = std::max(1.0, std::sqrt(left.squaredNorm() / degrees));
  Random random(20260131);
  Eigen::MatrixXd drawn(left.size(), replicates);
  for (double& value : drawn.reshaped()) value = size * random.normal();
  std::vector<double> maxima(replicates, 0.0);
  for (const double tau : pulse ? std::vector<double>{0.0, 600.0, 1800.0, 5400.0} : std::vector<double>{0.0}) {
    Eigen::MatrixXd raw(problem.size(), k * static_cast<Index>(search.onsets().size()));
    ModelTerm term = candidate.term;
    for (std::size_t o = 0; o < search.onsets().size(); ++o) {
      term.parameters = {search.onsets()[o]};
      if (pulse) term.parameters = {search.onsets()[o], 1e9, tau};
      raw.middleCols(static_cast<Index>(o) * k, k) = search.columns(term);
    }
    const Eigen::MatrixXd x = problem.projected(raw);
    raiseMaxima(x.transpose() * x, x.transpose() * drawn, k, pulse, maxima);
  }
  // Gumbel by moments.
  double mean = 0.0;
  double square = 0.0;
  for (const double m : maxima) mean += m / replicates;
  for (const double m : maxima) square += (m - mean) * (m - mean) / (replicates - 1);
  const double scale = std::max(1e-9, std::sqrt(6.0 * square) / std::numbers::pi);
  const double location = mean - std::numbers::egamma * scale;
  return -std::expm1(-std::exp(-(candidate.delta_chi2 - location) / scale));
}

}  // namespace spindrift
