// SPDX-License-Identifier: Apache-2.0
// How well effects predict states that were left out.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/discrepancy/effect_search.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// Variance of a prediction over that of the noise beyond which its error says nothing about the model.
constexpr double most_leverage = 10.0;

}  // namespace

EffectSearch::CrossValidation EffectSearch::crossValidate(const std::vector<ModelTerm>& before,
                                                          const std::vector<ModelTerm>& after,
                                                          const std::vector<NuisanceColumn>& base) const {
  CrossValidation out;
  const Index n = problem_->size();
  const int folds = std::min(5, problem_->epoch_count);
  double count = 0.0;
  const bool rotations = std::all_of(problem_->component.begin(), problem_->component.end(), isRotation);
  for (const bool with : {false, true}) {
    const auto& terms = with ? after : before;
    std::vector<Eigen::MatrixXd> parts;
    Index total = 0;
    for (const ModelTerm& term : terms) {
      parts.push_back(columns(term));
      total += parts.back().cols();
    }
    const auto priors = static_cast<Index>(base.size());
    Eigen::MatrixXd x(n, total + priors);
    Index at = 0;
    for (const Eigen::MatrixXd& part : parts) {
      x.middleCols(at, part.cols()) = part;
      at += part.cols();
    }
    for (const NuisanceColumn& column : base) x.col(at++) = column.values;
    double sum = 0.0;
    double chi2 = 0.0;
    count = 0.0;
    for (int fold = 0; fold < folds; ++fold) {
      const auto left_out = [&](Index u) {
        return problem_->epoch[static_cast<std::size_t>(u)] * folds / std::max(1, problem_->epoch_count) == fold;
      };
      // Constants come from what is left of the series.
      Eigen::MatrixXd a = x;
      Eigen::VectorXd r = problem_->y;
      Eigen::VectorXd weight(n);
      for (int s = 0; s < problem_->seriesCount(); ++s) {
        const Index from = problem_->series_begin[static_cast<std::size_t>(s)];
        const Index to = problem_->series_begin[static_cast<std::size_t>(s) + 1];
        double sum_w = 0.0;
        double mean_y = 0.0;
        Eigen::RowVectorXd mean_x = Eigen::RowVectorXd::Zero(x.cols());
        for (Index u = from; u < to; ++u) {
          if (left_out(u)) continue;
          const double w = (problem_->noise.weight.size() == 0 ? 1.0 : problem_->noise.weight[u]) /
                           std::pow(problem_->ownSigma(u), 2);
          sum_w += w;
          mean_y += w * r[u];
          mean_x += w * x.row(u);
        }
        for (Index u = from; u < to; ++u) {
          weight[u] = sum_w > 0.0 || !problem_->free_constants ? 1.0 / problem_->ownSigma(u) : 0.0;
          if (!(sum_w > 0.0) || !problem_->free_constants) continue;
          r[u] -= mean_y / sum_w;
          a.row(u) -= mean_x / sum_w;
        }
      }
      Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(x.cols(), x.cols());
      Eigen::VectorXd b = Eigen::VectorXd::Zero(x.cols());
      Eigen::MatrixXd train(n, x.cols());
      Eigen::VectorXd target(n);
      Index rows = 0;
      for (Index u = 0; u < n; ++u) {
        if (left_out(u)) continue;
        train.row(rows) = a.row(u) * weight[u];
        target[rows++] = r[u] * weight[u];
      }
      gram.noalias() = train.topRows(rows).transpose() * train.topRows(rows);
      b.noalias() = train.topRows(rows).transpose() * target.head(rows);
      for (Index c = 0; c < x.cols(); ++c) {
        if (c >= total) {
          const double prior = base[static_cast<std::size_t>(c - total)].prior_sigma;
          if (prior > 0.0) gram(c, c) += 1.0 / (prior * prior);
        }
        gram(c, c) = gram(c, c) * (1.0 + 1e-6) + 1e-12;
      }
      Eigen::VectorXd beta = Eigen::VectorXd::Zero(x.cols());
      const Eigen::LDLT<Eigen::MatrixXd> ldlt(gram);
      if (x.cols() > 0) beta = ldlt.solve(b);
      for (Index u = 0; u < n; ++u) {
        if (!left_out(u) || weight[u] == 0.0) continue;
        const double error = r[u] - a.row(u).dot(beta);
        // Minus twice the logarithm of the predictive density, the noise's own part left out: what the states that
        // remained do not determine is predicted with little confidence, not wrongly.
        const Eigen::VectorXd row = a.row(u).transpose() * weight[u];
        const double leverage = x.cols() > 0 ? std::max(0.0, row.dot(ldlt.solve(row))) : 0.0;
        chi2 += error * error * weight[u] * weight[u] / (1.0 + leverage) + std::log1p(leverage);
        if (leverage > most_leverage) continue;
        if (isRotation(problem_->component[static_cast<std::size_t>(u)]) == rotations) {
          sum += error * error;
          count += 1.0;
        }
      }
    }
    const double rms = count > 0.0 ? std::sqrt(sum / count) : 0.0;
    (with ? out.after_um : out.before_um) = rms;
    (with ? out.after_chi2 : out.before_chi2) = chi2;
  }
  return out;
}

}  // namespace spindrift
