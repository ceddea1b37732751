// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/discrepancy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text.h"
#include "core/discrepancy/discrepancy_numbers.h"
#include "core/discrepancy/discrepancy_search.h"
#include "core/discrepancy/distributed_dynamics.h"
#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/log_gaps.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

using Eigen::Index;

constexpr std::size_t unit_limit = 3000;

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
  const auto& rows = input.observations.rows;
  SPINDRIFT_ASSERT(input.predicted.size() == rows.size(), "one prediction for every observation");
  DiscrepancyResult result;
  std::vector<std::size_t> fit_rows;
  std::size_t usable = 0;
  std::size_t beyond_log = 0;
  double log_end = std::numeric_limits<double>::infinity();
  std::vector<LogGap> gaps;
  if (input.log && input.log->time_s().size() > 1) {
    const auto& t = input.log->time_s();
    std::vector<double> steps;
    for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
    log_end = t.back() + std::max(300.0, 2.0 * median(steps));
    gaps = logGaps(t);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].use == ObservationUse::Exclude) continue;
    if (!(rows[i].sigma > 0.0)) {
      throw InputError({input.observations.file, fmt::format("row {}", i + 1)},
                       fmt::format("sigma {} is not allowed; allowed: greater than zero.", rows[i].sigma));
    }
    ++usable;
    if (!std::isfinite(input.predicted[i])) {
      ++result.unmatched;
      continue;
    }
    if (rows[i].use != ObservationUse::Fit) continue;
    if (rows[i].time_s > log_end) {
      ++beyond_log;
      continue;
    }
    if (inGap(gaps, rows[i].time_s)) continue;
    fit_rows.push_back(i);
  }
  if (usable == 0)
    throw InputError({input.observations.file, ""}, "holds no observation to be used; allowed: at least one.");
  if (2 * (usable - result.unmatched) < usable) {
    throw InputError(
        {input.base_table.empty() ? input.observations.file : input.observations.file.parent_path() / input.base_table,
         ""},
        fmt::format("only {} of {} observations have a prediction in the simulation; allowed: at least half.",
                    usable - result.unmatched, usable));
  }
  if (result.unmatched > 0) {
    result.warnings.push_back(fmt::format(
        "{} of {} observations have no prediction in the simulation and are left out.", result.unmatched, usable));
  }
  if (beyond_log > 0) {
    result.warnings.push_back(
        fmt::format("{} observations are later than the end of the log and are not fitted.", beyond_log));
  }
  if (fit_rows.empty()) {
    throw InputError({input.observations.file, ""},
                     "holds no row to be fitted; allowed: at least one with use fit, at a time that the log covers.");
  }
  checkUnits(input, fit_rows);

  job.report(0.0, "preparing");
  auto drivers = std::make_shared<DriverTable>(input.machine, input.log ? &*input.log : nullptr);
  warnAboutLog(input, *drivers, result.warnings);
  ResidualProblem problem(input, fit_rows, unit_limit);
  const std::vector<Effect> catalogue = effectCatalogue(catalogueContext(input, *drivers, problem));
  warnAboutUndecidable(input, catalogue, result.warnings);
  for (const auto* list : {&options.accept, &options.reject}) {
    for (const std::string& id : *list) {
      if (std::none_of(catalogue.begin(), catalogue.end(), [&](const Effect& e) { return e.id == id; })) {
        std::vector<std::string> known;
        for (const Effect& e : catalogue) known.push_back(e.id);
        throw InputError(fmt::format("effect \"{}\" is not one that this machine can have; allowed: {}.", id,
                                     joinedList(known, "or")));
      }
    }
  }
  EffectSearch search(problem, *drivers, catalogue);
  const std::vector<NuisanceColumn> base = problem.simulationNuisances(input.simulation_gain_uncertainty);
  problem.setNuisances(base);
  problem.setNoise(estimateNoise(problem, problem.y, false));

  const int epochs = problem.epoch_count;
  const bool enough = problem.degreesOfFreedom() >= 12 && epochs >= 4;
  DiscrepancyOptions effective = options;
  if (!enough) effective.max_effects = 0;
  const SearchLimits limits;
  SearchOutcome outcome = searchEffects(search, problem, base, effective, limits, job);
  if (enough && !outcome.fit.terms.empty()) {
    // The noise again, now without the signal; if it looks different the search is run once more.
    Eigen::VectorXd left = problem.y;
    for (const Eigen::VectorXd& part : outcome.fit.contribution) left -= part;
    const NoiseModel again = estimateNoise(problem, left, true);
    const NoiseModel& used = problem.noise;
    const bool much_left = outcome.explained_fraction < 0.9;
    const double change = std::abs(again.correlated_part - used.correlated_part);
    if (!much_left && (change > 0.25 || again.scale < 0.8 * used.scale)) {
      problem.setNoise(again);
      outcome = searchEffects(search, problem, base, effective, limits, job);
    }
  }
  result.noise_scale = problem.noise.scale;
  result.noise_correlated_part = problem.noise.correlated_part;
  result.noise_correlation_time_s = problem.noise.correlation_time_s;
  result.steps = outcome.steps;
  result.explained_fraction = outcome.explained_fraction;
  result.leftover_p_value = outcome.leftover_p_value;
  if (!outcome.fit.terms.empty()) result.unknown_advantage = outcome.unknown_course.advantage;

  // Verdict.
  // A noise model a little off makes everything scatter more than it should: that alone takes no name away.
  const bool left = outcome.leftover_p_value < 1e-3;
  const bool clearly_left = outcome.leftover_p_value < 1e-5;
  // Two effects on top of each other follow many courses nearly: then what they leave counts sooner.
  bool stacked = false;
  for (std::size_t t = 0; t < outcome.fit.terms.size(); ++t) stacked = stacked || overlaps(outcome.fit, t);
  const bool stacked_left =
      stacked &&
      (left || (outcome.leftover_p_value < 0.01 && outcome.explained_fraction < limits.least_explained_by_stacked));
  const bool unexplained = stacked_left || (clearly_left && outcome.explained_fraction < limits.least_explained) ||
                           (left && (outcome.unknown_course.advantage > limits.unknown_advantage ||
                                     outcome.unknown_course.smallest_part < limits.least_over_leftover)) ||
                           outcome.onset_imitates || outcome.crowded || !outcome.composite.empty();
  bool ambiguous = false;
  bool too_many = false;
  JointFit named = outcome.fit;
  std::vector<TermEvidence> evidence = outcome.evidence;
  std::vector<bool> forced = outcome.forced;
  std::vector<std::string> alike;
  std::size_t alike_term = 0;
  for (const TermEvidence& e : evidence) {
    int rivals = 0;
    for (const RivalFit& r : e.rivals) {
      rivals += r.container ? 0 : 1;
      ambiguous = ambiguous || !r.container || r.undecided;
    }
    if (rivals > 2 && !too_many) {
      alike.push_back(outcome.fit.terms[alike_term].effect->id);
      for (const RivalFit& r : e.rivals) {
        if (!r.container) alike.push_back(r.id);
      }
    }
    too_many = too_many || rivals > 2;
    ++alike_term;
  }
  if (outcome.leftover.empty()) outcome.leftover = outcome.composite;
  result.leftover =
      unexplained || outcome.fit.terms.empty() || outcome.explained_fraction < 0.98 ? outcome.leftover : "";
  if (outcome.fit.terms.empty()) {
    result.verdict = outcome.leftover_p_value < 1e-3 ? DiscrepancyVerdict::Unknown : DiscrepancyVerdict::None;
    if (result.verdict == DiscrepancyVerdict::None) result.leftover.clear();
  } else if (unexplained || too_many) {
    result.verdict = DiscrepancyVerdict::Unknown;
  } else {
    result.verdict = ambiguous ? DiscrepancyVerdict::Ambiguous : DiscrepancyVerdict::Named;
  }
  if (result.verdict == DiscrepancyVerdict::Unknown) {
    // A name beside something that nothing explains is worse than none, unless the user put it there.
    if (result.leftover.empty()) {
      result.leftover = too_many ? "more effects fit equally well than could be named: " + joinedList(alike, "or")
                        : outcome.crowded ? "several effects together imitate what is left, none of them alone"
                                          : "a part that no effect explains";
    }
    JointFit kept;
    std::vector<TermEvidence> kept_evidence;
    std::vector<bool> kept_forced;
    std::vector<ModelTerm> terms;
    for (std::size_t t = 0; t < named.terms.size(); ++t) {
      if (!forced[t]) continue;
      terms.push_back(named.terms[t]);
      kept_evidence.push_back(evidence[t]);
      kept_forced.push_back(true);
    }
    problem.setNuisances(base);
    named = terms.empty() ? kept : search.refine(terms, 1);
    evidence = kept_evidence;
    forced = kept_forced;
  }

  // Numbers of the model.
  problem.setNuisances(base);
  const double chi2_scale = std::max(1.0, outcome.chi2_after / std::max(1.0, static_cast<double>(outcome.dof_before)));
  std::vector<ModelEffect> effects = modelEffects(search, problem, named, "fit of the residual", chi2_scale);
  std::vector<std::vector<ModelEffect>> versions;
  std::vector<double> weights;
  for (const WeightedDynamics& w : alternativeDynamics(search, problem, *drivers, named)) {
    versions.push_back(
        modelEffects(search, problem, w.distributed.fit, "fit of the residual", chi2_scale, w.distributed.prior_sigma));
    weights.push_back(w.weight);
  }
  const std::vector<ModelEffect> model_effects = averagedEffects(versions, weights);
  result.model = std::make_shared<EffectModel>(drivers, model_effects, nullptr, input.base_table);

  // Rows: simulated, completed, gap, held-out.
  std::vector<std::size_t> held_rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool known = rows[i].time_s <= log_end && !inGap(gaps, rows[i].time_s);
    if (known && rows[i].use == ObservationUse::Holdout) held_rows.push_back(i);
  }
  std::vector<double> sum(rows.size(), 0.0);
  RowResult before = evaluateRows(input, fit_rows, held_rows, sum);
  result.gap.rms_before_um = before.fit_rms;
  const bool has_holdout = before.holdout_rows > 0;
  result.gap.heldout_rms_before_um = before.holdout_rms;
  RowResult last = before;
  for (std::size_t t = 0; t < effects.size(); ++t) {
    // Each prefix with its own gains, as it was when the effect entered.
    const bool whole = t + 1 == effects.size();
    const std::vector<ModelTerm> first(named.terms.begin(), named.terms.begin() + static_cast<std::ptrdiff_t>(t) + 1);
    const JointFit prefix =
        whole ? JointFit{} : distributedDynamics(search, problem, *drivers, search.solve(first)).fit;
    std::vector<double> part(rows.size(), 0.0);
    for (std::size_t k = 0; k <= t; ++k) {
      ModelEffect e = whole ? model_effects[k] : effects[k];
      if (!whole) {
        e.variant = prefix.terms[k].variant;
        e.parameters = prefix.terms[k].parameters;
        e.gains = prefix.gains[k];
      }
      const std::vector<double> one = EffectModel::contribution(*drivers, e, rows);
      for (std::size_t r = 0; r < rows.size(); ++r) part[r] += one[r];
    }
    const RowResult now = evaluateRows(input, fit_rows, held_rows, part);
    FoundEffect found;
    const ModelEffect& e = effects[t];
    found.id = e.effect.id;
    found.physics = e.effect.physics;
    found.drivers = driversText(e);
    found.delta_bic = evidence[t].delta_bic;
    found.delta_chi2 = evidence[t].delta_chi2;
    found.margin = std::min(evidence[t].margin, 1e6);
    found.forced = forced[t];
    const auto& cv = evidence[t].crossvalidation;
    found.crossvalidated_rms_before_um = cv.before_um;
    found.crossvalidated_rms_after_um = cv.after_um;
    found.heldout_rms_before_um = has_holdout ? last.holdout_rms : cv.before_um;
    found.heldout_rms_after_um = has_holdout ? now.holdout_rms : cv.after_um;
    const auto gain_names = e.gainNames(*drivers);
    for (std::size_t g = 0; g < gain_names.size(); ++g) {
      found.parameters.push_back(
          {gain_names[g], e.gains[static_cast<Index>(g)], e.gain_uncertainty[static_cast<Index>(g)]});
    }
    const auto names = parameterNames(e.variant);
    for (std::size_t p = 0; p < names.size(); ++p) {
      found.parameters.push_back({names[p], e.parameters[p], e.parameter_uncertainty[p]});
    }
    for (const RivalFit& r : evidence[t].rivals) {
      (r.container && !r.undecided ? found.containers : found.rivals).push_back(r.id);
      if (r.undriven) {
        result.warnings.push_back(
            fmt::format("{} cannot be told from {}, because the log lacks what drives the latter: log it next time.",
                        found.id, r.id));
      }
    }
    for (const Component c : all_components) {
      double power = 0.0;
      double count = 0.0;
      for (Index u = 0; u < problem.size(); ++u) {
        if (problem.component[static_cast<std::size_t>(u)] != c) continue;
        power += named.contribution[t][u] * named.contribution[t][u];
        count += 1.0;
      }
      if (count > 0.0 && !isRotation(c)) found.rms_um = std::max(found.rms_um, std::sqrt(power / count));
    }
    found.confidence = confidenceOf(outcome, evidence[t], named, t, limits);
    result.effects.push_back(std::move(found));
    last = now;
    if (t + 1 == effects.size()) sum = part;
  }
  result.gap.rms_after_um = last.fit_rms;
  result.gap.heldout_rms_after_um = last.holdout_rms;
  if (!has_holdout && !result.effects.empty()) {
    result.gap.heldout_rms_before_um = result.effects.front().heldout_rms_before_um;
    result.gap.heldout_rms_after_um = result.effects.back().heldout_rms_after_um;
  }
  double noise = 0.0;
  double noise_count = 0.0;
  for (const std::size_t row : fit_rows) {
    if (isRotation(rows[row].component)) continue;
    noise += rows[row].sigma * rows[row].sigma;
    noise_count += 1.0;
  }
  result.gap.noise_um = noise_count > 0.0 ? std::sqrt(noise / noise_count) * result.noise_scale : 0.0;
  if (result.noise_scale < 0.88 || result.noise_scale > 1.12) {
    result.warnings.push_back(
        fmt::format("The scatter is {:.2f} times the stated sigma; it is used as found.", result.noise_scale));
  }
  result.constant = last.constant;
  result.effect_part = sum;
  result.simulated = input.predicted;
  result.completed.resize(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    result.completed[r] = input.predicted[r] + sum[r];
  }
  result.where = findPlaces(problem, *drivers, problem.projectedResidual().head(problem.size()));

  if (options.suggest && enough) {
    for (std::size_t t = 0; t < evidence.size() && !result.suggestion; ++t) {
      for (const RivalFit& rival : evidence[t].rivals) {
        if ((rival.container && !rival.undecided) || rival.undriven) continue;
        result.suggestion = suggestMeasurement(input, *drivers, search, problem, named, rival.joint,
                                               named.terms[t].effect->id + " from " + rival.id, search.logN());
        break;
      }
    }
  }

  result.status = enough ? FitStatus::Converged : FitStatus::Degenerate;
  result.decided = enough;
  if (!enough) {
    result.message = fmt::format(
        "{} observations in {} states leave too little beyond the free constant of each of {} series: which effect is "
        "missing, its lag and whether it is one at all cannot be decided; measure at least 4 states and several "
        "points.",
        fit_rows.size(), epochs, problem.seriesCount());
    if (outcome.leftover_p_value >= 1e-3) result.verdict = DiscrepancyVerdict::Unknown;
    if (result.leftover.empty()) result.leftover = "too few observations to decide";
  } else {
    switch (result.verdict) {
      case DiscrepancyVerdict::None:
        result.message = "Measurement and simulation agree within the noise.";
        break;
      case DiscrepancyVerdict::Unknown:
        result.message = "Something disagrees that no effect of the catalogue explains.";
        break;
      default: {
        std::vector<std::string> names;
        for (const FoundEffect& e : result.effects) names.push_back(e.id);
        result.message = fmt::format("Missing in the simulation: {}{}.", joinedList(names),
                                     result.verdict == DiscrepancyVerdict::Ambiguous
                                         ? "; these data cannot tell at least one of them from its rivals"
                                         : "");
      }
    }
  }
  job.report(1.0, "done");
  return result;
}

}  // namespace spindrift
