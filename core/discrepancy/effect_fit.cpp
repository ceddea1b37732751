// SPDX-License-Identifier: Apache-2.0
// Joint fits of several effects: gains at fixed lags and onsets, and line searches over these.
#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/discrepancy/effect_search.h"
#include "core/math/basic_solution.h"

namespace spindrift {

using Eigen::Index;

JointFit EffectSearch::solve(const std::vector<ModelTerm>& terms) const {
  JointFit fit;
  fit.terms = terms;
  const Eigen::VectorXd& y = problem_->projectedResidual();
  std::vector<Eigen::MatrixXd> parts;
  Index total = 0;
  for (const ModelTerm& term : terms) {
    parts.push_back(columns(term));
    total += parts.back().cols();
  }
  Eigen::MatrixXd raw(problem_->size(), total);
  Index at = 0;
  for (const Eigen::MatrixXd& part : parts) {
    raw.middleCols(at, part.cols()) = part;
    at += part.cols();
  }
  const double before = y.squaredNorm();
  Eigen::VectorXd beta = Eigen::VectorXd::Zero(total);
  int rank = 0;
  if (total > 0) {
    Eigen::MatrixXd x = problem_->projected(raw);
    const Eigen::VectorXd whole = problem_->whitened(raw).colwise().norm();
    Eigen::VectorXd scale(total);
    for (Index c = 0; c < total; ++c) {
      const double norm = x.col(c).norm();
      scale[c] = norm > 3e-3 * whole[c] && norm > 0.0 ? 1.0 / norm : 0.0;
    }
    x = x * scale.asDiagonal();
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(x);
    qr.setThreshold(dependent);
    const Eigen::VectorXd scaled = basicSolution(qr, y);
    beta = scale.cwiseProduct(scaled);
    rank = static_cast<int>(qr.rank());
    fit.chi2 = (y - x * scaled).squaredNorm();
  } else {
    fit.chi2 = before;
  }
  fit.delta_chi2 = before - fit.chi2;
  fit.parameter_count = rank;
  at = 0;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    fit.gains.emplace_back(beta.segment(at, parts[t].cols()));
    fit.contribution.emplace_back(parts[t] * fit.gains.back());
    fit.parameter_count += parameterCount(terms[t].variant);
    at += parts[t].cols();
  }
  fit.score = fit.delta_chi2 - fit.parameter_count * log_n_;
  return fit;
}

bool EffectSearch::parameterIsLag(const ModelTerm& term, std::size_t index) const {
  return parameterNames(term.variant)[index].starts_with("tau");
}

std::pair<double, double> EffectSearch::parameterBounds(const ModelTerm& term, std::size_t index) const {
  const std::string name = parameterNames(term.variant)[index];
  const double start = problem_->node_time_s.front();
  const double end = problem_->node_time_s.back();
  if (name.starts_with("onset")) {
    // A step that only the first or the last reading shows is an outlier.
    const auto& t = problem_->node_time_s;
    const bool step = term.variant.inputs[0].dynamics == Dynamics::Step && t.size() >= 6;
    return step ? std::pair(0.5 * (t[1] + t[2]), 0.5 * (t[t.size() - 3] + t[t.size() - 2])) : std::pair(start, end);
  }
  if (name.starts_with("length")) return {1.0, 11.0 * (end - start + 1.0)};
  if (term.effect->tau_s) return {(*term.effect->tau_s)[0], (*term.effect->tau_s)[1]};
  // A lag much longer than the campaign is an integrator: it fits a drift and predicts nonsense.
  return {std::max(60.0, term.effect->least_lag_s), std::clamp(0.45 * (end - start), 3600.0, 36000.0)};
}

JointFit EffectSearch::refine(const std::vector<ModelTerm>& terms, int rounds) const {
  // Projected columns of each term are kept; only those of the term that moves are made anew.
  const Eigen::VectorXd& y = problem_->projectedResidual();
  std::vector<ModelTerm> current = terms;
  std::vector<Eigen::MatrixXd> x;
  for (const ModelTerm& term : current) x.push_back(problem_->projected(columns(term)));
  // What all others are in the products does not change while one of them moves.
  Eigen::MatrixXd others;
  Eigen::MatrixXd gram_of_others;
  Eigen::VectorXd b_of_others;
  const auto holdAllBut = [&](std::size_t moving) {
    Index total = 0;
    for (std::size_t t = 0; t < x.size(); ++t) total += t == moving ? 0 : x[t].cols();
    others.resize(y.size(), total);
    Index at = 0;
    for (std::size_t t = 0; t < x.size(); ++t) {
      if (t == moving) continue;
      others.middleCols(at, x[t].cols()) = x[t];
      at += x[t].cols();
    }
    gram_of_others = others.transpose() * others;
    b_of_others = others.transpose() * y;
  };
  const auto chi2With = [&](const Eigen::MatrixXd& moved) {
    const Index held = others.cols();
    const Index total = held + moved.cols();
    Eigen::MatrixXd gram(total, total);
    Eigen::VectorXd b(total);
    gram.topLeftCorner(held, held) = gram_of_others;
    gram.bottomLeftCorner(moved.cols(), held).noalias() = moved.transpose() * others;
    gram.topRightCorner(held, moved.cols()) = gram.bottomLeftCorner(moved.cols(), held).transpose();
    gram.bottomRightCorner(moved.cols(), moved.cols()).noalias() = moved.transpose() * moved;
    b.head(held) = b_of_others;
    b.tail(moved.cols()).noalias() = moved.transpose() * y;
    gram.diagonal() *= 1.0 + 1e-8;
    gram.diagonal().array() += 1e-12;
    const Eigen::LDLT<Eigen::MatrixXd> ldlt(gram);
    return y.squaredNorm() - b.dot(ldlt.solve(b));
  };
  double best = 0.0;
  if (!x.empty()) {
    holdAllBut(0);
    best = chi2With(x[0]);
  }
  for (int round = 0; round < rounds; ++round) {
    const double before = best;
    for (std::size_t t = 0; t < current.size(); ++t) {
      holdAllBut(t);
      for (std::size_t p = 0; p < current[t].parameters.size(); ++p) {
        const bool lag = parameterIsLag(current[t], p);
        const auto [low, high] = parameterBounds(current[t], p);
        double step = lag ? 0.35 : 0.5 * (onsets_.size() > 1 ? onsets_[1] - onsets_[0] : 600.0);
        if (round > 0) step *= 0.4;
        for (int halving = 0; halving < 4; ++halving, step *= 0.4) {
          for (const double direction : {1.0, -1.0}) {
            bool moved = true;
            for (int guard = 0; moved && guard < 6; ++guard) {
              moved = false;
              ModelTerm trial = current[t];
              double& value = trial.parameters[p];
              if (lag && value <= 0.0) {
                if (direction < 0.0) break;
                value = 60.0;
              } else {
                value = lag ? value * std::exp(direction * step) : value + direction * step;
              }
              if (value < low || value > high) break;
              const Eigen::MatrixXd replacement = problem_->projected(columns(trial));
              const double chi2 = chi2With(replacement);
              if (chi2 < best - 1e-6) {
                best = chi2;
                current[t] = std::move(trial);
                x[t] = replacement;
                moved = true;
              }
            }
          }
        }
      }
    }
    if (before - best < 0.05) break;
  }
  return solve(current);
}

}  // namespace spindrift
