// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/judgement.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// A rival is listed when its probability is at least this part of that of the effect named.
constexpr double least_rival = 0.05;
/// An effect is named when it is more probable than not that something like it is there.
constexpr double least_confidence = 0.5;
/// 2 ln of the odds beyond which a remainder is told: "very strong" (Kass and Raftery 1995).
constexpr double remainder_evidence = 10.0;
/// Rivals beside the effect; more is no answer.
constexpr std::size_t most_rivals = 2;

/// rms of the remainder over that of an effect, in the components in which the effect acts, both whitened.
double imitationRatio(const ResidualProblem& problem, const JointFit& fit, std::size_t t, const Remainder& remainder) {
  const Eigen::VectorXd white = problem.projected(fit.contribution[t]).col(0).head(problem.size());
  std::map<Component, double> power;
  double total = 0.0;
  for (Index u = 0; u < white.size(); ++u) {
    power[problem.component[static_cast<std::size_t>(u)]] += white[u] * white[u];
    total += white[u] * white[u];
  }
  double left = 0.0;
  for (const Remainder::OfComponent& r : remainder.components) {
    if (r.evidence < remainder_evidence) continue;
    if (power[r.component] > 0.1 * total) left += r.power;
  }
  return total > 0.0 ? std::sqrt(left / total) : 1e9;
}

/// True if an effect that cannot be fitted (nothing in the log drives it) has the pattern of this one.
bool hasPatternOf(const ResidualProblem& problem, const EffectSearch& search, const Effect& other, const JointFit& fit,
                  std::size_t t) {
  const ModelTerm& term = fit.terms[t];
  const Eigen::MatrixXd& s = search.shape(other);
  const Eigen::MatrixXd& own = search.shape(*term.effect);
  if (s.isZero(0.0)) return false;
  // The course in time of the named effect, with its own pattern taken out where it has one.
  const Eigen::MatrixXd x = search.columns(term);
  const Index k = own.cols();
  Eigen::VectorXd course = Eigen::VectorXd::Zero(problem.size());
  for (Index i = 0; i < x.cols() / k; ++i) {
    const double weight = fit.gains[t].segment(i * k, k).norm();
    course += weight * problem.toUnits(inputResponses(search.drivers(), {{term.variant.inputs[static_cast<std::size_t>(i)]}, false},
                                                      std::vector<double>(static_cast<std::size_t>(parameterCount({{term.variant.inputs[static_cast<std::size_t>(i)]}, false})),
                                                                          term.parameters.empty() ? 0.0 : term.parameters[0]),
                                                      problem.node_time_s).col(0));
  }
  const Eigen::MatrixXd columns = problem.projected(course.asDiagonal() * s);
  const Eigen::VectorXd target = problem.projected(fit.contribution[t]);
  const Eigen::VectorXd left = target - columns * columns.colPivHouseholderQr().solve(target);
  return left.squaredNorm() < 0.03 * target.squaredNorm();
}

std::string describedRemainder(const Remainder& remainder) {
  std::vector<std::string> parts;
  for (const Remainder::OfComponent& r : remainder.components) {
    if (r.evidence >= remainder_evidence) {
      parts.push_back(fmt::format("{:.2f} {} rms in {}", r.rms_um, unitOf(r.component), toString(r.component)));
    }
  }
  return joinedList(parts);
}

}  // namespace

Judgement judge(const ResidualProblem& problem, const EffectSearch& search, const EffectPosterior& posterior,
                const Remainder& remainder, const DiscrepancyPriors& priors, const DiscrepancyOptions& options) {
  Judgement out;
  const JointFit& fit = posterior.fit;
  std::vector<ModelTerm> terms;
  bool ambiguous = false;
  std::vector<std::string> unnamed;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    const SlotEvidence& slot = posterior.slots[t];
    const Effect& effect = *fit.terms[t].effect;
    NamedEffect name;
    name.id = effect.id;
    name.delta_chi2 = slot.delta_chi2;
    name.delta_evidence = slot.delta_evidence;
    name.forced = posterior.forced[t];
    double rejected = 0.0;
    for (const Alternative& a : slot.others) {
      name.margin = std::min(name.margin, posterior.evidence - a.evidence);
      if (a.probability < least_rival * slot.probability) continue;
      if (a.rejected) {
        rejected += a.probability;
        out.warnings.push_back(fmt::format("{}, which was rejected, explains the same {}.", a.id,
                                           a.probability > slot.probability ? "better" : "about as well"));
        continue;
      }
      if (a.container) {
        name.containers.push_back(a.id);
        continue;
      }
      if (!name.closest) name.closest = a.joint;
      name.rivals.push_back(a.id);
    }
    for (const Effect& other : search.catalogue()) {
      if (!other.variants.empty() || other.id == effect.id) continue;
      // One that holds a simpler effect is seen through that one.
      const bool seen = std::any_of(other.contains.begin(), other.contains.end(), [&](const std::string& id) {
        const Effect* simple = search.find(id);
        return simple != nullptr && !simple->variants.empty();
      });
      if (seen) continue;
      if (!hasPatternOf(problem, search, other, fit, t)) continue;
      name.rivals.push_back(other.id);
      out.warnings.push_back(fmt::format("{} cannot be told from {}, because the log lacks what drives the latter: log it next time.",
                                         effect.id, other.id));
    }
    const double ratio = imitationRatio(problem, fit, t, remainder);
    const double known = 1.0 / (1.0 + std::pow(ratio / priors.imitation, 4));
    const double there = 1.0 / (1.0 + std::exp(-0.5 * std::min(slot.delta_evidence, slot.over_unknown)));
    const double undriven = 1.0 / (1.0 + static_cast<double>(std::count_if(
        search.catalogue().begin(), search.catalogue().end(), [&](const Effect& e) {
          return e.variants.empty() && std::find(name.rivals.begin(), name.rivals.end(), e.id) != name.rivals.end();
        })));
    (void)rejected;
    name.confidence = std::clamp(slot.probability * known * there * undriven, 0.01, 0.995);
    DiscrepancyStep step{effect.id, true, slot.delta_evidence, slot.delta_chi2, ""};
    if (name.forced) {
      step.reason = slot.delta_evidence > 0.0 ? "put in by you" : "put in by you; the data do not support it";
      if (!(slot.delta_evidence > 0.0)) {
        out.warnings.push_back(fmt::format("{} was accepted by hand; the data do not support it.", effect.id));
      }
    } else if (known * there < least_confidence) {
      step.accepted = false;
      step.reason = fmt::format("what it leaves is too large beside it ({:.2f}), or noise would do ({:.0f}): it may imitate a cause outside the catalogue",
                                ratio, slot.over_unknown);
      unnamed.push_back(effect.id);
    } else if (name.rivals.size() > most_rivals) {
      step.accepted = false;
      step.reason = fmt::format("{} others explain the same as well", name.rivals.size());
      unnamed.push_back(effect.id);
    } else {
      step.reason = "more probable than all sets without it";
    }
    out.steps.push_back(step);
    if (!step.accepted) continue;
    ambiguous = ambiguous || !name.rivals.empty();
    terms.push_back(fit.terms[t]);
    out.names.push_back(std::move(name));
  }
  out.named = terms.size() == fit.terms.size() ? fit : search.solve(terms);
  const std::string left = describedRemainder(remainder);
  if (!unnamed.empty()) {
    out.leftover = fmt::format("what {} would explain, but cannot be named{}", joinedList(unnamed),
                               left.empty() ? "" : ", and " + left);
  } else if (!left.empty()) {
    out.leftover = left + " that no effect of the catalogue explains";
  }
  // What is explained of all that is structured: chi-squared beyond that of noise.
  const double before = problem.projectedResidual().squaredNorm();
  double remaining = 0.0;
  for (const Remainder::OfComponent& r : remainder.components) remaining += r.evidence >= remainder_evidence ? r.power : 0.0;
  const double structured = std::max(1e-9, before - fit.chi2 + remaining);
  out.explained_fraction = std::clamp((before - out.named.chi2) / structured, 0.0, 1.0);
  if (fit.terms.empty()) out.explained_fraction = 0.0;
  const bool by_hand = std::all_of(out.names.begin(), out.names.end(), [](const NamedEffect& n) { return n.forced; });
  if (out.names.empty() || (by_hand && !out.leftover.empty() && options.max_effects > 0)) {
    out.verdict = out.leftover.empty() && out.names.empty() ? DiscrepancyVerdict::None : DiscrepancyVerdict::Unknown;
    if (!out.names.empty() && by_hand) out.verdict = ambiguous ? DiscrepancyVerdict::Ambiguous : DiscrepancyVerdict::Named;
  } else {
    out.verdict = ambiguous ? DiscrepancyVerdict::Ambiguous : DiscrepancyVerdict::Named;
  }
  return out;
}

}  // namespace spindrift
