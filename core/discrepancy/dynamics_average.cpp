// SPDX-License-Identifier: Apache-2.0
// Averages of the predictions of an effect over the drivers that may be its main one.
#include <algorithm>
#include <cmath>
#include <set>

#include "core/discrepancy/distributed_dynamics.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// In score, by which another main driver may be behind before anything is distributed.
constexpr double most_behind = 40.0;
/// Weights below do not count.
constexpr double least_weight = 0.02;
constexpr std::size_t most_lag_alternatives = 6;

bool lagsOnly(const EffectVariant& variant) {
  return !variant.inputs.empty() && std::all_of(variant.inputs.begin(), variant.inputs.end(), [](const EffectInput& i) {
    return i.dynamics == Dynamics::Lag || i.dynamics == Dynamics::AsymmetricLag;
  });
}

std::set<std::string> driversOf(const EffectVariant& variant) {
  std::set<std::string> names;
  for (const EffectInput& input : variant.inputs) names.insert(input.driver);
  return names;
}

/// `fit` with term `t` driven as `variant`, at the best of a few lags, refined; nothing if that is far behind.
std::optional<JointFit> drivenOtherwise(const EffectSearch& search, const DriverTable& drivers, const JointFit& fit,
                                        std::size_t t, const EffectVariant& variant) {
  std::vector<ModelTerm> best;
  double least = 0.0;
  for (const double tau : {0.0, 300.0, 900.0, 2700.0, 8100.0}) {
    const auto linear = [&](const EffectInput& input) { return drivers.find(input.driver)->linear; };
    if (tau == 0.0 && !std::all_of(variant.inputs.begin(), variant.inputs.end(), linear)) continue;
    std::vector<ModelTerm> terms = fit.terms;
    terms[t].variant = variant;
    terms[t].parameters.assign(static_cast<std::size_t>(parameterCount(variant)), tau);
    const JointFit trial = search.solve(terms);
    if (!best.empty() && !(trial.chi2 < least)) continue;
    least = trial.chi2;
    best = std::move(terms);
  }
  if (best.empty() || least > fit.chi2 + 4.0 * most_behind) return std::nullopt;
  JointFit refined = search.refine(best, 1);
  if (refined.score < fit.score - most_behind) return std::nullopt;
  return refined;
}

/// Place of an input with its parameters among those of `effect`; the end if it is not there.
std::pair<std::size_t, std::size_t> lagPlaceOf(const ModelEffect& effect, const EffectInput& input,
                                               const std::vector<double>& parameters) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < effect.variant.inputs.size(); ++i) {
    const EffectInput& there = effect.variant.inputs[i];
    const auto count = static_cast<std::size_t>(parameterCount({{there}, false}));
    const auto from = effect.parameters.begin() + static_cast<std::ptrdiff_t>(next);
    const bool same = there.driver == input.driver && there.dynamics == input.dynamics && count == parameters.size() &&
                      std::equal(parameters.begin(), parameters.end(), from);
    if (same) return {i, next};
    next += count;
  }
  return {effect.variant.inputs.size(), next};
}

/// The same effect with one lag for each input.
ModelEffect withLagsApart(ModelEffect effect) {
  if (!effect.variant.shared_lag) return effect;
  const auto inputs = static_cast<Index>(effect.variant.inputs.size());
  const std::vector<double> shared = effect.parameters;
  const auto each = static_cast<Index>(shared.size());
  const Index gains = effect.gains.size();
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(gains + inputs * each, effect.covariance.cols());
  spread.topLeftCorner(gains, gains).setIdentity();
  effect.parameters.clear();
  for (Index i = 0; i < inputs; ++i) {
    spread.block(gains + i * each, gains, each, each).setIdentity();
    effect.parameters.insert(effect.parameters.end(), shared.begin(), shared.end());
  }
  effect.covariance = spread * effect.covariance * spread.transpose();
  effect.variant.shared_lag = false;
  return effect;
}

/// One effect from its versions, of which the first has the largest weight.
ModelEffect averagedEffect(const std::vector<ModelEffect>& versions, const std::vector<double>& weights) {
  ModelEffect out = versions[0];
  out.variant = {};
  out.parameters.clear();
  const auto k = static_cast<Index>(out.effect.shape.size());
  // Where the inputs and parameters of every version are in the whole.
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> places(versions.size());
  for (std::size_t v = 0; v < versions.size(); ++v) {
    std::size_t next = 0;
    for (const EffectInput& input : versions[v].variant.inputs) {
      const auto count = static_cast<std::size_t>(parameterCount({{input}, false}));
      const auto from = versions[v].parameters.begin() + static_cast<std::ptrdiff_t>(next);
      const std::vector<double> parameters(from, from + static_cast<std::ptrdiff_t>(count));
      places[v].push_back(lagPlaceOf(out, input, parameters));
      if (places[v].back().first == out.variant.inputs.size()) {
        out.variant.inputs.push_back(input);
        out.parameters.insert(out.parameters.end(), parameters.begin(), parameters.end());
      }
      next += count;
    }
  }
  const Index gains = k * static_cast<Index>(out.variant.inputs.size());
  const Index total = gains + static_cast<Index>(out.parameters.size());
  // How much of the mean each input is: a lag of one version alone moves the mean by this version's weight only.
  std::vector<double> share(out.variant.inputs.size(), 0.0);
  for (std::size_t v = 0; v < versions.size(); ++v) {
    for (const auto& [input, parameter] : places[v]) share[input] += weights[v];
  }
  std::vector<Eigen::VectorXd> own(versions.size(), Eigen::VectorXd::Zero(gains));
  out.gains = Eigen::VectorXd::Zero(gains);
  out.covariance = Eigen::MatrixXd::Zero(total, total);
  for (std::size_t v = 0; v < versions.size(); ++v) {
    Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(total, versions[v].covariance.cols());
    Index next = versions[v].gains.size();
    for (std::size_t i = 0; i < places[v].size(); ++i) {
      const auto [input, parameter] = places[v][i];
      const auto from = static_cast<Index>(i) * k;
      own[v].segment(static_cast<Index>(input) * k, k) += versions[v].gains.segment(from, k);
      spread.block(static_cast<Index>(input) * k, from, k, k).setIdentity();
      const int count = parameterCount({{versions[v].variant.inputs[i]}, false});
      for (int p = 0; p < count; ++p) {
        spread(gains + static_cast<Index>(parameter) + p, next++) = 1.0 / share[input];
      }
    }
    out.gains += weights[v] * own[v];
    out.covariance += weights[v] * spread * versions[v].covariance * spread.transpose();
  }
  for (std::size_t v = 0; v < versions.size(); ++v) {
    const Eigen::VectorXd apart = own[v] - out.gains;
    out.covariance.topLeftCorner(gains, gains) += weights[v] * apart * apart.transpose();
  }
  const Eigen::VectorXd sd = out.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  out.gain_uncertainty = sd.head(gains);
  out.parameter_uncertainty.assign(sd.data() + gains, sd.data() + total);
  return out;
}

}  // namespace

std::vector<WeightedDynamics> alternativeDynamics(const EffectSearch& search, const ResidualProblem& problem,
                                                  const DriverTable& drivers, const JointFit& fit) {
  std::vector<JointFit> fits;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    if (!lagsOnly(fit.terms[t].variant)) continue;
    const std::set<std::string> present = driversOf(fit.terms[t].variant);
    for (const EffectVariant& variant : fit.terms[t].effect->variants) {
      // Some of the drivers that are in are no alternative: the fit has them with the gains that the data ask for.
      const std::set<std::string> other = driversOf(variant);
      if (!lagsOnly(variant) || std::includes(present.begin(), present.end(), other.begin(), other.end())) continue;
      if (auto driven = drivenOtherwise(search, drivers, fit, t, variant)) fits.push_back(std::move(*driven));
    }
  }
  std::sort(fits.begin(), fits.end(), [](const JointFit& a, const JointFit& b) { return a.score > b.score; });
  if (fits.size() > most_lag_alternatives) fits.resize(most_lag_alternatives);
  std::vector<WeightedDynamics> out;
  out.push_back({distributedDynamics(search, problem, drivers, fit), 1.0});
  for (const JointFit& other : fits) out.push_back({distributedDynamics(search, problem, drivers, other), 1.0});
  std::sort(out.begin(), out.end(), [](const WeightedDynamics& a, const WeightedDynamics& b) {
    return a.distributed.log_evidence > b.distributed.log_evidence;
  });
  const double best = out[0].distributed.log_evidence;
  double sum = 0.0;
  for (WeightedDynamics& w : out) w.weight = std::exp(w.distributed.log_evidence - best);
  std::erase_if(out, [](const WeightedDynamics& w) { return w.weight < least_weight; });
  for (const WeightedDynamics& w : out) sum += w.weight;
  for (WeightedDynamics& w : out) w.weight /= sum;
  return out;
}

std::vector<ModelEffect> averagedEffects(const std::vector<std::vector<ModelEffect>>& parts,
                                         const std::vector<double>& weights) {
  if (parts.size() == 1) return parts[0];
  std::vector<ModelEffect> out;
  for (std::size_t t = 0; t < parts[0].size(); ++t) {
    std::vector<ModelEffect> versions;
    for (const std::vector<ModelEffect>& part : parts) versions.push_back(withLagsApart(part[t]));
    out.push_back(averagedEffect(versions, weights));
  }
  return out;
}

}  // namespace spindrift
