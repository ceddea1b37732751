// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/into_simulation.h"

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/json_reader.h"
#include "core/base/text.h"
#include "core/discrepancy/comparable_rows.h"
#include "core/discrepancy/discrepancy_numbers.h"
#include "core/discrepancy/mechanism_choice.h"
#include "core/discrepancy/places.h"
#include "core/discrepancy/simulation_closure.h"
#include "core/discrepancy/simulator_hypotheses.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// In whitened units: what a parameter may move within its uncertainty and is not worth a run.
constexpr double not_worth_a_run = 0.3;
/// The same of the error of a linear prediction, from which on derivatives are taken anew. Where they are a few per
/// cent off, the solution moves by as much of what noise alone moves it.
constexpr double not_linear = 2.0;
/// Derivatives that are off by this part are good enough: they turn the solution by as much of its uncertainty.
constexpr double derivatives_hold = 0.1;
/// The same of one standard uncertainty: none at all.
constexpr double no_influence = 1e-6;
/// Correlation of two fitted parameters from which on these data do not tell them apart.
constexpr double inseparable = 0.98;
/// Uncertainty after the fit over that before, from which on nothing was learnt of a parameter.
constexpr double nothing_learnt = 0.9;
/// Change of a parameter in standard uncertainties from which on the data support it.
constexpr double supported = 2.0;
/// rms with the physics over that with the fitted term, up to which they close the gap as well.
constexpr double as_well = 1.05;

/// A parameter that is fitted.
struct Free {
  SimulatorParameter parameter;
  double prior_sigma = 0.0;  ///< 0: anything within its bounds
  bool put_in = false;
  double start = 0.0;

  [[nodiscard]] double scale() const {
    return parameter.standard_uncertainty > 0.0 ? parameter.standard_uncertainty
                                                : 0.1 * (parameter.max - parameter.min);
  }
  /// Of a finite difference around `value`, within the bounds.
  [[nodiscard]] double step(double value) const {
    const double size = std::min(0.25 * scale(), 0.25 * (parameter.max - parameter.min));
    return value + size <= parameter.max ? size : -size;
  }
};

using Closure = SimulationClosure;

/// Throws SimulatorFailed.
SimulatorRun runAt(Closure& closure, const ParameterValues& values) {
  SimulatorRuns runs = closure.run({values});
  if (!runs.failed[0].empty()) throw SimulatorFailed(runs.failed[0]);
  return std::move(runs.runs[0]);
}

ParameterValues valuesOf(const std::vector<Free>& free, const double* scaled) {
  ParameterValues out;
  for (std::size_t k = 0; k < free.size(); ++k) {
    const SimulatorParameter& p = free[k].parameter;
    out[p.name] = std::clamp(free[k].start + scaled[k] * free[k].scale(), p.min, p.max);
  }
  return out;
}

/// Residual and derivatives for the trust region. Parameters are in units of their scales, from where they start.
class ClosureCost : public ceres::CostFunction {
 public:
  /// `slopes`: projected change per unit of each parameter, empty where it has to be found first.
  ClosureCost(Closure& closure, const std::vector<Free>& free, std::vector<Eigen::VectorXd> slopes)
      : closure_(&closure), free_(&free), slopes_(std::move(slopes)) {
    set_num_residuals(static_cast<int>(closure.residual().size() + static_cast<Index>(free.size())));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(free.size()));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    try {
      const Eigen::VectorXd change = changeAt(parameters[0]);
      const Index rows = change.size();
      const auto count = static_cast<Index>(free_->size());
      Eigen::Map<Eigen::VectorXd> out(residuals, rows + count);
      out.head(rows) = closure_->residual() - change;
      for (Index k = 0; k < count; ++k) {
        const Free& f = (*free_)[static_cast<std::size_t>(k)];
        const double value = f.start + parameters[0][k] * f.scale();
        out[rows + k] = f.prior_sigma > 0.0 ? (value - f.parameter.value) / f.prior_sigma : 0.0;
      }
      if (jacobians == nullptr || jacobians[0] == nullptr) return true;
      updateSlopes(parameters[0], change);
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> j(jacobians[0], rows + count,
                                                                                           count);
      j.setZero();
      for (Index k = 0; k < count; ++k) {
        const Free& f = (*free_)[static_cast<std::size_t>(k)];
        j.col(k).head(rows) = -slopes_[static_cast<std::size_t>(k)] * f.scale();
        if (f.prior_sigma > 0.0) j(rows + k, k) = f.scale() / f.prior_sigma;
      }
      return true;
    } catch (const SimulatorFailed& failed) {
      failure_ = failed.what();
    } catch (...) {
      thrown_ = std::current_exception();
    }
    return false;
  }

  [[nodiscard]] const std::vector<Eigen::VectorXd>& slopes() const noexcept { return slopes_; }
  [[nodiscard]] const std::string& failure() const noexcept { return failure_; }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  [[nodiscard]] Eigen::VectorXd changeAt(const double* scaled) const {
    const std::vector<double> at(scaled, scaled + free_->size());
    if (at == last_at_) return last_change_;
    last_change_ = closure_->projectedChange(runAt(*closure_, valuesOf(*free_, scaled)));
    last_at_ = at;
    return last_change_;
  }

  /// Derivatives are kept while they foretell the runs; else those of what is put in are taken anew, as are all that
  /// are missing.
  void updateSlopes(const double* scaled, const Eigen::VectorXd& change) const {
    const std::vector<double> at(scaled, scaled + free_->size());
    bool stale = slopes_at_.empty();
    if (!stale) {
      Eigen::VectorXd foretold = slopes_change_;
      for (std::size_t k = 0; k < at.size(); ++k)
        foretold += slopes_[k] * ((at[k] - slopes_at_[k]) * (*free_)[k].scale());
      stale = (foretold - change).norm() > not_linear;
    }
    std::vector<std::size_t> which;
    for (std::size_t k = 0; k < at.size(); ++k) {
      // What did nothing does nothing.
      const bool idle = slopes_[k].size() > 0 && !(slopes_[k].norm() * (*free_)[k].scale() > no_influence);
      if (slopes_[k].size() == 0 || (stale && (*free_)[k].put_in && !slopes_at_.empty() && !idle)) which.push_back(k);
    }
    if (which.empty() && !slopes_at_.empty()) return;
    std::vector<ParameterValues> sets;
    for (const std::size_t k : which) {
      ParameterValues values = valuesOf(*free_, scaled);
      double& value = values[(*free_)[k].parameter.name];
      value += (*free_)[k].step(value);
      sets.push_back(std::move(values));
    }
    const SimulatorRuns runs = closure_->run(sets);
    for (std::size_t i = 0; i < which.size(); ++i) {
      if (!runs.failed[i].empty()) throw SimulatorFailed(runs.failed[i]);
      const Free& f = (*free_)[which[i]];
      const double value = valuesOf(*free_, scaled)[f.parameter.name];
      slopes_[which[i]] = (closure_->projectedChange(runs.runs[i]) - change) / f.step(value);
    }
    slopes_at_ = at;
    slopes_change_ = change;
  }

  Closure* closure_;
  const std::vector<Free>* free_;
  mutable std::vector<Eigen::VectorXd> slopes_;
  mutable std::vector<double> slopes_at_;
  mutable Eigen::VectorXd slopes_change_;
  mutable std::vector<double> last_at_;
  mutable Eigen::VectorXd last_change_;
  mutable std::string failure_;
  mutable std::exception_ptr thrown_;
};

struct Solved {
  std::vector<double> scaled;
  double cost = 0.0;
  bool usable = false;
  std::vector<Eigen::VectorXd> slopes;
  std::string failure;
};

Solved solve(Closure& closure, const std::vector<Free>& free, std::vector<double> start,
             std::vector<Eigen::VectorXd> slopes, int most_iterations) {
  // What ends a fit is told in our own sentences.
  FLAGS_minloglevel = google::GLOG_FATAL;
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ClosureCost cost(closure, free, std::move(slopes));
  ceres::Problem problem(ownership);
  Solved out;
  out.scaled = std::move(start);
  problem.AddResidualBlock(&cost, nullptr, out.scaled.data());
  for (std::size_t k = 0; k < free.size(); ++k) {
    const SimulatorParameter& p = free[k].parameter;
    problem.SetParameterLowerBound(out.scaled.data(), static_cast<int>(k), (p.min - free[k].start) / free[k].scale());
    problem.SetParameterUpperBound(out.scaled.data(), static_cast<int>(k), (p.max - free[k].start) / free[k].scale());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = most_iterations;
  options.max_num_consecutive_invalid_steps = 3;
  options.function_tolerance = 1e-4;
  options.parameter_tolerance = 1e-3;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  cost.rethrow();
  out.usable = summary.IsSolutionUsable();
  out.cost = 2.0 * summary.final_cost;
  out.slopes = cost.slopes();
  out.failure = cost.failure();
  return out;
}

/// Where the fit starts: as the search found it, or by the tangent.
double startOf(const SimulatorParameter& p, const DiscrepancyResult& result, const Closure& closure,
               const SimulatorTangents& tangents) {
  for (const FoundEffect& effect : result.effects) {
    for (const FittedParameter& f : effect.parameters) {
      if (f.name == p.name && (effect.id == p.id() || p.unit == "s")) return std::clamp(f.value, p.min, p.max);
    }
  }
  for (const SimulatorTangent& tangent : tangents.tangents) {
    if (tangent.parameter.name != p.name) continue;
    const Eigen::VectorXd x = closure.projected(tangent.per_unit);
    const double gain = x.dot(closure.residual()) / std::max(1e-12, x.squaredNorm());
    return std::clamp(p.value + gain, p.min, p.max);
  }
  return p.value;
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

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] - b[i];
  return out;
}

/// Measured, simulation before and after, and with the fitted term instead.
void tellFigures(const DiscrepancyInput& input, const DiscrepancyResult& result, const ComparableRows& rows,
                 SimulationUpdate& out) {
  const std::vector<double> nothing(out.before.size(), 0.0);
  const RowResult before = evaluateRows(input, rows.fit, rows.held_out, nothing);
  const RowResult after = evaluateRows(input, rows.fit, rows.held_out, difference(out.after, out.before));
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
  out.as_well_as_fitted_term = held ? out.heldout_rms_after_um <= as_well * out.heldout_rms_fitted_term_um
                                    : out.rms_after_um <= as_well * out.rms_fitted_term_um;
}

void tellParameters(const std::vector<Free>& free, const Solved& solved, double widening, SimulationUpdate& out) {
  const auto count = static_cast<Index>(free.size());
  std::vector<Index> inner;  // not at a bound, and with influence
  for (Index k = 0; k < count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const Free& f = free[at];
    FittedSimulatorParameter fitted{f.parameter, f.start + solved.scaled[at] * f.scale(), 0.0, f.put_in};
    const double range = f.parameter.max - f.parameter.min;
    fitted.no_influence = !(solved.slopes[at].norm() * f.scale() > no_influence);
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
  // Directions that nothing determines get a large uncertainty, not an infinite one.
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
      out.warnings.push_back(fmt::format(
          "{} and {} cannot be told apart with these data (correlation {:.3f}): only what they do together is known.",
          free[static_cast<std::size_t>(j)].parameter.name, free[at].parameter.name, r));
    }
  }
  for (FittedSimulatorParameter& p : out.parameters) {
    // Of what these data say nothing, what was known stays.
    if (!p.put_in && p.standard_uncertainty > nothing_learnt * p.parameter.standard_uncertainty)
      p.value = p.parameter.value;
    if (p.no_influence) {
      out.warnings.push_back(fmt::format("{} changes no prediction: it keeps its value {}.", p.parameter.name,
                                         withUncertainty(p.parameter.value, 0.0, p.parameter.printedUnit())));
    } else if (p.at_bound) {
      const bool low = p.value <= p.parameter.min + 1e-6 * (p.parameter.max - p.parameter.min);
      out.warnings.push_back(fmt::format(
          "{} ends at its bound {}: the data ask for {}; widen \"{}\" or look for "
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
    out.warnings.push_back(fmt::format(
        "{} was asked for, but these data do not support it: {} is no more than {:g} standard uncertainties from the "
        "{} before.",
        fitted->parameter.name, withUncertainty(fitted->value, fitted->standard_uncertainty, unit), supported,
        withUncertainty(fitted->parameter.value, 0.0, unit)));
  }
}

/// Halves the way from the present values to where the fit starts while the simulator fails there; the sentence of the
/// first failure, or none.
std::string retreat(Closure& closure, std::vector<Free>& free) {
  std::string failure;
  constexpr int most_halvings = 4;
  for (int halving = 0; halving <= most_halvings; ++halving) {
    try {
      const std::vector<double> zero(free.size(), 0.0);
      static_cast<void>(closure.projectedChange(runAt(closure, valuesOf(free, zero.data()))));
      return failure;
    } catch (const SimulatorFailed& failed) {
      if (failure.empty()) failure = failed.what();
    }
    for (Free& f : free) f.start = 0.5 * (f.start + f.parameter.value);
  }
  return failure;
}

/// One run with all parameters that keep their first derivatives moved by half their uncertainty, to and fro: true if
/// the derivatives foretell it.
bool slopesHold(Closure& closure, const std::vector<Free>& free, const Solved& solved) {
  std::vector<double> moved = solved.scaled;
  double sign = 0.5;
  for (std::size_t k = 0; k < free.size(); ++k) {
    if (free[k].put_in) continue;
    moved[k] += sign;
    sign = -sign;
  }
  if (moved == solved.scaled) return true;
  try {
    const ParameterValues here = valuesOf(free, solved.scaled.data());
    const ParameterValues there = valuesOf(free, moved.data());
    Eigen::VectorXd foretold = Eigen::VectorXd::Zero(closure.residual().size());
    for (std::size_t k = 0; k < free.size(); ++k) {
      const std::string& name = free[k].parameter.name;
      foretold += solved.slopes[k] * (there.at(name) - here.at(name));
    }
    const Eigen::VectorXd change =
        closure.projectedChange(runAt(closure, there)) - closure.projectedChange(runAt(closure, here));
    return (change - foretold).norm() < std::max(not_linear, derivatives_hold * foretold.norm());
  } catch (const SimulatorFailed&) {
    return true;  // nothing to learn there
  }
}

std::string sentenceOf(const SimulationUpdate& update) {
  std::vector<std::string> put;
  for (const FittedSimulatorParameter& p : update.parameters) {
    if (!p.put_in || p.no_influence) continue;
    put.push_back(fmt::format("{} = {} (was {})", p.parameter.name,
                              withUncertainty(p.value, p.standard_uncertainty, p.parameter.printedUnit()),
                              withUncertainty(p.parameter.value, 0.0, "")));
  }
  const bool held = std::isfinite(update.heldout_rms_after_um);
  const double before = held ? update.heldout_rms_before_um : update.rms_before_um;
  const double after = held ? update.heldout_rms_after_um : update.rms_after_um;
  const double term = held ? update.heldout_rms_fitted_term_um : update.rms_fitted_term_um;
  const char* states = held ? "on the held-out states" : "on the fitted states";
  if (!update.improves) {
    return fmt::format("The gap {} does not shrink ({:.2f} um before, {:.2f} um after): nothing was put in.", states,
                       before, after);
  }
  std::string text = fmt::format(
      "{}: the gap of the simulation's own new run {} is {:.2f} um, before {:.2f} um (noise "
      "{:.2f} um).",
      joinedList(put), states, after, before, update.noise_um);
  if (!update.as_well_as_fitted_term) {
    std::vector<std::string> places;
    for (const DisagreementPlace& place : update.where) {
      if (places.size() < 3)
        places.push_back(fmt::format("{} at {}", toString(place.component), shortenedList(place.points, 4, 3)));
    }
    text += fmt::format(" A fitted term closes it to {:.2f} um: the physics as they are do not close it as well{}.",
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
  const ComparableRows rows = comparableRows(input, told_before);
  Closure closure(input, result, simulator, rows.fit, job);
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

  // What is free: the mechanisms, what acts only with them, and what is uncertain and seen.
  const SimulatorTangents& tangents = *input.tangents;
  std::vector<Free> free;
  std::vector<Eigen::VectorXd> slopes;
  std::set<std::string> of_windows;
  for (const SimulatorTangent& t : tangents.tangents) {
    const bool put = std::find(out.mechanisms.begin(), out.mechanisms.end(), t.parameter.name) != out.mechanisms.end();
    if (put && t.window) of_windows.insert({t.window->begin_s, t.window->end_s});
  }
  std::set<std::string> of_any_window;
  for (const SimulatorWindow& w : simulator.windows()) of_any_window.insert({w.begin_s, w.end_s});
  for (const SimulatorParameter& p : simulator.parameters()) {
    const bool named = std::find(out.mechanisms.begin(), out.mechanisms.end(), p.name) != out.mechanisms.end();
    const bool mute = std::find(tangents.mute.begin(), tangents.mute.end(), p.name) != tangents.mute.end();
    Free f{p, 0.0, false, p.value};
    Eigen::VectorXd slope;
    if (named || of_windows.contains(p.name)) {
      f.put_in = true;
      f.start = startOf(p, result, closure, tangents);
    } else if (mute) {
      // It may act together with what is put in; then it keeps to what is known of it.
      if (of_any_window.contains(p.name) || p.off()) continue;
      f.put_in = true;
      f.prior_sigma = p.standard_uncertainty;
    } else {
      if (p.off() || !(p.standard_uncertainty > 0.0)) continue;
      const auto tangent = std::find_if(tangents.tangents.begin(), tangents.tangents.end(),
                                        [&](const SimulatorTangent& t) { return t.parameter.name == p.name; });
      if (tangent == tangents.tangents.end()) continue;
      slope = closure.projected(tangent->per_unit);
      if (slope.norm() * p.standard_uncertainty < not_worth_a_run) continue;
      f.prior_sigma = p.standard_uncertainty;
    }
    free.push_back(std::move(f));
    slopes.push_back(std::move(slope));
  }
  // A mechanism that starts at zero has no companions to see.
  for (Free& f : free) {
    if (f.put_in && f.parameter.off() && f.start == 0.0) f.start = tangentStep(f.parameter);
  }

  const std::string failed_at_start = retreat(closure, free);
  Solved solved = solve(closure, free, std::vector<double>(free.size(), 0.0), slopes, options.most_iterations);
  if (solved.usable) {
    job.report(0.7, "running the simulation");
    // Derivatives that no longer hold where it ended are taken anew, and the fit goes on with them.
    Solved again;
    if (!slopesHold(closure, free, solved)) {
      std::vector<Eigen::VectorXd> kept(free.size());
      for (std::size_t k = 0; k < free.size(); ++k) {
        if (!(solved.slopes[k].norm() * free[k].scale() > no_influence)) kept[k] = solved.slopes[k];
      }
      again = solve(closure, free, solved.scaled, std::move(kept), options.most_iterations);
    }
    if (again.usable) {
      if (again.failure.empty()) again.failure = solved.failure;
      solved = std::move(again);
    }
  }
  out.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  out.runs = closure.runs();
  if (!solved.usable) {
    out.status = FitStatus::NoConvergence;
    out.message = solved.failure.empty() ? "The fit of the simulator's parameters did not settle: nothing was put in."
                                         : "The simulator failed while it was fitted: " + solved.failure;
    return out;
  }
  const std::string& failure = failed_at_start.empty() ? solved.failure : failed_at_start;
  if (!failure.empty())
    out.warnings.push_back("Not all values could be tried; what is found keeps to those that could. " + failure);
  // Priors are data too.
  const double dof =
      std::max(1.0, static_cast<double>(closure.problem().degreesOfFreedom()) - static_cast<double>(free.size()));
  tellParameters(free, solved, std::sqrt(std::max(1.0, solved.cost / dof)), out);
  tellUnsupported(options.mechanisms, simulator, out);
  SimulatorRun last = runAt(closure, out.values);
  out.runs = closure.runs();
  out.after = last.predicted;
  out.rows = std::move(last.rows);
  tellFigures(input, result, rows, out);
  const DriverTable drivers(input.machine, input.log ? &*input.log : nullptr);
  SimulatorRun changed;
  changed.predicted = out.after;
  const Eigen::VectorXd left = closure.residual() - closure.projectedChange(changed);
  out.where = findPlaces(closure.problem(), drivers, left.head(closure.problem().size()));
  out.status = out.improves ? FitStatus::Converged : FitStatus::Rejected;
  out.message = sentenceOf(out);
  out.elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

nlohmann::json SimulationUpdate::json() const {
  nlohmann::json fitted = nlohmann::json::object();
  nlohmann::json names = nlohmann::json::array();
  for (const FittedSimulatorParameter& p : parameters) {
    names.push_back(p.parameter.name);
    fitted[p.parameter.name] = {{"value", jsonNumber(p.value)},
                                {"standard_uncertainty", jsonNumber(p.standard_uncertainty)},
                                {"before", jsonNumber(p.parameter.value)},
                                {"standard_uncertainty_before", jsonNumber(p.parameter.standard_uncertainty)},
                                {"unit", p.parameter.unit},
                                {"what", p.parameter.what},
                                {"put_in", p.put_in},
                                {"at_bound", p.at_bound},
                                {"no_influence", p.no_influence}};
  }
  nlohmann::json matrix = nlohmann::json::array();
  for (Index i = 0; i < correlation.rows(); ++i) {
    nlohmann::json row = nlohmann::json::array();
    for (Index j = 0; j < correlation.cols(); ++j) row.push_back(jsonNumber(correlation(i, j)));
    matrix.push_back(std::move(row));
  }
  nlohmann::json places = nlohmann::json::array();
  for (const DisagreementPlace& p : where) {
    places.push_back({{"component", toString(p.component)},
                      {"points", p.points},
                      {"from_s", p.from_s},
                      {"to_s", p.to_s},
                      {"excess_um", jsonNumber(p.excess_um)},
                      {"p_value", jsonNumber(p.p_value)}});
  }
  return {{"status", toString(status)},
          {"message", message},
          {"mechanisms", mechanisms},
          {"parameters", fitted},
          {"correlation", {{"parameters", names}, {"matrix", matrix}}},
          {"rms_before_um", jsonNumber(rms_before_um)},
          {"rms_after_um", jsonNumber(rms_after_um)},
          {"rms_fitted_term_um", jsonNumber(rms_fitted_term_um)},
          {"p2p_before_um", jsonNumber(p2p_before_um)},
          {"p2p_after_um", jsonNumber(p2p_after_um)},
          {"heldout_rms_before_um", jsonNumber(heldout_rms_before_um)},
          {"heldout_rms_after_um", jsonNumber(heldout_rms_after_um)},
          {"heldout_rms_fitted_term_um", jsonNumber(heldout_rms_fitted_term_um)},
          {"noise_um", jsonNumber(noise_um)},
          {"improves", improves},
          {"as_well_as_fitted_term", as_well_as_fitted_term},
          {"where", places},
          {"warnings", warnings},
          {"runs", runs},
          {"elapsed_s", jsonNumber(elapsed_s)}};
}

SimulationUpdate SimulationUpdate::parse(const nlohmann::json& json) {
  const auto number = [](const nlohmann::json& object, const char* key) {
    const nlohmann::json& value = object.at(key);
    return value.is_number() ? value.get<double>() : std::nan("");
  };
  SimulationUpdate out;
  for (const FitStatus status :
       {FitStatus::Converged, FitStatus::Degenerate, FitStatus::NoConvergence, FitStatus::Rejected}) {
    if (json.at("status") == std::string(toString(status))) out.status = status;
  }
  out.message = json.at("message").get<std::string>();
  out.mechanisms = json.at("mechanisms").get<std::vector<std::string>>();
  const nlohmann::json& names = json.at("correlation").at("parameters");
  const nlohmann::json& matrix = json.at("correlation").at("matrix");
  const auto count = static_cast<Index>(names.size());
  out.correlation = Eigen::MatrixXd::Zero(count, count);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto name = names[i].get<std::string>();
    const nlohmann::json& p = json.at("parameters").at(name);
    FittedSimulatorParameter fitted;
    fitted.parameter.name = name;
    fitted.parameter.value = number(p, "before");
    fitted.parameter.standard_uncertainty = number(p, "standard_uncertainty_before");
    fitted.parameter.unit = p.at("unit").get<std::string>();
    fitted.parameter.what = p.at("what").get<std::string>();
    fitted.value = number(p, "value");
    fitted.standard_uncertainty = number(p, "standard_uncertainty");
    fitted.put_in = p.at("put_in").get<bool>();
    fitted.at_bound = p.at("at_bound").get<bool>();
    fitted.no_influence = p.at("no_influence").get<bool>();
    out.parameters.push_back(std::move(fitted));
    for (std::size_t j = 0; j < names.size(); ++j) {
      const nlohmann::json& r = matrix.at(i).at(j);
      if (r.is_number()) out.correlation(static_cast<Index>(i), static_cast<Index>(j)) = r.get<double>();
    }
  }
  out.warnings = json.at("warnings").get<std::vector<std::string>>();
  out.rms_before_um = number(json, "rms_before_um");
  out.rms_after_um = number(json, "rms_after_um");
  out.rms_fitted_term_um = number(json, "rms_fitted_term_um");
  out.p2p_before_um = number(json, "p2p_before_um");
  out.p2p_after_um = number(json, "p2p_after_um");
  out.heldout_rms_before_um = number(json, "heldout_rms_before_um");
  out.heldout_rms_after_um = number(json, "heldout_rms_after_um");
  out.heldout_rms_fitted_term_um = number(json, "heldout_rms_fitted_term_um");
  out.noise_um = number(json, "noise_um");
  out.improves = json.at("improves").get<bool>();
  out.as_well_as_fitted_term = json.at("as_well_as_fitted_term").get<bool>();
  out.runs = json.at("runs").get<std::size_t>();
  out.elapsed_s = number(json, "elapsed_s");
  return out;
}

std::string SimulationUpdate::summary() const {
  std::string text = "into the simulation: " + message + "\n";
  for (const FittedSimulatorParameter& p : parameters) {
    if (p.no_influence) continue;
    text += fmt::format("  {:<14} {}  (was {:g}{})\n", p.parameter.name,
                        withUncertainty(p.value, p.standard_uncertainty, p.parameter.printedUnit()), p.parameter.value,
                        p.put_in ? ", put in" : "");
  }
  for (const std::string& warning : warnings) text += fmt::format("  note: {}\n", warning);
  return text;
}

}  // namespace spindrift
