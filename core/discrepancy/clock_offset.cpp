// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/clock_offset.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace spindrift {
namespace {

/// chi-squared of the terms, refined, with the clock of the log moved by `by_s`: lags follow the clock.
double chi2At(const ResidualProblem& problem, const std::vector<Effect>& catalogue, const DriverTable& drivers,
              const std::vector<ModelTerm>& terms, double by_s, int rounds) {
  DriverTable shifted = drivers;
  shifted.shiftClock(by_s);
  const EffectSearch search(problem, shifted, catalogue);
  for (const ModelTerm& term : terms) search.prepare(*term.effect);
  return search.refine(terms, rounds).chi2;
}

bool noneShowsClock(const std::vector<ModelTerm>& terms, const DriverTable& drivers) {
  return std::none_of(terms.begin(), terms.end(), [&](const ModelTerm& term) { return showsClock(term, drivers); });
}

}  // namespace

bool showsClock(const ModelTerm& term, const DriverTable& drivers) {
  return std::any_of(term.variant.inputs.begin(), term.variant.inputs.end(), [&](const EffectInput& input) {
    const Driver* driver = drivers.find(input.driver);
    if (driver == nullptr) return false;
    const auto [least, most] = std::minmax_element(driver->values.begin(), driver->values.end());
    return *most > *least;
  });
}

std::optional<ClockOffset> estimateClockOffset(const ResidualProblem& problem, const std::vector<Effect>& catalogue,
                                               const DriverTable& drivers, const JointFit& fit, double present_s,
                                               double prior_s) {
  if (noneShowsClock(fit.terms, drivers)) return std::nullopt;
  constexpr double step_s = 60.0;
  constexpr int most_steps = 10;
  std::map<int, double> values;
  const auto at = [&](int k) {
    const auto [value, fresh] = values.try_emplace(k, 0.0);
    if (fresh) {
      const double offset_s = k * step_s;
      value->second =
          chi2At(problem, catalogue, drivers, fit.terms, offset_s - present_s, 1) + std::pow(offset_s / prior_s, 2);
    }
    return value->second;
  };
  int best = static_cast<int>(std::lround(present_s / step_s));
  const double start = at(best);
  for (const int stride : {4, 2, 1}) {
    for (int guard = 0; guard < 8; ++guard) {
      const int from = best;
      for (const int k : {best - stride, best + stride}) {
        if (std::abs(k) <= most_steps && at(k) < at(best)) best = k;
      }
      if (best == from) break;
    }
  }
  const double low = at(best - 1);
  const double high = at(best + 1);
  const double curvature = low + high - 2.0 * at(best);
  // In 2 ln of the posterior.
  constexpr double worth_it = 8.0;
  if (!(curvature > 0.0) || !(start - at(best) > worth_it)) return std::nullopt;
  return ClockOffset{step_s * (best + std::clamp(0.5 * (low - high) / curvature, -1.0, 1.0)),
                     step_s * std::sqrt(2.0 / curvature)};
}

bool fitsFarBetterElsewhere(const ResidualProblem& problem, const std::vector<Effect>& catalogue,
                            const DriverTable& drivers, const JointFit& named) {
  if (noneShowsClock(named.terms, drivers)) return false;
  const double now = chi2At(problem, catalogue, drivers, named.terms, 0.0, 2);
  double best = now;
  for (int k = -far_clock_steps; k <= far_clock_steps; ++k)
    if (k != 0) best = std::min(best, chi2At(problem, catalogue, drivers, named.terms, k * far_clock_step_s, 2));
  // In 2 ln of the likelihood, the best of so many offsets.
  constexpr double beyond_doubt = 20.0;
  return now - best > beyond_doubt;
}

double priceOfFarClock(const ResidualProblem& problem, const std::vector<Effect>& catalogue, const DriverTable& drivers,
                       const JointFit& named) {
  constexpr double step_s = 60.0;
  constexpr int rounds = 2;
  const auto at = [&](double by_s) { return chi2At(problem, catalogue, drivers, named.terms, by_s, rounds); };
  const double curvature = at(step_s) + at(-step_s) - 2.0 * at(0.0);
  if (!(curvature > 0.0)) return 0.0;
  const double uncertainty_s = step_s * std::sqrt(2.0 / curvature);
  return std::max(0.0, 2.0 * std::log(far_clock_step_s / (std::sqrt(2.0 * std::numbers::pi) * uncertainty_s)));
}

std::optional<ClockOffset> farLogClock(const std::function<double(double)>& evidence_at) {
  double best = evidence_at(0.0);
  double best_s = 0.0;
  const auto look = [&](double by_s) {
    const double evidence = evidence_at(by_s);
    if (evidence > best) {
      best = evidence;
      best_s = by_s;
    }
    return evidence;
  };
  std::map<double, double> coarse;
  for (int k = 1; k <= far_clock_steps; ++k) {
    for (const double by_s : {k * far_clock_step_s, -k * far_clock_step_s}) coarse[by_s] = look(by_s);
  }
  if (best_s == 0.0) return std::nullopt;
  for (double step_s = 0.5 * far_clock_step_s; step_s >= far_clock_resolution_s; step_s *= 0.5) {
    const double about_s = best_s;
    look(about_s - step_s);
    look(about_s + step_s);
  }
  double weight = 0.0;
  double square = 0.0;
  for (const auto& [by_s, evidence] : coarse) {
    const double w = std::exp(0.5 * (evidence - best));
    weight += w;
    square += w * std::pow(by_s - best_s, 2);
  }
  const double spread = weight > 0.0 ? std::sqrt(square / weight) : 0.0;
  return ClockOffset{best_s, std::hypot(far_clock_resolution_s, spread)};
}

}  // namespace spindrift
