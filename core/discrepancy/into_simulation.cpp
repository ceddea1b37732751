// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/into_simulation.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <set>

#include "core/base/text.h"
#include "core/discrepancy/comparable_rows.h"
#include "core/discrepancy/discrepancy_numbers.h"
#include "core/discrepancy/mechanism_choice.h"
#include "core/discrepancy/places.h"
#include "core/discrepancy/simulation_closure.h"
#include "core/discrepancy/simulation_fit.h"
#include "core/discrepancy/simulator_hypotheses.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// In whitened units: what a parameter may move within its uncertainty and is
/// not worth a run.
constexpr double not_worth_a_run = 0.3;
/// Correlation of two fitted parameters from which on these data do not tell
/// them apart.
constexpr double inseparable = 0.98;
/// Change of a parameter in standard uncertainties from which on the data
/// support it.
constexpr double supported = 2.0;
/// The physics close the gap less well than the fitted term only if what they leave is larger by more than this factor
/// of the rms, and larger with this probability.
constexpr double as_well = 1.05;
constexpr double surely_more = 0.95;

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What is free: the mechanisms, what acts only with them, and what is
/// uncertain and seen.
std::vector<FreeParameter> freeParameters(const std::vector<std::string>& mechanisms, const DiscrepancyResult& result,
                                          const Simulator& simulator, const SimulatorTangents& tangents,
                                          const SimulationClosure& closure, std::vector<FreeWindow>& windows) {
  // Where loads between two times begin and end: as the search found it, else
  // where they explain most.
  std::map<std::string, double> times;
  std::set<std::string> of_any_window;
  for (const SimulatorWindow& w : simulator.windows()) of_any_window.insert({w.begin_s, w.end_s});
  const auto tangentOf = [&](const std::string& name) -> const SimulatorTangent* {
    for (const SimulatorTangent& t : tangents.tangents) {
      if (t.parameter.name == name) return &t;
    }
    return nullptr;
  };
  for (const SimulatorTangent& t : tangents.tangents) {
    if (!t.window || !holds(mechanisms, t.parameter.name)) continue;
    const LoadWindow best = bestWindow(t, closure.problem(), {Eigen::MatrixXd(), closure.residual()});
    times[t.window->begin_s] = best.from_s;
    times[t.window->end_s] = best.to_s;
    for (const FoundEffect& effect : result.effects) {
      for (const FittedParameter& f : effect.parameters) {
        if (effect.id == t.parameter.id() && times.contains(f.name)) times[f.name] = f.value;
      }
    }
  }
  std::vector<FreeParameter> free;
  for (const SimulatorParameter& p : simulator.parameters()) {
    FreeParameter f;
    f.parameter = p;
    f.start = p.value;
    const SimulatorTangent* tangent = tangentOf(p.name);
    if (holds(mechanisms, p.name) || times.contains(p.name)) {
      f.put_in = true;
      if (times.contains(p.name)) f.start = std::clamp(times.at(p.name), p.min, p.max);
      // Over the whole change that is asked for, where that is known.
      if (tangent != nullptr)
        f.slope = closure.projected(tangent->per_unit_far.empty() ? tangent->per_unit : tangent->per_unit_far);
    } else if (holds(tangents.mute, p.name)) {
      // It may act together with what is put in; then it keeps to what is known
      // of it.
      if (of_any_window.contains(p.name) || p.off()) continue;
      f.put_in = f.companion = true;
      f.prior_sigma = p.standard_uncertainty;
    } else {
      if (p.off() || !(p.standard_uncertainty > 0.0) || tangent == nullptr) continue;
      f.slope = closure.projected(tangent->per_unit);
      if (f.slope.norm() * p.standard_uncertainty < not_worth_a_run) continue;
      f.prior_sigma = p.standard_uncertainty;
    }
    free.push_back(std::move(f));
  }
  const auto placeOf = [&](const std::string& name) {
    return static_cast<std::size_t>(
        std::find_if(free.begin(), free.end(), [&](const FreeParameter& f) { return f.parameter.name == name; }) -
        free.begin());
  };
  for (const SimulatorTangent& t : tangents.tangents) {
    if (!t.window || !holds(mechanisms, t.parameter.name)) continue;
    windows.push_back({placeOf(t.parameter.name), placeOf(t.window->begin_s), placeOf(t.window->end_s), t.window});
    FreeParameter& load = free[windows.back().load];
    load.start = t.parameter.value + tangentStep(t.parameter);
    for (const FoundEffect& effect : result.effects) {
      for (const FittedParameter& f : effect.parameters) {
        if (effect.id == t.parameter.id() && f.name == t.parameter.name)
          load.start = std::clamp(f.value, t.parameter.min, t.parameter.max);
      }
    }
  }
  return free;
}

double peakToPeak(const DiscrepancyInput& input, const std::vector<std::size_t>& rows,
                  const std::vector<double>& predicted, const std::vector<double>& constant, bool rotations) {
  double low = 0.0;
  double high = 0.0;
  bool first = true;
  for (const std::size_t row : rows) {
    const Observation& o = input.observations.rows[row];
    if (isRotation(o.component) != rotations) continue;
    const double left = o.value - predicted[row] - constant[row];
    low = first ? left : std::min(low, left);
    high = first ? left : std::max(high, left);
    first = false;
  }
  return high - low;
}

std::vector<double> changeOf(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] - b[i];
  return out;
}

/// Measured, simulation before and after, and with the fitted term instead.
void tellFigures(const DiscrepancyInput& input, const DiscrepancyResult& result, const ComparableRows& rows,
                 SimulationUpdate& out) {
  const std::vector<double> nothing(out.before.size(), 0.0);
  const RowResult before = evaluateRows(input, rows.fit, rows.held_out, nothing);
  const RowResult after = evaluateRows(input, rows.fit, rows.held_out, changeOf(out.after, out.before));
  const RowResult term = evaluateRows(input, rows.fit, rows.held_out, result.effect_part);
  out.rms_before_um = before.fit_rms;
  out.rms_after_um = after.fit_rms;
  out.rms_fitted_term_um = term.fit_rms;
  const bool held = before.holdout_rows > 0;
  out.heldout_rms_before_um = held ? before.holdout_rms : std::nan("");
  out.heldout_rms_after_um = held ? after.holdout_rms : std::nan("");
  out.heldout_rms_fitted_term_um = held ? term.holdout_rms : std::nan("");
  out.p2p_before_um = peakToPeak(input, rows.fit, out.before, before.constant, before.rotations);
  out.p2p_after_um = peakToPeak(input, rows.fit, out.after, after.constant, after.rotations);
  out.noise_um = result.gap.noise_um;
  out.improves = held ? out.heldout_rms_after_um < out.heldout_rms_before_um : out.rms_after_um < out.rms_before_um;
  const bool more = held ? out.heldout_rms_after_um > as_well * out.heldout_rms_fitted_term_um
                         : out.rms_after_um > as_well * out.rms_fitted_term_um;
  out.as_well_as_fitted_term =
      !more || probabilityOfLeavingMore(input.observations.rows, held ? rows.held_out : rows.fit, after.left,
                                        term.left) < surely_more;
}

void tellParameters(const std::vector<FreeParameter>& free, const SimulationFit& solved, double widening,
                    SimulationUpdate& out) {
  const auto count = static_cast<Index>(free.size());
  std::vector<Index> inner;  // not at a bound, and with influence
  for (Index k = 0; k < count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const FreeParameter& f = free[at];
    FittedSimulatorParameter fitted{f.parameter, solved.values[at], 0.0, f.put_in};
    const double range = f.parameter.max - f.parameter.min;
    fitted.no_influence = !(solved.slopes[at].norm() * f.scale() > no_influence_at_all);
    fitted.at_bound =
        !fitted.no_influence && fitted.value != f.parameter.value &&
        (fitted.value <= f.parameter.min + 1e-6 * range || fitted.value >= f.parameter.max - 1e-6 * range);
    if (!fitted.no_influence && !fitted.at_bound) inner.push_back(k);
    if (fitted.no_influence) fitted.value = f.parameter.value;
    out.parameters.push_back(std::move(fitted));
  }
  const auto m = static_cast<Index>(inner.size());
  Eigen::MatrixXd information(m, m);
  for (Index a = 0; a < m; ++a) {
    const auto i = static_cast<std::size_t>(inner[static_cast<std::size_t>(a)]);
    for (Index b = 0; b < m; ++b) {
      const auto j = static_cast<std::size_t>(inner[static_cast<std::size_t>(b)]);
      information(a, b) = solved.slopes[i].dot(solved.slopes[j]) * free[i].scale() * free[j].scale();
    }
    if (free[i].prior_sigma > 0.0) information(a, a) += std::pow(free[i].scale() / free[i].prior_sigma, 2);
  }
  // Directions that nothing determines get a large uncertainty, not an infinite
  // one.
  information.diagonal().array() += 1e-9 * std::max(1.0, m > 0 ? information.diagonal().maxCoeff() : 1.0);
  const Eigen::MatrixXd covariance = information.ldlt().solve(Eigen::MatrixXd::Identity(m, m));
  out.correlation = Eigen::MatrixXd::Zero(count, count);
  for (Index a = 0; a < m; ++a) {
    const Index i = inner[static_cast<std::size_t>(a)];
    const auto at = static_cast<std::size_t>(i);
    out.parameters[at].standard_uncertainty = widening * free[at].scale() * std::sqrt(covariance(a, a));
    for (Index b = 0; b < m; ++b) {
      const Index j = inner[static_cast<std::size_t>(b)];
      const double r = covariance(a, b) / std::sqrt(covariance(a, a) * covariance(b, b));
      out.correlation(i, j) = r;
      if (b >= a || std::abs(r) < inseparable) continue;
      out.warnings.push_back(
          fmt::format("{} and {} cannot be distinguished with these data (correlation {:.3f}): only their joint effect "
                      "is determined.",
                      free[static_cast<std::size_t>(j)].parameter.name, free[at].parameter.name, r));
    }
  }
  for (FittedSimulatorParameter& p : out.parameters) {
    if (p.no_influence) {
      out.warnings.push_back(fmt::format("{} changes no prediction: it keeps its value {}.", p.parameter.name,
                                         withUncertainty(p.parameter.value, 0.0, p.parameter.printedUnit())));
    } else if (p.at_bound) {
      const bool low = p.value <= p.parameter.min + 1e-6 * (p.parameter.max - p.parameter.min);
      out.warnings.push_back(fmt::format(
          "{} ends at its bound {}: the data ask for {}; widen "
          "\"{}\" or look for "
          "another cause.",
          p.parameter.name, withUncertainty(low ? p.parameter.min : p.parameter.max, 0.0, p.parameter.printedUnit()),
          low ? "less" : "more", low ? "min" : "max"));
    }
    if (!p.no_influence && (p.put_in || p.value != p.parameter.value)) out.values[p.parameter.name] = p.value;
  }
}

/// What was asked for and these data do not show.
void tellUnsupported(const std::vector<std::string>& asked, const Simulator& simulator, SimulationUpdate& out) {
  for (const std::string& name : asked) {
    const SimulatorParameter* asked_for = simulator.find(name);
    const auto fitted =
        std::find_if(out.parameters.begin(), out.parameters.end(),
                     [&](const FittedSimulatorParameter& p) { return p.parameter.name == asked_for->name; });
    if (fitted == out.parameters.end() || fitted->no_influence) continue;
    if (std::abs(fitted->value - fitted->parameter.value) > supported * fitted->standard_uncertainty) continue;
    const std::string unit = fitted->parameter.printedUnit();
    out.warnings.push_back(
        fmt::format("{} was asked for, but these data do not support it: {} is no more "
                    "than {:g} standard uncertainties from the "
                    "{} before.",
                    fitted->parameter.name, withUncertainty(fitted->value, fitted->standard_uncertainty, unit),
                    supported, withUncertainty(fitted->parameter.value, 0.0, unit)));
  }
}

std::string updateSentence(const SimulationUpdate& update) {
  std::vector<std::string> put;
  for (const FittedSimulatorParameter& p : update.parameters) {
    if (!p.put_in || p.no_influence) continue;
    put.push_back(fmt::format("{} = {}, before {}", p.parameter.name,
                              withUncertainty(p.value, p.standard_uncertainty, p.parameter.printedUnit()),
                              withUncertainty(p.parameter.value, 0.0, "")));
  }
  const bool held = std::isfinite(update.heldout_rms_after_um);
  const double before = held ? update.heldout_rms_before_um : update.rms_before_um;
  const double after = held ? update.heldout_rms_after_um : update.rms_after_um;
  const double term = held ? update.heldout_rms_fitted_term_um : update.rms_fitted_term_um;
  const char* states = held ? "on the held-out states" : "on the fitted states";
  if (!update.improves) {
    return fmt::format(
        "The gap {} does not shrink ({:.2f} µm before, {:.2f} "
        "µm after): nothing was put in.",
        states, before, after);
  }
  std::string text = fmt::format(
      "{}: the gap of the simulation's own new run {} is {:.2f} "
      "µm, before {:.2f} µm (noise "
      "{:.2f} µm).",
      joinedList(put), states, after, before, update.noise_um);
  if (!update.as_well_as_fitted_term) {
    std::vector<std::string> places;
    for (const DisagreementPlace& place : update.where) {
      if (places.size() < 3)
        places.push_back(fmt::format("{} at {}", toString(place.component), shortenedList(place.points, 4, 3)));
    }
    text += fmt::format(
        " A fitted term closes it to {:.2f} µm: the physics as they are do not "
        "close it as well{}.",
        term, places.empty() ? "" : ", most in " + joinedList(places));
  }
  return text;
}

}  // namespace

SimulationUpdate putIntoSimulation(const DiscrepancyInput& input, const DiscrepancyResult& result,
                                   const Simulator& simulator, const IntoSimulationOptions& options, JobContext& job) {
  SPINDRIFT_ASSERT(input.tangents != nullptr, "a search with the simulator's tangents");
  const auto begin = std::chrono::steady_clock::now();
  SimulationUpdate out;
  out.before = out.after = input.predicted;
  std::vector<std::string> told_before;  // by the search
  const ComparableRows rows = comparableRows(input, input.log_clock_s, told_before);
  SimulationClosure closure(input, result, simulator, rows.fit, job);
  out.runs_to_search = input.tangents->runs;
  for (const std::string& name : options.mechanisms) {
    if (const SimulatorParameter* p = simulator.find(name)) {
      out.mechanisms.push_back(p->name);
      continue;
    }
    std::vector<std::string> known;
    for (const SimulatorParameter& p : simulator.parameters()) known.push_back(p.name);
    throw InputError({simulator.file(), ""},
                     fmt::format("has no parameter \"{}\"; allowed: {}.", name, joinedList(known, "or")));
  }
  if (options.mechanisms.empty()) {
    MechanismChoice behind = mechanismsBehind(input, result, simulator);
    out.mechanisms = std::move(behind.names);
    out.warnings = std::move(behind.warnings);
  }
  if (out.mechanisms.empty()) {
    out.status = FitStatus::Degenerate;
    out.message = result.effects.empty() ? "Nothing was named: there is nothing to put into the simulation."
                                         : "No mechanism of the simulation causes what was named: " +
                                               (out.warnings.empty() ? std::string() : out.warnings.front());
    return out;
  }

  std::vector<FreeWindow> windows;
  const std::vector<FreeParameter> free =
      freeParameters(out.mechanisms, result, simulator, *input.tangents, closure, windows);
  SimulationFit solved = fitSimulation(closure, free, windows, options.most_iterations, job);
  out.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  out.runs = closure.runs();
  if (!solved.usable) {
    out.status = FitStatus::NoConvergence;
    out.message = solved.failure.empty() ? "The fit of the simulator's parameters did not settle: nothing "
                                           "was put in."
                                         : "The simulator failed while it was fitted: " + solved.failure;
    return out;
  }
  if (!solved.failure.empty())
    out.warnings.push_back(
        "Not all values could be tried; what is found keeps "
        "to those that could. " +
        solved.failure);
  // Priors are data too.
  const double dof =
      std::max(1.0, static_cast<double>(closure.problem().degreesOfFreedom()) - static_cast<double>(free.size()));
  tellParameters(free, solved, std::sqrt(std::max(1.0, solved.cost / dof)), out);
  tellUnsupported(options.mechanisms, simulator, out);
  out.after = solved.run.predicted;
  out.rows = std::move(solved.run.rows);
  tellFigures(input, result, rows, out);
  const DriverTable drivers(input.machine, input.log ? &*input.log : nullptr);
  const Eigen::VectorXd left = closure.residual() - closure.projectedChange(solved.run);
  out.where = findPlaces(closure.problem(), drivers, left.head(closure.problem().size()));
  out.status = out.improves ? FitStatus::Converged : FitStatus::Rejected;
  out.message = updateSentence(out);
  out.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

}  // namespace spindrift
