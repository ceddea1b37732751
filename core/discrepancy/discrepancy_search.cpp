// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/discrepancy_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/distributions.h"

namespace spindrift {
namespace {

using Eigen::Index;

bool contains(const Effect& container, const std::string& simple) {
  return std::find(container.contains.begin(), container.contains.end(), simple) != container.contains.end();
}

std::vector<std::string> idsOf(const std::vector<ModelTerm>& terms) {
  std::vector<std::string> ids;
  for (const ModelTerm& term : terms) ids.push_back(term.effect->id);
  return ids;
}

/// Nuisances of the simulation and of accepted terms.
std::vector<NuisanceColumn> nuisancesOf(const EffectSearch& search, const std::vector<NuisanceColumn>& base,
                                        const JointFit& fit, std::size_t without, double model_error) {
  std::vector<NuisanceColumn> out = base;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    if (t == without) continue;
    for (NuisanceColumn& column : search.termNuisances(fit.terms[t], fit.gains[t], model_error)) {
      out.push_back(std::move(column));
    }
  }
  return out;
}

/// A second lag or another driver of the same effect, as long as the evidence grows.
JointFit refineDynamics(const EffectSearch& search, JointFit fit, std::size_t from) {
  for (std::size_t t = from; t < fit.terms.size(); ++t) {
    const ModelTerm& term = fit.terms[t];
    if (term.variant.inputs[0].driver.empty() || term.variant.inputs.size() > 2 || term.variant.shared_lag) continue;
    if (term.variant.inputs[0].dynamics != Dynamics::Lag) continue;
    if (static_cast<Index>(term.variant.inputs.size() + 1) * static_cast<Index>(term.effect->shape.size()) > 8)
      continue;
    JointFit best = fit;
    std::vector<std::string> drivers;
    for (const EffectVariant& variant : term.effect->variants) {
      for (const EffectInput& input : variant.inputs) {
        if (input.dynamics == Dynamics::Lag &&
            std::find(drivers.begin(), drivers.end(), input.driver) == drivers.end()) {
          drivers.push_back(input.driver);
        }
      }
    }
    for (const std::string& driver : drivers) {
      // The best of a few starts for the further lag, then one line search.
      JointFit start;
      start.score = -1e300;
      for (const double tau : {300.0, 1200.0, 4800.0, 14400.0}) {
        std::vector<ModelTerm> terms = fit.terms;
        terms[t].variant.inputs.push_back({driver, Dynamics::Lag});
        terms[t].parameters.push_back(tau);
        JointFit trial = search.solve(terms);
        if (trial.score > start.score) start = std::move(trial);
      }
      if (start.score < best.score - 12.0) continue;
      JointFit trial = search.refine(start.terms, 1);
      if (trial.score > best.score + 4.0) best = std::move(trial);
    }
    fit = std::move(best);
  }
  return fit;
}

}  // namespace

SearchOutcome searchEffects(EffectSearch& search, ResidualProblem& problem, const std::vector<NuisanceColumn>& base,
                            const DiscrepancyOptions& options, const SearchLimits& limits, const JobContext& job) {
  SearchOutcome out;
  problem.setNuisances(base);
  out.chi2_before = problem.projectedResidual().squaredNorm();
  out.dof_before = problem.degreesOfFreedom();
  const double log_n = search.logN();
  std::vector<std::string> rejected = options.reject;
  JointFit fit;
  fit.chi2 = out.chi2_before;

  const auto significant = [&](double delta, int k, double tried) {
    return delta > 0.0 && chiSquaredTail(delta, std::max(1, k)) * tried < options.false_alarm_rate &&
           delta > k * log_n + 8.0;
  };

  for (const std::string& id : options.accept) {
    const Effect* effect = search.find(id);
    if (effect == nullptr || effect->variants.empty()) continue;
    problem.setNuisances(nuisancesOf(search, base, fit, fit.terms.size(), 0.0));
    const CandidateFit candidate = search.best(*effect);
    if (candidate.parameter_count == 0) continue;
    problem.setNuisances(base);
    std::vector<ModelTerm> terms = fit.terms;
    terms.push_back(candidate.term);
    fit = refineDynamics(search, search.refine(terms, 2), terms.size() - 1);
    out.forced.push_back(true);
    out.steps.push_back({id, true, candidate.score, candidate.delta_chi2, "accepted by the user"});
  }

  while (static_cast<int>(fit.terms.size()) < options.max_effects) {
    job.throwIfCancelled();
    job.report(0.1 + 0.15 * static_cast<double>(fit.terms.size()), "trying every effect");
    problem.setNuisances(nuisancesOf(search, base, fit, fit.terms.size(), limits.model_error));
    std::vector<std::string> without = idsOf(fit.terms);
    without.insert(without.end(), rejected.begin(), rejected.end());
    std::vector<CandidateFit> candidates = search.sweep(without, job);
    // A refinement of an accepted effect (or what it contains) is no name of its own.
    std::erase_if(candidates, [&](const CandidateFit& c) {
      return std::any_of(fit.terms.begin(), fit.terms.end(), [&](const ModelTerm& term) {
        return (c.term.effect->refinement && contains(*c.term.effect, term.effect->id)) ||
               contains(*term.effect, c.term.effect->id);
      });
    });
    if (candidates.empty()) break;
    double tried = 0.0;
    for (const CandidateFit& c : candidates) tried += c.tried;
    // Among those that are nearly as good as the best, the simplest.
    std::size_t chosen = 0;
    for (std::size_t c = 1; c < candidates.size(); ++c) {
      const double margin = std::max(12.0, limits.container_margin * candidates[0].delta_chi2);
      if (candidates[c].score < candidates[0].score - margin) break;
      if (contains(*candidates[chosen].term.effect, candidates[c].term.effect->id)) chosen = c;
    }
    const CandidateFit& candidate = candidates[chosen];
    DiscrepancyStep step{candidate.term.effect->id, false, candidate.score, candidate.delta_chi2, ""};
    if (!significant(candidate.delta_chi2, candidate.parameter_count, tried)) {
      step.reason = "no more than the largest of all effects tried gains by chance";
      out.steps.push_back(step);
      break;
    }
    if (!fit.terms.empty() && candidate.delta_chi2 < limits.smallest_part * fit.delta_chi2) {
      step.reason = "too small beside what the accepted effects may miss";
      out.steps.push_back(step);
      break;
    }
    problem.setNuisances(base);
    const JointFit before = fit;
    std::vector<ModelTerm> terms = fit.terms;
    terms.push_back(candidate.term);
    JointFit joint = search.refine(terms, 2);
    const auto cv = search.crossValidate(before.terms, joint.terms, base);
    // What happens within one block (a warm-up at the start) cannot be learnt without it: then every fifth state
    // decides.
    const auto scattered = search.crossValidate(before.terms, joint.terms, base, true);
    if (!(cv.after_chi2 < cv.before_chi2) && !(scattered.after_chi2 + 8.0 < scattered.before_chi2)) {
      step.reason = "does not predict blocks of states that were left out";
      out.steps.push_back(step);
      break;
    }
    joint = refineDynamics(search, joint, 0);
    step.accepted = true;
    step.reason = "";
    out.steps.push_back(step);
    out.forced.push_back(false);
    fit = std::move(joint);
  }

  // Rivals and exchanges: every term against every other effect, the other terms kept.
  job.report(0.7, "comparing rivals");
  out.evidence.resize(fit.terms.size());
  int exchanges = 0;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    job.throwIfCancelled();
    std::vector<ModelTerm> others = fit.terms;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(t));
    problem.setNuisances(base);
    JointFit reduced;
    reduced.chi2 = out.chi2_before;
    if (!others.empty()) reduced = search.refine(others, 1);
    TermEvidence evidence;
    evidence.delta_chi2 = fit.delta_chi2 - reduced.delta_chi2;
    evidence.delta_bic = fit.score - reduced.score;
    problem.setNuisances(nuisancesOf(search, base, fit, t, 0.5 * limits.model_error));
    std::vector<std::string> without = idsOf(fit.terms);
    std::vector<CandidateFit> candidates = search.sweep(without, job);
    problem.setNuisances(base);
    if (candidates.size() > 6) candidates.resize(6);
    const std::string& id = fit.terms[t].effect->id;
    const double rival_margin = std::max(12.0, limits.rival_margin * evidence.delta_chi2);
    const double container_margin = std::max(20.0, limits.container_margin * evidence.delta_chi2);
    bool exchanged = false;
    for (const CandidateFit& candidate : candidates) {
      const Effect& other = *candidate.term.effect;
      const bool rejected_id = std::find(rejected.begin(), rejected.end(), other.id) != rejected.end();
      if (candidate.delta_chi2 < 0.7 * evidence.delta_chi2 || rejected_id) continue;
      std::vector<ModelTerm> terms = fit.terms;
      terms[t] = candidate.term;
      JointFit joint = search.refine(terms, 2);
      joint = refineDynamics(search, joint, t);
      const bool is_container = contains(other, id);
      const bool is_simpler = contains(*fit.terms[t].effect, other.id);
      const double ahead = joint.score - fit.score;
      const bool swap = is_container ? ahead > container_margin : is_simpler ? ahead > -container_margin : ahead > 0.5;
      if (swap && exchanges < 4 && !out.forced[t]) {
        ++exchanges;
        exchanged = true;
        fit = std::move(joint);
        break;
      }
      if (is_simpler) continue;
      if (!is_container) evidence.margin = std::min(evidence.margin, -ahead);
      if (ahead > -rival_margin) evidence.rivals.push_back({other.id, joint.score, is_container, joint});
    }
    if (exchanged) {
      --t;
      continue;
    }
    out.evidence[t] = std::move(evidence);
  }

  // An effect that no longer earns its place leaves.
  for (std::size_t t = fit.terms.size(); t-- > 0;) {
    if (out.forced[t] || fit.terms.size() < 2) continue;
    if (out.evidence[t].delta_bic > 8.0 && out.evidence[t].delta_chi2 > limits.smallest_part * fit.delta_chi2) continue;
    std::vector<ModelTerm> terms = fit.terms;
    out.steps.push_back({terms[t].effect->id, false, out.evidence[t].delta_bic, out.evidence[t].delta_chi2,
                         "left again: the other effects explain it"});
    terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(t));
    problem.setNuisances(base);
    fit = search.refine(terms, 2);
    out.evidence.erase(out.evidence.begin() + static_cast<std::ptrdiff_t>(t));
    out.forced.erase(out.forced.begin() + static_cast<std::ptrdiff_t>(t));
  }
  problem.setNuisances(base);
  if (!fit.terms.empty()) fit = search.refine(fit.terms, 1);
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    std::vector<ModelTerm> before(fit.terms.begin(), fit.terms.begin() + static_cast<std::ptrdiff_t>(t));
    std::vector<ModelTerm> after(fit.terms.begin(), fit.terms.begin() + static_cast<std::ptrdiff_t>(t) + 1);
    out.evidence[t].crossvalidation = search.crossValidate(before, after, base);
  }

  // What is left.
  job.report(0.9, "testing what is left");
  out.chi2_after = fit.terms.empty() ? out.chi2_before : fit.chi2;
  const double dof_after = std::max(1.0, static_cast<double>(out.dof_before - fit.parameter_count));
  out.structured_power = std::max(0.0, out.chi2_before - out.dof_before);
  out.leftover_power = std::max(0.0, out.chi2_after - dof_after);
  const double explained = std::max(0.0, out.chi2_before - out.chi2_after - fit.parameter_count);
  out.explained_fraction = explained + out.leftover_power > 0.0 ? explained / (explained + out.leftover_power) : 1.0;
  Eigen::VectorXd residual = problem.projectedResidual();
  if (!fit.terms.empty()) {
    for (std::size_t t = 0; t < fit.terms.size(); ++t) {
      residual -= problem.projected(search.columns(fit.terms[t])) * fit.gains[t];
    }
  }
  const Eigen::VectorXd whitened_residual = residual.head(problem.size());
  const StructureTest structure = testStructure(problem, whitened_residual);
  out.leftover_p_value = structure.p_value;
  if (structure.p_value < 0.01) out.leftover = structure.description;
  out.significant_before =
      testStructure(problem, Eigen::VectorXd(problem.projectedResidual().head(problem.size()))).p_value < 0.01;
  out.fit = std::move(fit);
  return out;
}

StructureTest testStructure(const ResidualProblem& problem, const Eigen::VectorXd& z) {
  struct Candidate {
    double p = 1.0;
    std::string text;
    Component component = Component::EX;
  };
  std::vector<Candidate> tests;
  const int epochs = problem.epoch_count;
  const double dof_part = std::max(
      0.3, static_cast<double>(problem.degreesOfFreedom()) / std::max<double>(1.0, static_cast<double>(z.size())));
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d high = -low;
  for (const DeviationQuery& q : problem.place) {
    low = low.cwiseMin(q.position_mm);
    high = high.cwiseMax(q.position_mm);
  }
  for (const Component c : all_components) {
    double sum = 0.0;
    double rows = 0.0;
    for (Index u = 0; u < z.size(); ++u) {
      if (problem.component[static_cast<std::size_t>(u)] != c) continue;
      sum += z[u] * z[u];
      rows += 1.0;
    }
    if (rows < 4.0) continue;
    tests.push_back({chiSquaredTail(sum, std::max(1.0, rows * dof_part)),
                     fmt::format("{} scatters more than its noise", toString(c)), c});
    // A course in time common to all points (kind 0) or growing along x, y, z (1..3): dof = epochs - 1.
    for (int kind = 0; kind < 4; ++kind) {
      if (kind > 0 && !(high[kind - 1] - low[kind - 1] > 1.0)) continue;
      Eigen::VectorXd num = Eigen::VectorXd::Zero(epochs);
      Eigen::VectorXd den = Eigen::VectorXd::Zero(epochs);
      for (Index u = 0; u < z.size(); ++u) {
        const auto i = static_cast<std::size_t>(u);
        if (problem.component[i] != c) continue;
        const double w = kind == 0 ? 1.0
                                   : (problem.place[i].position_mm[kind - 1] - 0.5 * (low[kind - 1] + high[kind - 1])) /
                                         (0.5 * (high[kind - 1] - low[kind - 1]));
        num[problem.epoch[i]] += w * z[u];
        den[problem.epoch[i]] += w * w;
      }
      double statistic = 0.0;
      int used = 0;
      for (int e = 0; e < epochs; ++e) {
        if (!(den[e] > 0.0)) continue;
        statistic += num[e] * num[e] / den[e];
        ++used;
      }
      if (used < 3) continue;
      std::string text = kind == 0 ? fmt::format("{} of all points follows a common course in time", toString(c))
                                   : fmt::format("{} follows a course in time that grows along {}", toString(c),
                                                 std::string(1, static_cast<char>('x' + kind - 1)));
      // Its period, if one frequency holds much of it.
      if (used >= 12) {
        const double start = problem.epoch_time_s.front();
        const double span = problem.epoch_time_s.back() - start;
        double best = 0.0;
        double total = 0.0;
        double period = 0.0;
        for (int e = 0; e < epochs; ++e) {
          if (den[e] > 0.0) total += num[e] * num[e] / den[e];
        }
        for (int k = 3; k <= epochs - 1; ++k) {
          const double omega = 3.14159265358979323846 * k / span;
          double cc = 0.0;
          double ss = 0.0;
          double cs = 0.0;
          double cy = 0.0;
          double sy = 0.0;
          for (int e = 0; e < epochs; ++e) {
            if (!(den[e] > 0.0)) continue;
            const double t = omega * (problem.epoch_time_s[static_cast<std::size_t>(e)] - start);
            const double v = num[e] / den[e];
            cc += den[e] * std::cos(t) * std::cos(t);
            ss += den[e] * std::sin(t) * std::sin(t);
            cs += den[e] * std::cos(t) * std::sin(t);
            cy += den[e] * std::cos(t) * v;
            sy += den[e] * std::sin(t) * v;
          }
          const double det = cc * ss - cs * cs;
          if (!(det > 1e-9)) continue;
          const double power = (ss * cy * cy - 2.0 * cs * cy * sy + cc * sy * sy) / det;
          if (power > best) {
            best = power;
            period = 2.0 * span / k;
          }
        }
        if (total > 0.0 && best > 0.6 * total) text += fmt::format(", with a period of about {:.0f} s", period);
      }
      tests.push_back({chiSquaredTail(statistic, std::max(1.0, (used - 1) * std::max(dof_part, 0.8))), text, c});
    }
  }
  for (int s = 0; s < problem.seriesCount(); ++s) {
    const Index from = problem.series_begin[static_cast<std::size_t>(s)];
    const Index count = problem.series_begin[static_cast<std::size_t>(s) + 1] - from;
    if (count < 4) continue;
    const Component c = problem.component[static_cast<std::size_t>(from)];
    tests.push_back({chiSquaredTail(z.segment(from, count).squaredNorm(), static_cast<double>(count - 1)),
                     fmt::format("{} of point {} deviates by itself", toString(c),
                                 problem.series_point[static_cast<std::size_t>(s)]),
                     c});
  }
  StructureTest out;
  for (const Candidate& test : tests) {
    const double p = std::min(1.0, test.p * static_cast<double>(tests.size()));
    if (p < out.p_value) {
      out.p_value = p;
      out.description = test.text;
      out.component = test.component;
    }
  }
  return out;
}

}  // namespace spindrift
