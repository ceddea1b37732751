// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/simulator_tangents.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "core/base/text.h"

namespace spindrift {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
/// Below this a parameter does nothing: um or urad, of one step.
constexpr double no_influence = 1e-6;

double largestChange(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isfinite(a[i]) && std::isfinite(b[i])) largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

/// Observations that are predicted in `base` only.
std::size_t valuesLost(const std::vector<double>& moved, const std::vector<double>& base) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < base.size(); ++i) count += std::isfinite(base[i]) && !std::isfinite(moved[i]) ? 1 : 0;
  return count;
}

std::vector<double> slope(const std::vector<double>& moved, const std::vector<double>& base, double step) {
  std::vector<double> out(base.size(), not_known);
  for (std::size_t i = 0; i < base.size(); ++i) out[i] = (moved[i] - base[i]) / step;
  return out;
}

/// Answers per unit over the time since `first_s`.
std::shared_ptr<WindowedLoad> stepResponse(const SimulatorWindow& window, const SimulatorRun& moved,
                                           const SimulatorRun& base, double step, double first_s, double last_s) {
  auto load = std::make_shared<WindowedLoad>();
  load->begin_s = window.begin_s;
  load->end_s = window.end_s;
  load->first_s = first_s;
  load->last_s = last_s;
  std::map<std::tuple<std::string, Component, double>, double> before;
  for (const SimulationRow& row : base.rows) before[{row.point, row.component, row.time_s}] = row.predicted;
  for (const SimulationRow& row : moved.rows) {
    const auto found = before.find({row.point, row.component, row.time_s});
    if (found == before.end()) continue;
    load->step_response[{row.point, row.component}].emplace_back(row.time_s - first_s,
                                                                 (row.predicted - found->second) / step);
  }
  for (auto& [key, series] : load->step_response) std::sort(series.begin(), series.end());
  return load;
}

/// Fitted rows as one least-squares problem in stated sigmas, free of the
/// constant of every series.
class QuickFit {
 public:
  QuickFit(const ObservationSet& observations, const std::vector<double>& base) : rows_(&observations.rows) {
    residual_.resize(base.size());
    for (std::size_t i = 0; i < base.size(); ++i) residual_[i] = (*rows_)[i].value - base[i];
    if (!observations.absolute) centre(residual_);
  }

  struct Change {
    double size = 0.0;  ///< of the parameter
    double delta_chi2 = 0.0;
  };
  [[nodiscard]] Change changeFor(std::vector<double> per_unit) const {
    centre(per_unit);
    double dot = 0.0;
    double power = 0.0;
    for (std::size_t i = 0; i < per_unit.size(); ++i) {
      if (!used(i, per_unit[i])) continue;
      const double w = 1.0 / std::pow((*rows_)[i].sigma, 2);
      dot += w * per_unit[i] * residual_[i];
      power += w * per_unit[i] * per_unit[i];
    }
    if (!(power > 0.0)) return {};
    return {dot / power, dot * dot / power};
  }

 private:
  [[nodiscard]] bool used(std::size_t i, double value) const {
    const Observation& o = (*rows_)[i];
    return o.use == ObservationUse::Fit && std::isfinite(value) && std::isfinite(residual_[i]) && o.sigma > 0.0;
  }
  void centre(std::vector<double>& values) const {
    std::map<std::pair<std::string, Component>, std::pair<double, double>> sums;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!used(i, values[i])) continue;
      auto& [sum, count] = sums[{(*rows_)[i].point, (*rows_)[i].component}];
      sum += values[i];
      count += 1.0;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto found = sums.find({(*rows_)[i].point, (*rows_)[i].component});
      if (found != sums.end()) values[i] -= found->second.first / found->second.second;
    }
  }

  const std::vector<Observation>* rows_;
  std::vector<double> residual_;
};

/// Secants for the parameters that explain most of the gap, if they have to
/// change by much.
void goFar(const Simulator& simulator, const ObservationSet& observations, const JobContext& job,
           SimulatorTangents& tangents) {
  if (simulator.linear()) return;
  constexpr std::size_t most = 4;
  constexpr double worth_a_run = 30.0;  // in chi-squared
  constexpr double far_steps = 1.2;
  constexpr int most_rounds = 3;
  // A run that far from the change wanted says enough of it.
  constexpr double near_enough = 0.25;
  // Of what the best single parameter explains.
  constexpr double least_part = 0.5;
  const QuickFit fit(observations, tangents.base);
  double best = 0.0;
  for (const SimulatorTangent& tangent : tangents.tangents)
    best = std::max(best, fit.changeFor(tangent.per_unit).delta_chi2);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t t = 0; t < tangents.tangents.size(); ++t) {
    const SimulatorTangent& tangent = tangents.tangents[t];
    const QuickFit::Change change = fit.changeFor(tangent.per_unit);
    if (tangent.window || change.delta_chi2 < std::max(worth_a_run, least_part * best) ||
        std::abs(change.size) < far_steps * std::abs(tangent.step))
      continue;
    order.emplace_back(-change.delta_chi2, t);
  }
  std::sort(order.begin(), order.end());
  if (order.size() > most) order.resize(most);
  std::vector<double> reached(order.size(), 0.0);
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<ParameterValues> sets;
    std::vector<std::size_t> which;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const SimulatorTangent& t = tangents.tangents[order[i].second];
      const double wanted = fit.changeFor(t.per_unit_far.empty() ? t.per_unit : t.per_unit_far).size;
      const double change =
          std::clamp(t.parameter.value + wanted, t.parameter.min, t.parameter.max) - t.parameter.value;
      if (std::abs(change) < 0.5 * std::abs(t.step) || std::abs(change - reached[i]) < near_enough * std::abs(change))
        continue;
      sets.push_back({{t.parameter.name, t.parameter.value + change}});
      which.push_back(i);
      reached[i] = change;
    }
    if (sets.empty()) return;
    const SimulatorRuns runs = runAll(simulator, sets, observations, job, "running the simulation");
    tangents.runs += sets.size();
    for (std::size_t i = 0; i < which.size(); ++i) {
      SimulatorTangent& t = tangents.tangents[order[which[i]].second];
      // The tangent nearby is as far as this simulation goes.
      if (!runs.failed[i].empty() || valuesLost(runs.runs[i].predicted, tangents.base) > 0) continue;
      t.per_unit_far = slope(runs.runs[i].predicted, tangents.base, reached[which[i]]);
    }
  }
}

/// The runs that show what parameters do.
class TangentRuns {
 public:
  TangentRuns(const Simulator& simulator, const ObservationSet& observations, const JobContext& job)
      : simulator_(&simulator), observations_(&observations), job_(&job) {
    for (const Observation& o : observations.rows) {
      first_s_ = std::min(first_s_, o.time_s);
      last_s_ = std::max(last_s_, o.time_s);
    }
  }

  SimulatorTangents tangents() {
    runSingly();
    if (!findWindowsTogether()) findWindowsSingly();
    SimulatorTangents out;
    out.base = base().predicted;
    for (Moved& m : moved_) {
      const SimulatorParameter& p = *m.parameter;
      if (!m.failed.empty()) {
        out.notes.push_back(fmt::format("What {} does is not known: {}", p.name, m.failed));
        continue;
      }
      SimulatorTangent tangent;
      tangent.parameter = p;
      tangent.step = tangentStep(p);
      tangent.window = m.window;
      if (!m.run || largestChange(m.run->predicted, out.base) <= no_influence) {
        out.mute.push_back(p.name);
        continue;
      }
      tangent.per_unit = slope(m.run->predicted, out.base, tangent.step);
      out.tangents.push_back(std::move(tangent));
    }
    out.runs = runs_;
    goFar(*simulator_, *observations_, job_->part(1.0, 1.0), out);
    return out;
  }

 private:
  /// A parameter and what it does, moved by its step.
  struct Moved {
    const SimulatorParameter* parameter = nullptr;
    std::optional<SimulatorRun> run;  ///< nothing: a time of a window whose load is off
    std::string failed;
    std::shared_ptr<WindowedLoad> window;
  };

  [[nodiscard]] const SimulatorRun& base() const { return base_; }
  SimulatorRuns run(const std::vector<ParameterValues>& sets, double from, double to) {
    runs_ += sets.size();
    return runAll(*simulator_, sets, *observations_, job_->part(from, to), "running the simulation");
  }
  void openTo(const SimulatorWindow& w, double to_s, ParameterValues& values) const {
    const SimulatorParameter* begin = simulator_->find(w.begin_s);
    const SimulatorParameter* end = simulator_->find(w.end_s);
    SPINDRIFT_ASSERT(begin != nullptr && end != nullptr, "a window between two parameters");
    values[w.begin_s] = std::clamp(first_s_, begin->min, begin->max);
    values[w.end_s] = std::clamp(to_s, end->min, end->max);
  }
  /// As the simulator stands, loads of this window act from the first
  /// observation to the end.
  [[nodiscard]] bool open(const SimulatorWindow& w) const {
    ParameterValues values;
    openTo(w, std::numeric_limits<double>::max(), values);
    return std::all_of(values.begin(), values.end(),
                       [&](const auto& v) { return simulator_->find(v.first)->value == v.second; });
  }
  [[nodiscard]] Moved* find(const std::string& name) {
    const auto found =
        std::find_if(moved_.begin(), moved_.end(), [&](const Moved& m) { return m.parameter->name == name; });
    return found == moved_.end() ? nullptr : &*found;
  }
  [[nodiscard]] bool off(const Moved& m) const { return m.parameter->off() && m.failed.empty() && m.run; }

  /// All that is uncertain or off, one at a time. Times of windows wait where
  /// one run may tell of them all.
  void runSingly() {
    const std::vector<SimulatorWindow>& windows = simulator_->windows();
    const bool any_off = std::any_of(simulator_->parameters().begin(), simulator_->parameters().end(),
                                     [](const SimulatorParameter& p) { return p.off() && p.max > p.min; });
    together_ = !windows.empty() && any_off &&
                std::all_of(windows.begin(), windows.end(), [&](const SimulatorWindow& w) { return open(w); });
    std::set<std::string> waiting;
    for (const SimulatorWindow& w : windows) {
      if (together_) waiting.insert({w.begin_s, w.end_s});
    }
    std::vector<ParameterValues> sets{{}};
    std::vector<std::size_t> which;
    for (const SimulatorParameter& p : simulator_->parameters()) {
      if (!p.off() && !(p.standard_uncertainty > 0.0)) continue;
      if (!(p.max > p.min)) continue;
      moved_.push_back({&p, {}, {}, {}});
      if (waiting.contains(p.name)) continue;
      which.push_back(moved_.size() - 1);
      sets.push_back({{p.name, p.value + tangentStep(p)}});
    }
    SimulatorRuns runs = run(sets, 0.0, 0.7);
    if (!runs.failed[0].empty()) throw SimulatorFailed(runs.failed[0]);
    base_ = std::move(runs.runs[0]);
    take(which, runs, 1);
  }
  void take(const std::vector<std::size_t>& which, SimulatorRuns& runs, std::size_t first) {
    for (std::size_t i = 0; i < which.size(); ++i) {
      Moved& m = moved_[which[i]];
      m.failed = runs.failed[first + i];
      if (!m.failed.empty()) continue;
      m.run = std::move(runs.runs[first + i]);
      const std::size_t lost = valuesLost(m.run->predicted, base_.predicted);
      if (lost == 0) continue;
      m.run.reset();
      m.failed = fmt::format(
          "with {} = {} the simulation gives no value for {} observations that it predicts with its own parameters.",
          m.parameter->name, exactNumber(m.parameter->value + tangentStep(*m.parameter)), lost);
    }
  }

  /// One run for each window: all loads that are off act at once, until half
  /// way. What that differs from the sum of their answers is the answer to the
  /// end of one of them, its own answer moved in time - if the simulator is
  /// linear. False: that is not so, or cannot be seen; then nothing is known.
  bool findWindowsTogether() {
    if (!together_) return false;
    std::vector<Moved*> loads;
    for (Moved& m : moved_) {
      if (off(m)) loads.push_back(&m);
    }
    std::vector<ParameterValues> sets;
    std::vector<double> closed_s;
    for (const SimulatorWindow& w : simulator_->windows()) {
      ParameterValues values;
      for (const Moved* m : loads) values[m->parameter->name] = m->parameter->value + tangentStep(*m->parameter);
      closed_s.push_back(rowTimeNear(0.5 * (first_s_ + last_s_)));
      openTo(w, closed_s.back(), values);
      if (values[w.end_s] != closed_s.back()) return giveUp();
      sets.push_back(std::move(values));
    }
    if (loads.empty() || base_.rows.empty()) return giveUp();
    const SimulatorRuns runs = run(sets, 0.7, 0.8);
    for (std::size_t i = 0; i < sets.size(); ++i) {
      if (!runs.failed[i].empty()) return giveUp();
      const std::optional<std::vector<bool>> belongs = whoEnds(loads, runs.runs[i], closed_s[i]);
      if (!belongs) return giveUp();
      for (std::size_t l = 0; l < loads.size(); ++l) {
        if ((*belongs)[l]) loads[l]->window = responseOf(*loads[l], simulator_->windows()[i]);
      }
    }
    return true;
  }
  bool giveUp() {
    std::vector<ParameterValues> sets;
    std::vector<std::size_t> which;
    for (std::size_t i = 0; i < moved_.size(); ++i) {
      Moved& m = moved_[i];
      m.window.reset();
      if (m.run || !m.failed.empty()) continue;
      which.push_back(i);
      sets.push_back({{m.parameter->name, m.parameter->value + tangentStep(*m.parameter)}});
    }
    SimulatorRuns runs = run(sets, 0.8, 0.85);
    take(which, runs, 0);
    return false;
  }
  [[nodiscard]] double rowTimeNear(double time_s) const {
    double nearest = time_s;
    double distance = std::numeric_limits<double>::infinity();
    for (const SimulationRow& row : base_.rows) {
      if (std::abs(row.time_s - time_s) >= distance) continue;
      distance = std::abs(row.time_s - time_s);
      nearest = row.time_s;
    }
    return nearest;
  }
  [[nodiscard]] std::shared_ptr<WindowedLoad> responseOf(const Moved& m, const SimulatorWindow& w) const {
    const double begin = std::max(first_s_, simulator_->find(w.begin_s)->min);
    return stepResponse(w, *m.run, base_, tangentStep(*m.parameter), begin, last_s_);
  }
  /// Which of the loads end in `ended`, a run with all of them until `end_s`;
  /// nothing where that cannot be told.
  [[nodiscard]] std::optional<std::vector<bool>> whoEnds(const std::vector<Moved*>& loads, const SimulatorRun& ended,
                                                         double end_s) const {
    // Off by this part of the whole, a coefficient or what is left is not what
    // a linear simulator gives.
    constexpr double tolerance = 0.15;
    const auto count = static_cast<Eigen::Index>(loads.size());
    using Key = std::tuple<std::string, Component, double>;
    std::map<Key, Eigen::Index> place;
    for (const SimulationRow& row : base_.rows) place.emplace(Key{row.point, row.component, row.time_s}, place.size());
    const auto rows = static_cast<Eigen::Index>(place.size());
    const auto changeOf = [&](const SimulatorRun& run) {
      Eigen::VectorXd out = Eigen::VectorXd::Zero(rows);
      for (const SimulationRow& row : run.rows) {
        const auto found = place.find(Key{row.point, row.component, row.time_s});
        if (found != place.end()) out[found->second] = row.predicted;
      }
      return out;
    };
    const Eigen::VectorXd here = changeOf(base_);
    Eigen::VectorXd left = changeOf(ended) - here;
    Eigen::MatrixXd ends(rows, count);
    for (Eigen::Index l = 0; l < count; ++l) {
      const Moved& m = *loads[static_cast<std::size_t>(l)];
      left -= changeOf(*m.run) - here;
      const std::shared_ptr<WindowedLoad> response = responseOf(m, simulator_->windows().front());
      for (const auto& [key, at] : place) {
        ends(at, l) =
            -tangentStep(*m.parameter) * response->at(std::get<2>(key) - end_s, std::get<0>(key), std::get<1>(key));
      }
    }
    std::vector<bool> out(loads.size(), false);
    if (!left.allFinite() || !ends.allFinite()) return std::nullopt;
    const Eigen::VectorXd part = ends.colPivHouseholderQr().solve(left);
    const double all = left.norm();
    for (Eigen::Index l = 0; l < count; ++l) {
      const double whole = std::clamp(std::round(part[l]), 0.0, 1.0);
      // Of a load whose end would hardly be seen nothing is told.
      if (std::abs(part[l] - whole) * ends.col(l).norm() > tolerance * all) return std::nullopt;
      out[static_cast<std::size_t>(l)] = whole > 0.0;
      left -= whole * ends.col(l);
    }
    double answers = 0.0;
    for (Eigen::Index l = 0; l < count; ++l) {
      if (out[static_cast<std::size_t>(l)]) answers += ends.col(l).squaredNorm();
    }
    // Times that belong to no load that is off act on one that is on.
    if (!(answers > 0.0) || left.norm() > tolerance * std::sqrt(answers)) return std::nullopt;
    return out;
  }

  /// For every load that is off: with all idle windows open, and with one of
  /// them closed half way.
  void findWindowsSingly() {
    std::vector<const SimulatorWindow*> idle;
    const auto changes = [&](const std::string& name) {
      const Moved* m = find(name);
      return m != nullptr && m->run && largestChange(m->run->predicted, base_.predicted) > no_influence;
    };
    for (const SimulatorWindow& w : simulator_->windows()) {
      if (!changes(w.begin_s) && !changes(w.end_s)) idle.push_back(&w);
    }
    if (idle.empty()) return;
    struct Trial {
      Moved* moved = nullptr;
      const SimulatorWindow* window = nullptr;  ///< closed half way; null: all open
    };
    std::vector<Trial> trials;
    std::vector<ParameterValues> sets;
    for (Moved& m : moved_) {
      if (!off(m)) continue;
      ParameterValues opened{{m.parameter->name, m.parameter->value + tangentStep(*m.parameter)}};
      for (const SimulatorWindow* w : idle) openTo(*w, std::numeric_limits<double>::max(), opened);
      const bool was_open = std::all_of(idle.begin(), idle.end(), [&](const SimulatorWindow* w) { return open(*w); });
      if (!was_open) {
        trials.push_back({&m, nullptr});
        sets.push_back(opened);
      }
      for (const SimulatorWindow* w : idle) {
        ParameterValues half = opened;
        openTo(*w, 0.5 * (first_s_ + last_s_), half);
        trials.push_back({&m, w});
        sets.push_back(half);
      }
    }
    SimulatorRuns runs = run(sets, 0.85, 1.0);
    std::map<const Moved*, SimulatorRun> opened;
    std::set<const Moved*> opened_failed;
    for (std::size_t t = 0; t < trials.size(); ++t) {
      if (trials[t].window != nullptr) continue;
      if (runs.failed[t].empty()) {
        opened[trials[t].moved] = std::move(runs.runs[t]);
      } else {
        opened_failed.insert(trials[t].moved);
      }
    }
    for (std::size_t t = 0; t < trials.size(); ++t) {
      Moved& m = *trials[t].moved;
      if (trials[t].window == nullptr || !runs.failed[t].empty()) continue;
      if (opened_failed.contains(&m)) continue;
      const auto other = opened.find(&m);
      const SimulatorRun& whole = other == opened.end() ? *m.run : other->second;
      if (whole.rows.empty() || largestChange(runs.runs[t].predicted, whole.predicted) <= no_influence) continue;
      if (other != opened.end()) m.run = std::move(other->second);
      m.window = responseOf(m, *trials[t].window);
      opened.erase(&m);
    }
  }

  const Simulator* simulator_;
  const ObservationSet* observations_;
  const JobContext* job_;
  double first_s_ = std::numeric_limits<double>::infinity();
  double last_s_ = -std::numeric_limits<double>::infinity();
  bool together_ = false;
  std::vector<Moved> moved_;
  SimulatorRun base_;
  std::size_t runs_ = 0;
};

Effect effectOf(const SimulatorParameter& parameter) {
  Effect effect;
  effect.id = parameter.id();
  effect.title = parameter.what.empty() ? parameter.name : parameter.what;
  effect.physics = parameter.what.empty()
                       ? fmt::format("the simulation's parameter {}", parameter.name)
                       : fmt::format("{} (the simulation's parameter {})", parameter.what, parameter.name);
  effect.formula = fmt::format("d(prediction) / d({}) as the simulation has it", parameter.name);
  effect.variants = {{{{"", Dynamics::None}}, false}};
  effect.own = true;
  effect.over_time = true;
  effect.same_cause = parameter.effects;
  if (parameter.value <= parameter.min) effect.sign = 1;
  if (parameter.value >= parameter.max) effect.sign = -1;
  return effect;
}

}  // namespace

double WindowedLoad::at(double since_s, const std::string& point, Component component) const {
  if (since_s <= 0.0) return 0.0;
  const auto found = step_response.find({point, component});
  if (found == step_response.end() || found->second.empty()) return 0.0;
  const auto& series = found->second;
  const auto after = std::lower_bound(series.begin(), series.end(), std::make_pair(since_s, -1e300));
  if (after == series.begin()) return series.front().second * since_s / std::max(1e-9, series.front().first);
  if (after == series.end()) return series.back().second;
  const auto before = std::prev(after);
  const double part = (since_s - before->first) / (after->first - before->first);
  return before->second + part * (after->second - before->second);
}

double tangentStep(const SimulatorParameter& p) {
  double step = p.standard_uncertainty > 0.0 ? p.standard_uncertainty : 0.1 * (p.max - p.min);
  step = std::min(step, 0.5 * (p.max - p.min));
  return p.value + step <= p.max ? step : -step;
}

SimulatorTangents simulatorTangents(const Simulator& simulator, const ObservationSet& observations,
                                    const JobContext& job) {
  return TangentRuns(simulator, observations, job).tangents();
}

Effect tangentEffect(const SimulatorTangent& tangent, const ObservationSet& observations, bool far) {
  Effect effect = effectOf(tangent.parameter);
  const auto field = std::make_shared<const ObservedField>(
      observations.rows, far && !tangent.per_unit_far.empty() ? tangent.per_unit_far : tangent.per_unit);
  effect.shape.push_back({tangent.parameter.unit, [field](const DeviationQuery& query, Component component) {
                            return field->at(query, component);
                          }});
  return effect;
}

Effect windowedEffect(const SimulatorTangent& tangent, double from_s, double to_s) {
  SPINDRIFT_ASSERT(tangent.window != nullptr, "a load between two times");
  Effect effect = effectOf(tangent.parameter);
  effect.shape.push_back(
      {tangent.parameter.unit, [load = tangent.window, from_s, to_s](const DeviationQuery& query, Component component) {
         return load->at(query.time_s - from_s, query.point, component) -
                load->at(query.time_s - to_s, query.point, component);
       }});
  return effect;
}

}  // namespace spindrift
