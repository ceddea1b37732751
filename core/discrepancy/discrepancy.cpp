// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/discrepancy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/base/text.h"
#include "core/discrepancy/comparable_rows.h"
#include "core/discrepancy/discrepancy_numbers.h"
#include "core/discrepancy/discrepancy_search.h"
#include "core/discrepancy/distributed_dynamics.h"
#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/verdict.h"

namespace spindrift {
namespace {

using Eigen::Index;

constexpr std::size_t unit_limit = 3000;

/// Every id of the user's lists is one that this machine can have.
void checkIds(const DiscrepancyOptions& options, const std::vector<Effect>& catalogue) {
  for (const auto* list : {&options.accept, &options.reject}) {
    for (const std::string& id : *list) {
      if (std::any_of(catalogue.begin(), catalogue.end(), [&](const Effect& e) { return e.id == id; })) continue;
      std::vector<std::string> known;
      for (const Effect& e : catalogue) known.push_back(e.id);
      throw InputError(fmt::format("effect \"{}\" is not one that this machine can have; allowed: {}.", id,
                                   joinedList(known, "or")));
    }
  }
}

/// Searches, and once more where the noise looks different without the signal that was found.
SearchOutcome searchTwice(EffectSearch& search, ResidualProblem& problem, const std::vector<NuisanceColumn>& base,
                          const DiscrepancyOptions& options, const SearchLimits& limits, const JobContext& job) {
  SearchOutcome outcome = searchEffects(search, problem, base, options, limits, job);
  if (outcome.fit.terms.empty() || outcome.explained_fraction < 0.9) return outcome;
  Eigen::VectorXd left = problem.y;
  for (const Eigen::VectorXd& part : outcome.fit.contribution) left -= part;
  const NoiseModel again = estimateNoise(problem, left, true);
  const double change = std::abs(again.correlated_part - problem.noise.correlated_part);
  if (!(change > 0.25) && !(again.scale < 0.8 * problem.noise.scale)) return outcome;
  const NoiseModel before = problem.noise;
  problem.setNoise(again);
  SearchOutcome second = searchEffects(search, problem, base, options, limits, job);
  // A noise under which effects leave something that left nothing before is not the better one.
  if (second.leftover_p_value < limits.leftover_p && outcome.leftover_p_value >= limits.leftover_p) {
    problem.setNoise(before);
    return outcome;
  }
  return second;
}

/// Everything that the numbers of a result are made of.
struct Solution {
  const DiscrepancyInput& input;
  const ComparableRows& rows;
  const EffectSearch& search;
  ResidualProblem& problem;
  std::shared_ptr<const DriverTable> drivers;
  const SearchOutcome& outcome;
  const SearchLimits& limits;
  JudgedOutcome judged;
  std::vector<ModelEffect> effects;   ///< gains of the joint fit
  std::vector<ModelEffect> averaged;  ///< the same, over all dynamics that the data allow: what predicts
};

/// Gains with their covariance, and the model that predicts.
void fitModel(Solution& solution) {
  const SearchOutcome& outcome = solution.outcome;
  const double chi2_scale = std::max(1.0, outcome.chi2_after / std::max(1.0, static_cast<double>(outcome.dof_before)));
  const auto withCovariance = [&](const JointFit& fit, const std::vector<Eigen::VectorXd>& prior_sigma) {
    return modelEffects(solution.search, solution.problem, fit, "fit of the residual", chi2_scale, prior_sigma);
  };
  solution.effects = withCovariance(solution.judged.named, {});
  std::vector<std::vector<ModelEffect>> versions;
  std::vector<double> weights;
  for (const WeightedDynamics& w :
       alternativeDynamics(solution.search, solution.problem, *solution.drivers, solution.judged.named)) {
    versions.push_back(withCovariance(w.distributed.fit, w.distributed.prior_sigma));
    weights.push_back(w.weight);
  }
  solution.averaged = averagedEffects(versions, weights);
}

/// What the first `count` effects make of every row, with their own gains as they were when the last of them entered.
std::vector<double> partOfFirst(const Solution& solution, std::size_t count) {
  const auto& observations = solution.input.observations.rows;
  std::vector<ModelEffect> effects = solution.averaged;
  if (count < effects.size()) {
    effects.assign(solution.effects.begin(), solution.effects.begin() + static_cast<std::ptrdiff_t>(count));
    const auto& terms = solution.judged.named.terms;
    const std::vector<ModelTerm> first(terms.begin(), terms.begin() + static_cast<std::ptrdiff_t>(count));
    const JointFit fit =
        distributedDynamics(solution.search, solution.problem, *solution.drivers, solution.search.solve(first)).fit;
    for (std::size_t k = 0; k < count; ++k) {
      effects[k].variant = fit.terms[k].variant;
      effects[k].parameters = fit.terms[k].parameters;
      effects[k].gains = fit.gains[k];
    }
  }
  std::vector<double> part(observations.size(), 0.0);
  for (const ModelEffect& effect : effects) {
    const std::vector<double> one = EffectModel::contribution(*solution.drivers, effect, observations);
    for (std::size_t r = 0; r < part.size(); ++r) part[r] += one[r];
  }
  return part;
}

/// rms of a contribution over the units in the displacement in which it is largest, um.
double largestRms(const ResidualProblem& problem, const Eigen::VectorXd& contribution) {
  double largest = 0.0;
  for (const Component c : all_components) {
    double power = 0.0;
    double count = 0.0;
    for (Index u = 0; u < problem.size(); ++u) {
      if (problem.component[static_cast<std::size_t>(u)] != c) continue;
      power += contribution[u] * contribution[u];
      count += 1.0;
    }
    if (count > 0.0 && !isRotation(c)) largest = std::max(largest, std::sqrt(power / count));
  }
  return largest;
}

/// Effect `t` as it is told, but for its held-out rows.
FoundEffect describedEffect(const Solution& solution, std::size_t t) {
  const ModelEffect& e = solution.effects[t];
  const TermEvidence& evidence = solution.judged.evidence[t];
  FoundEffect found;
  found.id = e.effect.id;
  found.physics = e.effect.physics;
  found.drivers = driversText(e);
  found.delta_bic = evidence.delta_bic;
  found.delta_chi2 = evidence.delta_chi2;
  found.margin = std::min(evidence.margin, 1e6);
  found.forced = solution.judged.forced[t];
  found.crossvalidated_rms_before_um = evidence.crossvalidation.before_um;
  found.crossvalidated_rms_after_um = evidence.crossvalidation.after_um;
  const auto gain_names = e.gainNames(*solution.drivers);
  for (std::size_t g = 0; g < gain_names.size(); ++g) {
    const auto at = static_cast<Index>(g);
    found.parameters.push_back({gain_names[g], e.gains[at], e.gain_uncertainty[at]});
  }
  const auto names = parameterNames(e.variant);
  for (std::size_t p = 0; p < names.size(); ++p) {
    found.parameters.push_back({names[p], e.parameters[p], e.parameter_uncertainty[p]});
  }
  for (const RivalFit& r : evidence.rivals) {
    (r.container && !r.undecided ? found.containers : found.rivals).push_back(r.id);
  }
  found.rms_um = largestRms(solution.problem, solution.judged.named.contribution[t]);
  found.confidence = confidenceOf(solution.outcome, evidence, solution.judged.named, t, solution.limits);
  return found;
}

/// rms of the stated sigma over the fitted displacements, times the scale of the noise, um.
double noiseFloor(const DiscrepancyInput& input, const std::vector<std::size_t>& fit_rows, double noise_scale) {
  double power = 0.0;
  double count = 0.0;
  for (const std::size_t row : fit_rows) {
    const Observation& o = input.observations.rows[row];
    if (isRotation(o.component)) continue;
    power += o.sigma * o.sigma;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(power / count) * noise_scale : 0.0;
}

/// Effects, and the gap as it shrinks with each; simulation and completed model per row.
void tellEffects(const Solution& solution, DiscrepancyResult& result) {
  const DiscrepancyInput& input = solution.input;
  std::vector<double> part(input.predicted.size(), 0.0);
  const RowResult before = evaluateRows(input, solution.rows.fit, solution.rows.held_out, part);
  const bool has_holdout = before.holdout_rows > 0;
  RowResult last = before;
  for (std::size_t t = 0; t < solution.effects.size(); ++t) {
    part = partOfFirst(solution, t + 1);
    const RowResult now = evaluateRows(input, solution.rows.fit, solution.rows.held_out, part);
    FoundEffect found = describedEffect(solution, t);
    found.heldout_rms_before_um = has_holdout ? last.holdout_rms : found.crossvalidated_rms_before_um;
    found.heldout_rms_after_um = has_holdout ? now.holdout_rms : found.crossvalidated_rms_after_um;
    for (const RivalFit& r : solution.judged.evidence[t].rivals) {
      if (!r.undriven) continue;
      result.warnings.push_back(
          fmt::format("{} cannot be told from {}, because the log lacks what drives the latter: log it next time.",
                      found.id, r.id));
    }
    result.effects.push_back(std::move(found));
    last = now;
  }
  result.gap.rms_before_um = before.fit_rms;
  result.gap.rms_after_um = last.fit_rms;
  result.gap.heldout_rms_before_um = before.holdout_rms;
  result.gap.heldout_rms_after_um = last.holdout_rms;
  if (!has_holdout && !result.effects.empty()) {
    result.gap.heldout_rms_before_um = result.effects.front().heldout_rms_before_um;
    result.gap.heldout_rms_after_um = result.effects.back().heldout_rms_after_um;
  }
  result.gap.noise_um = noiseFloor(input, solution.rows.fit, result.noise_scale);
  result.constant = last.constant;
  result.simulated = input.predicted;
  result.completed.resize(part.size());
  for (std::size_t r = 0; r < part.size(); ++r) result.completed[r] = input.predicted[r] + part[r];
  result.effect_part = std::move(part);
}

/// For the first effect with a rival that a measurement can separate.
std::optional<MeasurementSuggestion> suggestionFor(const Solution& solution) {
  const JudgedOutcome& judged = solution.judged;
  for (std::size_t t = 0; t < judged.evidence.size(); ++t) {
    for (const RivalFit& rival : judged.evidence[t].rivals) {
      if ((rival.container && !rival.undecided) || rival.undriven) continue;
      auto suggestion = suggestMeasurement(
          solution.input, *solution.drivers, solution.search, solution.problem, judged.named, rival.joint,
          judged.named.terms[t].effect->id + " from " + rival.id, solution.search.logN());
      if (suggestion) return suggestion;
      break;
    }
  }
  return std::nullopt;
}

std::string sentenceOf(const DiscrepancyResult& result, const DiscrepancyOptions& options) {
  switch (result.verdict) {
    case DiscrepancyVerdict::None:
      return "Measurement and simulation agree within the noise.";
    case DiscrepancyVerdict::Unknown:
      return options.max_effects == 0 ? "Something disagrees; no effect was tried."
                                      : "Something disagrees that no effect of the catalogue explains.";
    case DiscrepancyVerdict::Named:
    case DiscrepancyVerdict::Ambiguous:
      break;
  }
  std::vector<std::string> names;
  for (const FoundEffect& e : result.effects) names.push_back(e.id);
  const bool ambiguous = result.verdict == DiscrepancyVerdict::Ambiguous;
  return fmt::format("Missing in the simulation: {}{}.", joinedList(names),
                     ambiguous ? "; these data cannot tell at least one of them from its rivals" : "");
}

/// What too few observations leave to say.
void tellUndecided(const Solution& solution, DiscrepancyResult& result) {
  std::set<std::string> states;
  for (const std::size_t row : solution.rows.fit) states.insert(solution.input.observations.rows[row].state);
  const auto counted = [](std::size_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
  };
  const int series = solution.problem.seriesCount();
  result.message = fmt::format(
      "{} in {} leave too little beyond the free constant of each of {} series: which effect is missing, its lag and "
      "whether it is one at all cannot be decided; measure {}.",
      counted(solution.rows.fit.size(), "observation", "observations"), counted(states.size(), "state", "states"),
      series, states.size() < 4 ? "at least 4 states and several points" : "more states or more points");
  if (solution.outcome.leftover_p_value >= solution.limits.leftover_p) result.verdict = DiscrepancyVerdict::Unknown;
  if (result.leftover.empty()) result.leftover = "too few observations to decide";
}

}  // namespace

std::string_view toString(DiscrepancyVerdict verdict) noexcept {
  switch (verdict) {
    case DiscrepancyVerdict::Named:
      return "named";
    case DiscrepancyVerdict::Ambiguous:
      return "ambiguous";
    case DiscrepancyVerdict::Unknown:
      return "unknown";
    case DiscrepancyVerdict::None:
      return "none";
  }
  return "none";
}

void DiscrepancyOptions::validate() const {
  if (max_effects < 0 || max_effects > 10) {
    throw InputError(fmt::format("max_effects {} is not allowed; allowed: 0 to 10.", max_effects));
  }
  if (!(false_alarm_rate > 0.0) || false_alarm_rate > 0.2) {
    throw InputError(
        fmt::format("false_alarm_rate {} is not allowed; allowed: above 0, at most 0.2.", false_alarm_rate));
  }
}

DiscrepancyResult findDiscrepancy(const DiscrepancyInput& input, const DiscrepancyOptions& options, JobContext& job) {
  options.validate();
  SPINDRIFT_ASSERT(input.predicted.size() == input.observations.rows.size(), "one prediction for every observation");
  DiscrepancyResult result;
  const ComparableRows rows = comparableRows(input, result.warnings);
  result.unmatched = rows.unmatched;
  checkUnits(input, rows.fit);

  job.report(0.0, "preparing");
  const auto drivers = std::make_shared<const DriverTable>(input.machine, input.log ? &*input.log : nullptr);
  warnAboutLog(input, *drivers, result.warnings);
  ResidualProblem problem(input, rows.fit, unit_limit);
  const std::vector<Effect> catalogue = effectCatalogue(catalogueContext(input, *drivers, problem));
  warnAboutUndecidable(input, catalogue, result.warnings);
  checkIds(options, catalogue);
  EffectSearch search(problem, *drivers, catalogue);
  const std::vector<NuisanceColumn> base = problem.simulationNuisances(input.simulation_gain_uncertainty);
  problem.setNuisances(base);
  problem.setNoise(estimateNoise(problem, problem.y, false));

  const bool enough = problem.degreesOfFreedom() >= 12 && problem.epoch_count >= 4;
  DiscrepancyOptions effective = options;
  if (!enough) effective.max_effects = 0;
  const SearchLimits limits;
  const SearchOutcome outcome = enough ? searchTwice(search, problem, base, effective, limits, job)
                                       : searchEffects(search, problem, base, effective, limits, job);
  result.noise_scale = problem.noise.scale;
  result.noise_correlated_part = problem.noise.correlated_part;
  result.noise_correlation_time_s = problem.noise.correlation_time_s;
  if (result.noise_scale < 0.88 || result.noise_scale > 1.12) {
    result.warnings.push_back(
        fmt::format("The scatter is {:.2f} times the stated sigma; it is used as found.", result.noise_scale));
  }
  result.steps = outcome.steps;
  result.explained_fraction = outcome.explained_fraction;
  result.leftover_p_value = outcome.leftover_p_value;
  if (!outcome.fit.terms.empty()) result.unknown_advantage = outcome.unknown_course.advantage;

  Solution solution{input, rows, search, problem, drivers, outcome, limits, {}, {}, {}};
  solution.judged = judgeOutcome(search, problem, base, outcome, limits);
  result.verdict = solution.judged.verdict;
  result.leftover = solution.judged.leftover;
  problem.setNuisances(base);
  fitModel(solution);
  result.model = std::make_shared<EffectModel>(drivers, solution.averaged, nullptr, input.base_table);
  tellEffects(solution, result);
  result.where = findPlaces(problem, *drivers, problem.projectedResidual().head(problem.size()));
  if (options.suggest && enough) result.suggestion = suggestionFor(solution);

  result.decided = enough;
  result.status = enough ? FitStatus::Converged : FitStatus::Degenerate;
  if (enough) {
    result.message = sentenceOf(result, options);
  } else {
    tellUndecided(solution, result);
  }
  job.report(1.0, "done");
  return result;
}

}  // namespace spindrift
