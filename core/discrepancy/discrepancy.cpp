// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/discrepancy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/base/text.h"
#include "core/discrepancy/discrepancy_analysis.h"
#include "core/discrepancy/discrepancy_numbers.h"
#include "core/discrepancy/distributed_dynamics.h"
#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/effect_posterior.h"
#include "core/discrepancy/judgement.h"
#include "core/discrepancy/places.h"
#include "core/discrepancy/simulator_hypotheses.h"
#include "core/discrepancy/suggestion.h"
#include "core/discrepancy/told_noise.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// Everything that the numbers of a result are made of.
struct Solution {
  const DiscrepancyInput& input;
  const ComparableRows& rows;
  ResidualProblem& problem;
  const Analysis& analysis;
  Judgement judged;
  std::vector<ModelEffect> effects;   ///< gains of the joint fit
  std::vector<ModelEffect> averaged;  ///< the same, over all dynamics that the data allow: what predicts
};

/// Gains with their covariance, and the model that predicts.
void fitModel(Solution& solution) {
  const EffectSearch& search = *solution.analysis.search;
  const JointFit& named = solution.judged.named;
  solution.effects = modelEffects(search, solution.problem, named, "fit of the residual", 1.0);
  solution.averaged = predictingEffects(search, solution.problem, *solution.analysis.drivers, named);
}

/// What the first `count` effects make of every row, with their own gains as they were when the last of them entered.
std::vector<double> partOfFirst(const Solution& solution, std::size_t count) {
  const auto& observations = solution.input.observations.rows;
  std::vector<ModelEffect> effects = solution.averaged;
  if (count < effects.size()) {
    effects.assign(solution.effects.begin(), solution.effects.begin() + static_cast<std::ptrdiff_t>(count));
    const auto& terms = solution.judged.named.terms;
    const std::vector<ModelTerm> first(terms.begin(), terms.begin() + static_cast<std::ptrdiff_t>(count));
    const JointFit fit = distributedDynamics(*solution.analysis.search, solution.problem, *solution.analysis.drivers,
                                             solution.analysis.search->solve(first))
                             .fit;
    for (std::size_t k = 0; k < count; ++k) {
      effects[k].variant = fit.terms[k].variant;
      effects[k].parameters = fit.terms[k].parameters;
      effects[k].gains = fit.gains[k];
    }
  }
  std::vector<double> part(observations.size(), 0.0);
  for (const ModelEffect& effect : effects) {
    const std::vector<double> one = EffectModel::contribution(*solution.analysis.drivers, effect, observations);
    for (std::size_t r = 0; r < part.size(); ++r) part[r] += one[r];
  }
  return part;
}

/// rms of a contribution over the units in the displacement in which it is largest, um; in the rotation, urad, where
/// nothing else was observed.
double largestRms(const ResidualProblem& problem, const Eigen::VectorXd& contribution) {
  double largest = 0.0;
  const bool rotations = std::all_of(problem.component.begin(), problem.component.end(), isRotation);
  for (const Component c : all_components) {
    double power = 0.0;
    double count = 0.0;
    for (Index u = 0; u < problem.size(); ++u) {
      if (problem.component[static_cast<std::size_t>(u)] != c) continue;
      power += contribution[u] * contribution[u];
      count += 1.0;
    }
    if (count > 0.0 && isRotation(c) == rotations) largest = std::max(largest, std::sqrt(power / count));
  }
  return largest;
}

/// Effect `t` as it is told, but for its held-out rows.
FoundEffect describedEffect(const Solution& solution, std::size_t t) {
  const ModelEffect& e = solution.effects[t];
  const NamedEffect& name = solution.judged.names[t];
  FoundEffect found;
  found.id = e.effect.id;
  found.physics = e.effect.physics;
  if (e.effect.own) found.title = e.effect.title;
  found.drivers = driversText(e);
  found.delta_bic = name.delta_evidence;
  found.delta_chi2 = name.delta_chi2;
  found.margin = std::min(name.margin, 1e6);
  found.forced = name.forced;
  found.confidence = name.confidence;
  found.rivals = name.rivals;
  found.containers = name.containers;
  const auto gain_names = e.gainNames(*solution.analysis.drivers);
  for (std::size_t g = 0; g < gain_names.size(); ++g) {
    const auto at = static_cast<Index>(g);
    found.parameters.push_back({gain_names[g], e.gains[at], e.gain_uncertainty[at]});
  }
  const auto names = parameterNames(e.variant);
  for (std::size_t p = 0; p < names.size(); ++p) {
    found.parameters.push_back({names[p], e.parameters[p], e.parameter_uncertainty[p]});
  }
  solution.analysis.hypotheses.describe(found, e.gains[0], e.gain_uncertainty[0]);
  found.rms_um = largestRms(solution.problem, solution.judged.named.contribution[t]);
  return found;
}

/// Without rows that are held out: rms of states that were left out, before and after each effect.
void crossValidate(const Solution& solution, DiscrepancyResult& result) {
  const EffectSearch& search = *solution.analysis.search;
  for (std::size_t t = 0; t < result.effects.size(); ++t) {
    const auto& terms = solution.judged.named.terms;
    const std::vector<ModelTerm> before(terms.begin(), terms.begin() + static_cast<std::ptrdiff_t>(t));
    const std::vector<ModelTerm> after(terms.begin(), terms.begin() + static_cast<std::ptrdiff_t>(t + 1));
    const auto cv = search.crossValidate(before, after, solution.problem.nuisances());
    result.effects[t].crossvalidated_rms_before_um = cv.before_um;
    result.effects[t].crossvalidated_rms_after_um = cv.after_um;
  }
}

/// rms of the noise of single readings as found, over the fitted displacements, shifts of states included, um.
double noiseFloor(const DiscrepancyInput& input, const ResidualProblem& problem,
                  const std::vector<std::size_t>& fit_rows, bool rotations) {
  double power = 0.0;
  double count = 0.0;
  for (const std::size_t row : fit_rows) {
    const Observation& o = input.observations.rows[row];
    if (isRotation(o.component) != rotations) continue;
    const ComponentNoise& n = problem.noise.of(o.component);
    power += std::pow(o.sigma * n.scale, 2) * n.varianceOfStudent() + n.common * n.common;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(power / count) : 0.0;
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
    found.heldout_rms_before_um = last.holdout_rms;
    found.heldout_rms_after_um = now.holdout_rms;
    result.effects.push_back(std::move(found));
    last = now;
  }
  crossValidate(solution, result);
  if (!has_holdout) {
    for (FoundEffect& found : result.effects) {
      found.heldout_rms_before_um = found.crossvalidated_rms_before_um;
      found.heldout_rms_after_um = found.crossvalidated_rms_after_um;
    }
  }
  result.gap.rms_before_um = before.fit_rms;
  result.gap.rms_after_um = last.fit_rms;
  result.gap.heldout_rms_before_um = before.holdout_rms;
  result.gap.heldout_rms_after_um = last.holdout_rms;
  if (!has_holdout && result.effects.empty()) {
    result.gap.heldout_rms_before_um = result.gap.heldout_rms_after_um = std::nan("");
  } else if (!has_holdout) {
    result.gap.heldout_rms_before_um = result.effects.front().heldout_rms_before_um;
    result.gap.heldout_rms_after_um = result.effects.back().heldout_rms_after_um;
  }
  result.gap.noise_um = noiseFloor(input, solution.problem, solution.rows.fit, before.rotations);
  result.gap.rotations = before.rotations;
  result.constant = last.constant;
  result.simulated = input.predicted;
  result.completed.resize(part.size());
  for (std::size_t r = 0; r < part.size(); ++r) result.completed[r] = input.predicted[r] + part[r];
  result.effect_part = std::move(part);
}

/// Where what is named is a part of the simulation: by how much that is off. Returns these.
std::vector<std::string> tellErrorsOfParts(const Solution& solution, DiscrepancyResult& result) {
  std::vector<std::string> parts;
  if (solution.input.tangents) return parts;  // a simulator's own parameters are put into it (into_simulation.h)
  const JointFit& named = solution.judged.named;
  for (std::size_t t = 0; t < solution.effects.size(); ++t) {
    const ModelEffect& effect = solution.effects[t];
    const auto part = std::find_if(solution.analysis.parts.begin(), solution.analysis.parts.end(),
                                   [&](const SimulationPart& p) { return p.id == named.terms[t].effect->id; });
    if (part == solution.analysis.parts.end() || effect.gains.size() == 0) continue;
    Eigen::Index largest = 0;
    effect.gains.cwiseQuotient(effect.gain_uncertainty.cwiseMax(1e-300)).cwiseAbs().maxCoeff(&largest);
    const std::optional<PartError> error =
        partError(solution.problem, *part, named.contribution[t],
                  effect.gain_uncertainty[largest] / std::max(1e-300, std::abs(effect.gains[largest])));
    if (!error) continue;
    result.warnings.push_back(fmt::format("The simulation has {} already: {:.0f} ± {:.0f} % too {} of it.", error->id,
                                          100.0 * std::abs(error->relative), std::max(1.0, 100.0 * error->uncertainty),
                                          error->relative > 0.0 ? "much" : "little"));
    parts.push_back(error->id);
  }
  return parts;
}

/// The most probable candidates, and what each that was rejected is given up for.
void tellCandidates(const EffectPosterior& posterior, const DiscrepancyOptions& options, DiscrepancyResult& result) {
  const auto rejected = [&](const std::string& id) {
    return std::find(options.reject.begin(), options.reject.end(), id) != options.reject.end();
  };
  constexpr std::size_t most = 10;
  for (const auto& [id, probability] : posterior.candidates) {
    if (result.candidates.size() < most) result.candidates.push_back({id, probability, rejected(id)});
  }
  for (const std::string& id : options.reject) {
    const auto found = std::find_if(posterior.candidates.begin(), posterior.candidates.end(),
                                    [&](const auto& c) { return c.first == id; });
    constexpr double worth_telling = 0.005;
    if (found == posterior.candidates.end() || found->second < worth_telling) {
      result.warnings.push_back(fmt::format("{} was rejected by hand; the data do not ask for it either.", id));
      continue;
    }
    std::vector<std::string> others;
    for (const auto& [other, probability] : posterior.candidates) {
      if (!rejected(other) && probability >= worth_telling && others.size() < 3)
        others.push_back(fmt::format("{} {:.2f}", other, probability));
    }
    result.warnings.push_back(fmt::format("{} was rejected by hand; with it considered its probability is {:.2f}{}.",
                                          id, found->second, others.empty() ? "" : ", beside " + joinedList(others)));
  }
}

/// `parts`: effects found that the simulation has, of another size.
std::string sentenceOf(const DiscrepancyResult& result, const std::vector<std::string>& parts,
                       const DiscrepancyOptions& options) {
  const NoiseEstimate* far = farAboveStated(result.noise);
  switch (result.verdict) {
    case DiscrepancyVerdict::None:
      if (result.gap.withinNoise() && far != nullptr) {
        return fmt::format(
            "Nothing stands out of the scatter, but the readings of {} scatter {:.0f} times as much as their stated "
            "σ: what is smaller would not show.",
            toString(far->component), far->scale);
      }
      return result.gap.withinNoise() ? "Measurement and simulation agree within the noise."
                                      : "Measurement and simulation differ by no more than a rough simulation may be "
                                        "off by; nothing is missing beyond that.";
    case DiscrepancyVerdict::Unknown:
      return options.max_effects == 0 ? "Measurement and simulation differ; no effect was tried."
                                      : "Measurement and simulation differ; no effect of the catalogue explains it.";
    case DiscrepancyVerdict::Named:
    case DiscrepancyVerdict::Ambiguous:
      break;
  }
  std::vector<std::string> missing;
  for (const FoundEffect& e : result.effects)
    if (std::find(parts.begin(), parts.end(), e.id) == parts.end()) missing.push_back(e.id);
  const char* rivals = result.verdict == DiscrepancyVerdict::Ambiguous
                           ? "; these data do not distinguish at least one of them from its rivals"
                           : "";
  if (parts.empty()) return fmt::format("Missing in the simulation: {}{}.", joinedList(missing), rivals);
  if (missing.empty()) return fmt::format("Of the wrong size in the simulation: {}{}.", joinedList(parts), rivals);
  return fmt::format("Missing in the simulation: {}; of the wrong size in it: {}{}.", joinedList(missing),
                     joinedList(parts), rivals);
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
      "{} in {}: too few observations per series after removing the offset of each of {} series, so the missing "
      "effect, its time constant and whether it is one at all cannot be decided; measure {}.",
      counted(solution.rows.fit.size(), "observation", "observations"), counted(states.size(), "state", "states"),
      series, states.size() < 4 ? "at least 4 states and several points" : "more states or more points");
  result.verdict = DiscrepancyVerdict::Unknown;
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

const NoiseEstimate* farAboveStated(const std::vector<NoiseEstimate>& noise) {
  constexpr double far = 3.0;
  const auto most = std::max_element(noise.begin(), noise.end(),
                                     [](const NoiseEstimate& a, const NoiseEstimate& b) { return a.scale < b.scale; });
  return most != noise.end() && most->scale > far ? &*most : nullptr;
}

const NoiseEstimate* DiscrepancyResult::noiseOf(Component component) const {
  const auto found =
      std::find_if(noise.begin(), noise.end(), [&](const NoiseEstimate& n) { return n.component == component; });
  return found == noise.end() ? nullptr : &*found;
}

double DiscrepancyResult::readingSigma(Component component, double sigma) const {
  const NoiseEstimate* found = noiseOf(component);
  return found == nullptr ? sigma : std::hypot(sigma * found->scale, found->common_um);
}

void DiscrepancyOptions::validate() const {
  if (max_effects < 0 || max_effects > 10) {
    throw InputError(fmt::format("max_effects {} is not allowed; allowed: 0 to 10.", max_effects));
  }
  if (!(suggest_hours > 0.0) || suggest_hours > 72.0) {
    throw InputError(
        fmt::format("{} hours for the next measurement are not allowed; allowed: above 0, at most 72.", suggest_hours));
  }
  if (suggest_points < 1 || suggest_points > 50) {
    throw InputError(
        fmt::format("{} points for the next measurement are not allowed; allowed: 1 to 50.", suggest_points));
  }
  if (suggest_times < 3 || suggest_times > 200) {
    throw InputError(
        fmt::format("{} times for the next measurement are not allowed; allowed: 3 to 200.", suggest_times));
  }
  if (!(false_alarm_rate > 0.0) || false_alarm_rate > 0.2) {
    throw InputError(
        fmt::format("false_alarm_rate {} is not allowed; allowed: above 0, at most 0.2.", false_alarm_rate));
  }
}

DiscrepancyResult findDiscrepancy(const DiscrepancyInput& given, const DiscrepancyOptions& options, JobContext& job) {
  options.validate();
  SPINDRIFT_ASSERT(given.predicted.size() == given.observations.rows.size(), "one prediction for every observation");
  const DiscrepancyPriors priors;
  const JudgedAnalysis answer = judgedAnalysis(given, options, priors, job);
  const DiscrepancyInput& input = *answer.input;
  ResidualProblem& problem = *answer.problem;
  const Analysis& analysis = *answer.analysis;
  const ComparableRows& rows = answer.rows;

  DiscrepancyResult result;
  result.warnings = answer.warnings;
  result.unmatched = rows.unmatched;
  result.sensors = analysis.drivers->sensors();
  result.clock_offset_s = answer.log_clock_s + analysis.clock_offset_s + analysis.simulation_clock_s;
  const bool found_far_off = answer.log_clock_s != input.log_clock_s;
  result.clock_offset_uncertainty_s =
      std::hypot(answer.log_clock_uncertainty_s, analysis.clock_uncertainty_s, analysis.simulation_clock_uncertainty_s);
  if (found_far_off) {
    result.warnings.push_back(
        fmt::format("What is named fits the log as if its clock were about {:.0f} min {} that of the observations, and "
                    "is told with "
                    "it: compare the clocks.",
                    std::abs(result.clock_offset_s) / 60.0, result.clock_offset_s > 0.0 ? "ahead of" : "behind"));
  } else if (input.log_clock_s != given.log_clock_s) {
    result.warnings.push_back(fmt::format(
        "The clock of log and simulation is {:.0f} s {} that of the observations, as far as the data show it (± {:.0f} "
        "s), so they are compared with both at that time.",
        std::abs(result.clock_offset_s), result.clock_offset_s > 0.0 ? "ahead of" : "behind",
        result.clock_offset_uncertainty_s));
  } else if (std::abs(result.clock_offset_s - given.log_clock_s) > 30.0) {
    result.warnings.push_back(fmt::format(
        "The clock of the log is {:.0f} s {} that of the observations, as far as the data show it (± {:.0f} s).",
        std::abs(result.clock_offset_s), result.clock_offset_s > 0.0 ? "ahead of" : "behind",
        result.clock_offset_uncertainty_s));
  }

  Solution solution{input, rows, problem, analysis, answer.judged, {}, {}};
  result.verdict = solution.judged.verdict;
  result.leftover = solution.judged.leftover;
  result.steps = solution.judged.steps;
  result.explained_fraction = solution.judged.explained_fraction;
  tellCandidates(analysis.posterior, options, result);
  fitModel(solution);
  result.model = std::make_shared<EffectModel>(analysis.drivers, solution.averaged, nullptr, input.base_table);
  tellEffects(solution, result);
  const std::vector<std::string> parts = tellErrorsOfParts(solution, result);
  tellNoise(problem, analysis.posterior.fit, analysis.remainder, input.observations.rows, result);
  result.noise_model = std::make_shared<const NoiseModel>(problem.noise);
  result.twins = analysis.hypotheses.twins(problem);
  for (const auto& [a, b] : result.twins) {
    result.warnings.push_back(fmt::format(
        "{} and {} of the simulation have the same effect on the observations and cannot be distinguished.", a, b));
  }
  result.where = findPlaces(problem, *analysis.drivers, problem.projectedResidual().head(problem.size()));
  if (options.suggest && answer.enough && result.verdict == DiscrepancyVerdict::Ambiguous) {
    std::vector<std::string> ambiguous;
    for (const NamedEffect& name : solution.judged.names) {
      const bool of_catalogue = analysis.hypotheses.find(name.id) == nullptr &&
                                std::none_of(name.rivals.begin(), name.rivals.end(), [&](const std::string& rival) {
                                  return analysis.hypotheses.find(rival) != nullptr;
                                });
      // What a simulator would predict for another programme is not known here.
      if (!name.rivals.empty() && of_catalogue) ambiguous.push_back(name.id);
    }
    if (!ambiguous.empty())
      result.suggestion = suggestMeasurement(input, *analysis.drivers, *analysis.search, problem, analysis.posterior,
                                             ambiguous, answer.options, priors, job);
  }

  warnAboutSensors(result.sensors, result.warnings);
  result.decided = answer.enough;
  result.status = answer.enough ? FitStatus::Converged : FitStatus::Degenerate;
  if (answer.enough) {
    result.message = sentenceOf(result, parts, options);
  } else {
    tellUndecided(solution, result);
  }
  job.report(1.0, "done");
  return result;
}

}  // namespace spindrift
