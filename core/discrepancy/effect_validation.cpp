// SPDX-License-Identifier: Apache-2.0
// What a fitted effect may be wrong by, and how well effects predict states that were left out.
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

std::vector<NuisanceColumn> EffectSearch::termNuisances(const ModelTerm& term, const Eigen::VectorXd& gains,
                                                        double model_error) const {
  std::vector<NuisanceColumn> out;
  const Eigen::MatrixXd x = columns(term);
  for (Index c = 0; c < x.cols(); ++c) out.push_back({x.col(c), 0.0});
  const Eigen::VectorXd fitted = x * gains;
  for (std::size_t p = 0; p < term.parameters.size(); ++p) {
    ModelTerm moved = term;
    const bool lag = parameterIsLag(term, p);
    if (lag && moved.parameters[p] <= 0.0) {
      moved.parameters[p] = 120.0;
    } else {
      moved.parameters[p] = lag ? moved.parameters[p] * 1.15 : moved.parameters[p] + 60.0;
    }
    const Eigen::VectorXd difference = columns(moved) * gains - fitted;
    if (difference.norm() > 1e-9 * fitted.norm()) out.push_back({difference, 0.0});
  }
  const bool timeless = term.variant.inputs[0].driver.empty() && term.variant.inputs[0].dynamics != Dynamics::Pulse;
  if (!(model_error > 0.0) || timeless) return out;

  // Pattern in space of the input that moves most, per unit of q.
  const Index k = shape(*term.effect).cols();
  Index input = 0;
  double largest = -1.0;
  for (Index i = 0; i < static_cast<Index>(term.variant.inputs.size()); ++i) {
    const double size = (x.middleCols(i * k, k) * gains.segment(i * k, k)).norm();
    if (size > largest) {
      largest = size;
      input = i;
    }
  }
  const Eigen::VectorXd pattern = shape(*term.effect) * gains.segment(input * k, k);
  const double pattern_size = pattern.norm();
  if (!(pattern_size > 0.0)) return out;
  // Size of q: rms about the mean of the series.
  Eigen::VectorXd centred = fitted;
  for (int s = 0; s < problem_->seriesCount(); ++s) {
    const Index from = problem_->series_begin[static_cast<std::size_t>(s)];
    const Index count = problem_->series_begin[static_cast<std::size_t>(s) + 1] - from;
    centred.segment(from, count).array() -= fitted.segment(from, count).mean();
  }
  const double q_size = centred.norm() / pattern_size;
  const double start = problem_->node_time_s.front();
  const double span = std::max(1.0, problem_->node_time_s.back() - start);
  const int hats = std::clamp(problem_->epoch_count / 2, 3, 16);
  for (int h = 0; h < hats; ++h) {
    Eigen::VectorXd column(problem_->size());
    for (Index u = 0; u < column.size(); ++u) {
      const double position = (problem_->time_s[static_cast<std::size_t>(u)] - start) / span * (hats - 1);
      column[u] = pattern[u] * q_size * std::max(0.0, 1.0 - std::abs(position - h));
    }
    out.push_back({column, model_error});
  }
  // The same course in time with another spread over the volume.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d half = Eigen::Vector3d::Constant(1.0);
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d high = -low;
  for (const DeviationQuery& q : problem_->place) {
    low = low.cwiseMin(q.position_mm);
    high = high.cwiseMax(q.position_mm);
  }
  centre = 0.5 * (low + high);
  half = (0.5 * (high - low)).cwiseMax(1.0);
  for (const Component c : all_components) {
    double power = 0.0;
    double q_power = 0.0;
    Index rows = 0;
    for (Index u = 0; u < problem_->size(); ++u) {
      if (problem_->component[static_cast<std::size_t>(u)] != c) continue;
      power += centred[u] * centred[u];
      q_power += pattern[u] * pattern[u];
      ++rows;
    }
    if (!(power > 0.0)) continue;
    const double pattern_rms = std::sqrt(q_power / static_cast<double>(rows));
    for (int kind = 0; kind < 4; ++kind) {
      Eigen::VectorXd column = Eigen::VectorXd::Zero(problem_->size());
      for (Index u = 0; u < problem_->size(); ++u) {
        if (problem_->component[static_cast<std::size_t>(u)] != c) continue;
        const double q = std::abs(pattern[u]) > 1e-9 * pattern_rms ? fitted[u] / pattern[u] : 0.0;
        const double weight =
            kind == 3 ? 1.0
                      : (problem_->place[static_cast<std::size_t>(u)].position_mm[kind] - centre[kind]) / half[kind];
        column[u] = q * pattern_rms * weight;
      }
      out.push_back({column, model_error});
    }
  }
  return out;
}

EffectSearch::CrossValidation EffectSearch::crossValidate(const std::vector<ModelTerm>& before,
                                                          const std::vector<ModelTerm>& after,
                                                          const std::vector<NuisanceColumn>& base,
                                                          bool interleaved) const {
  CrossValidation out;
  const Index n = problem_->size();
  const int folds = std::min(5, problem_->epoch_count);
  double count = 0.0;
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
        if (interleaved) return problem_->epoch[static_cast<std::size_t>(u)] % folds == fold;
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
          const double w = 1.0 / (problem_->sigma[u] * problem_->sigma[u]);
          sum_w += w;
          mean_y += w * r[u];
          mean_x += w * x.row(u);
        }
        for (Index u = from; u < to; ++u) {
          weight[u] = sum_w > 0.0 ? 1.0 / (problem_->sigma[u] * problem_->noise.scale) : 0.0;
          if (!(sum_w > 0.0)) continue;
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
        if (!isRotation(problem_->component[static_cast<std::size_t>(u)])) {
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
