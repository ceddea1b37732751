// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/effect_search.h"

#include <algorithm>
#include <cmath>

namespace spindrift {

using Eigen::Index;

EffectSearch::EffectSearch(ResidualProblem& problem, const DriverTable& drivers, const std::vector<Effect>& catalogue)
    : problem_(&problem), drivers_(&drivers), catalogue_(&catalogue) {
  log_n_ = std::log(std::max(8.0, static_cast<double>(problem.size())));
  for (int i = 0; i < 10; ++i) lags_.push_back(120.0 * std::pow(180.0, i / 9.0));  // 2 min ... 6 h
  pulse_lags_ = {0.0, 600.0, 1800.0, 5400.0};
  // Onsets halfway between epochs, after the second and before the last but one, thinned to 48.
  std::vector<double> times = problem.epoch_time_s;
  std::sort(times.begin(), times.end());
  const std::size_t step = std::max<std::size_t>(1, times.size() / 48);
  for (std::size_t i = 1; i + 2 < times.size(); i += step) onsets_.push_back(0.5 * (times[i] + times[i + 1]));
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
    const std::vector<double> parameters(static_cast<std::size_t>(parameterCount(alone)), a);
    q = inputResponses(*drivers_, alone, parameters, problem_->node_time_s).col(0);
  }
  Eigen::VectorXd units = problem_->toUnits(q);
  const std::scoped_lock lock(mutex_);
  return responses_.emplace(key, std::move(units)).first->second;
}

void EffectSearch::prepare(const Effect& effect) const {
  if (shapes_.contains(effect.id)) return;
  Eigen::MatrixXd s = problem_->shapeAtUnits(effect);
  // A periodic error at points a whole number of pitches apart is nothing but rounding.
  for (Index k = 0; k < s.cols(); ++k) {
    if (s.col(k).cwiseAbs().maxCoeff() < 1e-9) s.col(k).setZero();
  }
  shapes_.emplace(effect.id, std::move(s));
}

const Eigen::MatrixXd& EffectSearch::shape(const Effect& effect) const {
  const auto found = shapes_.find(effect.id);
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

Eigen::VectorXd EffectSearch::derivative(const ModelTerm& term, const Eigen::VectorXd& gains, std::size_t p) const {
  const double value = term.parameters[p];
  const double step = parameterIsLag(term, p) ? std::max(60.0, 0.1 * value) : 60.0;
  ModelTerm up = term;
  up.parameters[p] = value + step;
  return (columns(up) - columns(term)) * gains / step;
}

}  // namespace spindrift
