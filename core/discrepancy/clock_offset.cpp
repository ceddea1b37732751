// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/clock_offset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text.h"

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

}  // namespace

std::optional<ClockOffset> estimateClockOffset(const ResidualProblem& problem, const std::vector<Effect>& catalogue,
                                               const DriverTable& drivers, const JointFit& fit, double present_s,
                                               double prior_s) {
  if (std::none_of(fit.terms.begin(), fit.terms.end(), drivenByLog) || drivers.empty()) return std::nullopt;
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

std::string farClockOffset(const ResidualProblem& problem, const std::vector<Effect>& catalogue,
                           const DriverTable& drivers, const JointFit& named) {
  const bool from_log = std::any_of(named.terms.begin(), named.terms.end(),
                                    [](const ModelTerm& term) { return !term.variant.inputs[0].driver.empty(); });
  if (!from_log) return {};
  constexpr double step_s = 1200.0;
  constexpr int most_steps = 12;
  const double now = chi2At(problem, catalogue, drivers, named.terms, 0.0, 2);
  double best = now;
  int best_step = 0;
  for (int k = -most_steps; k <= most_steps; ++k) {
    if (k == 0) continue;
    const double value = chi2At(problem, catalogue, drivers, named.terms, k * step_s, 2);
    if (value < best) {
      best = value;
      best_step = k;
    }
  }
  // In 2 ln of the likelihood, the best of so many offsets.
  constexpr double beyond_doubt = 20.0;
  if (now - best < beyond_doubt) return {};
  std::vector<std::string> ids;
  for (const ModelTerm& term : named.terms) ids.push_back(term.effect->id);
  return fmt::format(
      "{} would fit far better if the clock of the log were {:.0f} min {} that of the observations: compare the "
      "clocks.",
      joinedList(ids), std::abs(best_step) * step_s / 60.0, best_step > 0 ? "ahead of" : "behind");
}

}  // namespace spindrift
