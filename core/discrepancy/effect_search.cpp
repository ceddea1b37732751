// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/effect_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/math/statistics.h"

namespace spindrift {

using Eigen::Index;

EffectSearch::EffectSearch(const ResidualProblem& problem, const DriverTable& drivers,
                           const std::vector<Effect>& catalogue)
    : problem_(&problem), drivers_(&drivers), catalogue_(&catalogue) {
  log_n_ = std::log(std::max(8.0, static_cast<double>(problem.size())));
  // From 2 min to what the span of the observations can tell from an integrator.
  const double span = problem.node_time_s.empty() ? 0.0 : problem.node_time_s.back() - problem.node_time_s.front();
  const double longest = std::clamp(0.4 * span, 3600.0, 36000.0);
  for (int i = 0; i < 10; ++i) lags_.push_back(120.0 * std::pow(longest / 120.0, i / 9.0));
  pulse_lags_ = {0.0, 600.0, 1800.0, 5400.0};
  // Onsets halfway between epochs, after the second and before the last but one, thinned to 48.
  std::vector<double> times = problem.epoch_time_s;
  std::sort(times.begin(), times.end());
  const std::size_t step = std::max<std::size_t>(1, times.size() / 48);
  for (std::size_t i = 1; i + 2 < times.size(); i += step) onsets_.push_back(0.5 * (times[i] + times[i + 1]));
}

std::vector<double> EffectSearch::within(const Effect& effect, const std::vector<double>& lags) {
  const double low = effect.tau_s ? (*effect.tau_s)[0] : effect.least_lag_s;
  if (!effect.tau_s && low <= 0.0) return lags;
  const double high = effect.tau_s ? (*effect.tau_s)[1] : std::numeric_limits<double>::infinity();
  std::vector<double> out;
  if (low > 0.0) out.push_back(low);
  // A lag next to a bound says nothing that the bound does not.
  for (const double tau : lags) {
    if (tau > 1.2 * low && tau < high / 1.2) out.push_back(tau);
  }
  if (effect.tau_s) out.push_back(high);
  return out;
}

double EffectSearch::endlessLength() const noexcept {
  return 10.0 * (problem_->node_time_s.back() - problem_->node_time_s.front() + 1.0);
}

const Effect* EffectSearch::find(std::string_view id) const {
  const auto found = std::find_if(catalogue_->begin(), catalogue_->end(), [&](const Effect& e) { return e.id == id; });
  return found == catalogue_->end() ? nullptr : &*found;
}

Eigen::VectorXd EffectSearch::gridResponse(const EffectInput& input, double a, double b) const {
  const auto key = std::make_tuple(input.driver, static_cast<int>(input.dynamics), a, b);
  {
    const std::scoped_lock lock(mutex_);
    const auto found = responses_.find(key);
    if (found != responses_.end()) return found->second;
  }
  Eigen::VectorXd q(static_cast<Index>(problem_->node_time_s.size()));
  if (input.dynamics == Dynamics::Step || input.dynamics == Dynamics::Pulse) {
    // The rise of a pulse; it ends by another one that is taken off.
    const double tau = input.dynamics == Dynamics::Step ? 0.0 : b;
    for (Index r = 0; r < q.size(); ++r) {
      const double t = problem_->node_time_s[static_cast<std::size_t>(r)] - a;
      q[r] = t <= 0.0 ? 0.0 : tau > 0.0 ? 1.0 - std::exp(-t / tau) : 1.0;
    }
  } else {
    const EffectVariant alone{{input}, false};
    std::vector<double> parameters(static_cast<std::size_t>(parameterCount(alone)), a);
    if (input.dynamics == Dynamics::AsymmetricLag) parameters[1] = b;
    q = inputResponses(*drivers_, alone, parameters, problem_->node_time_s).col(0);
  }
  Eigen::VectorXd units = problem_->toUnits(q);
  const std::scoped_lock lock(mutex_);
  return responses_.emplace(key, std::move(units)).first->second;
}

void EffectSearch::prepare(const Effect& effect) const {
  if (shapes_.contains({effect.id, effect.form})) return;
  Eigen::MatrixXd s = problem_->shapeAtUnits(effect);
  // A periodic error at points a whole number of pitches apart is nothing but rounding.
  for (Index k = 0; k < s.cols(); ++k) {
    if (s.col(k).cwiseAbs().maxCoeff() < 1e-9) s.col(k).setZero();
  }
  shapes_.emplace(std::pair(effect.id, effect.form), std::move(s));
}

const Eigen::MatrixXd& EffectSearch::shape(const Effect& effect) const {
  const auto found = shapes_.find({effect.id, effect.form});
  SPINDRIFT_ASSERT(found != shapes_.end(), "an effect that was not prepared");
  return found->second;
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

Eigen::VectorXd EffectSearch::course(const ModelTerm& term, const Eigen::VectorXd& gains) const {
  const Eigen::MatrixXd& s = shape(*term.effect);
  const auto k = s.cols();
  const Eigen::MatrixXd q = inputResponses(*drivers_, term.variant, term.parameters, problem_->node_time_s);
  Index main = 0;
  double most = -1.0;
  for (Index c = 0; c < k; ++c) {
    double size = 0.0;
    for (Index i = 0; i < q.cols(); ++i) size += std::abs(gains[i * k + c]) * q.col(i).norm();
    size *= s.col(c).norm();
    if (size > most) {
      most = size;
      main = c;
    }
  }
  Eigen::VectorXd nodes = Eigen::VectorXd::Zero(q.rows());
  for (Index i = 0; i < q.cols(); ++i) nodes += gains[i * k + main] * q.col(i);
  Eigen::VectorXd out = problem_->toUnits(nodes);
  const Eigen::VectorXd centred = out.array() - out.mean();
  const double rms = centred.norm() / std::sqrt(static_cast<double>(std::max<Index>(1, out.size())));
  return rms > 0.0 ? Eigen::VectorXd(out / rms) : Eigen::VectorXd();
}

bool drivenByLog(const ModelTerm& term) {
  return std::any_of(term.variant.inputs.begin(), term.variant.inputs.end(), [](const EffectInput& input) {
    return !input.driver.empty() && input.driver != assumed_instrument;
  });
}

bool drivenByStandIn(const ModelTerm& term) {
  return term.effect->driver_missing && drivenByLog(term);
}

bool EffectSearch::admissible(const ModelTerm& term, const Eigen::VectorXd& gains, double in_one_state) const {
  const Effect& effect = *term.effect;
  const auto k = static_cast<Index>(effect.shape.size());
  const auto& inputs = term.variant.inputs;
  const bool warm = inputs.back().dynamics == Dynamics::Start;
  const Index driven = static_cast<Index>(inputs.size()) - (warm ? 1 : 0);
  for (Index i = 0; i < driven; ++i) {
    const auto own = gains.segment(i * k, k);
    if (effect.sign != 0 && own[0] * effect.sign < 0.0) return false;
    if (effect.free_origin && k == 2) {
      const double origin = own[0] != 0.0 ? -1000.0 * own[1] / own[0] : effect.origin_low_mm - 1.0;
      if (origin < effect.origin_low_mm || origin > effect.origin_high_mm) return false;
    }
    double to = 0.0;
    bool seen = true;
    for (const std::size_t column : effect.ratio_to) {
      to += own[static_cast<Index>(column)];
      seen = seen && !shape(effect).col(static_cast<Index>(column)).isZero(0.0);
    }
    for (std::size_t c = 0; seen && c < effect.largest_ratio.size(); ++c) {
      const double most = effect.largest_ratio[c];
      if (most > 0.0 && std::abs(own[static_cast<Index>(c)]) > most * std::abs(to)) return false;
    }
  }
  const Dynamics first = inputs[0].dynamics;
  if (first == Dynamics::AsymmetricLag && !possibleLags(term.parameters[0], term.parameters[1])) return false;
  if (first == Dynamics::Pulse && inputs.size() == 1 && problem_->epoch_time_s.size() >= 6) {
    const Eigen::VectorXd q = inputResponses(*drivers_, term.variant, term.parameters, problem_->epoch_time_s).col(0);
    const Eigen::ArrayXd moved = (q.array() - median(std::vector<double>(q.begin(), q.end()))).square();
    if (moved.maxCoeff() > in_one_state * moved.sum()) return false;
  }
  // What moved was seen where it was and where it is: one or two readings that are off may have gone wrong.
  if (first == Dynamics::Step && problem_->epoch_time_s.size() >= 6) {
    constexpr std::size_t fewest_states = 3;
    const Eigen::MatrixXd& pattern = shape(effect);
    std::set<int> before;
    std::set<int> after;
    for (Index u = 0; u < problem_->size(); ++u) {
      if (pattern.row(u).isZero(0.0)) continue;
      const auto unit = static_cast<std::size_t>(u);
      (problem_->time_s[unit] < term.parameters[0] ? before : after).insert(problem_->epoch[unit]);
    }
    if (std::min(before.size(), after.size()) < fewest_states) return false;
  }
  // Two lags of one driver add up; they do not cancel.
  if (driven == 2 && inputs[0].driver == inputs[1].driver && inputs[0].dynamics == Dynamics::Lag) {
    const double a = gains[0];
    const double b = gains[k];
    constexpr double most_opposed = 0.5;
    if (a * b < 0.0 && std::min(std::abs(a), std::abs(b)) > most_opposed * std::max(std::abs(a), std::abs(b)))
      return false;
  }
  if (!warm) return true;
  // What was warm at the start is what the same driver had made, in the same pattern and no larger than it can make.
  const Eigen::MatrixXd& s = shape(effect);
  const auto start = gains.segment(driven * k, k);
  double dot = 0.0;
  double own_power = 0.0;
  double start_power = 0.0;
  double most = 0.0;
  bool signed_driver = false;
  const auto own = gains.segment(0, k);
  for (Index c = 0; c < k; ++c) {
    const double w = s.col(c).squaredNorm();
    dot += w * own[c] * start[c];
    own_power += w * own[c] * own[c];
    start_power += w * start[c] * start[c];
  }
  for (Index i = 0; i < driven; ++i) {
    const Driver* driver = drivers_->find(inputs[static_cast<std::size_t>(i)].driver);
    if (driver == nullptr) continue;
    const double sum = gains.segment(i * k, k).norm();
    double largest = 0.0;
    for (const double v : driver->values) largest = std::max(largest, std::abs(v));
    most += sum * largest / std::max(1e-12, own.norm());
    signed_driver = signed_driver || driver->linear;
  }
  const double size = std::sqrt(own_power * start_power);
  if (k > 1 && std::abs(dot) < 0.9 * size) return false;
  if (!signed_driver && dot < 0.0) return false;
  return std::sqrt(start_power) <= 1.2 * most * std::sqrt(own_power);
}

Eigen::VectorXd EffectSearch::derivative(const ModelTerm& term, const Eigen::VectorXd& gains, std::size_t p) const {
  const double value = term.parameters[p];
  const double step = parameterIsLag(term, p) ? std::max(60.0, 0.1 * value) : 60.0;
  ModelTerm up = term;
  up.parameters[p] = value + step;
  return (columns(up) - columns(term)) * gains / step;
}

}  // namespace spindrift
