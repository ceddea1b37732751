// SPDX-License-Identifier: Apache-2.0
// Joint fits of several effects: gains at fixed lags and onsets, and searches over these, each for itself and all
// together. Source: Kaufman 1975, A variable projection method for solving separable nonlinear least squares problems.
#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

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

namespace {

/// Terms whose non-linear parameters move, with the gains that are best for these. Bounds that hold are kept: a better
/// fit that breaks one is none.
class MovingTerms {
 public:
  MovingTerms(const EffectSearch& search, const ResidualProblem& problem, const std::vector<ModelTerm>& terms)
      : search_(&search), problem_(&problem), y_(&problem.projectedResidual()), terms_(terms) {
    for (const ModelTerm& term : terms_) x_.push_back(problem.projected(search.columns(term)));
    if (terms_.empty()) return;
    holdNone();
    const Solution start = solution(joined(x_, y_->size()));
    chi2_ = start.chi2;
    admissible_ = admissible(terms_, start.gains);
  }

  [[nodiscard]] const std::vector<ModelTerm>& terms() const noexcept { return terms_; }
  [[nodiscard]] double chi2() const noexcept { return chi2_; }

  /// Takes `trial` in the place of term t if that fits better.
  bool move(std::size_t t, const ModelTerm& trial) {
    if (held_but_ != t) holdAllBut(t);
    Eigen::MatrixXd columns = problem_->projected(search_->columns(trial));
    const Solution with = solution(columns);
    if (!(with.chi2 < chi2_ - least_gain)) return false;
    std::vector<ModelTerm> moved = terms_;
    moved[t] = trial;
    const bool allowed = admissible(moved, with.gains);
    if (admissible_ && !allowed) return false;
    terms_ = std::move(moved);
    x_[t] = std::move(columns);
    chi2_ = with.chi2;
    admissible_ = allowed;
    return true;
  }

  /// Line searches over every parameter for itself, the first of them `part` of the width of the grid.
  void searchEach(double onset_step_s, double part) {
    for (std::size_t t = 0; t < terms_.size(); ++t) {
      for (std::size_t p = 0; p < terms_[t].parameters.size(); ++p) {
        const bool lag = search_->parameterIsLag(terms_[t], p);
        const auto [low, high] = search_->parameterBounds(terms_[t], p);
        double step = part * (lag ? 0.35 : onset_step_s);
        for (int halving = 0; halving < 4; ++halving, step *= 0.4) {
          for (const double direction : {1.0, -1.0}) {
            for (int guard = 0; guard < 6; ++guard) {
              ModelTerm trial = terms_[t];
              double& value = trial.parameters[p];
              if (lag && value <= 0.0) {
                if (direction < 0.0) break;
                value = 60.0;
              } else {
                value = lag ? value * std::exp(direction * step) : value + direction * step;
              }
              if (value < low || value > high || !move(t, trial)) break;
            }
          }
        }
      }
    }
  }

  /// All of them together, by Gauss-Newton steps on what the gains do not follow (Kaufman 1975), damped
  /// (Levenberg-Marquardt): lags of two effects that bend each other lie in a narrow valley.
  void searchTogether(int steps) {
    struct Moved {
      std::size_t t, p;
      bool lag;
    };
    std::vector<Moved> parameters;
    for (std::size_t t = 0; t < terms_.size(); ++t) {
      if (terms_[t].variant.inputs[0].dynamics == Dynamics::Step) continue;
      for (std::size_t p = 0; p < terms_[t].parameters.size(); ++p) {
        const bool lag = search_->parameterIsLag(terms_[t], p);
        if (!lag || terms_[t].parameters[p] > 0.0) parameters.push_back({t, p, lag});
      }
    }
    if (parameters.size() < 2) return;
    const auto count = static_cast<Index>(parameters.size());
    double damping = 1e-3;
    for (int step = 0; step < steps; ++step) {
      const Eigen::MatrixXd x = joined(x_, y_->size());
      holdNone();
      const Solution now = solution(x);
      const auto gains = byTerm(now.gains);
      Eigen::MatrixXd raw(problem_->size(), count);
      for (Index k = 0; k < count; ++k) {
        const auto& [t, p, lag] = parameters[static_cast<std::size_t>(k)];
        raw.col(k) = search_->derivative(terms_[t], gains[t], p) * (lag ? terms_[t].parameters[p] : 1.0);
      }
      const Eigen::MatrixXd j = problem_->projected(raw);
      const Eigen::VectorXd left = *y_ - x * now.gains;
      const Eigen::MatrixXd xj = x.transpose() * j;
      const Eigen::MatrixXd normal = j.transpose() * j - xj.transpose() * now.normal.solve(xj);
      const Eigen::VectorXd slope = j.transpose() * left;  // what is left has nothing of x
      const Eigen::VectorXd size = normal.diagonal().cwiseMax(1e-12);
      const double before = chi2_;
      bool moved = false;
      for (int attempt = 0; attempt < 3 && !moved; ++attempt) {
        Eigen::MatrixXd damped = normal;
        damped.diagonal() += damping * size;
        const Eigen::VectorXd by = damped.ldlt().solve(slope);
        std::vector<ModelTerm> trial = terms_;
        for (Index k = 0; k < count; ++k) {
          const auto& [t, p, lag] = parameters[static_cast<std::size_t>(k)];
          const auto [low, high] = search_->parameterBounds(terms_[t], p);
          double& value = trial[t].parameters[p];
          value = lag ? value * std::exp(std::clamp(by[k], -1.0, 1.0)) : value + by[k];
          value = std::clamp(value, low, high);
        }
        moved = moveAll(trial);
        damping = std::clamp(moved ? 0.1 * damping : 30.0 * damping, 1e-6, 1e3);
      }
      if (!moved || before - chi2_ < 0.05) return;
    }
  }

 private:
  static constexpr double least_gain = 1e-6;
  struct Solution {
    double chi2 = 0.0;
    Eigen::VectorXd gains;  ///< of the terms in their order
    Eigen::LDLT<Eigen::MatrixXd> normal;
  };

  [[nodiscard]] static Eigen::MatrixXd joined(const std::vector<Eigen::MatrixXd>& parts, Index rows) {
    Index total = 0;
    for (const Eigen::MatrixXd& part : parts) total += part.cols();
    Eigen::MatrixXd out(rows, total);
    Index at = 0;
    for (const Eigen::MatrixXd& part : parts) {
      out.middleCols(at, part.cols()) = part;
      at += part.cols();
    }
    return out;
  }

  /// Products of all but term t, which do not change while it moves.
  void holdAllBut(std::size_t t) {
    held_but_ = t;
    std::vector<Eigen::MatrixXd> others = x_;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(t));
    before_ = 0;
    for (std::size_t k = 0; k < t; ++k) before_ += x_[k].cols();
    others_ = joined(others, y_->size());
    gram_of_others_ = others_.transpose() * others_;
    b_of_others_ = others_.transpose() * *y_;
  }
  void holdNone() {
    held_but_.reset();
    before_ = 0;
    others_.resize(y_->size(), 0);
    gram_of_others_.resize(0, 0);
    b_of_others_.resize(0);
  }

  /// With `moved` beside what is held.
  [[nodiscard]] Solution solution(const Eigen::MatrixXd& moved) const {
    const Index held = others_.cols();
    const Index total = held + moved.cols();
    Eigen::MatrixXd gram(total, total);
    Eigen::VectorXd b(total);
    gram.topLeftCorner(held, held) = gram_of_others_;
    gram.bottomLeftCorner(moved.cols(), held).noalias() = moved.transpose() * others_;
    gram.topRightCorner(held, moved.cols()) = gram.bottomLeftCorner(moved.cols(), held).transpose();
    gram.bottomRightCorner(moved.cols(), moved.cols()).noalias() = moved.transpose() * moved;
    b.head(held) = b_of_others_;
    b.tail(moved.cols()).noalias() = moved.transpose() * *y_;
    gram.diagonal() *= 1.0 + 1e-8;
    gram.diagonal().array() += 1e-12;
    Solution out;
    out.normal.compute(gram);
    const Eigen::VectorXd beta = out.normal.solve(b);
    out.chi2 = y_->squaredNorm() - b.dot(beta);
    out.gains.resize(total);
    out.gains << beta.head(before_), beta.tail(moved.cols()), beta.segment(before_, held - before_);
    return out;
  }

  /// The same of all terms at once; none is held.
  bool moveAll(const std::vector<ModelTerm>& trial) {
    std::vector<Eigen::MatrixXd> columns;
    for (const ModelTerm& term : trial) columns.push_back(problem_->projected(search_->columns(term)));
    const Solution with = solution(joined(columns, y_->size()));
    if (!(with.chi2 < chi2_ - least_gain)) return false;
    const bool allowed = admissible(trial, with.gains);
    if (admissible_ && !allowed) return false;
    terms_ = trial;
    x_ = std::move(columns);
    chi2_ = with.chi2;
    admissible_ = allowed;
    return true;
  }

  [[nodiscard]] std::vector<Eigen::VectorXd> byTerm(const Eigen::VectorXd& gains) const {
    std::vector<Eigen::VectorXd> out;
    Index at = 0;
    for (const Eigen::MatrixXd& x : x_) {
      out.emplace_back(gains.segment(at, x.cols()));
      at += x.cols();
    }
    return out;
  }

  [[nodiscard]] bool admissible(const std::vector<ModelTerm>& terms, const Eigen::VectorXd& gains) const {
    const std::vector<Eigen::VectorXd> of = byTerm(gains);
    for (std::size_t t = 0; t < terms.size(); ++t)
      if (!search_->admissible(terms[t], of[t])) return false;
    return true;
  }

  const EffectSearch* search_;
  const ResidualProblem* problem_;
  const Eigen::VectorXd* y_;
  std::vector<ModelTerm> terms_;
  std::vector<Eigen::MatrixXd> x_;  ///< columns of every term, projected
  double chi2_ = 0.0;
  bool admissible_ = false;
  std::optional<std::size_t> held_but_;
  Index before_ = 0;  ///< columns of terms before the one that moves
  Eigen::MatrixXd others_;
  Eigen::MatrixXd gram_of_others_;
  Eigen::VectorXd b_of_others_;
};

}  // namespace

JointFit EffectSearch::refine(const std::vector<ModelTerm>& terms, int rounds) const {
  MovingTerms moving(*this, *problem_, terms);
  constexpr int steps_at_first = 4;
  constexpr int steps_later = 8;
  const double onset_step_s = 0.5 * (onsets_.size() > 1 ? onsets_[1] - onsets_[0] : 600.0);
  for (int round = 0; round < rounds; ++round) {
    const double before = moving.chi2();
    moving.searchEach(onset_step_s, round == 0 ? 1.0 : 0.4);
    moving.searchTogether(round == 0 ? steps_at_first : steps_later);
    if (before - moving.chi2() < 0.05) break;
  }
  return solve(moving.terms());
}

}  // namespace spindrift
