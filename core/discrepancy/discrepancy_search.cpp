// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/discrepancy_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

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

/// Refines the dynamics of the terms from `from` on.
JointFit refineDynamics(const EffectSearch& search, JointFit fit, std::size_t from,
                        const std::vector<NuisanceColumn>& base) {
  for (std::size_t t = from; t < fit.terms.size(); ++t) fit = search.refineDynamics(std::move(fit), t, base);
  return fit;
}

/// Both act through one and the same shape over the units.
bool sameShape(const EffectSearch& search, const Effect& a, const Effect& b) {
  const Eigen::MatrixXd& first = search.shape(a);
  const Eigen::MatrixXd& second = search.shape(b);
  if (first.cols() != 1 || second.cols() != 1) return false;
  const double dot = first.col(0).dot(second.col(0));
  return std::abs(dot) > 0.999 * first.col(0).norm() * second.col(0).norm() && dot != 0.0;
}

/// An onset that no log shows, or a course that fits several drivers alike, may as well be an effect of the same shape
/// whose driver the log lacks; an onset and another course in one shape together imitate such an effect.
void addUndrivenRivals(const EffectSearch& search, SearchOutcome& out) {
  for (std::size_t t = 0; t < out.fit.terms.size(); ++t) {
    const ModelTerm& term = out.fit.terms[t];
    auto& rivals = out.evidence[t].rivals;
    const bool onset = term.variant.inputs[0].dynamics == Dynamics::Pulse;
    const bool vague = std::any_of(rivals.begin(), rivals.end(), [](const RivalFit& r) { return !r.container; });
    if (!onset && !vague) continue;
    for (const Effect& effect : search.catalogue()) {
      if (!effect.driver_missing || effect.id == term.effect->id || !sameShape(search, effect, *term.effect)) continue;
      const bool by_position = effect.id.starts_with("heat_source.");
      for (std::size_t other = 0; onset && other < out.fit.terms.size(); ++other) {
        const Effect& beside = *out.fit.terms[other].effect;
        const bool alike = by_position ? contains(effect, beside.id) : sameShape(search, effect, beside);
        if (other == t || !alike || !effect.variants.empty()) continue;
        out.composite = fmt::format("{} and {} together look like {}, whose driver the log lacks", beside.id,
                                    term.effect->id, effect.id);
      }
      if (by_position || (!onset && !effect.variants.empty())) continue;
      if (std::any_of(rivals.begin(), rivals.end(), [&](const RivalFit& r) { return r.id == effect.id; })) continue;
      rivals.push_back({effect.id, out.fit.score, false, {}, true});
    }
  }
}

/// How many effects have their main part in one and the same component, at most.
int mostInOneComponent(const ResidualProblem& problem, const JointFit& fit) {
  std::map<Component, int> count;
  for (const Eigen::VectorXd& part : fit.contribution) {
    std::map<Component, double> power;
    for (Index u = 0; u < problem.size(); ++u) {
      const double z = part[u] / problem.sigma[u];
      power[problem.component[static_cast<std::size_t>(u)]] += z * z;
    }
    const auto largest =
        std::max_element(power.begin(), power.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    ++count[largest->first];
  }
  int most = 0;
  for (const auto& [component, effects] : count) most = std::max(most, effects);
  return most;
}

struct Leftover {
  double chi2 = 0.0;
  double explained_fraction = 0.0;
  StructureTest structure;
  UnknownCourse unknown_course;
};

/// What a fit leaves, against the noise and against an unknown cause.
Leftover leftoverOf(const EffectSearch& search, ResidualProblem& problem, const std::vector<NuisanceColumn>& base,
                    const JointFit& fit, const SearchLimits& limits) {
  problem.setNuisances(base);
  Leftover out;
  Eigen::VectorXd residual = problem.projectedResidual();
  const double before = residual.squaredNorm();
  std::vector<NamedPart> parts;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    const Eigen::VectorXd part = problem.projected(search.columns(fit.terms[t])) * fit.gains[t];
    residual -= part;
    parts.push_back({part.head(problem.size()),
                     static_cast<int>(fit.gains[t].size() + static_cast<Index>(fit.terms[t].parameters.size()))});
  }
  out.chi2 = residual.squaredNorm();
  const double dof = std::max(1.0, static_cast<double>(problem.degreesOfFreedom() - fit.parameter_count));
  const double left = std::max(0.0, out.chi2 - dof);
  const double explained = std::max(0.0, before - out.chi2 - fit.parameter_count);
  out.explained_fraction = explained + left > 0.0 ? explained / (explained + left) : 1.0;
  out.structure = testStructure(problem, residual.head(problem.size()));
  out.unknown_course =
      testUnknownCourse(problem, residual.head(problem.size()), parts, limits.leftover_error, search.logN());
  return out;
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
    fit = refineDynamics(search, search.refine(terms, 2), terms.size() - 1, base);
    out.forced.push_back(true);
    out.steps.push_back({id, true, candidate.score, candidate.delta_chi2, "accepted by the user"});
  }

  const auto extend = [&](JointFit current, int most, std::vector<DiscrepancyStep>& steps) {
    while (static_cast<int>(current.terms.size()) < most) {
      job.throwIfCancelled();
      job.report(0.1 + 0.15 * static_cast<double>(current.terms.size()), "trying every effect");
      problem.setNuisances(nuisancesOf(search, base, current, current.terms.size(), limits.model_error));
      std::vector<std::string> without = idsOf(current.terms);
      without.insert(without.end(), rejected.begin(), rejected.end());
      std::vector<CandidateFit> candidates = search.sweep(without, job);
      // A refinement of an accepted effect (or what it contains) is no name of its own.
      std::erase_if(candidates, [&](const CandidateFit& c) {
        return std::any_of(current.terms.begin(), current.terms.end(), [&](const ModelTerm& term) {
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
      const Dynamics dynamics = candidate.term.variant.inputs[0].dynamics;
      const bool onset = dynamics == Dynamics::Step || dynamics == Dynamics::Pulse;
      const double onset_effects =
          static_cast<double>(std::count_if(candidates.begin(), candidates.end(), [](const CandidateFit& c) {
            const Dynamics d = c.term.variant.inputs[0].dynamics;
            return d == Dynamics::Step || d == Dynamics::Pulse;
          }));
      const bool by_chance = onset
                                 ? !(candidate.score > 8.0) || onsetPValue(search, problem, candidate) * onset_effects >
                                                                   options.false_alarm_rate
                                 : !significant(candidate.delta_chi2, candidate.parameter_count, tried);
      if (by_chance) {
        step.reason = "no more than the largest of all effects tried gains by chance";
        steps.push_back(step);
        break;
      }
      if (!current.terms.empty() && candidate.delta_chi2 < limits.smallest_part * current.delta_chi2) {
        step.reason = "too small beside what the accepted effects may miss";
        steps.push_back(step);
        break;
      }
      problem.setNuisances(base);
      const JointFit before = current;
      std::vector<ModelTerm> terms = current.terms;
      terms.push_back(candidate.term);
      JointFit joint = search.refine(terms, 2);
      const auto cv = search.crossValidate(before.terms, joint.terms, base);
      // What happens within one block (a warm-up at the start) cannot be learnt without it: then every fifth state
      // decides.
      const auto scattered = search.crossValidate(before.terms, joint.terms, base, true);
      if (!(cv.after_chi2 < cv.before_chi2) && !(scattered.after_chi2 + 8.0 < scattered.before_chi2)) {
        step.reason = "does not predict blocks of states that were left out";
        steps.push_back(step);
        break;
      }
      joint = refineDynamics(search, joint, 0, base);
      step.accepted = true;
      step.reason = "";
      steps.push_back(step);
      current = std::move(joint);
    }
    return current;
  };
  fit = extend(std::move(fit), options.max_effects, out.steps);

  out.forced.resize(fit.terms.size(), false);

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
      joint = refineDynamics(search, joint, t, base);
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

  // A simpler effect beside one that contains it leaves, where the larger can do without it.
  for (std::size_t t = fit.terms.size(); t-- > 0;) {
    const std::string id = fit.terms[t].effect->id;
    if (out.forced[t] || std::none_of(fit.terms.begin(), fit.terms.end(),
                                      [&](const ModelTerm& other) { return contains(*other.effect, id); })) {
      continue;
    }
    std::vector<ModelTerm> terms = fit.terms;
    terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(t));
    problem.setNuisances(base);
    JointFit joint = refineDynamics(search, search.refine(terms, 2), 0, base);
    // What the larger lacks without it is the model error of its dynamics rather than a cause of its own.
    if (joint.score < fit.score - std::max(20.0, limits.contained_part * fit.delta_chi2)) continue;
    out.steps.push_back({id, false, fit.score - joint.score, fit.delta_chi2 - joint.delta_chi2,
                         "left again: contained in another effect of the model"});
    fit = std::move(joint);
    out.evidence.erase(out.evidence.begin() + static_cast<std::ptrdiff_t>(t));
    out.forced.erase(out.forced.begin() + static_cast<std::ptrdiff_t>(t));
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
  problem.setNuisances(base);
  const Leftover left = leftoverOf(search, problem, base, fit, limits);
  out.chi2_after = left.chi2;
  out.structured_power = std::max(0.0, out.chi2_before - out.dof_before);
  out.explained_fraction = left.explained_fraction;
  out.leftover_p_value = left.structure.p_value;
  if (left.structure.p_value < 0.01) out.leftover = left.structure.description;
  out.unknown_course = left.unknown_course;
  out.significant_before =
      testStructure(problem, Eigen::VectorXd(problem.projectedResidual().head(problem.size()))).p_value < 0.01;
  out.fit = std::move(fit);
  out.crowded = mostInOneComponent(problem, out.fit) > limits.most_in_one_component || out.unknown_course.cancelling;
  addUndrivenRivals(search, out);
  return out;
}

}  // namespace spindrift
