// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/simulation_fit.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace spindrift {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Whitened: the error of the model, from which on its derivatives are taken
/// anew.
constexpr double not_linear = 2.0;
/// Derivatives that are off by this part are good enough: they turn the
/// solution by as much of its uncertainty.
constexpr double derivatives_hold = 0.1;
/// Chi-squared that a further run would have to win, also as part of the cost:
/// about 0.2 standard uncertainties at most.
constexpr double worth_a_run = 0.02;
constexpr double worth_a_run_of_cost = 1e-4;
/// Uncertainty after the fit over that before, from which on nothing is learnt
/// of a parameter: it keeps its value.
constexpr double nothing_learnt = 0.9;
constexpr int most_failures = 4;
constexpr int most_passes = 4;
constexpr double smallest_radius = 0.02;

VectorXd windowAnswer(const FreeWindow& window, const SimulationClosure& closure, double begin_s, double end_s) {
  const ResidualProblem& problem = closure.problem();
  VectorXd raw(problem.size());
  for (Index u = 0; u < problem.size(); ++u) {
    const auto at = static_cast<std::size_t>(u);
    const std::string& point = problem.place[at].point;
    const Component component = problem.component[at];
    raw[u] = window.response->at(problem.time_s[at] - begin_s, point, component) -
             window.response->at(problem.time_s[at] - end_s, point, component);
  }
  return problem.projected(raw).col(0);
}

/// Half of the time between the rows of the response: over less it is a
/// straight line.
double halfSpacing(const WindowedLoad& load) {
  for (const auto& [key, series] : load.step_response) {
    if (series.size() > 1)
      return 0.5 * (series.back().first - series.front().first) / static_cast<double>(series.size() - 1);
  }
  return 60.0;
}

/// The model of the simulator around the best values.
class Model {
 public:
  Model(const SimulationClosure& closure, const std::vector<FreeParameter>& free,
        const std::vector<FreeWindow>& windows)
      : closure_(&closure), free_(&free), windows_(&windows), fixed_(free.size(), false) {
    for (const FreeParameter& f : free) {
      slopes_.push_back(f.slope.size() > 0 ? f.slope : VectorXd::Zero(closure.residual().size()));
      at_.push_back(f.parameter.value);
      lower_.push_back(f.parameter.min);
      upper_.push_back(f.parameter.max);
    }
    // What acts by its step response has corrections of that only.
    for (const FreeWindow& w : windows) {
      for (const std::size_t k : {w.load, w.begin, w.end}) slopes_[k].setZero();
      at_[w.begin] = free[w.begin].start;
      at_[w.end] = free[w.end].start;
    }
    change_ = VectorXd::Zero(closure.residual().size());
  }

  [[nodiscard]] const std::vector<double>& centre() const noexcept { return at_; }
  [[nodiscard]] VectorXd changeAt(const std::vector<double>& values) const {
    VectorXd out = change_;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (values[k] != at_[k]) out += slopes_[k] * (values[k] - at_[k]);
    }
    for (const FreeWindow& w : *windows_) out += windowAt(w, values) - windowAt(w, at_);
    return out;
  }
  /// Per unit of each parameter.
  [[nodiscard]] std::vector<VectorXd> slopesAt(const std::vector<double>& values) const {
    std::vector<VectorXd> out = slopes_;
    for (const FreeWindow& w : *windows_) {
      const double a = values[w.begin];
      const double b = values[w.end];
      out[w.load] += windowAnswer(w, *closure_, a, b);
      const double h = halfSpacing(*w.response);
      const auto slope = [&](double from_a, double from_b, double to_a, double to_b, double width) -> VectorXd {
        return values[w.load] / width *
               (windowAnswer(w, *closure_, to_a, to_b) - windowAnswer(w, *closure_, from_a, from_b));
      };
      out[w.begin] += slope(a - h, b, a + h, b, 2.0 * h);
      out[w.end] += slope(a, b - h, a, b + h, 2.0 * h);
    }
    return out;
  }
  [[nodiscard]] double cost(const VectorXd& change, const std::vector<double>& values) const {
    double out = (closure_->residual() - change).squaredNorm();
    for (std::size_t k = 0; k < values.size(); ++k) {
      const FreeParameter& f = (*free_)[k];
      if (f.prior_sigma > 0.0) out += std::pow((values[k] - f.parameter.value) / f.prior_sigma, 2);
    }
    return out;
  }

  void moveTo(const std::vector<double>& values, const VectorXd& change) {
    at_ = values;
    change_ = change;
  }
  void setSlope(std::size_t k, VectorXd slope) { slopes_[k] = std::move(slope); }
  [[nodiscard]] const VectorXd& slope(std::size_t k) const { return slopes_[k]; }
  /// Makes the model tell `error` more over the way from one place to another.
  void learn(const VectorXd& error, const std::vector<double>& from, const std::vector<double>& to) {
    VectorXd way(static_cast<Index>(from.size()));
    for (Index k = 0; k < way.size(); ++k) {
      const auto at = static_cast<std::size_t>(k);
      way[k] = (to[at] - from[at]) / (*free_)[at].scale();
      // A window is what its step response says.
      for (const FreeWindow& w : *windows_) {
        if (at == w.begin || at == w.end) way[k] = 0.0;
      }
    }
    const double length = way.squaredNorm();
    if (!(length > 0.0)) return;
    for (Index k = 0; k < way.size(); ++k) {
      const auto at = static_cast<std::size_t>(k);
      if (way[k] != 0.0) slopes_[at] += error * (way[k] / length / (*free_)[at].scale());
    }
  }

  /// Minimum within the bounds and `radius` (in scales) of the centre.
  [[nodiscard]] std::vector<double> minimum(double radius) const;
  /// Parameters of which these data teach nothing keep their values from now
  /// on.
  void keepUnlearnt();

 private:
  friend class ModelCost;
  [[nodiscard]] VectorXd windowAt(const FreeWindow& w, const std::vector<double>& values) const {
    if (values[w.load] == 0.0) return VectorXd::Zero(change_.size());
    return values[w.load] * windowAnswer(w, *closure_, values[w.begin], values[w.end]);
  }

  const SimulationClosure* closure_;
  const std::vector<FreeParameter>* free_;
  const std::vector<FreeWindow>* windows_;
  std::vector<VectorXd> slopes_;
  std::vector<double> at_;
  std::vector<double> lower_;
  std::vector<double> upper_;
  std::vector<bool> fixed_;
  VectorXd change_;
};

/// Residual and derivatives of the model; parameters in scales from the centre.
class ModelCost : public ceres::CostFunction {
 public:
  explicit ModelCost(const Model& model) : model_(&model) {
    const std::size_t count = model.free_->size();
    set_num_residuals(static_cast<int>(model.change_.size() + static_cast<Index>(count)));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(count));
  }
  [[nodiscard]] std::vector<double> valuesAt(const double* scaled) const {
    std::vector<double> out = model_->at_;
    for (std::size_t k = 0; k < out.size(); ++k) out[k] += scaled[k] * (*model_->free_)[k].scale();
    return out;
  }
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const std::vector<double> values = valuesAt(parameters[0]);
    const std::vector<FreeParameter>& free = *model_->free_;
    const Index rows = model_->change_.size();
    const auto count = static_cast<Index>(free.size());
    Eigen::Map<VectorXd> out(residuals, rows + count);
    out.head(rows) = model_->closure_->residual() - model_->changeAt(values);
    for (Index k = 0; k < count; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const FreeParameter& f = free[at];
      out[rows + k] = f.prior_sigma > 0.0 ? (values[at] - f.parameter.value) / f.prior_sigma : 0.0;
    }
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    const std::vector<VectorXd> slopes = model_->slopesAt(values);
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> j(jacobians[0], rows + count,
                                                                                         count);
    j.setZero();
    for (Index k = 0; k < count; ++k) {
      const auto at = static_cast<std::size_t>(k);
      j.col(k).head(rows) = -slopes[at] * free[at].scale();
      if (free[at].prior_sigma > 0.0) j(rows + k, k) = free[at].scale() / free[at].prior_sigma;
    }
    return true;
  }

 private:
  const Model* model_;
};

std::vector<double> Model::minimum(double radius) const {
  // What ends a fit is told in our own sentences.
  FLAGS_minloglevel = google::GLOG_FATAL;
  const std::vector<FreeParameter>& free = *free_;
  ModelCost cost(*this);
  std::vector<double> scaled(free.size(), 0.0);
  std::vector<double> low(free.size());
  std::vector<double> high(free.size());
  for (std::size_t k = 0; k < free.size(); ++k) {
    low[k] = std::min(0.0, std::max(-radius, (lower_[k] - at_[k]) / free[k].scale()));
    high[k] = std::max(0.0, std::min(radius, (upper_[k] - at_[k]) / free[k].scale()));
    if (fixed_[k]) low[k] = high[k] = 0.0;
    // A load that begins at zero says nothing of its times.
    if (!fixed_[k] && at_[k] == free[k].parameter.value)
      scaled[k] = std::clamp((free[k].start - at_[k]) / free[k].scale(), low[k], high[k]);
  }
  // Steps that are cut at a bound lead along it slowly: what ends at one stays there, and the others go on.
  std::vector<int> constant;
  for (std::size_t k = 0; k < free.size(); ++k) {
    if (!(high[k] > low[k])) constant.push_back(static_cast<int>(k));
  }
  for (int pass = 0; pass < most_passes && constant.size() < free.size(); ++pass) {
    ceres::Problem::Options ownership;
    ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(ownership);
    problem.AddResidualBlock(&cost, nullptr, scaled.data());
    if (!constant.empty())
      problem.SetManifold(scaled.data(), new ceres::SubsetManifold(static_cast<int>(free.size()), constant));
    std::vector<int> free_ones;
    for (int k = 0; k < static_cast<int>(free.size()); ++k) {
      if (std::find(constant.begin(), constant.end(), k) != constant.end()) continue;
      free_ones.push_back(k);
      const auto at = static_cast<std::size_t>(k);
      problem.SetParameterLowerBound(scaled.data(), k, low[at]);
      problem.SetParameterUpperBound(scaled.data(), k, high[at]);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 60;
    options.function_tolerance = 1e-9;
    options.parameter_tolerance = 1e-7;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    bool more = false;
    for (const int k : free_ones) {
      const auto at = static_cast<std::size_t>(k);
      const double edge = 1e-9 * (high[at] - low[at]);
      if (scaled[at] > low[at] + edge && scaled[at] < high[at] - edge) continue;
      constant.push_back(k);
      more = true;
    }
    if (!more) break;
    std::sort(constant.begin(), constant.end());
  }
  std::vector<double> out = cost.valuesAt(scaled.data());
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = std::clamp(out[k], lower_[k], upper_[k]);
  return out;
}

void Model::keepUnlearnt() {
  const std::vector<FreeParameter>& free = *free_;
  const std::vector<VectorXd> slopes = slopesAt(minimum(1e9));
  const auto count = static_cast<Index>(free.size());
  MatrixXd information(count, count);
  for (Index a = 0; a < count; ++a) {
    const auto i = static_cast<std::size_t>(a);
    for (Index b = 0; b < count; ++b) {
      const auto j = static_cast<std::size_t>(b);
      information(a, b) = slopes[i].dot(slopes[j]) * free[i].scale() * free[j].scale();
    }
    if (free[i].prior_sigma > 0.0) information(a, a) += std::pow(free[i].scale() / free[i].prior_sigma, 2);
  }
  information.diagonal().array() += 1e-9 * std::max(1.0, information.diagonal().maxCoeff());
  const MatrixXd covariance = information.ldlt().solve(MatrixXd::Identity(count, count));
  for (Index k = 0; k < count; ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (!(free[at].prior_sigma > 0.0) || free[at].put_in) continue;
    fixed_[at] = free[at].scale() * std::sqrt(covariance(k, k)) > nothing_learnt * free[at].prior_sigma;
  }
}

class Fitter {
 public:
  Fitter(SimulationClosure& closure, std::vector<FreeParameter> free, std::vector<FreeWindow> windows,
         const JobContext& job)
      : closure_(&closure),
        job_(&job),
        free_(std::move(free)),
        windows_(std::move(windows)),
        model_(closure, free_, windows_) {}

  SimulationFit fit(int most_iterations) {
    measureUnknown();
    model_.keepUnlearnt();
    best_cost_ = model_.cost(VectorXd::Zero(closure_->residual().size()), model_.centre());
    double radius = 1e9;
    int failures = 0;
    bool derivatives_known = false;  // at the best values
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      job_->report(static_cast<double>(iteration) / (iteration + 3.0), "fitting the simulation");
      const std::vector<double> trial = model_.minimum(radius);
      const VectorXd foretold = model_.changeAt(trial);
      if (moved(trial) == 0.0) break;
      const bool first = !best_run_;
      if (!first &&
          best_cost_ - model_.cost(foretold, trial) < std::max(worth_a_run, worth_a_run_of_cost * best_cost_)) {
        if (derivatives_known) break;
        learnAround(model_.centre(), {});
        derivatives_known = true;
        continue;
      }
      // With the first run, and where the model was wrong, its derivatives are
      // looked at.
      std::vector<ParameterValues> sets{valuesOf(trial)};
      std::vector<std::vector<double>> around;
      if (!derivatives_known) around = placesAround(trial);
      for (const std::vector<double>& place : around) sets.push_back(valuesOf(place));
      SimulatorRuns runs = closure_->run(sets);
      const std::optional<VectorXd> change = changeOf(runs, 0);
      if (!change) {
        if (++failures >= most_failures) break;
        radius = 0.5 * moved(trial);
        continue;
      }
      const VectorXd error = *change - foretold;
      const double way = (*change - model_.changeAt(model_.centre())).norm();
      const double cost = model_.cost(*change, trial);
      const bool better = cost < best_cost_;
      const bool far_off = error.norm() > std::max(not_linear, derivatives_hold * way);
      if (around.empty() || !windows_.empty()) model_.learn(error, model_.centre(), trial);
      if (!better) {
        // The model, which knows of it now, is trusted over half the way.
        if (++failures >= most_failures || moved(trial) < smallest_radius) break;
        radius = 0.5 * moved(trial);
        continue;
      }
      if (radius < 1e9) radius = std::max(radius, moved(trial)) * (far_off ? 1.0 : 2.0);
      model_.moveTo(trial, *change);
      best_cost_ = cost;
      best_run_ = std::move(runs.runs[0]);
      if (!around.empty()) {
        learnFrom(around, runs, 1);
        derivatives_known = true;
      } else if (far_off) {
        derivatives_known = false;
      }
    }
    if (!best_run_ && failure_.empty()) {
      // Nothing is better than the simulation as it stands.
      SimulatorRuns runs = closure_->run({{}});
      if (runs.failed[0].empty()) best_run_ = std::move(runs.runs[0]);
    }
    SimulationFit out;
    out.failure = failure_;
    out.usable = best_run_.has_value();
    if (!out.usable) return out;
    out.values = model_.centre();
    out.slopes = model_.slopesAt(out.values);
    out.cost = best_cost_;
    out.run = std::move(*best_run_);
    return out;
  }

 private:
  [[nodiscard]] ParameterValues valuesOf(const std::vector<double>& values) const {
    ParameterValues out;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const SimulatorParameter& p = free_[k].parameter;
      out[p.name] = std::clamp(values[k], p.min, p.max);
    }
    return out;
  }
  /// Largest move from the best values, in scales.
  [[nodiscard]] double moved(const std::vector<double>& values) const {
    double out = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k)
      out = std::max(out, std::abs(values[k] - model_.centre()[k]) / free_[k].scale());
    return out;
  }
  [[nodiscard]] bool ofWindow(std::size_t k) const {
    return std::any_of(windows_.begin(), windows_.end(),
                       [&](const FreeWindow& w) { return k == w.load || k == w.begin || k == w.end; });
  }
  std::optional<VectorXd> changeOf(const SimulatorRuns& runs, std::size_t i) {
    std::string why = runs.failed[i];
    if (why.empty()) {
      try {
        return closure_->projectedChange(runs.runs[i]);
      } catch (const SimulatorFailed& failed) {
        why = failed.what();
      }
    }
    if (failure_.empty()) failure_ = why;
    return std::nullopt;
  }

  /// What is put in and is not known yet is looked at where the simulator
  /// stands.
  void measureUnknown() {
    std::vector<std::size_t> which;
    std::vector<ParameterValues> sets;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      if (free_[k].slope.size() > 0 || free_[k].companion || ofWindow(k)) continue;
      const double value = model_.centre()[k];
      which.push_back(k);
      sets.push_back({{free_[k].parameter.name, value + free_[k].step(value)}});
    }
    if (sets.empty()) return;
    const SimulatorRuns runs = closure_->run(sets);
    for (std::size_t i = 0; i < which.size(); ++i) {
      const std::optional<VectorXd> change = changeOf(runs, i);
      if (change) model_.setSlope(which[i], *change / free_[which[i]].step(model_.centre()[which[i]]));
    }
  }

  /// What is put in moved one at a time; then everything else at once, to and
  /// fro.
  [[nodiscard]] std::vector<std::vector<double>> placesAround(const std::vector<double>& centre) {
    around_.clear();
    std::vector<std::vector<double>> out;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      if (!free_[k].put_in || free_[k].companion || ofWindow(k)) continue;
      std::vector<double> place = centre;
      place[k] += free_[k].step(place[k]);
      out.push_back(place);
      around_.push_back(k);
    }
    std::vector<double> others = centre;
    double sign = 0.5;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      if (free_[k].put_in && !free_[k].companion) continue;
      const SimulatorParameter& p = free_[k].parameter;
      double to = others[k] + sign * free_[k].scale();
      if (to < p.min || to > p.max) to = others[k] - sign * free_[k].scale();
      others[k] = std::clamp(to, p.min, p.max);
      sign = -sign;
    }
    if (others != centre) out.push_back(others);
    return out;
  }

  void learnAround(const std::vector<double>& centre, std::vector<std::vector<double>> around) {
    around = placesAround(centre);
    std::vector<ParameterValues> sets;
    for (const std::vector<double>& place : around) sets.push_back(valuesOf(place));
    const SimulatorRuns runs = closure_->run(sets);
    learnFrom(around, runs, 0);
  }

  /// Runs from `first` on were at these places around the centre of the model.
  void learnFrom(const std::vector<std::vector<double>>& around, const SimulatorRuns& runs, std::size_t first) {
    const std::vector<double> centre = model_.centre();
    const VectorXd here = model_.changeAt(centre);
    for (std::size_t i = 0; i < around.size(); ++i) {
      const std::optional<VectorXd> change = changeOf(runs, first + i);
      if (!change) continue;
      if (i < around_.size()) {
        const std::size_t k = around_[i];
        model_.setSlope(k, (*change - here) / (around[i][k] - centre[k]));
        continue;
      }
      const VectorXd foretold = model_.changeAt(around[i]) - here;
      const VectorXd error = *change - here - foretold;
      if (holds(error, foretold)) {
        // Companions are without influence then.
        std::vector<double> known = around[i];
        for (std::size_t k = 0; k < free_.size(); ++k) {
          if (free_[k].companion) known[k] = centre[k];
        }
        model_.learn(error, centre, known);
        continue;
      }
      // Companions may be all that was unknown.
      measureOthers(here, true);
      const VectorXd with_companions = model_.changeAt(around[i]) - here;
      if (holds(*change - here - with_companions, with_companions)) {
        model_.learn(*change - here - with_companions, centre, around[i]);
      } else {
        measureOthers(here, false);
      }
    }
  }
  [[nodiscard]] static bool holds(const VectorXd& error, const VectorXd& foretold) {
    return error.norm() < std::max(not_linear, derivatives_hold * foretold.norm());
  }

  /// Derivatives of the companions, or of everything else that is not put in,
  /// one at a time.
  void measureOthers(const VectorXd& here, bool companions) {
    const std::vector<double> centre = model_.centre();
    std::vector<ParameterValues> sets;
    std::vector<std::size_t> which;
    std::vector<double> steps;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      if (companions ? !free_[k].companion : free_[k].put_in) continue;
      std::vector<double> place = centre;
      steps.push_back(free_[k].step(place[k]));
      place[k] += steps.back();
      sets.push_back(valuesOf(place));
      which.push_back(k);
    }
    const SimulatorRuns runs = closure_->run(sets);
    for (std::size_t i = 0; i < which.size(); ++i) {
      const std::optional<VectorXd> change = changeOf(runs, i);
      if (change) model_.setSlope(which[i], (*change - here) / steps[i]);
    }
  }

  SimulationClosure* closure_;
  const JobContext* job_;
  std::vector<FreeParameter> free_;
  std::vector<FreeWindow> windows_;
  Model model_;
  std::vector<std::size_t> around_;  ///< parameters that were moved one at a time
  std::optional<SimulatorRun> best_run_;
  double best_cost_ = 0.0;
  std::string failure_;
};

}  // namespace

double FreeParameter::scale() const {
  return parameter.standard_uncertainty > 0.0 ? parameter.standard_uncertainty : 0.1 * (parameter.max - parameter.min);
}

double FreeParameter::step(double value) const {
  const double size = std::min(0.25 * scale(), 0.25 * (parameter.max - parameter.min));
  return value + size <= parameter.max ? size : -size;
}

SimulationFit fitSimulation(SimulationClosure& closure, std::vector<FreeParameter> free,
                            const std::vector<FreeWindow>& windows, int most_iterations, const JobContext& job) {
  return Fitter(closure, std::move(free), windows, job).fit(most_iterations);
}

}  // namespace spindrift
