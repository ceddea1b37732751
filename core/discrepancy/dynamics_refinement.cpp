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

/// One or two drivers that go together (heat, and heat times a position) after one lag.
struct LagOption {
  std::vector<std::string> drivers;
  double tau_s = 0.0;
  bool room_beside = false;  // the room, where the effect itself is not driven by it
};

/// Holds every driver of at least one way in which the catalogue has the effect driven.
bool coversAVariant(const ModelTerm& term) {
  const auto has = [&](const EffectInput& wanted) {
    return std::any_of(term.variant.inputs.begin(), term.variant.inputs.end(),
                       [&](const EffectInput& input) { return input.driver == wanted.driver; });
  };
  return std::any_of(term.effect->variants.begin(), term.effect->variants.end(),
                     [&](const EffectVariant& v) { return std::all_of(v.inputs.begin(), v.inputs.end(), has); });
}

struct SetGain {
  double delta = -1.0;
  double room_part = 0.0;
  double cancellation = 1.0;  // sizes of the inputs added, over the size of what they make together
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
  double sizes = 0.0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    const auto at = static_cast<Index>(i) * k;
    const double power = beta.segment(at, k).dot(g.block(at, at, k, k) * beta.segment(at, k));
    sizes += std::sqrt(std::max(0.0, power));
    double& largest = options[set[i]].room_beside ? room : own;
    largest = std::max(largest, power);
  }
  const double together = beta.dot(g * beta);
  out.cancellation = together > 0.0 ? sizes / std::sqrt(together) : 1e9;
  out.room_part = own > 0.0 ? std::sqrt(room / own) : 1e9;
  return out;
}

}  // namespace

JointFit EffectSearch::refineDynamics(JointFit fit, std::size_t t, const std::vector<NuisanceColumn>& base) const {
  constexpr double largest_room_part = 0.35;
  // A body that warms through another one has two lags whose gains differ in sign, but they do not cancel; large gains
  // that do, imitate the course of any driver.
  constexpr double most_cancellation = 3.0;
  const ModelTerm term = fit.terms[t];
  const Dynamics first = term.variant.inputs[0].dynamics;
  if (first != Dynamics::Lag && first != Dynamics::AsymmetricLag) return fit;
  const Effect& effect = *term.effect;
  // Where inputs share their lag (heat, and heat times a position) they go together, two to an option.
  const EffectVariant& usual = effect.variants.front();
  const bool paired = usual.shared_lag && usual.inputs.size() == 2;
  const Index k = shape(effect).cols() * (paired ? 2 : 1);
  constexpr std::size_t most_inputs = 3;
  const double longest = parameterBounds({&effect, {{{"", Dynamics::Lag}}, false}, {0.0}}, 0).second;
  std::vector<LagOption> options;
  const auto addDrivers = [&](const std::vector<std::string>& drivers, bool room_beside) {
    if (std::any_of(options.begin(), options.end(), [&](const LagOption& o) { return o.drivers == drivers; })) return;
    if (drivers.size() == 1 && drivers_->find(drivers[0])->linear) options.push_back({drivers, 0.0, room_beside});
    for (const double tau : lags_) {
      if (tau <= longest) options.push_back({drivers, tau, room_beside});
    }
  };
  for (const EffectVariant& variant : effect.variants) {
    if (variant.shared_lag != paired || (paired && variant.inputs.size() != 2)) continue;
    if (paired) {
      addDrivers({variant.inputs[0].driver, variant.inputs[1].driver}, false);
      continue;
    }
    for (const EffectInput& input : variant.inputs) {
      if (input.dynamics == Dynamics::Lag) addDrivers({input.driver}, false);
    }
  }
  if (effect.follows_room && !paired) {
    for (const std::string& room : drivers_->room()) addDrivers({room}, true);
  }
  // What the other terms explain is taken out of everything.
  Eigen::MatrixXd taken(problem_->projectedResidual().size(), 0);
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
    const Eigen::MatrixXd projected = problem_->projected(raw);
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(projected);
    taken = qr.householderQ() * Eigen::MatrixXd::Identity(projected.rows(), qr.rank());
  }
  const std::size_t drivers_each = paired ? 2 : 1;
  Eigen::MatrixXd courses(problem_->size(), static_cast<Index>(options.size() * drivers_each));
  Index course = 0;
  for (const LagOption& option : options) {
    for (const std::string& driver : option.drivers) courses.col(course++) = unitResponse(driver, option.tau_s, -1.0);
  }
  const ProjectedColumns x = problem_->projectedProducts(courses, shape(effect), activeSeries(effect), taken);
  const Eigen::MatrixXd gram = x.gram();
  const Eigen::VectorXd& b = x.with_residual;

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
        const bool allowed = value.room_part <= largest_room_part && value.cancellation <= most_cancellation;
        if (!allowed || !(value.delta > gain)) continue;
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
      for (const std::string& driver : options[o].drivers) {
        changed.variant.inputs.push_back({driver, Dynamics::Lag});
        changed.parameters.push_back(options[o].tau_s);
      }
    }
    if (paired && trial.size() == 1) {
      changed.variant.shared_lag = true;
      changed.parameters.resize(1);
    }
    if (!coversAVariant(changed)) continue;
    next = refine(next.terms, 1);
    if (inputs == 1 && !(next.score > best.score + 4.0)) continue;
    if (!predictsBetter(best, next, base)) break;
    best = std::move(next);
  }
  return withAsymmetricLag(std::move(best), t, base);
}

bool EffectSearch::predictsBetter(const JointFit& before, const JointFit& after,
                                  const std::vector<NuisanceColumn>& base) const {
  if (!(after.score > before.score + 4.0)) return false;
  const CrossValidation blocks = crossValidate(before.terms, after.terms, base);
  const CrossValidation scattered = crossValidate(before.terms, after.terms, base, true);
  if (blocks.after_chi2 < blocks.before_chi2) return true;
  const bool as_good = blocks.after_chi2 < 1.02 * blocks.before_chi2;
  // What happens within one block cannot be predicted without it, whatever its dynamics.
  const bool blind = blocks.before_chi2 > 2.0 * scattered.before_chi2;
  return (as_good || blind) && scattered.after_chi2 + 8.0 < scattered.before_chi2;
}

JointFit EffectSearch::withAsymmetricLag(JointFit fit, std::size_t t, const std::vector<NuisanceColumn>& base) const {
  const ModelTerm& term = fit.terms[t];
  if (term.variant.shared_lag) return fit;
  // The input that moves most among those that are switched: air that motion stirs lets a body cool faster than it
  // cools at rest.
  const Index k = shape(*term.effect).cols();
  const Eigen::MatrixXd x = problem_->projected(columns(term));
  std::size_t input = term.variant.inputs.size();
  double largest = 0.0;
  for (std::size_t i = 0; i < term.variant.inputs.size(); ++i) {
    const EffectInput& candidate = term.variant.inputs[i];
    if (candidate.dynamics != Dynamics::Lag || drivers_->find(candidate.driver)->linear) continue;
    const auto at = static_cast<Index>(i) * k;
    const double size = (x.middleCols(at, k) * fit.gains[t].segment(at, k)).norm();
    if (!(size > largest)) continue;
    largest = size;
    input = i;
  }
  if (input == term.variant.inputs.size() || !(term.parameters[input] > 0.0)) return fit;
  JointFit best = fit;
  for (const double ratio : {0.4, 2.5}) {
    JointFit next = fit;
    ModelTerm& changed = next.terms[t];
    changed.variant.inputs[input].dynamics = Dynamics::AsymmetricLag;
    const auto at = changed.parameters.begin() + static_cast<std::ptrdiff_t>(input);
    changed.parameters.insert(at + 1, changed.parameters[input] * ratio);
    next = refine(next.terms, 1);
    if (next.score > best.score) best = std::move(next);
  }
  if (best.score > fit.score && predictsBetter(fit, best, base)) return best;
  return fit;
}

}  // namespace spindrift
