// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/mechanism_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/discrepancy/comparable_rows.h"
#include "core/discrepancy/simulation_closure.h"
#include "core/discrepancy/simulator_tangents.h"

namespace spindrift {
namespace {

/// Chi-squared that the answer of a parameter explains alone; an answer that is not known explains nothing.
double gainOf(const SimulatorParameter& parameter, const SimulatorTangents& tangents,
              const SimulationClosure& closure) {
  // Of two that explain nothing the mechanism that is off is the likelier cause.
  double gain = parameter.off() ? 1e-6 : 0.0;
  for (const SimulatorTangent& tangent : tangents.tangents) {
    if (tangent.parameter.name != parameter.name) continue;
    const Eigen::VectorXd x = closure.projected(tangent.per_unit);
    if (x.squaredNorm() > 0.0) gain += std::pow(x.dot(closure.residual()), 2) / x.squaredNorm();
  }
  return gain;
}

}  // namespace

MechanismChoice mechanismsBehind(const DiscrepancyInput& input, const DiscrepancyResult& result,
                                 const Simulator& simulator) {
  SPINDRIFT_ASSERT(input.tangents != nullptr, "a search with the simulator's tangents");
  MechanismChoice out;
  if (result.effects.empty()) return out;
  std::vector<std::string> told_before;  // by the search
  const ComparableRows rows = comparableRows(input, input.log_clock_s, told_before);
  const JobContext no_job;
  const SimulationClosure closure(input, result, simulator, rows.fit, no_job);
  const auto add = [&](const std::string& name) {
    if (std::find(out.names.begin(), out.names.end(), name) == out.names.end()) out.names.push_back(name);
  };
  for (const FoundEffect& effect : result.effects) {
    if (const SimulatorParameter* own = simulator.find(effect.id)) {
      add(own->name);
      continue;
    }
    const SimulatorParameter* best = nullptr;
    double most = 0.0;
    for (const SimulatorParameter& p : simulator.parameters()) {
      if (std::find(p.effects.begin(), p.effects.end(), effect.id) == p.effects.end()) continue;
      const double gain = gainOf(p, *input.tangents, closure);
      if (best != nullptr && gain <= most) continue;
      best = &p;
      most = gain;
    }
    if (best != nullptr) {
      add(best->name);
      continue;
    }
    out.warnings.push_back(
        fmt::format("No parameter of {} is said to cause {}: it stays a fitted term; allowed: a parameter with this "
                    "id among its \"effects\".",
                    simulator.file().filename().string(), effect.id));
  }
  return out;
}

std::string whyNotTogether(const std::vector<std::string>& names, const std::vector<SimulatorParameter>& parameters,
                           const std::vector<SimulatorWindow>& windows,
                           const std::vector<std::pair<std::string, std::string>>& twins) {
  const auto chosen = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  bool any_mechanism = false;
  for (const SimulatorParameter& p : parameters) {
    if (!chosen(p.name)) continue;
    if (!(p.max > p.min)) {
      return fmt::format("{} cannot be fitted: its bounds \"min\" and \"max\" are both {}.", p.name,
                         withUncertainty(p.min, 0.0, p.printedUnit()));
    }
    any_mechanism = any_mechanism || !p.effects.empty();
  }
  for (const SimulatorWindow& w : windows) {
    for (const std::string& name : {w.begin_s, w.end_s}) {
      if (!chosen(name) || any_mechanism) continue;
      return fmt::format("{} is a time of a load between {} and {}: it can only be put in together with that load.",
                         name, w.begin_s, w.end_s);
    }
  }
  for (const auto& [a, b] : twins) {
    if (!chosen(a) || !chosen(b)) continue;
    return fmt::format(
        "{} and {} have the same effect on the observations: their magnitudes cannot be estimated jointly; allowed: "
        "one of the two.",
        a, b);
  }
  return {};
}

}  // namespace spindrift
