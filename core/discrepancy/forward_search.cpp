// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/forward_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/math/distributions.h"

namespace spindrift {

bool sameShape(const EffectSearch& search, const Effect& a, const Effect& b) {
  const Eigen::MatrixXd& first = search.shape(a);
  const Eigen::MatrixXd& second = search.shape(b);
  if (first.cols() != 1 || second.cols() != 1) return false;
  const double dot = first.col(0).dot(second.col(0));
  return std::abs(dot) > 0.999 * first.col(0).norm() * second.col(0).norm() && dot != 0.0;
}

namespace {

bool sameDrivers(const Effect& a, const Effect& b) {
  return std::any_of(a.variants.begin(), a.variants.end(), [&](const EffectVariant& first) {
    return std::any_of(b.variants.begin(), b.variants.end(), [&](const EffectVariant& second) {
      return std::equal(first.inputs.begin(), first.inputs.end(), second.inputs.begin(), second.inputs.end(),
                        [](const EffectInput& x, const EffectInput& y) {
                          return x.driver == y.driver && !x.driver.empty() && x.dynamics == y.dynamics;
                        });
    });
  });
}

}  // namespace

bool twoNamesOfOne(const EffectSearch& search, const Effect& a, const Effect& b) {
  return sameShape(search, a, b) && sameDrivers(a, b);
}

bool contains(const Effect& container, const std::string& simple) {
  return std::find(container.contains.begin(), container.contains.end(), simple) != container.contains.end();
}

std::vector<std::string> idsOf(const std::vector<ModelTerm>& terms) {
  std::vector<std::string> ids;
  for (const ModelTerm& term : terms) ids.push_back(term.effect->id);
  return ids;
}

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

JointFit refineDynamics(const EffectSearch& search, JointFit fit, std::size_t from,
                        const std::vector<NuisanceColumn>& base) {
  for (std::size_t t = from; t < fit.terms.size(); ++t) fit = search.refineDynamics(std::move(fit), t, base);
  return fit;
}

double smallestGain(const EffectSearch& search, const ResidualProblem& problem, const JointFit& fit,
                    const Eigen::VectorXd& further, bool onset, std::size_t without, const SearchLimits& limits) {
  Eigen::VectorXd explained = Eigen::VectorXd::Zero(problem.size());
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    if (t == without) continue;
    explained += (problem.projected(search.columns(fit.terms[t])) * fit.gains[t]).head(problem.size());
  }
  const Eigen::VectorXd own = problem.projected(further).col(0).head(problem.size());
  std::map<Component, double> seen;
  std::map<Component, double> power;
  for (Eigen::Index u = 0; u < problem.size(); ++u) {
    const Component c = problem.component[static_cast<std::size_t>(u)];
    seen[c] += own[u] * own[u];
    power[c] += explained[u] * explained[u];
  }
  const auto main =
      std::max_element(seen.begin(), seen.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  double all = 0.0;
  for (const auto& [component, each] : power) all += each;
  const double part_of_component = onset ? limits.smallest_with_onset : limits.smallest_in_component;
  return std::max(limits.smallest_part * all, part_of_component * power[main->first]);
}

int foreignDrivers(const ModelTerm& term) {
  std::set<std::string> used;
  for (const EffectInput& input : term.variant.inputs) used.insert(input.driver);
  int least = static_cast<int>(used.size());
  for (const EffectVariant& variant : term.effect->variants) {
    std::set<std::string> foreign = used;
    for (const EffectInput& input : variant.inputs) foreign.erase(input.driver);
    least = std::min(least, static_cast<int>(foreign.size()));
  }
  return least;
}

double priceOfNames(const JointFit& larger, const JointFit& smaller, const SearchLimits& limits) {
  const auto names = static_cast<double>(larger.terms.size()) - static_cast<double>(smaller.terms.size());
  double hypotheses = names;
  for (const ModelTerm& term : larger.terms) hypotheses += foreignDrivers(term);
  for (const ModelTerm& term : smaller.terms) hypotheses -= foreignDrivers(term);
  return std::max(8.0 * names, hypotheses * std::max(20.0, limits.start_margin * smaller.delta_chi2));
}

bool hasOnset(const ModelTerm& term) {
  const Dynamics dynamics = term.variant.inputs[0].dynamics;
  return dynamics == Dynamics::Step || dynamics == Dynamics::Pulse;
}

Component mainComponent(const ResidualProblem& problem, const Eigen::VectorXd& contribution) {
  std::map<Component, double> power;
  for (Eigen::Index u = 0; u < problem.size(); ++u) {
    const double z = contribution[u] / problem.sigma[u];
    power[problem.component[static_cast<std::size_t>(u)]] += z * z;
  }
  return std::max_element(power.begin(), power.end(), [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

int mostInOneComponent(const ResidualProblem& problem, const JointFit& fit) {
  std::map<Component, int> count;
  for (const Eigen::VectorXd& part : fit.contribution) ++count[mainComponent(problem, part)];
  int most = 0;
  for (const auto& [component, effects] : count) most = std::max(most, effects);
  return most;
}

std::vector<CandidateFit> ForwardSearch::candidatesFor(const JointFit& current, bool refined) {
  // Every path begins with the same sweep.
  const bool at_start = current.terms.size() == forced_count_;
  if (at_start && !first_.empty()) return first_;
  problem_->setNuisances(nuisancesOf(*search_, *base_, current, current.terms.size(), limits_->model_error));
  std::vector<std::string> without = idsOf(current.terms);
  without.insert(without.end(), options_->reject.begin(), options_->reject.end());
  std::vector<CandidateFit> candidates = search_->sweep(without, *job_);
  // A refinement of an accepted effect (or what it contains) is no name of its own, nor is its other name.
  std::erase_if(candidates, [&](const CandidateFit& c) {
    return std::any_of(current.terms.begin(), current.terms.end(), [&](const ModelTerm& term) {
      return twoNamesOfOne(*search_, *c.term.effect, *term.effect) ||
             (c.term.effect->refinement && contains(*c.term.effect, term.effect->id)) ||
             (refined && contains(*term.effect, c.term.effect->id));
    });
  });
  if (at_start) first_ = candidates;
  return candidates;
}

bool ForwardSearch::addBest(JointFit& current, bool refined, std::vector<DiscrepancyStep>& steps) {
  std::vector<CandidateFit> candidates = candidatesFor(current, refined);
  if (candidates.empty()) return false;
  double tried = 0.0;
  for (const CandidateFit& c : candidates) tried += c.tried;
  // Among those that are nearly as good as the best, the simplest.
  std::size_t chosen = 0;
  for (std::size_t c = 1; c < candidates.size(); ++c) {
    const double margin = std::max(12.0, limits_->container_margin * candidates[0].delta_chi2);
    if (candidates[c].score < candidates[0].score - margin) break;
    if (contains(*candidates[chosen].term.effect, candidates[c].term.effect->id)) chosen = c;
  }
  const CandidateFit& candidate = candidates[chosen];
  DiscrepancyStep step{candidate.term.effect->id, false, candidate.score, candidate.delta_chi2, ""};
  const auto refuse = [&](const char* reason) {
    step.reason = reason;
    steps.push_back(step);
    return false;
  };
  const auto onset_effects = static_cast<double>(
      std::count_if(candidates.begin(), candidates.end(), [](const CandidateFit& c) { return hasOnset(c.term); }));
  const auto significant = [&] {
    if (hasOnset(candidate.term)) {
      return candidate.score > 8.0 &&
             onsetPValue(*search_, *problem_, candidate) * onset_effects <= options_->false_alarm_rate;
    }
    const int k = candidate.parameter_count;
    const double delta = candidate.delta_chi2;
    return delta > k * search_->logN() + 8.0 &&
           chiSquaredTail(delta, std::max(1, k)) * tried < options_->false_alarm_rate;
  };
  if (!significant()) return refuse("no more than the largest of all effects tried gains by chance");
  const char* const too_small = "too small beside what the accepted effects may miss";
  if (!current.terms.empty() && candidate.delta_chi2 < limits_->smallest_part * current.delta_chi2) {
    return refuse(too_small);
  }
  problem_->setNuisances(*base_);
  std::vector<ModelTerm> terms = current.terms;
  terms.push_back(candidate.term);
  JointFit joint = search_->refine(terms, 2);
  if (!current.terms.empty() &&
      joint.delta_chi2 - current.delta_chi2 < smallestGain(*search_, *problem_, current, joint.contribution.back(),
                                                           hasOnset(candidate.term), current.terms.size(), *limits_)) {
    return refuse(too_small);
  }
  const auto cv = search_->crossValidate(current.terms, joint.terms, *base_);
  // What happens within one block (a warm-up at the start) cannot be learnt without it: then every fifth state decides.
  const auto scattered = search_->crossValidate(current.terms, joint.terms, *base_, true);
  if (!(cv.after_chi2 < cv.before_chi2) && !(scattered.after_chi2 + 8.0 < scattered.before_chi2)) {
    return refuse("does not predict blocks of states that were left out");
  }
  current = refined ? refineDynamics(*search_, joint, 0, *base_) : std::move(joint);
  step.accepted = true;
  step.reason = "gains more than chance and predicts the states that were left out";
  steps.push_back(step);
  return true;
}

JointFit ForwardSearch::extend(JointFit current, bool refined, std::vector<DiscrepancyStep>& steps) {
  while (static_cast<int>(current.terms.size()) < options_->max_effects) {
    job_->throwIfCancelled();
    job_->report(0.1 + 0.1 * static_cast<double>(current.terms.size()), "trying every effect");
    // With so many in one component nothing is named in the end, whatever else is added.
    const bool crowded =
        current.terms.size() > forced_count_ && mostInOneComponent(*problem_, current) > limits_->most_in_one_component;
    if (crowded || !addBest(current, refined, steps)) break;
  }
  return current;
}

bool ForwardSearch::worthOtherStarts(const JointFit& fit) const {
  if (fit.terms.empty()) return false;
  const bool wide = std::any_of(fit.terms.begin(), fit.terms.end(),
                                [](const ModelTerm& term) { return !term.effect->contains.empty(); });
  if (wide) return true;
  problem_->setNuisances(*base_);
  Eigen::VectorXd residual = problem_->projectedResidual();
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    residual -= problem_->projected(search_->columns(fit.terms[t])) * fit.gains[t];
  }
  return testStructure(*problem_, residual.head(problem_->size())).p_value < limits_->leftover_p;
}

bool ForwardSearch::better(const JointFit& challenger, const JointFit& champion) const {
  if (challenger.terms.size() == champion.terms.size()) return challenger.score > champion.score + 8.0;
  const bool more = challenger.terms.size() > champion.terms.size();
  const double price =
      more ? priceOfNames(challenger, champion, *limits_) : priceOfNames(champion, challenger, *limits_);
  return challenger.score > champion.score + (more ? price : -price);
}

namespace {

bool refinedBeyondCatalogue(const JointFit& fit) {
  return std::any_of(fit.terms.begin(), fit.terms.end(),
                     [](const ModelTerm& term) { return foreignDrivers(term) > 0; });
}

}  // namespace

JointFit ForwardSearch::run(JointFit forced, std::vector<DiscrepancyStep>& steps) {
  forced_count_ = forced.terms.size();
  first_.clear();
  const std::vector<DiscrepancyStep> before = steps;
  const std::size_t first = forced.terms.size();
  JointFit best = extend(forced, true, steps);
  if (best.terms.size() == first) return best;
  const auto consider = [&](JointFit fit, std::vector<DiscrepancyStep> path) {
    if (!better(fit, best)) return;
    best = std::move(fit);
    steps = std::move(path);
  };
  if (refinedBeyondCatalogue(best)) {
    // Another driver or lag of the first effect may be another effect: all that enter, and only then their dynamics.
    std::vector<DiscrepancyStep> path = before;
    JointFit fit = extend(forced, false, path);
    if (fit.terms.size() > best.terms.size()) {
      problem_->setNuisances(*base_);
      fit = refineDynamics(*search_, std::move(fit), first, *base_);
      fit = extend(std::move(fit), true, path);
      consider(std::move(fit), std::move(path));
    }
  }
  if (!worthOtherStarts(best)) return best;
  std::vector<CandidateFit> starts = candidatesFor(forced, true);
  const double enough = limits_->start_part * (starts.empty() ? 0.0 : starts.front().delta_chi2);
  const std::string taken = best.terms[first].effect->id;
  std::erase_if(starts, [&](const CandidateFit& c) {
    return c.delta_chi2 < enough || c.term.effect->id == taken || c.score < 8.0;
  });
  if (starts.size() > limits_->most_starts) starts.resize(limits_->most_starts);
  for (const CandidateFit& start : starts) {
    job_->throwIfCancelled();
    problem_->setNuisances(*base_);
    std::vector<ModelTerm> terms = forced.terms;
    terms.push_back(start.term);
    std::vector<DiscrepancyStep> path = before;
    JointFit fit = search_->refine(terms, 1);
    fit = refineDynamics(*search_, std::move(fit), first, *base_);
    path.push_back({start.term.effect->id, true, start.score, start.delta_chi2,
                    "taken as a start in place of " + taken + ", which explains less in the end"});
    fit = extend(std::move(fit), true, path);
    consider(std::move(fit), std::move(path));
  }
  return best;
}

}  // namespace spindrift
