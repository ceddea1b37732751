// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/simulator_tangents.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

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

/// Fitted rows as one least-squares problem in stated sigmas, free of the constant of every series.
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

/// Secants for the parameters that explain most of the gap, if they have to change by much.
void goFar(const Simulator& simulator, const ObservationSet& observations, const JobContext& job,
           SimulatorTangents& tangents) {
  if (simulator.linear()) return;
  constexpr std::size_t most = 4;
  constexpr double worth_a_run = 30.0;  // in chi-squared
  constexpr double far_steps = 1.2;
  constexpr int most_rounds = 3;
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
      if (std::abs(change) < 0.5 * std::abs(t.step) || std::abs(change - reached[i]) < 0.1 * std::abs(change)) continue;
      sets.push_back({{t.parameter.name, t.parameter.value + change}});
      which.push_back(i);
      reached[i] = change;
    }
    if (sets.empty()) return;
    const SimulatorRuns runs = runAll(simulator, sets, observations, job, "running the simulation");
    tangents.runs += sets.size();
    for (std::size_t i = 0; i < which.size(); ++i) {
      SimulatorTangent& t = tangents.tangents[order[which[i]].second];
      if (!runs.failed[i].empty()) continue;  // the tangent nearby is as far as this simulation goes
      t.per_unit_far = slope(runs.runs[i].predicted, tangents.base, reached[which[i]]);
    }
  }
}

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
  SimulatorTangents out;
  std::set<std::string> of_windows;
  for (const SimulatorWindow& w : simulator.windows()) of_windows.insert({w.begin_s, w.end_s});
  // All that is uncertain, one at a time; windows are opened for the loads that are off.
  double first_s = std::numeric_limits<double>::infinity();
  double last_s = -first_s;
  for (const Observation& o : observations.rows) {
    first_s = std::min(first_s, o.time_s);
    last_s = std::max(last_s, o.time_s);
  }
  const auto openTo = [&](const SimulatorWindow& w, double to_s, ParameterValues& values) {
    const SimulatorParameter* begin = simulator.find(w.begin_s);
    const SimulatorParameter* end = simulator.find(w.end_s);
    SPINDRIFT_ASSERT(begin != nullptr && end != nullptr, "a window between two parameters");
    values[w.begin_s] = std::clamp(first_s, begin->min, begin->max);
    values[w.end_s] = std::clamp(to_s, end->min, end->max);
  };
  std::vector<const SimulatorParameter*> moved;
  std::vector<ParameterValues> sets{{}};
  for (const SimulatorParameter& p : simulator.parameters()) {
    if (!p.off() && !(p.standard_uncertainty > 0.0)) continue;
    if (!(p.max > p.min)) continue;
    moved.push_back(&p);
    sets.push_back({{p.name, p.value + tangentStep(p)}});
  }
  SimulatorRuns runs = runAll(simulator, sets, observations, job.part(0.0, 0.6), "running the simulation");
  if (!runs.failed[0].empty()) throw SimulatorFailed(runs.failed[0]);
  out.runs = sets.size();
  out.base = runs.runs[0].predicted;
  // Windows that do nothing as the simulator stands: their loads are off.
  std::vector<const SimulatorWindow*> idle;
  const auto changes = [&](const std::string& name) {
    for (std::size_t i = 0; i < moved.size(); ++i) {
      if (moved[i]->name != name || !runs.failed[i + 1].empty()) continue;
      return largestChange(runs.runs[i + 1].predicted, out.base) > no_influence;
    }
    return false;
  };
  for (const SimulatorWindow& w : simulator.windows()) {
    if (!changes(w.begin_s) && !changes(w.end_s)) idle.push_back(&w);
  }
  // For every load that is off: with all idle windows open, and with one of them closed half way.
  struct Trial {
    std::size_t moved = 0;
    const SimulatorWindow* window = nullptr;  ///< closed half way; null: all open
  };
  std::vector<Trial> trials;
  std::vector<ParameterValues> more;
  if (!idle.empty()) {
    for (std::size_t i = 0; i < moved.size(); ++i) {
      if (!moved[i]->off() || !runs.failed[i + 1].empty()) continue;
      ParameterValues open = sets[i + 1];
      for (const SimulatorWindow* w : idle) openTo(*w, std::numeric_limits<double>::max(), open);
      trials.push_back({i, nullptr});
      more.push_back(open);
      for (const SimulatorWindow* w : idle) {
        ParameterValues half = open;
        openTo(*w, 0.5 * (first_s + last_s), half);
        trials.push_back({i, w});
        more.push_back(half);
      }
    }
  }
  const SimulatorRuns opened = runAll(simulator, more, observations, job.part(0.6, 1.0), "running the simulation");
  out.runs += more.size();
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const SimulatorParameter& p = *moved[i];
    if (!runs.failed[i + 1].empty()) {
      out.notes.push_back(fmt::format("What {} does is not known: {}", p.name, runs.failed[i + 1]));
      continue;
    }
    SimulatorTangent tangent;
    tangent.parameter = p;
    tangent.step = tangentStep(p);
    const std::vector<double>* answer = &runs.runs[i + 1].predicted;
    std::size_t all_open = trials.size();
    for (std::size_t t = 0; t < trials.size(); ++t) {
      if (trials[t].moved != i || !opened.failed[t].empty()) continue;
      if (trials[t].window == nullptr) {
        all_open = t;
        continue;
      }
      if (all_open == trials.size() || opened.runs[all_open].rows.empty()) continue;
      if (largestChange(opened.runs[t].predicted, opened.runs[all_open].predicted) <= no_influence) continue;
      const double begin = std::max(first_s, simulator.find(trials[t].window->begin_s)->min);
      tangent.window =
          stepResponse(*trials[t].window, opened.runs[all_open], runs.runs[0], tangent.step, begin, last_s);
      answer = &opened.runs[all_open].predicted;
    }
    if (largestChange(*answer, out.base) <= no_influence) {
      out.mute.push_back(p.name);
      continue;
    }
    tangent.per_unit = slope(*answer, out.base, tangent.step);
    out.tangents.push_back(std::move(tangent));
  }
  goFar(simulator, observations, job.part(1.0, 1.0), out);
  return out;
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
