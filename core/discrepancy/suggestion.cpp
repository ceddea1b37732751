// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/text.h"
#include "core/discrepancy/discrepancy_search.h"

namespace spindrift {
namespace {

using Eigen::Index;

double valueAt(const DriverTable& drivers, const JointFit& fit, const DeviationQuery& query, Component component,
               std::size_t time_index, const std::vector<Eigen::MatrixXd>& responses) {
  double sum = 0.0;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    const Effect& effect = *fit.terms[t].effect;
    const auto k = static_cast<Index>(effect.shape.size());
    for (Index c = 0; c < k; ++c) {
      const double shape = effect.shape[static_cast<std::size_t>(c)].value(query, component);
      if (shape == 0.0) continue;
      for (Index i = 0; i < responses[t].cols(); ++i) {
        sum += shape * responses[t](static_cast<Index>(time_index), i) * fit.gains[t][i * k + c];
      }
    }
  }
  (void)drivers;
  return sum;
}

}  // namespace

std::optional<MeasurementSuggestion> suggestMeasurement(const DiscrepancyInput& input, const DriverTable& drivers,
                                                        const ResidualProblem& problem, const JointFit& first,
                                                        const JointFit& second, const std::string& separates,
                                                        double log_n) {
  if (problem.size() == 0) return std::nullopt;
  // Candidate times: the whole log, in 96 steps; candidate places: the points measured and the corners of the travel.
  double start = problem.node_time_s.front();
  double end = problem.node_time_s.back();
  if (!drivers.empty()) {
    start = std::min(start, drivers.time_s().front());
    end = std::max(end, drivers.time_s().back());
  }
  std::vector<double> times;
  for (int i = 0; i <= 96; ++i) times.push_back(start + (end - start) * i / 96.0);
  const auto responsesOf = [&](const JointFit& fit) {
    std::vector<Eigen::MatrixXd> out;
    for (const ModelTerm& term : fit.terms)
      out.push_back(inputResponses(drivers, term.variant, term.parameters, times));
    return out;
  };
  const auto first_responses = responsesOf(first);
  const auto second_responses = responsesOf(second);
  struct Place {
    std::string name;
    DeviationQuery query;
  };
  std::vector<Place> places;
  std::set<std::string> seen;
  for (const DeviationQuery& q : problem.place) {
    if (seen.insert(q.point).second) places.push_back({q.point, q});
  }
  const auto travel = [&](char letter) -> const LinearAxis* {
    for (const LinearAxis& a : input.machine.axes) {
      if (!a.name.empty() && a.name[0] == letter) return &a;
    }
    return nullptr;
  };
  if (const LinearAxis* x = travel('X'), *y = travel('Y'), *z = travel('Z');
      x != nullptr && y != nullptr && z != nullptr) {
    for (int corner = 0; corner < 8; ++corner) {
      Place p;
      p.query.position_mm = {x->travel_mm[static_cast<std::size_t>(corner & 1)],
                             y->travel_mm[static_cast<std::size_t>((corner >> 1) & 1)],
                             z->travel_mm[static_cast<std::size_t>((corner >> 2) & 1)]};
      p.name = fmt::format("({:.0f}, {:.0f}, {:.0f}) mm", p.query.position_mm.x(), p.query.position_mm.y(),
                           p.query.position_mm.z());
      p.query.point = p.name;
      places.push_back(p);
    }
  }
  std::map<Component, double> sigmas;
  std::map<Component, int> counts;
  for (Index u = 0; u < problem.size(); ++u) {
    sigmas[problem.component[static_cast<std::size_t>(u)]] += problem.sigma[u];
    ++counts[problem.component[static_cast<std::size_t>(u)]];
  }
  // What a place gives in one run over the times: the difference about its mean, in units of sigma.
  struct Value {
    double power = 0.0;
    std::size_t place = 0;
    std::vector<double> by_time;
  };
  std::vector<Value> values;
  std::vector<double> total(times.size(), 0.0);
  for (std::size_t p = 0; p < places.size(); ++p) {
    Value v;
    v.place = p;
    v.by_time.assign(times.size(), 0.0);
    for (auto& [component, sum] : sigmas) {
      const double sigma = sum / counts[component] * problem.noise.scale;
      std::vector<double> d(times.size());
      double mean = 0.0;
      for (std::size_t t = 0; t < times.size(); ++t) {
        DeviationQuery q = places[p].query;
        q.time_s = times[t];
        d[t] = valueAt(drivers, first, q, component, t, first_responses) -
               valueAt(drivers, second, q, component, t, second_responses);
        mean += d[t] / static_cast<double>(times.size());
      }
      for (std::size_t t = 0; t < times.size(); ++t) v.by_time[t] += (d[t] - mean) * (d[t] - mean) / (sigma * sigma);
    }
    for (const double x : v.by_time) v.power += x;
    values.push_back(std::move(v));
  }
  std::sort(values.begin(), values.end(), [](const Value& a, const Value& b) { return a.power > b.power; });
  const std::size_t best_places = std::min<std::size_t>(3, values.size());
  for (std::size_t p = 0; p < best_places; ++p) {
    for (std::size_t t = 0; t < times.size(); ++t) total[t] += values[p].by_time[t];
  }
  std::vector<std::size_t> order(times.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return total[a] > total[b]; });
  MeasurementSuggestion out;
  double expected = 0.0;
  std::vector<std::size_t> chosen;
  for (const std::size_t i : order) {
    if (chosen.size() >= 8) break;
    chosen.push_back(i);
    expected += total[i];
  }
  if (!(expected > 0.0) || !std::isfinite(expected)) return std::nullopt;
  // So often that the evidence becomes clear (a difference of 20), at most 20 times.
  const double wanted = 20.0 + log_n;
  const int repeats = static_cast<int>(std::clamp(std::ceil(wanted / expected), 1.0, 20.0));
  std::sort(chosen.begin(), chosen.end());
  for (const std::size_t i : chosen) out.times_s.push_back(times[i]);
  for (std::size_t p = 0; p < best_places; ++p) out.points.push_back(places[values[p].place].name);
  out.expected_delta_bic = expected * repeats;
  out.separates = separates;
  std::vector<std::string> conditions;
  if (input.log && !input.log->empty()) {
    const double t = times[order.front()];
    if (input.log->has("spindle_rpm")) {
      const double rpm = input.log->at("spindle_rpm", t);
      conditions.push_back(rpm > 0.0 ? fmt::format("spindle at {:.0f} rpm", rpm) : std::string("spindle at rest"));
    }
    for (const char* axis : axis_letters) {
      const std::string name = fmt::format("feed_{}_mm_min", axis);
      if (input.log->has(name) && input.log->at(name, t) > 0.0) {
        conditions.push_back(fmt::format("{} moving at {:.0f} mm/min", std::string(1, static_cast<char>(axis[0] - 32)),
                                         input.log->at(name, t)));
      }
    }
    if (input.log->has("coolant"))
      conditions.push_back(input.log->at("coolant", t) > 0.0 ? "coolant on" : "coolant off");
  }
  out.conditions = "run the same programme";
  if (!conditions.empty()) out.conditions += " (at the clearest time: " + joinedList(conditions) + ")";
  if (repeats > 1) out.conditions += fmt::format(", {} readings at every time", repeats);
  return out;
}

}  // namespace spindrift
