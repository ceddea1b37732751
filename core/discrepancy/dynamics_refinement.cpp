// SPDX-License-Identifier: Apache-2.0
// Which drivers and lags an accepted effect really has: a real spindle is not one lag. All drivers that the effect may
// have, each on the grid of lags, compete as inputs; the best set of one, two and three is found on their Gram matrix
// (forward, then exchanging one by one), each larger set has to earn its place, and the lags are refined at the end.
#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/discrepancy/effect_search.h"

namespace spindrift {
namespace {

using Eigen::Index;

struct LagOption {
  std::string driver;
  double tau_s = 0.0;
  bool room_beside = false;  // the room, where the effect itself is not driven by it
};

struct SetGain {
  double delta = -1.0;
  double room_part = 0.0;
};

/// Gain in chi-squared of a set of options, and how large the room is beside the largest other input.
SetGain gainOf(const std::vector<std::size_t>& set, const std::vector<LagOption>& options, Index k,
               const Eigen::MatrixXd& gram, const Eigen::VectorXd& b) {
  const auto size = static_cast<Index>(set.size()) * k;
  Eigen::MatrixXd g(size, size);
  Eigen::VectorXd r(size);
  for (std::size_t i = 0; i < set.size(); ++i) {
    const auto at = static_cast<Index>(i) * k;
    const auto from = static_cast<Index>(set[i]) * k;
    r.segment(at, k) = b.segment(from, k);
    for (std::size_t j = 0; j < set.size(); ++j) {
      g.block(at, static_cast<Index>(j) * k, k, k) = gram.block(from, static_cast<Index>(set[j]) * k, k, k);
    }
  }
  // A ridge of a part in 1e6 keeps nearly equal lags from cancelling each other with enormous gains.
  const Eigen::VectorXd diagonal = g.diagonal();
  g.diagonal() += 1e-6 * diagonal;
  g.diagonal().array() += 1e-12;
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(g);
  const Eigen::VectorXd beta = ldlt.solve(r);
  SetGain out;
  out.delta = b.size() > 0 ? r.dot(beta) : 0.0;
  double own = 0.0;
  double room = 0.0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    const auto at = static_cast<Index>(i) * k;
    const double power = beta.segment(at, k).dot(g.block(at, at, k, k) * beta.segment(at, k));
    double& largest = options[set[i]].room_beside ? room : own;
    largest = std::max(largest, power);
  }
  out.room_part = own > 0.0 ? std::sqrt(room / own) : 1e9;
  return out;
}

}  // namespace

JointFit EffectSearch::refineDynamics(JointFit fit, std::size_t t, const std::vector<NuisanceColumn>& base) const {
  constexpr double largest_room_part = 0.35;
  const ModelTerm term = fit.terms[t];
  const Dynamics first = term.variant.inputs[0].dynamics;
  if (first != Dynamics::Lag && first != Dynamics::AsymmetricLag) return fit;
  const Effect& effect = *term.effect;
  const Index k = shape(effect).cols();
  if (term.variant.shared_lag) return fit;
  constexpr std::size_t most_inputs = 3;
  const double longest = parameterBounds({&effect, {{{"", Dynamics::Lag}}, false}, {0.0}}, 0).second;
  std::vector<LagOption> options;
  const auto addDriver = [&](const std::string& driver, bool room_beside) {
    if (std::any_of(options.begin(), options.end(), [&](const LagOption& o) { return o.driver == driver; })) return;
    if (drivers_->find(driver)->linear) options.push_back({driver, 0.0, room_beside});
    for (const double tau : lags_) {
      if (tau <= longest) options.push_back({driver, tau, room_beside});
    }
  };
  for (const EffectVariant& variant : effect.variants) {
    if (variant.shared_lag) continue;
    for (const EffectInput& input : variant.inputs) {
      if (input.dynamics == Dynamics::Lag) addDriver(input.driver, false);
    }
  }
  if (effect.follows_room) {
    for (const std::string& room : drivers_->room()) addDriver(room, true);
  }
  // Columns of all options, orthogonal to the nuisances and to the other terms.
  Eigen::MatrixXd x(problem_->size(), static_cast<Index>(options.size()) * k);
  for (std::size_t o = 0; o < options.size(); ++o) {
    const Eigen::VectorXd& q = unitResponse(options[o].driver, options[o].tau_s, -1.0);
    x.middleCols(static_cast<Index>(o) * k, k).noalias() = q.asDiagonal() * shape(effect);
  }
  x = problem_->projected(x);
  Eigen::VectorXd y = problem_->projectedResidual();
  std::vector<ModelTerm> others = fit.terms;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(t));
  if (!others.empty()) {
    Index total = 0;
    for (const ModelTerm& other : others) total += columns(other).cols();
    Eigen::MatrixXd raw(problem_->size(), total);
    Index at = 0;
    for (const ModelTerm& other : others) {
      const Eigen::MatrixXd part = columns(other);
      raw.middleCols(at, part.cols()) = part;
      at += part.cols();
    }
    const Eigen::MatrixXd taken = problem_->projected(raw);
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(taken);
    const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(taken.rows(), qr.rank());
    x -= q * (q.transpose() * x);
    y -= q * (q.transpose() * y);
  }
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(x.cols(), x.cols());
  gram.selfadjointView<Eigen::Lower>().rankUpdate(x.transpose());
  gram = Eigen::MatrixXd(gram.selfadjointView<Eigen::Lower>());
  const Eigen::VectorXd b = x.transpose() * y;

  std::vector<std::size_t> set;
  double set_gain = 0.0;
  JointFit best = fit;
  for (std::size_t inputs = 1; inputs <= most_inputs && static_cast<Index>(inputs) * k <= 9; ++inputs) {
    std::vector<std::size_t> trial = set;
    trial.push_back(0);
    const auto bestAt = [&](std::size_t place) {
      std::vector<std::size_t> moved = trial;
      std::size_t found = options.size();
      double gain = -1.0;
      for (std::size_t o = 0; o < options.size(); ++o) {
        if (std::find(trial.begin(), trial.end(), o) != trial.end() && o != trial[place]) continue;
        moved[place] = o;
        const SetGain value = gainOf(moved, options, k, gram, b);
        if (value.room_part > largest_room_part || !(value.delta > gain)) continue;
        gain = value.delta;
        found = o;
      }
      if (found < options.size()) trial[place] = found;
      return gain;
    };
    double gain = bestAt(trial.size() - 1);
    for (int round = 0; round < 3; ++round) {
      const double before = gain;
      for (std::size_t place = 0; place < trial.size(); ++place) gain = std::max(gain, bestAt(place));
      if (gain < before + 0.1) break;
    }
    // One more gain per shape column and one more lag.
    const double cost = inputs > 1 ? static_cast<double>(k + 1) * log_n_ : 0.0;
    if (!(gain > set_gain + cost + (inputs > 1 ? 4.0 : 0.0))) break;
    set = trial;
    set_gain = gain;
    JointFit next = fit;
    ModelTerm& changed = next.terms[t];
    changed.variant = {};
    changed.parameters.clear();
    for (const std::size_t o : trial) {
      changed.variant.inputs.push_back({options[o].driver, Dynamics::Lag});
      changed.parameters.push_back(options[o].tau_s);
    }
    next = refine(next.terms, 1);
    if (inputs > 1 || next.score > best.score + 4.0) {
      if (!(next.score > best.score + 4.0)) break;
      const CrossValidation blocks = crossValidate(best.terms, next.terms, base);
      const CrossValidation scattered = crossValidate(best.terms, next.terms, base, true);
      const bool better = blocks.after_chi2 < blocks.before_chi2;
      const bool as_good = blocks.after_chi2 < 1.02 * blocks.before_chi2;
      // What happens within one block cannot be predicted without it, whatever its dynamics.
      const bool blind = blocks.before_chi2 > 2.0 * scattered.before_chi2;
      if (!better && !((as_good || blind) && scattered.after_chi2 + 8.0 < scattered.before_chi2)) break;
      best = std::move(next);
    }
  }
  return best;
}

}  // namespace spindrift
