// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/discrepancy_search.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/discrepancy/distributed_dynamics.h"
#include "core/discrepancy/forward_search.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// `container` holds `simple`: by the catalogue, or because the one pattern of the latter is made of its patterns.
bool holds(const EffectSearch& search, const Effect& container, const Effect& simple) {
  if (contains(container, simple.id)) return true;
  const Eigen::MatrixXd& wide = search.shape(container);
  const Eigen::MatrixXd& narrow = search.shape(simple);
  if (narrow.cols() != 1 || wide.cols() < 2 || !(narrow.norm() > 0.0)) return false;
  const Eigen::VectorXd left = narrow.col(0) - wide * wide.colPivHouseholderQr().solve(narrow.col(0));
  return left.norm() < 1e-6 * narrow.norm();
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
      rivals.push_back({effect.id, out.fit.score, false, {}, true, false, 0.0});
    }
  }
}

/// Rivals that the noise alone may have put behind stay, all of them. Of those that only the model error of their
/// dynamics lets in, as many as make a set of three.
void keepClosestRivals(TermEvidence& evidence, const SearchLimits& limits) {
  std::sort(evidence.rivals.begin(), evidence.rivals.end(),
            [](const RivalFit& a, const RivalFit& b) { return a.score > b.score; });
  const double equal = std::max(12.0, limits.equal_margin * evidence.delta_chi2);
  int kept = 0;
  std::erase_if(evidence.rivals, [&](const RivalFit& r) {
    if (r.container) return false;
    const bool keep = -r.ahead < equal || kept < 2;
    kept += keep ? 1 : 0;
    return !keep;
  });
}

/// Of wider effects that fit as well, the best joins a set of rivals that has room for it.
void closeSets(SearchOutcome& out) {
  for (TermEvidence& evidence : out.evidence) {
    auto& rivals = evidence.rivals;
    bool room = std::count_if(rivals.begin(), rivals.end(), [](const RivalFit& r) { return !r.container; }) < 2;
    for (RivalFit& r : rivals) {
      r.undecided = r.undecided && room;
      room = room && !r.undecided;
    }
  }
}

/// An effect that no longer earns its place leaves, the smallest gain first.
void dropSuperfluous(const EffectSearch& search, ResidualProblem& problem, const std::vector<NuisanceColumn>& base,
                     const SearchLimits& limits, JointFit& fit, SearchOutcome& out) {
  problem.setNuisances(base);
  while (fit.terms.size() > 1) {
    std::size_t weakest = fit.terms.size();
    JointFit best_without;
    for (std::size_t t = 0; t < fit.terms.size(); ++t) {
      if (out.forced[t]) continue;
      std::vector<ModelTerm> terms = fit.terms;
      terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(t));
      JointFit without = search.refine(terms, 2);
      const double lost = fit.delta_chi2 - without.delta_chi2;
      const double least = smallestGain(search, problem, fit, fit.contribution[t], hasOnset(fit.terms[t]), t, limits);
      if (fit.score - without.score > 8.0 && lost > least) continue;
      if (weakest < fit.terms.size() && without.score < best_without.score) continue;
      weakest = t;
      best_without = std::move(without);
    }
    if (weakest == fit.terms.size()) return;
    out.steps.push_back({fit.terms[weakest].effect->id, false, fit.score - best_without.score,
                         fit.delta_chi2 - best_without.delta_chi2, "left again: the other effects explain it"});
    fit = std::move(best_without);
    const auto at = static_cast<std::ptrdiff_t>(weakest);
    out.forced.erase(out.forced.begin() + at);
    if (out.evidence.size() > weakest) out.evidence.erase(out.evidence.begin() + at);
  }
}

int foreignDrivers(const JointFit& fit) {
  int count = 0;
  for (const ModelTerm& term : fit.terms) count += spindrift::foreignDrivers(term);
  return count;
}

struct RivalComparison {
  TermEvidence evidence;
  bool exchanged = false;  ///< another effect does better in its place and has taken it
};

/// Term `t` against every other effect, the other terms kept.
RivalComparison compareRivals(EffectSearch& search, ResidualProblem& problem, const std::vector<NuisanceColumn>& base,
                              const DiscrepancyOptions& options, const SearchLimits& limits, const JobContext& job,
                              double chi2_before, bool may_exchange, std::size_t t, JointFit& fit) {
  std::vector<ModelTerm> others = fit.terms;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(t));
  problem.setNuisances(base);
  JointFit reduced;
  reduced.chi2 = chi2_before;
  if (!others.empty()) reduced = search.refine(others, 1);
  RivalComparison out;
  TermEvidence& evidence = out.evidence;
  evidence.delta_chi2 = fit.delta_chi2 - reduced.delta_chi2;
  evidence.delta_bic = fit.score - reduced.score;
  problem.setNuisances(nuisancesOf(search, base, fit, t, 0.5 * limits.model_error));
  std::vector<std::string> without = idsOf(fit.terms);
  std::vector<CandidateFit> candidates = search.sweep(without, job);
  // What the effect itself gains beside the others, measured in the same way.
  const double own = std::min(evidence.delta_chi2, search.best(*fit.terms[t].effect).delta_chi2);
  problem.setNuisances(base);
  if (candidates.size() > 6) candidates.resize(6);
  const double rival_margin = std::max(12.0, limits.rival_margin * evidence.delta_chi2);
  const double container_margin = std::max(20.0, limits.container_margin * evidence.delta_chi2);
  for (const CandidateFit& candidate : candidates) {
    const Effect& other = *candidate.term.effect;
    const bool rejected_id = std::find(options.reject.begin(), options.reject.end(), other.id) != options.reject.end();
    if (candidate.delta_chi2 < 0.7 * own || rejected_id) continue;
    std::vector<ModelTerm> terms = fit.terms;
    terms[t] = candidate.term;
    JointFit joint = search.refine(terms, 2);
    joint = refineDynamics(search, joint, t, base);
    const bool is_container = holds(search, other, *fit.terms[t].effect);
    const bool is_simpler = !is_container && holds(search, *fit.terms[t].effect, other);
    const double ahead = joint.score - fit.score;
    double simpler_margin = container_margin;
    const bool wider_shape = search.shape(*fit.terms[t].effect).cols() > search.shape(other).cols();
    if (is_simpler && wider_shape && !(ahead > -container_margin)) {
      // The simpler shape with the course in time of the wider: if that does nearly as well, what the wider gains it
      // gains by drivers that happen to fit, and its shape is not what is seen.
      std::vector<ModelTerm> narrowed = fit.terms;
      narrowed[t].effect = &other;
      const double lost = fit.delta_chi2 - search.solve(narrowed).delta_chi2;
      if (lost < limits.shape_part * evidence.delta_chi2) {
        simpler_margin = std::max(container_margin, limits.shape_part * evidence.delta_chi2);
      }
    }
    const bool swap = is_container ? ahead > container_margin : is_simpler ? ahead > -simpler_margin : ahead > 0.5;
    if (swap && may_exchange) {
      out.exchanged = true;
      fit = std::move(joint);
      return out;
    }
    if (!twoNamesOfOne(search, other, *fit.terms[t].effect)) {
      evidence.behind.emplace_back(-ahead, is_container || is_simpler);
    }
    if (is_simpler) continue;
    if (!is_container) evidence.margin = std::min(evidence.margin, -ahead);
    if (ahead > -rival_margin) {
      const bool undecided = is_container && ahead > -limits.undecided_margin;
      evidence.rivals.push_back({other.id, joint.score, is_container, joint, false, undecided, ahead});
    }
  }
  keepClosestRivals(evidence, limits);
  return out;
}

/// A simpler effect beside one that contains it leaves, where the larger can do without it.
void dropContained(EffectSearch& search, ResidualProblem& problem, const std::vector<NuisanceColumn>& base,
                   const SearchLimits& limits, JointFit& fit, SearchOutcome& out) {
  for (std::size_t t = fit.terms.size(); t-- > 0;) {
    const std::string id = fit.terms[t].effect->id;
    const auto covers = [&](const ModelTerm& other) { return contains(*other.effect, id); };
    if (out.forced[t] || std::none_of(fit.terms.begin(), fit.terms.end(), covers)) continue;
    std::vector<ModelTerm> terms = fit.terms;
    terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(t));
    problem.setNuisances(base);
    JointFit joint = refineDynamics(search, search.refine(terms, 2), 0, base);
    // What the larger lacks without it is the model error of its dynamics rather than a cause of its own.
    const bool simpler = foreignDrivers(joint) <= foreignDrivers(fit);
    const double price =
        simpler ? std::max(20.0, limits.contained_part * fit.delta_chi2) : priceOfNames(fit, joint, limits);
    if (joint.score < fit.score - price) continue;
    out.steps.push_back({id, false, fit.score - joint.score, fit.delta_chi2 - joint.delta_chi2,
                         "left again: another effect of the model does nearly as well without it"});
    fit = std::move(joint);
    out.evidence.erase(out.evidence.begin() + static_cast<std::ptrdiff_t>(t));
    out.forced.erase(out.forced.begin() + static_cast<std::ptrdiff_t>(t));
  }
}

/// An onset can be put where it explains most of any course. One that leaves the like of itself is not the cause, nor
/// are two in one and the same shape.
bool onsetImitates(const EffectSearch& search, const ResidualProblem& problem, const JointFit& fit,
                   const StructureTest& left, const SearchLimits& limits) {
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    if (!hasOnset(fit.terms[t])) continue;
    if (left.p_value < limits.leftover_p && mainComponent(problem, fit.contribution[t]) == left.component) {
      return true;
    }
    for (std::size_t other = 0; other < t; ++other) {
      if (hasOnset(fit.terms[other]) && sameShape(search, *fit.terms[t].effect, *fit.terms[other].effect)) return true;
    }
  }
  return false;
}

struct Leftover {
  double chi2 = 0.0;
  double explained_fraction = 0.0;
  StructureTest structure;
  UnknownCourse unknown_course;
};

/// What a fit leaves, against the noise and against an unknown cause. Its dynamics may be wrong by a part of its
/// amplitude.
Leftover leftoverOf(const EffectSearch& search, ResidualProblem& problem, const std::vector<NuisanceColumn>& base,
                    const JointFit& fit, const SearchLimits& limits) {
  problem.setNuisances(base);
  Leftover out;
  Eigen::VectorXd residual = problem.projectedResidual();
  const double before = residual.squaredNorm();
  std::vector<NamedPart> parts;
  // Two effects in the same readings imitate many courses: they get no such allowance.
  bool stacked = false;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) stacked = stacked || overlaps(fit, t);
  const JointFit allowed =
      stacked ? fit : distributedDynamics(search, problem, search.drivers(), fit, limits.leftover_error).fit;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    const Eigen::VectorXd part = problem.projected(allowed.contribution[t]);
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

bool overlaps(const JointFit& fit, std::size_t t) {
  for (std::size_t other = 0; other < fit.terms.size(); ++other) {
    const Eigen::VectorXd& a = fit.contribution[t];
    const Eigen::VectorXd& b = fit.contribution[other];
    if (other != t && a.cwiseAbs().dot(b.cwiseAbs()) > 0.1 * a.norm() * b.norm()) return true;
  }
  return false;
}

SearchOutcome searchEffects(EffectSearch& search, ResidualProblem& problem, const std::vector<NuisanceColumn>& base,
                            const DiscrepancyOptions& options, const SearchLimits& limits, const JobContext& job) {
  SearchOutcome out;
  problem.setNuisances(base);
  out.chi2_before = problem.projectedResidual().squaredNorm();
  out.dof_before = problem.degreesOfFreedom();
  JointFit fit;
  fit.chi2 = out.chi2_before;

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

  ForwardSearch forward(search, problem, base, options, limits, job);
  fit = forward.run(std::move(fit), out.steps);

  out.forced.resize(fit.terms.size(), false);
  dropSuperfluous(search, problem, base, limits, fit, out);

  // Rivals and exchanges: every term against every other effect, the other terms kept.
  job.report(0.7, "comparing rivals");
  out.evidence.resize(fit.terms.size());
  int exchanges = 0;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    job.throwIfCancelled();
    RivalComparison compared = compareRivals(search, problem, base, options, limits, job, out.chi2_before,
                                             exchanges < 4 && !out.forced[t], t, fit);
    if (compared.exchanged) {
      ++exchanges;
      --t;
      continue;
    }
    out.evidence[t] = std::move(compared.evidence);
  }

  dropContained(search, problem, base, limits, fit, out);
  dropSuperfluous(search, problem, base, limits, fit, out);
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
  out.onset_imitates = onsetImitates(search, problem, fit, left.structure, limits);
  out.fit = std::move(fit);
  out.crowded = mostInOneComponent(problem, out.fit) > limits.most_in_one_component || out.unknown_course.cancelling;
  addUndrivenRivals(search, out);
  closeSets(out);
  return out;
}

}  // namespace spindrift
