// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/discrepancy_analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "core/base/text.h"
#include "core/discrepancy/clock_offset.h"
#include "core/discrepancy/comparable_rows.h"
#include "core/discrepancy/discrepancy_numbers.h"
#include "core/discrepancy/distributed_dynamics.h"
#include "core/discrepancy/effect_relations.h"
#include "core/discrepancy/effect_titles.h"
#include "core/discrepancy/own_effects.h"
#include "core/discrepancy/simulation_clock.h"
#include "core/discrepancy/simulation_parts.h"
#include "core/math/distributions.h"

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
  if (!input.own || input.own->builtIn()) out = formsApart(effectCatalogue(catalogueContext(input, drivers, problem)));
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

/// True if the noise is another one, so that effects have to be weighed again.
bool differs(const NoiseModel& a, const NoiseModel& b) {
  const auto ratio = [](double x, double y) { return std::abs(std::log(std::max(1e-9, x) / std::max(1e-9, y))); };
  for (std::size_t c = 0; c < a.component.size(); ++c) {
    const ComponentNoise& x = a.component[c];
    const ComponentNoise& y = b.component[c];
    if ((x.tail_dof > 0.0) != (y.tail_dof > 0.0) || (x.gross_part > 0.0) != (y.gross_part > 0.0)) return true;
    if (ratio(x.scale, y.scale) > 0.1 || std::abs(x.correlated_part - y.correlated_part) > 0.2 ||
        std::abs(x.drift_part - y.drift_part) > 0.2)
      return true;
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
void settle(Analysis& a, const DiscrepancyInput& input, ResidualProblem& problem, const DiscrepancyOptions& options,
            const DiscrepancyPriors& priors, bool exact, const ModelTerm* off, JobContext& job) {
  a.simulation_error = exact ? 0.0 : std::max(input.simulation_gain_uncertainty, usual_simulation_error);
  a.hypotheses.chooseWindows(a.catalogue, problem, [&](const std::string&) {
    return CandidateLibrary::Given{Eigen::MatrixXd(problem.projectedResidual().size(), 0), problem.projectedResidual()};
  });
  std::vector<std::vector<ModelTerm>> known;
  constexpr int most_rounds = 3;
  for (int round = 0; round < most_rounds; ++round) {
    job.report(0.1 + 0.25 * round, "weighing effects");
    a.search = std::make_unique<EffectSearch>(problem, *a.drivers, a.catalogue);
    const CandidateLibrary library(*a.search, problem, job);
    PosteriorSearch posterior(*a.search, problem, library, options, priors, a.simulation_error);
    a.posterior = posterior.run(job, off, known);
    a.remainder = remainderOf(problem, posterior.given(a.posterior.fit));
    const auto finish = [&] { posterior.weighAgainstUnknown(a.posterior, a.remainder); };
    if (round + 1 == most_rounds) {
      finish();
      break;
    }
    // Beside a wrong set the noise takes what the right one would explain, and keeps it.
    const JointFit& likeliest = posterior.likeliestBesideItsOwnNoise(a.posterior);
    const bool other_set = &likeliest != &a.posterior.fit;
    known.push_back(a.posterior.fit.terms);
    if (other_set) known.push_back(likeliest.terms);
    const double clock_before = a.clock_offset_s;
    if (const auto clock =
            estimateClockOffset(problem, a.catalogue, *a.drivers, likeliest, clock_before, priors.clock_s)) {
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
    Eigen::VectorXd left = problem.without(likeliest.contribution);
    const ResidualProblem::NuisancePart taken = problem.nuisancePart(left);
    left -= taken.values;
    const double error_before = a.simulation_error;
    if (!exact) a.simulation_error = simulationError(problem, taken, input.simulation_gain_uncertainty);
    const bool other_error = std::abs(a.simulation_error - error_before) > 0.01;
    const NoiseModel again = estimateNoise(problem, left, true);
    const bool other_clock = std::abs(a.clock_offset_s - clock_before) > 20.0;
    if (!differs(problem.noise, again) && !other_clock && !other_error && !other_window && !other_set) {
      finish();
      break;
    }
    problem.setNoise(again);
  }
}

/// The effects that were put in, by hand or as a part of the simulation, if there are others and noise made as large as
/// needed is the more probable one in the place of every one of these.
std::optional<std::vector<ModelTerm>> likelierNoise(const EffectPosterior& posterior, const ModelTerm* off) {
  std::vector<ModelTerm> put_in;
  for (std::size_t t = 0; t < posterior.slots.size(); ++t) {
    const ModelTerm& term = posterior.fit.terms[t];
    if (posterior.forced[t] || (off != nullptr && term.effect->id == off->effect->id)) {
      put_in.push_back(term);
    } else if (!(posterior.slots[t].over_noise < 0.0)) {
      return std::nullopt;
    }
  }
  if (put_in.size() == posterior.slots.size()) return std::nullopt;
  return put_in;
}

/// The same, and once more from the noise that takes the place of all effects where that is the more probable answer:
/// noise and effects in turn stop at either of the two, for each is estimated beside the other.
void alternate(Analysis& a, const DiscrepancyInput& input, ResidualProblem& problem, const DiscrepancyOptions& options,
               const DiscrepancyPriors& priors, bool exact, const ModelTerm* off, JobContext& job) {
  constexpr int most_given_up = 3;
  for (int given_up = 0;; ++given_up) {
    settle(a, input, problem, options, priors, exact, off, job);
    const std::optional<std::vector<ModelTerm>> put_in = likelierNoise(a.posterior, off);
    if (!put_in || given_up == most_given_up) return;
    Eigen::VectorXd left = problem.without(a.search->solve(*put_in).contribution);
    left -= problem.nuisancePart(left).values;
    problem.setNoise(estimateNoise(problem, left, true));
  }
}

/// Without what states or neighbours in time have in common, in these components.
NoiseModel ownNoiseOf(NoiseModel noise,
                      const std::vector<Component>& components = {all_components.begin(), all_components.end()}) {
  for (const Component c : components) {
    ComponentNoise& n = noise.of(c);
    n.common = 0.0;
    n.drift_part = 0.0;
    n.drift_time_s = 0.0;
    n.correlated_part = 0.0;
    n.correlation_time_s = 0.0;
  }
  return noise;
}

/// Noise and effects together. The first noise is estimated before any effect is known, and what moves all points of a
/// state alike may have gone into it: where nothing is found beside such noise, or components have much in common in it
/// (doubtfulNoise), the search begins once more with the own noise of the readings alone in these. Its answer stands if
/// it is the more probable one with noise and a smooth remainder made as large as either answer needs, and leaves no
/// such shifts: what follows a part of them alone may be anything.
void weigh(Analysis& a, const DiscrepancyInput& input, ResidualProblem& problem, const DiscrepancyOptions& options,
           const DiscrepancyPriors& priors, bool exact, const ModelTerm* off, JobContext& job) {
  const ResidualProblem::NuisancePart first = problem.nuisancePart(problem.y);
  const NoiseModel start = estimateNoise(problem, problem.y - first.values, false);
  const double clock_at_start_s = a.clock_offset_s;
  const double clock_uncertainty_at_start_s = a.clock_uncertainty_s;
  problem.setNoise(start);
  alternate(a, input, problem, options, priors, exact, off, job);
  // A simulator's own hypotheses do not hide in the noise: each is fitted to what it predicts.
  if (options.max_effects == 0 || input.tangents) return;
  const NoiseModel noise = problem.noise;
  const bool nothing = a.posterior.fit.terms.size() == (off == nullptr ? 0 : 1);
  const NoiseModel own = nothing ? ownNoiseOf(start) : ownNoiseOf(noise, doubtfulNoise(problem, noise));
  if (!differs(noise, nothing ? ownNoiseOf(noise) : own)) return;
  const double clock_offset_s = a.clock_offset_s;
  const double clock_uncertainty_s = a.clock_uncertainty_s;
  const double simulation_error = a.simulation_error;
  std::unique_ptr<EffectSearch> search = std::move(a.search);
  EffectPosterior posterior = std::move(a.posterior);
  Remainder remainder = std::move(a.remainder);
  problem.setNoise(own);
  // A clock that was moved to fit what was found in place of the missing one would hide it again.
  a.drivers->shiftClock(clock_at_start_s - a.clock_offset_s);
  a.clock_offset_s = clock_at_start_s;
  a.clock_uncertainty_s = clock_uncertainty_at_start_s;
  alternate(a, input, problem, options, priors, exact, off, job);
  const auto& found = a.posterior.fit.terms;
  // Shifts have any course; what chooses its own onset is none the more probable for following them.
  const bool driven =
      nothing || std::all_of(found.begin(), found.end(), [&](const ModelTerm& term) {
        return drivenByLog(term) || std::any_of(posterior.fit.terms.begin(), posterior.fit.terms.end(),
                                                [&](const ModelTerm& t) { return t.effect->id == term.effect->id; });
      });
  if (driven && movedTogether(problem, problem.noise).empty()) {
    // Each beside the nuisances that its own noise leaves: without shifts these are stretched to follow them.
    ResidualProblem before = problem;
    NoiseModel shifted = noise;
    shifted.weight = problem.noise.weight;
    before.setNoise(shifted);
    if (answerDeviance(problem, a.posterior.fit, a.posterior.price) + priors.instead_of_common_noise <
        answerDeviance(before, posterior.fit, posterior.price))
      return;
  }
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
  std::vector<SimulationPart>& parts = a.parts;
  const auto nuisancesOf = [&](double parts_error) {
    std::vector<NuisanceColumn> nuisances = problem.simulationNuisances(
        exact ? 0.0 : std::max(input.simulation_gain_uncertainty, input.tangents ? 0.0 : parts_error));
    Eigen::VectorXd rate = clockRate(problem, parts);
    a.clock_column.reset();
    if (rate.cwiseAbs().maxCoeff() > 1e-12) a.clock_column = nuisances.size();
    if (rate.cwiseAbs().maxCoeff() > 1e-12) nuisances.push_back({std::move(rate), priors.clock_s, false});
    for (NuisanceColumn& column : a.hypotheses.nuisances(problem)) nuisances.push_back(std::move(column));
    return nuisances;
  };
  problem.setNuisances(nuisancesOf(priors.simulation_error));
  problem.setNoise(estimateNoise(problem, problem.y - problem.nuisancePart(problem.y).values, false));
  parts = partsOfSimulation(problem, *a.drivers, a.catalogue, priors, job);
  // What the simulation has it may have too much of: what is missing is then less than nothing of it.
  for (Effect& effect : a.catalogue)
    if (std::any_of(parts.begin(), parts.end(), [&](const SimulationPart& p) { return p.id == effect.id; }))
      effect.sign = 0;
  problem.setNuisances(nuisancesOf(priors.simulation_error));
  weigh(a, input, problem, options, priors, exact, nullptr, job);
  if (exact || input.tangents || !(priors.rough_simulation_error > input.simulation_gain_uncertainty)) return;
  a.rough_parts = parts;
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
  double far_probability = 0.0;
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
      const double over_rough = weighed(priors.far_part / (count * fair)).second - of_rough;
      far_probability = 1.0 / (1.0 + std::exp(-0.5 * over_rough));
      if (over_rough > 0.0) far = largest;
      problem.setNuisances(nuisances);
    }
  }
  if (far != nullptr) {
    problem.setNuisances(nuisancesOf(priors.simulation_error));
    weigh(a, input, problem, options, priors, exact, &far->term, job);
    for (std::size_t t = 0; t < a.posterior.slots.size(); ++t)
      if (a.posterior.fit.terms[t].effect->id == far->id) a.posterior.slots[t].probability *= far_probability;
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

/// What the held-out displacements leave as a fit predicts them. A reading of a disturbed state is no fault of the fit:
/// beyond some standard deviations of the noise as found it counts as those.
HeldOutErrors heldOutErrors(const DiscrepancyInput& input, const ComparableRows& rows, const ResidualProblem& problem,
                            const Analysis& analysis, const JointFit& fit) {
  constexpr std::size_t enough = 20;
  constexpr double far_out = 5.0;
  HeldOutErrors out;
  out.rms_um = std::nan("");
  if (rows.held_out.size() < enough) return out;
  std::vector<double> part(input.predicted.size(), 0.0);
  for (const ModelEffect& effect : predictingEffects(*analysis.search, problem, *analysis.drivers, fit)) {
    const std::vector<double> one = EffectModel::contribution(*analysis.drivers, effect, input.observations.rows);
    for (std::size_t r = 0; r < part.size(); ++r) part[r] += one[r];
  }
  RowResult result = evaluateRows(input, rows.fit, rows.held_out, part);
  if (result.holdout_rows < enough) return out;
  out.left = std::move(result.left);
  double squares = 0.0;
  double count = 0.0;
  for (const std::size_t row : rows.held_out) {
    double& left = out.left[row];
    if (!std::isfinite(left)) continue;
    const Observation& o = input.observations.rows[row];
    const ComponentNoise& noise = problem.noise.of(o.component);
    const double most = far_out * std::hypot(o.sigma * noise.scale, noise.common);
    left = std::clamp(left, -most, most);
    squares += left * left;
    count += 1.0;
  }
  out.rms_um = std::sqrt(squares / std::max(1.0, count));
  return out;
}

/// The clock as the simulation shows it, beside what was found: taken as an error of the simulation whatever it is, and
/// told where it is beyond doubt.
void readSimulationClock(const ResidualProblem& problem, Analysis& a) {
  constexpr double beyond_doubt = 4.0;  // standard deviations: other errors of the simulation move with it
  constexpr double least_s = 60.0;
  constexpr double of_the_rate = 0.15;  // minutes are much beside what follows within minutes: no straight line
  if (!a.clock_column || a.clock_offset_s != 0.0) return;
  const ResidualProblem::NuisancePart taken = problem.nuisancePart(problem.without(a.posterior.fit.contribution));
  // Without the prior, which draws it to zero.
  const double prior_s = problem.nuisances()[*a.clock_column].prior_sigma;
  const double told = 1.0 - taken.variances[*a.clock_column] / (prior_s * prior_s);
  if (!(told > 0.1)) return;
  const double offset_s = taken.coefficients[*a.clock_column] / told;
  const double sigma_s = std::sqrt(taken.variances[*a.clock_column] / told);
  if (!(std::abs(offset_s) > std::max(least_s, beyond_doubt * sigma_s))) return;
  a.simulation_clock_s = offset_s;
  a.simulation_clock_uncertainty_s = std::hypot(sigma_s, of_the_rate * offset_s);
}

JudgedAnalysis withClock(const DiscrepancyInput& input, const DiscrepancyOptions& options,
                         const DiscrepancyPriors& priors, double log_clock_s, JobContext& job) {
  JudgedAnalysis out;
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
  if (!input.tangents) readSimulationClock(*out.problem, *out.analysis);
  const Analysis& analysis = *out.analysis;
  out.warnings.insert(out.warnings.end(), analysis.notes.begin(), analysis.notes.end());
  out.judged = judge(*out.problem, *analysis.search, analysis.posterior, analysis.remainder, analysis.rough_parts,
                     priors, out.options,
                     {[&](const JointFit& fit) { return heldOutErrors(input, out.rows, *out.problem, analysis, fit); },
                      [&](const HeldOutErrors& a, const HeldOutErrors& b) {
                        if (a.left.empty() || b.left.empty()) return 0.5;
                        return probabilityOfLeavingMore(input.observations.rows, out.rows.held_out, a.left, b.left);
                      }});
  if (out.judged.noise) out.problem->setNoise(*out.judged.noise);
  out.warnings.insert(out.warnings.end(), out.judged.warnings.begin(), out.judged.warnings.end());
  return out;
}

/// What readings with heavy tails cost beyond the normal ones with the weights that these gave them, in 2 ln: an answer
/// that calls more readings outliers is not the more probable one for that.
double devianceOfTails(const ResidualProblem& problem) {
  if (problem.noise.weight.size() == 0) return 0.0;
  double sum = 0.0;
  for (Index u = 0; u < problem.size(); ++u) {
    const ComponentNoise& n = problem.noise.of(problem.component[static_cast<std::size_t>(u)]);
    const double dof = n.tail_dof;
    const double weight = problem.noise.weight[u];
    if (n.gross_part > 0.0) {
      // The density of normal noise at the reading, from how probable it is that it is none of the gross errors.
      const double gross = n.gross_density * n.scale;
      const double inside = std::min(normalDensity(0.0), gross * weight / ((1.0 - weight) * (1.0 - n.gross_part)));
      const double square = 2.0 * std::log(normalDensity(0.0) / inside);
      sum += -2.0 * std::log((1.0 - n.gross_part) * inside + gross) -
             (weight * square - std::log(weight) + std::log(2.0 * std::numbers::pi));
      continue;
    }
    if (!(dof > 0.0)) continue;
    const double square = std::max(0.0, (dof + 1.0) / weight - dof);  // of the reading over its scale
    const double student = (dof + 1.0) * std::log1p(square / dof) + std::log(dof * std::numbers::pi) -
                           2.0 * (std::lgamma(0.5 * (dof + 1.0)) - std::lgamma(0.5 * dof));
    const double normal = weight * square - std::log(weight) + std::log(2.0 * std::numbers::pi);
    sum += student - normal;
  }
  return sum;
}

/// -2 ln of the probability of the data of an answer, for each reading.
double devianceOfEach(const JudgedAnalysis& answer) {
  const EffectPosterior& posterior = answer.analysis->posterior;
  return (answerDeviance(*answer.problem, posterior.fit, posterior.price) + devianceOfTails(*answer.problem)) /
         static_cast<double>(answer.rows.fit.size());
}

/// The clock as the simulation shows it beside what was found, s; 0 where it shows none.
double stepOfSimulationClock(const ResidualProblem& problem, const Analysis& a) {
  constexpr double told = 3.0;
  constexpr double least_s = 20.0;
  if (!a.clock_column) return 0.0;
  const ResidualProblem::NuisancePart taken = problem.nuisancePart(problem.without(a.posterior.fit.contribution));
  const double by_s = taken.coefficients[*a.clock_column];
  const double sigma_s = std::sqrt(taken.variances[*a.clock_column]);
  return std::abs(by_s) > std::max(least_s, told * sigma_s) ? by_s : 0.0;
}

/// The same with the simulation asked for a time of its clock `by_s` later.
std::shared_ptr<const DiscrepancyInput> askedLater(const DiscrepancyInput& input, const DriverTable& drivers,
                                                   const std::vector<SimulationPart>& parts, double by_s) {
  auto out = std::make_shared<DiscrepancyInput>(input);
  out->log_clock_s += by_s;
  if (!input.base) {
    out->predicted = predictedLater(input, drivers, parts, by_s);
    return out;
  }
  out->base = std::make_shared<SimulationOfOtherClock>(input.base, by_s);
  for (std::size_t r = 0; r < out->predicted.size(); ++r) {
    const Observation& o = input.observations.rows[r];
    out->predicted[r] = out->base->predict(DeviationQuery::of(o), o.component).value;
  }
  return out;
}

/// Asks the simulation for another time where its parts fit better there, until they say of no other: a clock that is
/// minutes off is no straight line beside what follows within minutes.
void followSimulationClock(JudgedAnalysis& answer, const DiscrepancyOptions& options, const DiscrepancyPriors& priors,
                           JobContext& job) {
  if (!answer.enough || !answer.input->log || answer.input->log->empty()) return;
  if (answer.input->tangents || options.max_effects == 0) return;
  constexpr int most_steps = 3;
  // The parts are known to within the noise alone, and something may be missing beside them; when something was
  // switched between two rows of the log is not known.
  constexpr double of_the_offset = 0.15;
  constexpr double least_s = 10.0;
  const std::vector<double>& time_s = answer.input->log->time_s();
  const double interval_s = (time_s.back() - time_s.front()) / std::max(1.0, static_cast<double>(time_s.size()) - 1.0);
  const auto uncertaintyOf = [&](double moved_s) {
    return std::hypot(least_s, interval_s / std::sqrt(12.0), of_the_offset * moved_s);
  };
  const double start_s = answer.log_clock_s;
  const auto prior = [&](double clock_s) { return std::pow((clock_s - start_s) / priors.clock_s, 2); };
  for (int k = 0; k < most_steps; ++k) {
    const Analysis& a = *answer.analysis;
    DriverTable drivers = *a.drivers;
    drivers.shiftClock(-a.clock_offset_s);
    // What is named may stand for the clock, and what is not named yet may look like one: both are tried; and that of
    // the log, as what was found follows it.
    std::vector<double> steps_s;
    if (k == 0) steps_s.push_back(simulationClock(*answer.problem, drivers, a.catalogue, a.parts, priors.clock_s));
    if (k == 0) steps_s.push_back(a.clock_offset_s);
    steps_s.push_back(stepOfSimulationClock(*answer.problem, a));
    std::optional<JudgedAnalysis> better;
    double most_worth = 0.0;
    for (const double by_s : steps_s) {
      if (by_s == 0.0 || !logCovers(*answer.input, answer.log_clock_s + by_s)) continue;
      const std::shared_ptr<const DiscrepancyInput> moved = askedLater(*answer.input, drivers, a.parts, by_s);
      DiscrepancyPriors known = priors;
      known.clock_s = uncertaintyOf(moved->log_clock_s - start_s);
      JudgedAnalysis again = withClock(*moved, options, known, moved->log_clock_s, job);
      again.input = moved;
      const double worth =
          (devianceOfEach(answer) - devianceOfEach(again)) * static_cast<double>(answer.rows.fit.size()) +
          prior(answer.log_clock_s) - prior(again.log_clock_s);
      if (worth <= most_worth) continue;
      most_worth = worth;
      better = std::move(again);
    }
    if (!better) break;
    answer = std::move(*better);
  }
  if (answer.log_clock_s != start_s) answer.log_clock_uncertainty_s = uncertaintyOf(answer.log_clock_s - start_s);
}

/// With a clock of the log far from that of the observations, where something is left, or what is named would fit
/// better.
std::optional<JudgedAnalysis> withFarClock(const DiscrepancyInput& input, const JudgedAnalysis& near,
                                           const DiscrepancyOptions& options, const DiscrepancyPriors& priors,
                                           JobContext& job) {
  if (!near.enough || !input.log || input.tangents || options.max_effects == 0) return std::nullopt;
  // Read from the simulation, which is computed from the log.
  if (near.log_clock_uncertainty_s > 0.0) return std::nullopt;
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
    if (!logCovers(input, near.log_clock_s + by_s)) return -std::numeric_limits<double>::infinity();
    DriverTable drivers = *analysis.drivers;
    drivers.shiftClock(by_s);
    const EffectSearch search(problem, drivers, analysis.catalogue);
    const CandidateLibrary library(search, problem, job);
    return PosteriorSearch(search, problem, library, strongest, priors, analysis.simulation_error).run(job).evidence;
  };
  const std::optional<ClockOffset> by = farLogClock(evidenceAt);
  if (!by) return std::nullopt;
  JudgedAnalysis far = withClock(input, options, priors, near.log_clock_s + by->offset_s, job);
  far.log_clock_uncertainty_s = by->standard_uncertainty_s;
  // A clock that is hours off is believed for what explains all of it.
  const bool all = !far.judged.names.empty() && far.judged.leftover.empty();
  const Analysis& moved = *far.analysis;
  const auto& of_far = far.judged.named.terms;
  const bool shown = std::any_of(of_far.begin(), of_far.end(),
                                 [&](const ModelTerm& term) { return showsClock(term, *moved.drivers); });
  if (!all || !shown) return std::nullopt;
  const double worth = moved.posterior.over_unknown - std::max(0.0, analysis.posterior.over_unknown);
  const double price = priceOfFarClock(*far.problem, moved.catalogue, *moved.drivers, far.judged.named);
  if (worth < 2.0 * std::log(far_clocks / priors.far_clock) + price) return std::nullopt;
  return far;
}

}  // namespace

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

JudgedAnalysis judgedAnalysis(const DiscrepancyInput& input, const DiscrepancyOptions& options,
                              const DiscrepancyPriors& priors, JobContext& job) {
  JobContext at_once = job.part(0.0, 0.5);
  JudgedAnalysis answer = withClock(input, options, priors, input.log_clock_s, at_once);
  answer.input = std::shared_ptr<const DiscrepancyInput>(std::shared_ptr<const DiscrepancyInput>(), &input);
  followSimulationClock(answer, options, priors, at_once);
  JobContext far_off = job.part(0.5, 1.0);
  std::optional<JudgedAnalysis> far = withFarClock(*answer.input, answer, options, priors, far_off);
  if (!far) return answer;
  far->input = answer.input;
  return std::move(*far);
}

}  // namespace spindrift
