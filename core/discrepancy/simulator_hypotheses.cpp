// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/simulator_hypotheses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/text.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// Times that a load may begin at, at most.
constexpr std::size_t most_begins = 40;
/// Two columns closer than this (cosine) are the same to these readings.
constexpr double same_direction = 0.995;

/// The answer to a load that begins at `from_s` and stays, projected, and free of what is given.
Eigen::VectorXd beganAt(const WindowedLoad& load, double from_s, const ResidualProblem& problem,
                        const CandidateLibrary::Given& given) {
  Eigen::VectorXd raw(problem.size());
  for (Index u = 0; u < problem.size(); ++u) {
    const auto at = static_cast<std::size_t>(u);
    raw[u] = load.at(problem.time_s[at] - from_s, problem.place[at].point, problem.component[at]);
  }
  Eigen::VectorXd x = Eigen::VectorXd::Zero(given.residual.size());
  const Eigen::MatrixXd projected = problem.projected(raw);
  x.head(projected.rows()) = projected.col(0);
  if (given.basis.cols() > 0) x -= given.basis * (given.basis.transpose() * x);
  return x;
}

}  // namespace

LoadWindow bestWindow(const SimulatorTangent& tangent, const ResidualProblem& problem,
                      const CandidateLibrary::Given& given) {
  SPINDRIFT_ASSERT(tangent.window != nullptr, "a load between two times");
  const WindowedLoad& load = *tangent.window;
  const SimulatorParameter& p = tangent.parameter;
  const int sign = p.value <= p.min ? 1 : p.value >= p.max ? -1 : 0;
  std::vector<double> times{load.first_s};
  std::vector<double> epochs = problem.epoch_time_s;
  std::sort(epochs.begin(), epochs.end());
  const std::size_t step = std::max<std::size_t>(1, epochs.size() / most_begins);
  for (std::size_t i = 0; i < epochs.size(); i += step) {
    if (epochs[i] > times.back() && epochs[i] < load.last_s) times.push_back(epochs[i]);
  }
  const auto gainOf = [&](const Eigen::VectorXd& x) {
    const double norm = x.squaredNorm();
    if (!(norm > 1e-12)) return 0.0;
    const double dot = x.dot(given.residual);
    if (sign != 0 && dot * sign < 0.0) return 0.0;
    return dot * dot / norm;
  };
  std::vector<Eigen::VectorXd> begun;
  begun.reserve(times.size());
  for (const double t : times) begun.push_back(beganAt(load, t, problem, given));
  LoadWindow best{load.first_s, load.last_s, 1};
  double most = gainOf(begun.front());
  int choices = 0;
  for (std::size_t a = 0; a < times.size(); ++a) {
    for (std::size_t b = a + 1; b <= times.size(); ++b) {
      const bool ends = b < times.size();
      const double gain = gainOf(ends ? Eigen::VectorXd(begun[a] - begun[b]) : begun[a]);
      ++choices;
      if (!(gain > most)) continue;
      most = gain;
      best.from_s = times[a];
      best.to_s = ends ? times[b] : load.last_s;
    }
  }
  best.choices = std::max(1, choices);
  // Between the times of the grid.
  const double spacing =
      times.size() > 1 ? (times.back() - times.front()) / static_cast<double>(times.size() - 1) : 0.0;
  const bool stays = best.to_s >= load.last_s;
  for (double move = 0.5 * spacing; move > 30.0; move *= 0.5) {
    for (const bool begin : {true, false}) {
      if (!begin && stays) continue;
      for (const double direction : {1.0, -1.0}) {
        LoadWindow trial = best;
        double& value = begin ? trial.from_s : trial.to_s;
        value += direction * move;
        if (trial.from_s < load.first_s || trial.to_s > load.last_s || trial.to_s - trial.from_s < 60.0) continue;
        Eigen::VectorXd x = beganAt(load, trial.from_s, problem, given);
        if (!stays) x -= beganAt(load, trial.to_s, problem, given);
        const double gain = gainOf(x);
        if (!(gain > most)) continue;
        most = gain;
        best = trial;
      }
    }
  }
  return best;
}

SimulatorHypotheses::SimulatorHypotheses(const SimulatorTangents* tangents, const ObservationSet& observations)
    : tangents_(tangents), observations_(&observations) {}

void SimulatorHypotheses::append(std::vector<Effect>& catalogue) const {
  if (tangents_ == nullptr) return;
  for (const SimulatorTangent& tangent : tangents_->tangents) {
    if (std::any_of(catalogue.begin(), catalogue.end(),
                    [&](const Effect& e) { return e.id == tangent.parameter.id(); }))
      continue;
    catalogue.push_back(tangent.window ? windowedEffect(tangent, tangent.window->first_s, tangent.window->last_s)
                                       : tangentEffect(tangent, *observations_, true));
  }
}

std::vector<NuisanceColumn> SimulatorHypotheses::nuisances(const ResidualProblem& problem) const {
  std::vector<NuisanceColumn> out;
  if (tangents_ == nullptr) return out;
  for (const SimulatorTangent& tangent : tangents_->tangents) {
    const SimulatorParameter& p = tangent.parameter;
    if (p.off() || !(p.standard_uncertainty > 0.0)) continue;
    out.push_back(
        {problem.shapeAtUnits(tangentEffect(tangent, *observations_, false)).col(0), p.standard_uncertainty, false});
  }
  return out;
}

bool SimulatorHypotheses::chooseWindows(std::vector<Effect>& catalogue, const ResidualProblem& problem,
                                        const std::function<CandidateLibrary::Given(const std::string& id)>& given) {
  if (tangents_ == nullptr) return false;
  bool moved = false;
  for (const SimulatorTangent& tangent : tangents_->tangents) {
    if (!tangent.window) continue;
    const std::string id = tangent.parameter.id();
    const auto effect =
        std::find_if(catalogue.begin(), catalogue.end(), [&](const Effect& e) { return e.id == id && e.over_time; });
    if (effect == catalogue.end()) continue;
    const LoadWindow window = bestWindow(tangent, problem, given(id));
    const double far = 0.02 * (tangent.window->last_s - tangent.window->first_s);
    const auto [before, fresh] = windows_.try_emplace(id, window);
    const bool same =
        std::abs(before->second.from_s - window.from_s) <= far && std::abs(before->second.to_s - window.to_s) <= far;
    if (!fresh && same) continue;
    moved = true;
    before->second = window;
    *effect = windowedEffect(tangent, window.from_s, window.to_s);
    effect->choices = window.choices;
  }
  return moved;
}

const SimulatorTangent* SimulatorHypotheses::find(const std::string& id) const {
  if (tangents_ == nullptr) return nullptr;
  for (const SimulatorTangent& tangent : tangents_->tangents) {
    if (tangent.parameter.id() == id) return &tangent;
  }
  return nullptr;
}

const LoadWindow* SimulatorHypotheses::windowOf(const std::string& id) const {
  const auto found = windows_.find(id);
  return found == windows_.end() ? nullptr : &found->second;
}

void SimulatorHypotheses::describe(FoundEffect& found, double gain, double gain_uncertainty) const {
  const SimulatorTangent* tangent = find(found.id);
  if (tangent == nullptr) return;
  const SimulatorParameter& p = tangent->parameter;
  found.parameters = {{p.name, p.value + gain, gain_uncertainty}};
  const std::string value = withUncertainty(p.value + gain, gain_uncertainty, p.printedUnit());
  if (p.off()) {
    found.drivers = fmt::format("switched off in the simulation; measured {}", value);
  } else if (p.value != 0.0) {
    // Too low: the simulation has less than the machine.
    const double part = -100.0 * gain / (p.value + gain);
    const double uncertainty = 100.0 * std::abs(gain_uncertainty * p.value / std::pow(p.value + gain, 2));
    found.drivers = fmt::format("{} too {} in the simulation: {} there, measured {}",
                                withUncertainty(std::abs(part), uncertainty, "%"), gain > 0.0 ? "low" : "high",
                                withUncertainty(p.value, 0.0, p.printedUnit()), value);
    found.parameters.push_back({p.name + "_relative_change", gain / p.value, gain_uncertainty / std::abs(p.value)});
  } else {
    found.drivers = fmt::format("taken as 0 in the simulation; measured {}", value);
  }
  if (const LoadWindow* window = windowOf(found.id)) {
    found.parameters.push_back({tangent->window->begin_s, window->from_s, 0.0});
    found.parameters.push_back({tangent->window->end_s, window->to_s, 0.0});
    found.drivers += fmt::format(", from {:.0f} s to {:.0f} s", window->from_s, window->to_s);
  }
}

std::vector<std::pair<std::string, std::string>> SimulatorHypotheses::twins(const ResidualProblem& problem) const {
  std::vector<std::pair<std::string, std::string>> out;
  if (tangents_ == nullptr) return out;
  std::vector<Eigen::VectorXd> columns;
  std::vector<const SimulatorParameter*> parameters;
  for (const SimulatorTangent& tangent : tangents_->tangents) {
    const Eigen::MatrixXd shape =
        problem.shapeAtUnits(tangent.window ? windowedEffect(tangent, tangent.window->first_s, tangent.window->last_s)
                                            : tangentEffect(tangent, *observations_, true));
    const Eigen::MatrixXd white = problem.projected(shape);
    if (!(white.norm() * tangentStep(tangent.parameter) > 1.0)) continue;
    columns.push_back(white.col(0).normalized());
    parameters.push_back(&tangent.parameter);
  }
  for (std::size_t a = 0; a < columns.size(); ++a) {
    for (std::size_t b = a + 1; b < columns.size(); ++b) {
      if (std::abs(columns[a].dot(columns[b])) >= same_direction)
        out.emplace_back(parameters[a]->name, parameters[b]->name);
    }
  }
  return out;
}

}  // namespace spindrift
