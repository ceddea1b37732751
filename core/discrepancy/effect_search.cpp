// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/effect_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace spindrift {
namespace {

using Eigen::Index;

/// Gain in chi-squared of the columns `index` from their Gram matrix and products with the residual, by Cholesky;
/// columns that depend on those before them are left out. `first_gains` gets the gains.
struct GramGain {
  double delta = 0.0;
  int rank = 0;
  std::array<double, 8> gain{};
};

GramGain gramGain(const Eigen::MatrixXd& gram, const Eigen::VectorXd& b, const Index* index, int count,
                  const Eigen::VectorXd& whole) {
  GramGain out;
  std::array<std::array<double, 8>, 8> l{};
  std::array<double, 8> z{};
  std::array<int, 8> kept{};
  for (int i = 0; i < count; ++i) {
    const Index a = index[i];
    std::array<double, 8> row{};
    double pivot = gram(a, a);
    for (int j = 0; j < out.rank; ++j) {
      double value = gram(a, index[kept[static_cast<std::size_t>(j)]]);
      for (int k = 0; k < j; ++k)
        value -= row[static_cast<std::size_t>(k)] * l[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)];
      value /= l[static_cast<std::size_t>(j)][static_cast<std::size_t>(j)];
      row[static_cast<std::size_t>(j)] = value;
      pivot -= value * value;
    }
    // Directions that the nuisances or the other columns have already, up to a part in a thousand of the power.
    if (!(pivot > 1e-5 * whole[a]) || !(pivot > 1e-18)) continue;
    const auto r = static_cast<std::size_t>(out.rank);
    l[r] = row;
    l[r][r] = std::sqrt(pivot);
    double value = b[a];
    for (std::size_t k = 0; k < r; ++k) value -= l[r][k] * z[k];
    z[r] = value / l[r][r];
    out.delta += z[r] * z[r];
    kept[r] = i;
    ++out.rank;
  }
  for (int r = out.rank - 1; r >= 0; --r) {
    double value = z[static_cast<std::size_t>(r)];
    for (int k = r + 1; k < out.rank; ++k) {
      value -= l[static_cast<std::size_t>(k)][static_cast<std::size_t>(r)] *
               out.gain[static_cast<std::size_t>(kept[static_cast<std::size_t>(k)])];
    }
    out.gain[static_cast<std::size_t>(kept[static_cast<std::size_t>(r)])] =
        value / l[static_cast<std::size_t>(r)][static_cast<std::size_t>(r)];
  }
  return out;
}

}  // namespace

EffectSearch::EffectSearch(ResidualProblem& problem, const DriverTable& drivers, const std::vector<Effect>& catalogue)
    : problem_(&problem), drivers_(&drivers), catalogue_(&catalogue) {
  log_n_ = std::log(std::max(8.0, static_cast<double>(problem.size())));
  for (int i = 0; i < 12; ++i) lags_.push_back(120.0 * std::pow(180.0, i / 11.0));  // 2 min ... 6 h
  // Onsets halfway between epochs, thinned to 48.
  std::vector<double> times = problem.epoch_time_s;
  std::sort(times.begin(), times.end());
  const std::size_t step = std::max<std::size_t>(1, times.size() / 48);
  for (std::size_t i = 0; i + 1 < times.size(); i += step) onsets_.push_back(0.5 * (times[i] + times[i + 1]));
}

const Effect* EffectSearch::find(std::string_view id) const {
  const auto found = std::find_if(catalogue_->begin(), catalogue_->end(), [&](const Effect& e) { return e.id == id; });
  return found == catalogue_->end() ? nullptr : &*found;
}

const Eigen::VectorXd& EffectSearch::unitResponse(const std::string& driver, double tau_on, double tau_off) const {
  const auto key = std::make_tuple(driver, tau_on, tau_off);
  const auto found = responses_.find(key);
  if (found != responses_.end()) return found->second;
  const Driver* source = drivers_->find(driver);
  SPINDRIFT_ASSERT(source != nullptr, "an effect with a driver that the table does not have");
  return responses_.emplace(key, problem_->toUnits(drivers_->response(*source, tau_on, tau_off, problem_->node_time_s)))
      .first->second;
}

const Eigen::MatrixXd& EffectSearch::shape(const Effect& effect) const {
  const auto found = shapes_.find(effect.id);
  if (found != shapes_.end()) return found->second;
  const Index n = problem_->size();
  Eigen::MatrixXd s(n, static_cast<Index>(effect.shape.size()));
  for (Index u = 0; u < n; ++u) {
    for (std::size_t k = 0; k < effect.shape.size(); ++k) {
      s(u, static_cast<Index>(k)) = effect.shape[k].value(problem_->place[static_cast<std::size_t>(u)],
                                                          problem_->component[static_cast<std::size_t>(u)]);
    }
  }
  // A periodic error at points a whole number of pitches apart is nothing but rounding.
  for (Index k = 0; k < s.cols(); ++k) {
    if (s.col(k).cwiseAbs().maxCoeff() < 1e-9) s.col(k).setZero();
  }
  return shapes_.emplace(effect.id, std::move(s)).first->second;
}

const std::vector<int>& EffectSearch::activeSeries(const Effect& effect) const {
  const auto found = active_.find(effect.id);
  if (found != active_.end()) return found->second;
  const Eigen::MatrixXd& s = shape(effect);
  std::vector<int> active;
  for (int i = 0; i < problem_->seriesCount(); ++i) {
    const Index from = problem_->series_begin[static_cast<std::size_t>(i)];
    const Index count = problem_->series_begin[static_cast<std::size_t>(i) + 1] - from;
    if (!s.middleRows(from, count).isZero(0.0)) active.push_back(i);
  }
  return active_.emplace(effect.id, std::move(active)).first->second;
}

Eigen::MatrixXd EffectSearch::columns(const ModelTerm& term) const {
  const Eigen::MatrixXd& s = shape(*term.effect);
  const auto k = s.cols();
  Eigen::MatrixXd out(s.rows(), k * static_cast<Index>(term.variant.inputs.size()));
  const Eigen::MatrixXd q = inputResponses(*drivers_, term.variant, term.parameters, problem_->node_time_s);
  for (Index i = 0; i < q.cols(); ++i) {
    const Eigen::VectorXd on_units = problem_->toUnits(q.col(i));
    out.middleCols(i * k, k) = on_units.asDiagonal() * s;
  }
  return out;
}

CandidateFit EffectSearch::bestOfVariant(const Effect& effect, const EffectVariant& variant) const {
  CandidateFit best;
  best.term = {&effect, variant, {}};
  const Eigen::MatrixXd& s = shape(effect);
  const Index k = s.cols();
  const int nonlinear = parameterCount(variant);

  // The options of every input: (parameters, column of q).
  std::vector<std::vector<std::vector<double>>> options(variant.inputs.size());
  std::vector<Eigen::VectorXd> responses;
  const Dynamics dynamics = variant.inputs[0].dynamics;
  std::vector<double> pulse_lags{0.0, 600.0, 1800.0, 5400.0};
  for (std::size_t i = 0; i < variant.inputs.size(); ++i) {
    const EffectInput& input = variant.inputs[i];
    const auto add = [&](std::vector<double> parameters, Eigen::VectorXd q) {
      options[i].push_back(std::move(parameters));
      responses.push_back(std::move(q));
    };
    switch (input.dynamics) {
      case Dynamics::None:
        add({}, input.driver.empty() ? Eigen::VectorXd(Eigen::VectorXd::Ones(problem_->size()))
                                     : unitResponse(input.driver, 0.0, -1.0));
        break;
      case Dynamics::Lag: {
        // Temperatures may also act at once.
        if (drivers_->find(input.driver)->linear && !variant.shared_lag)
          add({0.0}, unitResponse(input.driver, 0.0, -1.0));
        for (const double tau : lags_) add({tau}, unitResponse(input.driver, tau, -1.0));
        break;
      }
      case Dynamics::AsymmetricLag:
        for (std::size_t a = 0; a < lags_.size(); a += 2) {
          for (std::size_t b = 0; b < lags_.size(); b += 2) {
            if (a != b) add({lags_[a], lags_[b]}, unitResponse(input.driver, lags_[a], lags_[b]));
          }
        }
        break;
      case Dynamics::Step:
      case Dynamics::Pulse:
        for (const double tau : input.dynamics == Dynamics::Step ? std::vector<double>{0.0} : pulse_lags) {
          for (const double onset : onsets_) {
            Eigen::VectorXd q(static_cast<Index>(problem_->node_time_s.size()));
            for (Index r = 0; r < q.size(); ++r) {
              const double t = problem_->node_time_s[static_cast<std::size_t>(r)] - onset;
              q[r] = t <= 0.0 ? 0.0 : tau > 0.0 ? 1.0 - std::exp(-t / tau) : 1.0;
            }
            add({onset, 0.0, tau}, problem_->toUnits(q));
          }
        }
        break;
    }
  }
  const auto count = static_cast<Index>(responses.size());
  if (count == 0) return best;
  Eigen::MatrixXd courses(problem_->size(), count);
  for (Index c = 0; c < count; ++c) courses.col(c) = responses[static_cast<std::size_t>(c)];
  const ProjectedColumns x = problem_->projectedProducts(courses, s, activeSeries(effect), Eigen::MatrixXd());
  const Eigen::VectorXd& b = x.with_residual;
  const Eigen::VectorXd& whole = x.whole;
  const double log_n = log_n_;
  const auto consider = [&](const GramGain& gain, std::vector<double> parameters) {
    const int parameters_used = gain.rank + nonlinear;
    const double score = gain.delta - parameters_used * log_n;
    best.tried += 1.0;
    if (gain.rank == 0 || !std::isfinite(gain.delta)) return;
    if (best.parameter_count == 0 || score > best.score) {
      best.score = score;
      best.delta_chi2 = gain.delta;
      best.parameter_count = parameters_used;
      best.term.parameters = std::move(parameters);
    }
  };
  // Sign and origin of a combination; false if it is not admissible.
  const auto admissible = [&](const GramGain& gain, int inputs) {
    if (effect.sign != 0) {
      for (int i = 0; i < inputs; ++i) {
        if (gain.gain[static_cast<std::size_t>(i * k)] * effect.sign < 0.0) return false;
      }
    }
    if (effect.free_origin && k == 2) {
      for (int i = 0; i < inputs; ++i) {
        const double slope = gain.gain[static_cast<std::size_t>(2 * i)];
        const double constant = gain.gain[static_cast<std::size_t>(2 * i + 1)];
        const double origin = slope != 0.0 ? -1000.0 * constant / slope : effect.origin_low_mm - 1.0;
        if (origin < effect.origin_low_mm || origin > effect.origin_high_mm) return false;
      }
    }
    return true;
  };
  std::array<Index, 8> index{};
  if (dynamics == Dynamics::Pulse) {
    const auto onsets = static_cast<Index>(onsets_.size());
    for (std::size_t lag = 0; lag < pulse_lags.size(); ++lag) {
      const Index at = static_cast<Index>(lag) * onsets;
      const Eigen::MatrixXd gram = x.gram(at, onsets);
      for (Index i = 0; i < onsets; ++i) {
        for (Index j = i + 1; j <= onsets; ++j) {
          double g = gram(i, i);
          double r = b[at + i];
          double length = 0.0;
          if (j < onsets) {
            g += gram(j, j) - 2.0 * gram(i, j);
            r -= b[at + j];
            length = onsets_[static_cast<std::size_t>(j)] - onsets_[static_cast<std::size_t>(i)];
          } else {
            length = 10.0 * (problem_->node_time_s.back() - problem_->node_time_s.front() + 1.0);
          }
          if (!(g > 1e-5 * whole[at + i])) continue;
          GramGain gain;
          gain.rank = 1;
          gain.delta = r * r / g;
          consider(gain, {onsets_[static_cast<std::size_t>(i)], length, pulse_lags[lag]});
        }
      }
    }
  } else if (variant.inputs.size() == 1 || variant.shared_lag) {
    const auto inputs = static_cast<int>(variant.inputs.size());
    const auto lags = static_cast<Index>(options[0].size());
    if (inputs * k > 8) return best;
    for (Index o = 0; o < lags; ++o) {
      ProjectedColumns part;
      part.rows.resize(x.rows.rows(), inputs * k);
      part.dots.resize(x.dots.rows(), inputs * k);
      Eigen::VectorXd product(inputs * k);
      Eigen::VectorXd power(inputs * k);
      for (int i = 0; i < inputs; ++i) {
        const Index at = (i * lags + o) * k;
        part.rows.middleCols(i * k, k) = x.rows.middleCols(at, k);
        part.dots.middleCols(i * k, k) = x.dots.middleCols(at, k);
        product.segment(i * k, k) = b.segment(at, k);
        power.segment(i * k, k) = whole.segment(at, k);
      }
      std::iota(index.begin(), index.end(), 0);
      const GramGain gain = gramGain(part.gram(), product, index.data(), static_cast<int>(inputs * k), power);
      if (!admissible(gain, inputs)) continue;
      const auto& p = options[0][static_cast<std::size_t>(o)];
      consider(gain, dynamics == Dynamics::Step ? std::vector<double>{p[0]} : p);
    }
  } else if (variant.inputs.size() == 2) {
    if (2 * k > 8) return best;
    const Eigen::MatrixXd gram = x.gram();
    const auto first = static_cast<Index>(options[0].size());
    for (Index i = 0; i < first; ++i) {
      for (Index j = first; j < count; ++j) {
        for (Index c = 0; c < k; ++c) {
          index[static_cast<std::size_t>(c)] = i * k + c;
          index[static_cast<std::size_t>(k + c)] = j * k + c;
        }
        const GramGain gain = gramGain(gram, b, index.data(), static_cast<int>(2 * k), whole);
        if (!admissible(gain, 2)) continue;
        std::vector<double> p = options[0][static_cast<std::size_t>(i)];
        const auto& second = options[1][static_cast<std::size_t>(j - first)];
        p.insert(p.end(), second.begin(), second.end());
        consider(gain, std::move(p));
      }
    }
  }
  return best;
}

CandidateFit EffectSearch::best(const Effect& effect) const {
  CandidateFit best;
  best.term.effect = &effect;
  double tried = 0.0;
  for (const EffectVariant& variant : effect.variants) {
    CandidateFit fit = bestOfVariant(effect, variant);
    tried += fit.tried;
    if (fit.parameter_count > 0 && (best.parameter_count == 0 || fit.score > best.score)) best = std::move(fit);
  }
  best.tried = std::max(1.0, tried);
  return best;
}

std::vector<CandidateFit> EffectSearch::sweep(const std::vector<std::string>& without, const JobContext& job) const {
  std::vector<CandidateFit> out;
  for (const Effect& effect : *catalogue_) {
    if (effect.variants.empty() || std::find(without.begin(), without.end(), effect.id) != without.end()) continue;
    job.throwIfCancelled();
    CandidateFit fit = best(effect);
    if (fit.parameter_count > 0) out.push_back(std::move(fit));
  }
  std::sort(out.begin(), out.end(), [](const CandidateFit& a, const CandidateFit& b) { return a.score > b.score; });
  return out;
}

}  // namespace spindrift
