// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/simulation_parts.h"

#include <algorithm>
#include <cmath>

#include "core/discrepancy/discrepancy_numbers.h"
#include "core/discrepancy/simulation_clock.h"

namespace spindrift {

std::vector<SimulationPart> partsOfSimulation(const ResidualProblem& problem, const DriverTable& drivers,
                                              const std::vector<Effect>& catalogue, const DiscrepancyPriors& priors,
                                              const JobContext& job) {
  if (!(problem.simulated.size() > 0 && problem.simulated.cwiseAbs().maxCoeff() > 0.0)) return {};
  ResidualProblem simulation = problem;
  simulation.y = simulation.simulated;
  simulation.setNuisances({});
  const EffectSearch search(simulation, drivers, catalogue);
  const CandidateLibrary library(search, simulation, job);
  const DiscrepancyOptions nothing_by_hand;
  const JointFit fit = PosteriorSearch(search, simulation, library, nothing_by_hand, priors, 0.0).run(job).fit;
  std::vector<SimulationPart> out;
  std::vector<ModelEffect> models = modelEffects(search, simulation, fit, "simulation", 1.0);
  for (std::size_t t = 0; t < fit.terms.size(); ++t)
    out.push_back({fit.terms[t].effect->id, fit.terms[t], fit.gains[t], fit.contribution[t], {}, std::move(models[t])});
  if (drivers.empty()) return out;
  // Of the order of an offset, so that parts that follow their drivers within minutes are moved as they would be.
  constexpr double apart_s = 120.0;
  for (const double by_s : {-apart_s, apart_s}) {
    DriverTable shifted = drivers;
    shifted.shiftClock(by_s);
    const EffectSearch moved(simulation, shifted, catalogue);
    for (std::size_t t = 0; t < fit.terms.size(); ++t) {
      if (!drivenByLog(fit.terms[t])) continue;
      moved.prepare(*fit.terms[t].effect);
      const Eigen::VectorXd share = moved.columns(fit.terms[t]) * fit.gains[t] / (2.0 * by_s);
      out[t].rate = out[t].rate.size() == 0 ? share : Eigen::VectorXd(out[t].rate + share);
    }
  }
  return out;
}

Eigen::VectorXd clockRate(const ResidualProblem& problem, const std::vector<SimulationPart>& parts) {
  Eigen::VectorXd rest = problem.simulated;
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(problem.size());
  for (const SimulationPart& part : parts) {
    if (part.rate.size() == 0) continue;
    rest -= part.values;
    rate += part.rate;
  }
  return rate + problem.ratePerSecond(rest);
}

double simulationClock(const ResidualProblem& problem, const DriverTable& drivers, const std::vector<Effect>& catalogue,
                       const std::vector<SimulationPart>& parts, double prior_s) {
  Eigen::VectorXd rest = problem.simulated;
  bool logged = false;
  for (const SimulationPart& part : parts) {
    rest -= part.values;
    logged = logged || part.rate.size() > 0;
  }
  if (!logged) return 0.0;
  const Eigen::VectorXd rest_rate = problem.ratePerSecond(rest);
  const auto leftAt = [&](double offset_s) {
    DriverTable shifted = drivers;
    shifted.shiftClock(offset_s);
    const EffectSearch moved(problem, shifted, catalogue);
    Eigen::VectorXd left = problem.y - offset_s * rest_rate;
    for (const SimulationPart& part : parts) {
      if (part.rate.size() == 0) continue;
      moved.prepare(*part.term.effect);
      const Eigen::MatrixXd columns = moved.columns(part.term);
      left -= columns * part.gains - part.values;
    }
    return problem.projected(left).squaredNorm();
  };
  constexpr double step_s = 60.0;
  constexpr int most_steps = 10;
  constexpr double worth_it = 8.0;  // in 2 ln of the likelihood
  const double now = leftAt(0.0);
  double least = now - worth_it;
  double best_s = 0.0;
  for (int k = -most_steps; k <= most_steps; ++k) {
    if (k == 0) continue;
    const double offset_s = k * step_s;
    const double left = leftAt(offset_s) + std::pow(offset_s / prior_s, 2);
    if (left < least) {
      least = left;
      best_s = offset_s;
    }
  }
  return best_s;
}

std::vector<double> predictedLater(const DiscrepancyInput& input, const DriverTable& drivers,
                                   const std::vector<SimulationPart>& parts, double later_s) {
  const std::vector<Observation>& rows = input.observations.rows;
  DriverTable shifted = drivers;
  shifted.shiftClock(later_s);
  std::vector<double> rest = input.predicted;
  std::vector<double> moved(rows.size(), 0.0);
  for (const SimulationPart& part : parts) {
    if (part.rate.size() == 0) continue;
    const std::vector<double> now = EffectModel::contribution(drivers, part.model, rows);
    const std::vector<double> then = EffectModel::contribution(shifted, part.model, rows);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      rest[r] -= now[r];
      moved[r] += then[r];
    }
  }
  const PredictedAt between = predictedBetween(rows, rest);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const double later = between(rows[r], rows[r].time_s + later_s);
    moved[r] += std::isfinite(rest[r]) && std::isfinite(later) ? later : rest[r];
  }
  return moved;
}

std::vector<PartError> partErrors(const ResidualProblem& problem, const std::vector<SimulationPart>& parts,
                                  std::size_t first, const Eigen::VectorXd& values) {
  const ResidualProblem::NuisancePart taken = problem.nuisancePart(values);
  std::vector<double> size_um;
  for (const SimulationPart& part : parts)
    size_um.push_back(std::abs(taken.values.dot(part.values)) / part.values.norm());
  std::vector<PartError> out;
  constexpr double main_part = 0.5;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (size_um[p] < main_part * *std::max_element(size_um.begin(), size_um.end())) continue;
    // What is missing, as a part of what the simulation has.
    const double missing = taken.values.dot(parts[p].values) / parts[p].values.squaredNorm();
    const double needed = std::max(1e-9, 1.0 + missing);
    out.push_back(
        {parts[p].id, -missing / needed, std::sqrt(std::max(0.0, taken.variances[first + p])) / (needed * needed)});
  }
  return out;
}

std::optional<PartError> partError(const ResidualProblem& problem, const SimulationPart& part,
                                   const Eigen::VectorXd& missing, double relative_uncertainty) {
  constexpr double alike = 0.7;  // cosine
  constexpr double least_left = 0.1;
  Eigen::VectorXd weight(problem.size());
  for (Eigen::Index u = 0; u < problem.size(); ++u) weight[u] = 1.0 / problem.ownSigma(u);
  const Eigen::VectorXd has = problem.centred(part.values).cwiseProduct(weight);
  const Eigen::VectorXd lacks = problem.centred(missing).cwiseProduct(weight);
  if (!(has.norm() > 0.0) || std::abs(has.dot(lacks)) < alike * has.norm() * lacks.norm()) return std::nullopt;
  const double part_missing = lacks.dot(has) / has.squaredNorm();
  const double needed = 1.0 + part_missing;
  if (needed < least_left) return std::nullopt;
  return PartError{part.id, -part_missing / needed, std::abs(part_missing) * relative_uncertainty / (needed * needed)};
}

}  // namespace spindrift
