// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/discrepancy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/base/text.h"
#include "core/discrepancy/clock_offset.h"
#include "core/discrepancy/comparable_rows.h"
#include "core/discrepancy/discrepancy_numbers.h"
#include "core/discrepancy/distributed_dynamics.h"
#include "core/discrepancy/effect_model.h"
#include "core/discrepancy/effect_posterior.h"
#include "core/discrepancy/effect_relations.h"
#include "core/discrepancy/effect_titles.h"
#include "core/discrepancy/judgement.h"
#include "core/discrepancy/own_effects.h"
#include "core/discrepancy/places.h"
#include "core/discrepancy/simulation_parts.h"
#include "core/discrepancy/simulator_hypotheses.h"
#include "core/discrepancy/suggestion.h"
#include "core/discrepancy/told_noise.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// Every id of the user's lists is one that this machine can have. What is left out may also be an effect that these
/// data cannot show anyway (backlash where every point is approached from one side, a shape that is zero at all
/// points).
void checkIds(const DiscrepancyOptions& options, const std::vector<Effect>& catalogue, const OwnEffects* own) {
  for (const auto* list : {&options.accept, &options.reject}) {
    for (const std::string& id : *list) {
      if (std::any_of(catalogue.begin(), catalogue.end(), [&](const Effect& e) { return e.id == id; })) continue;
      if (list == &options.reject && (effectTitleOf(id) || (own != nullptr && own->find(id) != nullptr))) continue;
      std::vector<std::string> known;
      for (const Effect& e : catalogue) known.push_back(e.id);
      throw InputError(fmt::format("effect \"{}\" is not one that this machine can have; allowed: {}.", id,
                                   joinedList(known, "or")));
    }
  }
}

/// What effects of the user's hold as special cases, and which are the same under two names.
void relateOwnEffects(std::vector<Effect>& effects, const ResidualProblem& problem,
                      std::vector<std::string>& warnings) {
  std::vector<Eigen::MatrixXd> shapes;
  shapes.reserve(effects.size());
  for (const Effect& effect : effects) shapes.push_back(problem.shapeAtUnits(effect));
  const EffectRelations relations = effectRelations(effects, shapes, false);
  for (std::size_t a = 0; a < effects.size(); ++a) {
    for (const std::size_t b : relations.holds[a]) {
      if ((effects[a].own || effects[b].own) && !holdsEffect(effects[a], effects[b].id))
        effects[a].contains.push_back(effects[b].id);
    }
  }
  for (const auto& [a, b] : relations.same) {
    if (!effects[a].own && !effects[b].own) continue;
    warnings.push_back(
        fmt::format("{} and {} have the same shape at all points and the same drivers: no measurement of this kind can "
                    "distinguish them.",
                    effects[a].id, effects[b].id));
  }
}

/// The catalogue, as far as the user wants it, and the user's own effects.
std::vector<Effect> catalogueOf(const DiscrepancyInput& input, DriverTable& drivers, const ResidualProblem& problem,
                                std::vector<std::string>& warnings) {
  std::vector<Effect> out;
  const SimulatorHypotheses hypotheses(input.tangents.get(), input.observations);
  if (!input.own || input.own->builtIn()) out = effectCatalogue(catalogueContext(input, drivers, problem));
  if (!input.own) {
    hypotheses.append(out);
    return out;
  }
  std::vector<Effect> own = input.own->bind(drivers, input.log ? &*input.log : nullptr,
                                            input.machine.reference_temperature_degC, input.absolute);
  input.own->check(own, input.observations.rows, warnings);
  out.insert(out.end(), std::make_move_iterator(own.begin()), std::make_move_iterator(own.end()));
  relateOwnEffects(out, problem, warnings);
  hypotheses.append(out);
  return out;
}

/// Everything that is estimated together: noise, clock and effects. It stays where it is: its search looks at its
/// catalogue.
struct Analysis {
  Analysis(std::shared_ptr<DriverTable> its_drivers, std::vector<Effect> effects, SimulatorHypotheses parameters)
      : drivers(std::move(its_drivers)), catalogue(std::move(effects)), hypotheses(std::move(parameters)) {}
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;

  std::shared_ptr<DriverTable> drivers;
  std::vector<Effect> catalogue;
  SimulatorHypotheses hypotheses;  ///< those of the catalogue that are parameters of a simulator
  std::unique_ptr<EffectSearch> search;
  EffectPosterior posterior;
  Remainder remainder;
  double clock_offset_s = 0.0;  ///< beyond that by which the drivers came
  double clock_uncertainty_s = 0.0;
  double simulation_error = 0.0;  ///< of its parts, as estimated
  std::vector<std::string> notes;
};

/// True if the noise is another one, so that effects have to be weighed again.
bool differs(const NoiseModel& a, const NoiseModel& b) {
  const auto ratio = [](double x, double y) { return std::abs(std::log(std::max(1e-9, x) / std::max(1e-9, y))); };
  if ((a.tail_dof > 0.0) != (b.tail_dof > 0.0)) return true;
  for (std::size_t c = 0; c < a.component.size(); ++c) {
    const ComponentNoise& x = a.component[c];
    const ComponentNoise& y = b.component[c];
    if (ratio(x.scale, y.scale) > 0.1 || std::abs(x.correlated_part - y.correlated_part) > 0.2) return true;
    if ((x.common > 0.0 || y.common > 0.0) && ratio(x.common + 0.02, y.common + 0.02) > 0.25) return true;
  }
  return false;
}

/// While nothing is known of it.
constexpr double usual_simulation_error = 0.015;

/// How wrong the parts of the simulation are, from those that its nuisances can follow: the median of what they come
/// to, the most deviating left out, within what is plausible.
double simulationError(const ResidualProblem& problem, const ResidualProblem::NuisancePart& taken, double stated) {
  std::vector<double> sizes;
  for (std::size_t c = 0; c < taken.coefficients.size(); ++c) {
    const NuisanceColumn& column = problem.nuisances()[c];
    // What the data do not see says nothing.
    if (!column.relative || taken.variances[c] > 0.5 * column.prior_sigma * column.prior_sigma) continue;
    sizes.push_back(std::max(0.0, taken.coefficients[c] * taken.coefficients[c] - taken.variances[c]));
  }
  if (sizes.size() < 2) return stated;
  std::sort(sizes.begin(), sizes.end());
  sizes.pop_back();
  double sum = 0.0;
  for (const double s : sizes) sum += s;
  constexpr double largest = 0.04;
  return std::clamp(std::sqrt(sum / static_cast<double>(sizes.size())), 0.5 * stated, largest);
}

/// Noise and effects in turn, beginning with the noise that the problem has and under its nuisances, until neither
/// changes. `off`: a part of the simulation that is taken to be of the wrong size; or null.
void alternate(Analysis& a, const DiscrepancyInput& input, ResidualProblem& problem, const DiscrepancyOptions& options,
               const DiscrepancyPriors& priors, bool exact, const ModelTerm* off, JobContext& job) {
  a.simulation_error = exact ? 0.0 : std::max(input.simulation_gain_uncertainty, usual_simulation_error);
  a.hypotheses.chooseWindows(a.catalogue, problem, [&](const std::string&) {
    return CandidateLibrary::Given{Eigen::MatrixXd(problem.projectedResidual().size(), 0), problem.projectedResidual()};
  });
  constexpr int most_rounds = 3;
  for (int round = 0; round < most_rounds; ++round) {
    job.report(0.1 + 0.25 * round, "weighing effects");
    a.search = std::make_unique<EffectSearch>(problem, *a.drivers, a.catalogue);
    const CandidateLibrary library(*a.search, problem, job);
    PosteriorSearch posterior(*a.search, problem, library, options, priors, a.simulation_error);
    a.posterior = posterior.run(job, off);
    a.remainder = remainderOf(problem, posterior.given(a.posterior.fit));
    const auto finish = [&] { posterior.weighAgainstUnknown(a.posterior); };
    if (round + 1 == most_rounds) {
      finish();
      break;
    }
    const double clock_before = a.clock_offset_s;
    if (const auto clock =
            estimateClockOffset(problem, a.catalogue, *a.drivers, a.posterior.fit, clock_before, priors.clock_s)) {
      a.clock_offset_s = clock->offset_s;
      a.clock_uncertainty_s = clock->standard_uncertainty_s;
      a.drivers->shiftClock(clock->offset_s - clock_before);
    }
    // Windows of loads beside the other effects found.
    const bool other_window = a.hypotheses.chooseWindows(a.catalogue, problem, [&](const std::string& id) {
      std::vector<ModelTerm> others;
      for (const ModelTerm& term : a.posterior.fit.terms) {
        if (term.effect->id != id) others.push_back(term);
      }
      return posterior.given(a.search->solve(others));
    });
    Eigen::VectorXd left = problem.without(a.posterior.fit.contribution);
    const ResidualProblem::NuisancePart taken = problem.nuisancePart(left);
    left -= taken.values;
    const double error_before = a.simulation_error;
    if (!exact) a.simulation_error = simulationError(problem, taken, input.simulation_gain_uncertainty);
    const bool other_error = std::abs(a.simulation_error - error_before) > 0.01;
    const NoiseModel again = estimateNoise(problem, left, true);
    const bool other_clock = std::abs(a.clock_offset_s - clock_before) > 20.0;
    if (!differs(problem.noise, again) && !other_clock && !other_error && !other_window) {
      finish();
      break;
    }
    problem.setNoise(again);
  }
}

/// Without what states or neighbours in time have in common.
NoiseModel ownNoiseOf(NoiseModel noise) {
  for (ComponentNoise& n : noise.component) {
    n.common = 0.0;
    n.correlated_part = 0.0;
    n.correlation_time_s = 0.0;
  }
  return noise;
}

/// Noise and effects together. The first noise is estimated before any effect is known, and what moves all points of a
/// state alike may have gone into it: where nothing is found beside such noise, the search begins once more with the
/// own noise of the readings alone. Its answer stands if it is the more probable one with noise and a smooth remainder
/// made as large as either answer needs.
void weigh(Analysis& a, const DiscrepancyInput& input, ResidualProblem& problem, const DiscrepancyOptions& options,
           const DiscrepancyPriors& priors, bool exact, const ModelTerm* off, JobContext& job) {
  const ResidualProblem::NuisancePart first = problem.nuisancePart(problem.y);
  const NoiseModel start = estimateNoise(problem, problem.y - first.values, false);
  problem.setNoise(start);
  alternate(a, input, problem, options, priors, exact, off, job);
  const bool nothing = a.posterior.fit.terms.size() == (off == nullptr ? 0 : 1);
  // A simulator's own hypotheses do not hide in the noise: each is fitted to what it predicts.
  if (!nothing || options.max_effects == 0 || input.tangents || !differs(problem.noise, ownNoiseOf(problem.noise)))
    return;
  const NoiseModel noise = problem.noise;
  const double clock_offset_s = a.clock_offset_s;
  const double clock_uncertainty_s = a.clock_uncertainty_s;
  const double simulation_error = a.simulation_error;
  std::unique_ptr<EffectSearch> search = std::move(a.search);
  EffectPosterior posterior = std::move(a.posterior);
  Remainder remainder = std::move(a.remainder);
  problem.setNoise(ownNoiseOf(start));
  alternate(a, input, problem, options, priors, exact, off, job);
  if (a.posterior.over_unknown > priors.instead_of_common_noise) return;
  a.drivers->shiftClock(clock_offset_s - a.clock_offset_s);
  a.clock_offset_s = clock_offset_s;
  a.clock_uncertainty_s = clock_uncertainty_s;
  a.simulation_error = simulation_error;
  a.search = std::move(search);
  a.posterior = std::move(posterior);
  a.remainder = std::move(remainder);
  problem.setNoise(noise);
}

/// The part that is off by most; null where no part is.
const SimulationPart* largestError(const std::vector<SimulationPart>& parts, const std::vector<PartError>& errors) {
  if (errors.empty()) return nullptr;
  const PartError& largest = *std::max_element(
      errors.begin(), errors.end(),
      [](const PartError& a, const PartError& b) { return std::abs(a.relative) < std::abs(b.relative); });
  return &*std::find_if(parts.begin(), parts.end(), [&](const SimulationPart& p) { return p.id == largest.id; });
}

void analyse(Analysis& a, const DiscrepancyInput& input, ResidualProblem& problem, const DiscrepancyOptions& options,
             const DiscrepancyPriors& priors, JobContext& job) {
  // Absolute values that are said to be predicted exactly: what deviates is none of the simulation's own scale.
  const bool exact = input.absolute && !(input.simulation_gain_uncertainty > 0.0);
  // Where a simulator says which of its parameters are uncertain, its parts are not doubted beyond what is stated.
  std::vector<SimulationPart> parts;
  const auto nuisancesOf = [&](double parts_error) {
    std::vector<NuisanceColumn> nuisances = problem.simulationNuisances(
        exact ? 0.0 : std::max(input.simulation_gain_uncertainty, input.tangents ? 0.0 : parts_error));
    Eigen::VectorXd rate = clockRate(problem, parts);
    if (rate.cwiseAbs().maxCoeff() > 1e-12) nuisances.push_back({std::move(rate), priors.clock_s, false});
    for (NuisanceColumn& column : a.hypotheses.nuisances(problem)) nuisances.push_back(std::move(column));
    return nuisances;
  };
  problem.setNuisances(nuisancesOf(priors.simulation_error));
  problem.setNoise(estimateNoise(problem, problem.y - problem.nuisancePart(problem.y).values, false));
  parts = partsOfSimulation(problem, *a.drivers, a.catalogue, priors, job);
  problem.setNuisances(nuisancesOf(priors.simulation_error));
  weigh(a, input, problem, options, priors, exact, nullptr, job);
  if (exact || input.tangents || !(priors.rough_simulation_error > input.simulation_gain_uncertainty)) return;
  // An effect may be what a rough simulation leaves: a part that is somewhat too large or too small, not one missing.
  const auto sizes = [&] {
    Eigen::MatrixXd fitted(problem.size(), static_cast<Index>(a.posterior.fit.terms.size()));
    for (Index t = 0; t < fitted.cols(); ++t) fitted.col(t) = a.posterior.fit.contribution[static_cast<std::size_t>(t)];
    return Eigen::VectorXd(problem.projected(fitted).colwise().squaredNorm());
  };
  const Eigen::VectorXd narrow = sizes();
  const double evidence = a.posterior.evidence - problem.nuisanceLogDeterminant();
  std::vector<NuisanceColumn> nuisances = nuisancesOf(priors.simulation_error);
  const std::size_t first_part = nuisances.size();
  for (const SimulationPart& part : parts) nuisances.push_back({part.values, priors.rough_simulation_error, true});
  problem.setNuisances(nuisances);
  constexpr double followed = 0.6;
  bool rough = narrow.size() == 0 || (sizes().array() < followed * narrow.array()).any();
  const SimulationPart* far = nullptr;
  const double fair = 1.0 - priors.rough_simulation - priors.far_part;
  if (rough) {
    const auto weighed = [&](double odds) {
      const CandidateLibrary library(*a.search, problem, job);
      EffectPosterior found =
          PosteriorSearch(*a.search, problem, library, options, priors, a.simulation_error).run(job);
      const double of_hypothesis = found.evidence - problem.nuisanceLogDeterminant() + 2.0 * std::log(odds);
      return std::pair(std::move(found), of_hypothesis);
    };
    const auto [other, of_rough] = weighed(priors.rough_simulation / fair);
    rough = of_rough > evidence;
    const double limit = priors.rough_simulation_limit * priors.rough_simulation_error;
    const std::vector<PartError> errors =
        partErrors(problem, parts, first_part, problem.without(other.fit.contribution));
    for (const PartError& error : errors) rough = rough && std::abs(error.relative) <= limit;
    // Or one part alone is far off and nothing else: that is told, not taken for roughness.
    const SimulationPart* largest = largestError(parts, errors);
    if (rough && largest != nullptr && other.fit.terms.empty()) {
      std::vector<NuisanceColumn> alone = nuisancesOf(priors.simulation_error);
      alone.push_back({largest->values, priors.far_part_error, true});
      problem.setNuisances(alone);
      const double count = static_cast<double>(parts.size());
      if (weighed(priors.far_part / (count * fair)).second > of_rough) far = largest;
      problem.setNuisances(nuisances);
    }
  }
  if (far != nullptr) {
    problem.setNuisances(nuisancesOf(priors.simulation_error));
    weigh(a, input, problem, options, priors, exact, &far->term, job);
    return;
  }
  if (!rough) {
    problem.setNuisances(nuisancesOf(priors.simulation_error));
    return;
  }
  weigh(a, input, problem, options, priors, exact, nullptr, job);
  for (const PartError& error : partErrors(problem, parts, first_part, problem.without(a.posterior.fit.contribution))) {
    if (std::abs(error.relative) < 2.0 * error.uncertainty) continue;
    a.notes.push_back(
        fmt::format("The simulation has {:.0f} ± {:.0f} % too {} of {}: no more than a rough simulation may be off by "
                    "({:.0f} %), so "
                    "it is taken as its error and not as a missing effect.",
                    100.0 * std::abs(error.relative), std::max(1.0, 100.0 * error.uncertainty),
                    error.relative > 0.0 ? "much" : "little", error.id,
                    100.0 * priors.rough_simulation_limit * priors.rough_simulation_error));
  }
}

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

/// A fit as it predicts: over all dynamics that the data allow.
std::vector<ModelEffect> predictingEffects(const EffectSearch& search, const ResidualProblem& problem,
                                           const DriverTable& drivers, const JointFit& fit) {
  std::vector<std::vector<ModelEffect>> versions;
  std::vector<double> weights;
  for (const WeightedDynamics& w : alternativeDynamics(search, problem, drivers, fit)) {
    versions.push_back(
        modelEffects(search, problem, w.distributed.fit, "fit of the residual", 1.0, w.distributed.prior_sigma));
    weights.push_back(w.weight);
  }
  return averagedEffects(versions, weights);
}

/// rms of the held-out displacements as a fit predicts them, um; NaN where there are too few to judge by.
double heldOutRms(const DiscrepancyInput& input, const ComparableRows& rows, const ResidualProblem& problem,
                  const Analysis& analysis, const JointFit& fit) {
  constexpr std::size_t enough = 20;
  if (rows.held_out.size() < enough) return std::nan("");
  std::vector<double> part(input.predicted.size(), 0.0);
  for (const ModelEffect& effect : predictingEffects(*analysis.search, problem, *analysis.drivers, fit)) {
    const std::vector<double> one = EffectModel::contribution(*analysis.drivers, effect, input.observations.rows);
    for (std::size_t r = 0; r < part.size(); ++r) part[r] += one[r];
  }
  const RowResult result = evaluateRows(input, rows.fit, rows.held_out, part);
  return result.holdout_rows < enough ? std::nan("") : result.holdout_rms;
}

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
  const double tails = problem.noise.tail_dof > 2.0 ? problem.noise.tail_dof / (problem.noise.tail_dof - 2.0) : 1.0;
  for (const std::size_t row : fit_rows) {
    const Observation& o = input.observations.rows[row];
    if (isRotation(o.component) != rotations) continue;
    const ComponentNoise& n = problem.noise.of(o.component);
    power += std::pow(o.sigma * n.scale, 2) * tails + n.common * n.common;
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
  if (!has_holdout && !result.effects.empty()) {
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

std::string sentenceOf(const DiscrepancyResult& result, const DiscrepancyOptions& options) {
  switch (result.verdict) {
    case DiscrepancyVerdict::None:
      return result.gap.withinNoise() ? "Measurement and simulation agree within the noise."
                                      : "Measurement and simulation differ by no more than a rough simulation may be "
                                        "off by; nothing is missing beyond that.";
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
                     ambiguous ? "; these data do not distinguish at least one of them from its rivals" : "");
}

/// The answer with the clock of the log where it is taken to be.
struct Attempt {
  double log_clock_s = 0.0;  ///< clock of the log minus clock of the observations, before it is estimated
  double log_clock_uncertainty_s = 0.0;
  std::vector<std::string> warnings;
  ComparableRows rows;
  std::unique_ptr<ResidualProblem> problem;
  std::unique_ptr<Analysis> analysis;
  DiscrepancyOptions options;  ///< as far as the data admit them
  bool enough = false;
  Judgement judged;
};

Attempt answered(const DiscrepancyInput& input, const DiscrepancyOptions& options, const DiscrepancyPriors& priors,
                 double log_clock_s, JobContext& job) {
  Attempt out;
  out.log_clock_s = log_clock_s;
  out.log_clock_uncertainty_s = input.log_clock_uncertainty_s;
  out.rows = comparableRows(input, log_clock_s, out.warnings);
  out.warnings.insert(out.warnings.end(), input.notes.begin(), input.notes.end());
  checkUnits(input, out.rows.fit);
  job.report(0.0, "preparing");
  auto drivers = std::make_shared<DriverTable>(input.machine, input.log ? &*input.log : nullptr);
  warnAboutLog(input, *drivers, log_clock_s, out.warnings);
  warnAboutData(input, out.rows.fit, out.warnings);
  out.problem = std::make_unique<ResidualProblem>(input, out.rows.fit, most_units);
  std::vector<Effect> catalogue = catalogueOf(input, *drivers, *out.problem, out.warnings);
  warnAboutUndecidable(input, catalogue, out.warnings);
  checkIds(options, catalogue, input.own.get());
  drivers->shiftClock(log_clock_s);

  out.enough = out.problem->degreesOfFreedom() >= 12 && (input.absolute || out.problem->epoch_count >= 4);
  out.options = options;
  if (!out.enough) out.options.max_effects = 0;
  out.analysis = std::make_unique<Analysis>(std::move(drivers), std::move(catalogue),
                                            SimulatorHypotheses(input.tangents.get(), input.observations));
  analyse(*out.analysis, input, *out.problem, out.options, priors, job);
  const Analysis& analysis = *out.analysis;
  out.warnings.insert(out.warnings.end(), analysis.notes.begin(), analysis.notes.end());
  out.judged = judge(*out.problem, *analysis.search, analysis.posterior, analysis.remainder, priors, out.options,
                     [&](const JointFit& fit) { return heldOutRms(input, out.rows, *out.problem, analysis, fit); });
  out.warnings.insert(out.warnings.end(), out.judged.warnings.begin(), out.judged.warnings.end());
  return out;
}

/// With a clock of the log far from that of the observations, where something is left, or what is named would fit
/// better.
std::optional<Attempt> answeredFarOff(const DiscrepancyInput& input, const Attempt& near,
                                      const DiscrepancyOptions& options, const DiscrepancyPriors& priors,
                                      JobContext& job) {
  if (!near.enough || !input.log || input.tangents || options.max_effects == 0) return std::nullopt;
  const Analysis& analysis = *near.analysis;
  // What nothing in the log drives may stand for what the log drives at another time.
  const auto& named = near.judged.named;
  const bool doubtful = near.judged.verdict == DiscrepancyVerdict::Unknown || !near.judged.leftover.empty() ||
                        !std::all_of(named.terms.begin(), named.terms.end(), drivenByLog) ||
                        fitsFarBetterElsewhere(*near.problem, analysis.catalogue, *analysis.drivers, named);
  if (!doubtful) return std::nullopt;
  // What goes with the log may have been taken for noise that is common to a state or follows itself in time.
  ResidualProblem problem = *near.problem;
  problem.setNoise(ownNoiseOf(problem.noise));
  // The clock is found by what is strongest.
  DiscrepancyOptions strongest = options;
  strongest.max_effects = 1;
  const auto evidenceAt = [&](double by_s) {
    DriverTable drivers = *analysis.drivers;
    drivers.shiftClock(by_s);
    const EffectSearch search(problem, drivers, analysis.catalogue);
    const CandidateLibrary library(search, problem, job);
    return PosteriorSearch(search, problem, library, strongest, priors, analysis.simulation_error).run(job).evidence;
  };
  const std::optional<ClockOffset> by = farLogClock(evidenceAt);
  if (!by) return std::nullopt;
  Attempt far = answered(input, options, priors, near.log_clock_s + by->offset_s, job);
  far.log_clock_uncertainty_s = by->standard_uncertainty_s;
  // A clock that is hours off is believed for what explains all of it.
  const bool all = !far.judged.names.empty() && far.judged.leftover.empty();
  const double worth = far.analysis->posterior.over_unknown - std::max(0.0, analysis.posterior.over_unknown);
  if (!all || worth < 2.0 * std::log(far_clocks / priors.far_clock)) return std::nullopt;
  return far;
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

DiscrepancyResult findDiscrepancy(const DiscrepancyInput& input, const DiscrepancyOptions& options, JobContext& job) {
  options.validate();
  SPINDRIFT_ASSERT(input.predicted.size() == input.observations.rows.size(), "one prediction for every observation");
  const DiscrepancyPriors priors;
  Attempt attempt = answered(input, options, priors, input.log_clock_s, job);
  if (std::optional<Attempt> far = answeredFarOff(input, attempt, options, priors, job)) attempt = std::move(*far);
  ResidualProblem& problem = *attempt.problem;
  const Analysis& analysis = *attempt.analysis;
  const ComparableRows& rows = attempt.rows;

  DiscrepancyResult result;
  result.warnings = attempt.warnings;
  result.unmatched = rows.unmatched;
  result.sensors = analysis.drivers->sensors();
  result.clock_offset_s = attempt.log_clock_s + analysis.clock_offset_s;
  const bool found_far_off = attempt.log_clock_s != input.log_clock_s;
  result.clock_offset_uncertainty_s = std::hypot(attempt.log_clock_uncertainty_s, analysis.clock_uncertainty_s);
  if (found_far_off) {
    result.warnings.push_back(
        fmt::format("What is named fits the log as if its clock were about {:.0f} min {} that of the observations, and "
                    "is told with "
                    "it: compare the clocks.",
                    std::abs(result.clock_offset_s) / 60.0, result.clock_offset_s > 0.0 ? "ahead of" : "behind"));
  } else if (std::abs(analysis.clock_offset_s) > 30.0) {
    result.warnings.push_back(fmt::format(
        "The clock of the log is {:.0f} s {} that of the observations, as far as the data show it (± {:.0f} s).",
        std::abs(result.clock_offset_s), result.clock_offset_s > 0.0 ? "ahead of" : "behind",
        result.clock_offset_uncertainty_s));
  }

  Solution solution{input, rows, problem, analysis, attempt.judged, {}, {}};
  result.verdict = solution.judged.verdict;
  result.leftover = solution.judged.leftover;
  result.steps = solution.judged.steps;
  result.explained_fraction = solution.judged.explained_fraction;
  tellCandidates(analysis.posterior, options, result);
  fitModel(solution);
  result.model = std::make_shared<EffectModel>(analysis.drivers, solution.averaged, nullptr, input.base_table);
  tellEffects(solution, result);
  tellNoise(problem, analysis.posterior.fit, analysis.remainder, input.observations.rows, result);
  result.noise_model = std::make_shared<const NoiseModel>(problem.noise);
  result.twins = analysis.hypotheses.twins(problem);
  for (const auto& [a, b] : result.twins) {
    result.warnings.push_back(fmt::format(
        "{} and {} of the simulation have the same effect on the observations and cannot be distinguished.", a, b));
  }
  result.where = findPlaces(problem, *analysis.drivers, problem.projectedResidual().head(problem.size()));
  if (options.suggest && attempt.enough && result.verdict == DiscrepancyVerdict::Ambiguous) {
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
                                             ambiguous, attempt.options, priors, job);
  }

  warnAboutSensors(result.sensors, result.warnings);
  result.decided = attempt.enough;
  result.status = attempt.enough ? FitStatus::Converged : FitStatus::Degenerate;
  if (attempt.enough) {
    result.message = sentenceOf(result, options);
  } else {
    tellUndecided(solution, result);
  }
  job.report(1.0, "done");
  return result;
}

}  // namespace spindrift
