// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/judgement.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/math/singular_values.h"
#include "core/math/statistics.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// A rival is listed when its probability is at least this part of that of the effect named.
constexpr double least_rival = 0.1;
/// An effect is named when it is clearly more probable than not that something like it is there.
constexpr double least_confidence = 0.7;
/// 2 ln of the odds beyond which a remainder is told: "very strong" (Kass and Raftery 1995).
constexpr double remainder_evidence = 10.0;
/// An effect of the catalogue is more probable, before any data, than a cause that nobody thought of: odds 10 to 1.
constexpr double unknown_price = 4.6;
/// In 2 ln: every further effect in one component is so much less probable than one cause that nobody thought of.
constexpr double further_price = 20.0;
/// rms of what is held out with an effect over that without it, from which on it is taken back.
constexpr double worse_held_out = 1.04;
/// And how sure that has to be, over the held-out states.
constexpr double surely_worse = 0.95;
/// In evidence: what is there without doubt is told, even where its course cannot be foretold; but not where all names
/// together make the gap on what is held out larger.
constexpr double beyond_held_out = 200.0;
/// Bodies make the pattern of an effect uneven by a part of its amplitude that nobody would take for another cause.
constexpr double uneven_bodies = 0.75;
/// In evidence: a part of the simulation that is off explains what an effect explains, all but this.
constexpr double instead_as_well = 6.0;
/// Of a course or a pattern another may leave this part of its power and is still the same to the eye of the data.
constexpr double alike = 0.03;
/// In evidence: an effect whose driver is in the log, and that is so much more probable than an unknown cause in its
/// place, may leave as much as any may; with twice that evidence twice as much: what else is there has its own time
/// history.
constexpr double told_from_the_rest = 20.0;
/// Rivals beside the effect; more is no answer.
constexpr std::size_t most_rivals = 2;

/// Of `values` what has the pattern of an effect, with any smooth course in time: what the same cause would leave if it
/// acted otherwise. A common drift of all points is none of a play that changes its sign from reading to reading.
Eigen::VectorXd inPatternOf(const ResidualProblem& problem, const Eigen::MatrixXd& shape,
                            const Eigen::VectorXd& values) {
  const int hats = std::clamp(problem.epoch_count / 3, 2, 8);
  const double start = problem.node_time_s.front();
  const double span = std::max(1.0, problem.node_time_s.back() - start);
  Eigen::MatrixXd columns(problem.size(), shape.cols() * hats);
  Eigen::VectorXd sigma(problem.size());
  for (Index u = 0; u < problem.size(); ++u) {
    sigma[u] = problem.ownSigma(u);
    const double position = (problem.time_s[static_cast<std::size_t>(u)] - start) / span * (hats - 1);
    for (int h = 0; h < hats; ++h) {
      const double hat = std::max(0.0, 1.0 - std::abs(position - h));
      for (Index k = 0; k < shape.cols(); ++k) columns(u, h * shape.cols() + k) = hat * shape(u, k) / sigma[u];
    }
  }
  const Eigen::VectorXd white = values.cwiseQuotient(sigma);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  return (columns * qr.solve(white)).cwiseProduct(sigma);
}

/// The terms that are one load seen in several patterns, this one included: each has found its begin and its end for
/// itself, and they agree within the time between two states. A sun bends a column and lifts its head.
std::vector<std::size_t> sameLoad(const ResidualProblem& problem, const JointFit& fit, std::size_t t) {
  const auto free_window = [&](std::size_t k) {
    const EffectInput& first = fit.terms[k].variant.inputs[0];
    return first.driver.empty() && first.dynamics == Dynamics::Pulse && fit.terms[k].parameters.size() > 1;
  };
  std::vector<std::size_t> out{t};
  if (!free_window(t) || problem.epoch_time_s.size() < 2) return out;
  const double interval_s = (problem.epoch_time_s.back() - problem.epoch_time_s.front()) /
                            static_cast<double>(problem.epoch_time_s.size() - 1);
  const double begin_s = fit.terms[t].parameters[0];
  const double end_s = begin_s + fit.terms[t].parameters[1];
  for (std::size_t k = 0; k < fit.terms.size(); ++k) {
    if (k == t || !free_window(k)) continue;
    const double other_s = fit.terms[k].parameters[0];
    if (std::abs(other_s - begin_s) < interval_s && std::abs(other_s + fit.terms[k].parameters[1] - end_s) < interval_s)
      out.push_back(k);
  }
  return out;
}

/// rms of what is left over that of an effect, over the readings that the effect moves, in standard deviations of the
/// noise. Left is the remainder, what other effects explain that are not named, and of the shifts of states what is
/// larger than shifts are. Effects that cancel each other count as what they are together, and those that are one load
/// as one effect.
double imitationRatio(const ResidualProblem& problem, const EffectSearch& search, const JointFit& fit, std::size_t t,
                      const Remainder& remainder, const std::vector<bool>& unnamed) {
  const std::vector<std::size_t> load = sameLoad(problem, fit, t);
  const auto ofLoad = [&](std::size_t k) { return std::find(load.begin(), load.end(), k) != load.end(); };
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(problem.size());
  for (const std::size_t k : load) moved += fit.contribution[k];
  const Eigen::VectorXd own = problem.centred(moved);
  Eigen::VectorXd together = Eigen::VectorXd::Zero(problem.size());
  Eigen::VectorXd rest = Eigen::VectorXd::Zero(problem.size());
  for (std::size_t k = 0; k < fit.terms.size(); ++k)
    (unnamed[k] && !ofLoad(k) ? rest : together) += fit.contribution[k];
  const Eigen::VectorXd all = together;
  together = problem.centred(together);
  rest = problem.centred(rest);
  std::array<bool, 6> told{};
  for (const Remainder::OfComponent& r : remainder.components) {
    told[static_cast<std::size_t>(r.component)] = r.evidence >= remainder_evidence;
  }
  // Patterns of the user's effects may be any: what remains in others is none of theirs.
  const Effect& effect = *fit.terms[t].effect;
  const Eigen::VectorXd remaining =
      effect.own ? inPatternOf(problem, search.shape(effect), remainder.values) : remainder.values;
  double left = 0.0;
  double own_power = 0.0;
  double together_power = 0.0;
  double own_since = 0.0;
  double together_since = 0.0;
  const double largest = own.cwiseAbs().maxCoeff();
  for (Index u = 0; u < problem.size(); ++u) {
    const Component c = problem.component[static_cast<std::size_t>(u)];
    if (std::abs(moved[u]) < 1e-6 * largest) continue;
    const double sigma = problem.ownSigma(u);
    own_since += std::pow(moved[u] / sigma, 2);
    together_since += std::pow(all[u] / sigma, 2);
    own_power += std::pow(own[u] / sigma, 2);
    together_power += std::pow(together[u] / sigma, 2);
    left += std::pow(rest[u] / sigma, 2);
    if (told[static_cast<std::size_t>(c)]) left += std::pow(remaining[u] / sigma, 2);
    const ComponentNoise& n = problem.noise.of(c);
    const double reading = problem.reading_sigma[u] * n.scale;
    left += n.shiftsBeyond(std::sqrt(n.varianceOfTails()) * reading) / (sigma * sigma);
  }
  const double power = std::min(own_power, together_power);
  // A step is a step: it has no dynamics that could be a little different.
  const Dynamics dynamics = fit.terms[t].variant.inputs[0].dynamics;
  // One that chooses its own onset and length follows half of anything; two that choose the same do not.
  double strict = 1.0;
  if (dynamics == Dynamics::Step) strict = 3.0;
  if (dynamics == Dynamics::Pulse && load.size() == 1) strict = 1.5;
  if (effect.own) strict = 1.0;
  if (!(power > 0.0) || !(together_power > 0.0) || !(together_since > 0.0)) return 1e9;
  // Effects that cancel each other follow much that they do not cause: about their means, or since the log began.
  const double cancelling = 0.1 * std::sqrt(std::max(own_power / together_power, own_since / together_since));
  return std::hypot(strict * std::sqrt(left / power), cancelling > 0.2 ? cancelling : 0.0);
}

/// A part of the simulation in place of an effect.
struct PartInstead {
  std::string id;
  double missing = 0.0;  ///< of the part, as a part of it
  double uncertainty = 0.0;
  double evidence = 0.0;  ///< gain in 2 ln of the evidence
  bool possible = false;  ///< no more than a rough simulation may be off by
};

PartInstead partInstead(const ResidualProblem& problem, const SimulationPart& part, const Eigen::VectorXd& left,
                        const DiscrepancyPriors& priors) {
  const Eigen::VectorXd x = problem.projected(part.values).col(0);
  const double square = x.squaredNorm();
  const double s = priors.rough_simulation_error;
  PartInstead out;
  out.id = part.id;
  out.missing = x.dot(left) / (square + 1.0 / (s * s));
  out.evidence = out.missing * x.dot(left) - std::log1p(s * s * square);
  // As the data say without the prior, of what there should be.
  const double whole = square > 0.0 ? x.dot(left) / square : 0.0;
  out.possible = whole > -1.0 && std::abs(whole / (1.0 + whole)) <= priors.rough_simulation_limit * s;
  const double needed = std::max(0.1, 1.0 + out.missing);
  out.uncertainty = 1.0 / std::sqrt(square + 1.0 / (s * s)) / (needed * needed);
  out.missing /= needed;
  return out;
}

/// How much of an effect that the log drives another pattern over the points needs that has the same course in time, as
/// a part of its own amplitude: a gain of its own for every series beside the effect, less what as many free gains
/// take of noise. 0 where that is no more than chance. Bodies are a little uneven; a cause outside the catalogue has
/// a pattern of its own.
double otherPattern(const ResidualProblem& problem, const JointFit& fit, std::size_t t) {
  constexpr int most_series = 90;
  constexpr double beyond_chance = 4.0;  // standard deviations of chi-squared
  const Effect& effect = *fit.terms[t].effect;
  if (effect.own || !drivenByLog(fit.terms[t]) || problem.seriesCount() > most_series) return 0.0;
  const Eigen::VectorXd& moved = fit.contribution[t];
  const double largest = moved.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) return 0.0;
  // The course in each component that the effect moves: a mean over the series, each as far as it follows the largest.
  std::vector<Eigen::VectorXd> columns;
  for (const Component c : all_components) {
    std::vector<int> members;
    int main = -1;
    double main_size = 0.0;
    const auto ofSeries = [&](int s) {
      const Index from = problem.series_begin[static_cast<std::size_t>(s)];
      return moved.segment(from, problem.series_begin[static_cast<std::size_t>(s) + 1] - from);
    };
    for (int s = 0; s < problem.seriesCount(); ++s) {
      const Index from = problem.series_begin[static_cast<std::size_t>(s)];
      if (ofSeries(s).size() == 0 || problem.component[static_cast<std::size_t>(from)] != c) continue;
      members.push_back(s);
      if (const double size = ofSeries(s).cwiseAbs().maxCoeff(); size > main_size) {
        main_size = size;
        main = s;
      }
    }
    if (members.size() < 4 || main < 0 || main_size < 0.1 * largest) continue;
    std::vector<double> at_main(static_cast<std::size_t>(problem.epoch_count), 0.0);
    const Index main_from = problem.series_begin[static_cast<std::size_t>(main)];
    for (Index i = 0; i < ofSeries(main).size(); ++i)
      at_main[static_cast<std::size_t>(problem.epoch[static_cast<std::size_t>(main_from + i)])] = ofSeries(main)[i];
    std::vector<double> sum(at_main.size(), 0.0);
    std::vector<double> weight(at_main.size(), 0.0);
    for (const int s : members) {
      const Index from = problem.series_begin[static_cast<std::size_t>(s)];
      double both = 0.0;
      double square = 0.0;
      for (Index i = 0; i < ofSeries(s).size(); ++i) {
        const double m = at_main[static_cast<std::size_t>(problem.epoch[static_cast<std::size_t>(from + i)])];
        both += m * ofSeries(s)[i];
        square += m * m;
      }
      const double share = square > 0.0 ? both / square : 0.0;
      for (Index i = 0; i < ofSeries(s).size(); ++i) {
        const auto e = static_cast<std::size_t>(problem.epoch[static_cast<std::size_t>(from + i)]);
        sum[e] += share * ofSeries(s)[i];
        weight[e] += share * share;
      }
    }
    for (const int s : members) {
      Eigen::VectorXd column = Eigen::VectorXd::Zero(problem.size());
      const Index from = problem.series_begin[static_cast<std::size_t>(s)];
      for (Index i = 0; i < ofSeries(s).size(); ++i) {
        const auto e = static_cast<std::size_t>(problem.epoch[static_cast<std::size_t>(from + i)]);
        column[from + i] = weight[e] > 0.0 ? sum[e] / weight[e] : 0.0;
      }
      columns.push_back(std::move(column));
    }
  }
  if (columns.empty()) return 0.0;
  Eigen::MatrixXd x(problem.size(), static_cast<Index>(columns.size()));
  for (Index k = 0; k < x.cols(); ++k) x.col(k) = columns[static_cast<std::size_t>(k)];
  const Eigen::MatrixXd white = problem.projected(x);
  const Eigen::VectorXd left = problem.projected(problem.without(fit.contribution)).col(0);
  const Eigen::VectorXd own = problem.projected(moved).col(0);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(white);
  const double taken = (white * qr.solve(left)).squaredNorm();
  const auto freedom = static_cast<double>(std::max<Index>(1, qr.rank() - 1));
  const double excess = taken - freedom;
  if (excess < beyond_chance * std::sqrt(2.0 * freedom)) return 0.0;
  return std::sqrt(excess / std::max(1e-9, own.squaredNorm()));
}

/// True if the log lacks what drives an effect at all times and has only temperatures of other places in its stead:
/// they follow another course.
bool seenElsewhere(const Effect& effect) {
  return effect.driver_missing && effect.always_driven &&
         std::all_of(effect.variants.begin(), effect.variants.end(), [](const EffectVariant& variant) {
           return std::all_of(variant.inputs.begin(), variant.inputs.end(),
                              [](const EffectInput& input) { return input.driver.starts_with("T_"); });
         });
}

/// True if what a term moves changes over time no faster than a room does: in the series that it moves most, a
/// polynomial of a few terms follows it.
bool couldBeAnySlowCourse(const ResidualProblem& problem, const JointFit& fit, std::size_t t) {
  constexpr int terms = 5;
  const Eigen::VectorXd& moved = fit.contribution[t];
  double most = 0.0;
  double left = 0.0;
  for (int s = 0; s < problem.seriesCount(); ++s) {
    const Index from = problem.series_begin[static_cast<std::size_t>(s)];
    const Index count = problem.series_begin[static_cast<std::size_t>(s) + 1] - from;
    if (count <= terms) continue;
    const Eigen::VectorXd course = moved.segment(from, count).array() - moved.segment(from, count).mean();
    if (course.squaredNorm() <= most) continue;
    most = course.squaredNorm();
    const double begin_s = problem.time_s[static_cast<std::size_t>(from)];
    const double span_s = std::max(1.0, problem.time_s[static_cast<std::size_t>(from + count - 1)] - begin_s);
    Eigen::MatrixXd powers(count, terms);
    for (Index i = 0; i < count; ++i) {
      const double x = 2.0 * (problem.time_s[static_cast<std::size_t>(from + i)] - begin_s) / span_s - 1.0;
      for (int k = 0; k < terms; ++k) powers(i, k) = std::pow(x, k);
    }
    left = (course - powers * powers.colPivHouseholderQr().solve(course)).squaredNorm();
  }
  return left < alike * most;
}

/// True if an effect that cannot be fitted (nothing in the log drives it) has the pattern of this one: with any course
/// in time it would have moved the same readings as this one does.
bool hasPatternOf(const ResidualProblem& problem, const EffectSearch& search, const Effect& other, const JointFit& fit,
                  std::size_t t) {
  const Eigen::MatrixXd& s = search.shape(other);
  if (s.isZero(0.0)) return false;
  const Eigen::VectorXd& target = fit.contribution[t];
  std::vector<std::vector<Index>> by_epoch(static_cast<std::size_t>(problem.epoch_count));
  for (Index u = 0; u < problem.size(); ++u)
    by_epoch[static_cast<std::size_t>(problem.epoch[static_cast<std::size_t>(u)])].push_back(u);
  double left = 0.0;
  double whole = 0.0;
  for (const std::vector<Index>& units : by_epoch) {
    Eigen::MatrixXd x(static_cast<Index>(units.size()), s.cols());
    Eigen::VectorXd f(x.rows());
    for (Index i = 0; i < x.rows(); ++i) {
      const Index u = units[static_cast<std::size_t>(i)];
      const double weight = 1.0 / problem.ownSigma(u);
      x.row(i) = weight * s.row(u);
      f[i] = weight * target[u];
    }
    if (x.rows() == 0) continue;
    left += (f - x * x.completeOrthogonalDecomposition().solve(f)).squaredNorm();
    whole += f.squaredNorm();
  }
  return left < alike * whole;
}

/// Noise that alone explains what the named effects leave: nothing smooth, and no larger shifts than there are.
std::optional<NoiseModel> explainingNoise(const ResidualProblem& problem, const JointFit& fit, const JointFit& named) {
  Eigen::VectorXd left = problem.without(named.contribution);
  left -= problem.nuisancePart(left).values;
  NoiseModel noise = estimateNoise(problem, left, true);
  if (!movedTogether(problem, noise).empty()) return std::nullopt;
  double smooth = 0.0;
  if (driftsOfAll(noise) == driftsOfAll(problem.noise)) {
    smooth = smoothBesideNoise(problem, fit, named);
  } else {
    // Beside the effect not all axes drifted.
    ResidualProblem without = problem;
    without.setNoise(noise);
    smooth = smoothBesideNoise(without, fit, named);
  }
  if (smooth >= remainder_evidence) return std::nullopt;
  return noise;
}

/// Mean of what is left over the points of each state in one component; and the period of the sine that explains most
/// of it, if it explains more than half.
std::optional<double> commonPeriod(const ResidualProblem& problem, const JointFit& fit, Component c) {
  Eigen::VectorXd left = problem.y;
  for (const Eigen::VectorXd& part : fit.contribution) left -= part;
  left = problem.centred(left);
  std::vector<double> sum(static_cast<std::size_t>(problem.epoch_count), 0.0);
  std::vector<double> count(sum.size(), 0.0);
  for (Index u = 0; u < problem.size(); ++u) {
    if (problem.component[static_cast<std::size_t>(u)] != c) continue;
    sum[static_cast<std::size_t>(problem.epoch[static_cast<std::size_t>(u)])] += left[u];
    count[static_cast<std::size_t>(problem.epoch[static_cast<std::size_t>(u)])] += 1.0;
  }
  std::vector<double> t;
  std::vector<double> v;
  for (std::size_t e = 0; e < sum.size(); ++e) {
    if (!(count[e] > 0.0)) continue;
    t.push_back(problem.epoch_time_s[e]);
    v.push_back(sum[e] / count[e]);
  }
  if (t.size() < 10) return std::nullopt;
  const auto n = static_cast<Index>(t.size());
  const Eigen::Map<const Eigen::VectorXd> values(v.data(), n);
  const double span = t.back() - t.front();
  double best = 0.0;
  double period = 0.0;
  for (int k = 4; k <= static_cast<int>(t.size()) * 2; ++k) {
    const double trial = 2.0 * span / k;
    Eigen::MatrixXd x(n, 3);
    for (Index i = 0; i < n; ++i) {
      const double phase = 2.0 * std::numbers::pi * t[static_cast<std::size_t>(i)] / trial;
      x.row(i) << 1.0, std::sin(phase), std::cos(phase);
    }
    const Eigen::VectorXd fitted = x * x.colPivHouseholderQr().solve(values);
    const double whole = (values.array() - values.mean()).matrix().squaredNorm();
    const double explained = whole > 0.0 ? 1.0 - (values - fitted).squaredNorm() / whole : 0.0;
    if (explained > best) {
      best = explained;
      period = trial;
    }
  }
  if (best > 0.6) return period;
  return std::nullopt;
}

/// `id` is the cause of `effect` in other words.
bool sameCause(const Effect& effect, const std::string& id) {
  return std::find(effect.same_cause.begin(), effect.same_cause.end(), id) != effect.same_cause.end();
}

std::string describedRemainder(const ResidualProblem& problem, const NoiseModel& noise, const JointFit& fit,
                               const Remainder& remainder) {
  std::vector<std::string> parts;
  const std::vector<Component> together = movedTogether(problem, noise);
  for (const Component c : together) {
    const auto period = commonPeriod(problem, fit, c);
    parts.push_back(fmt::format("{} of all points has a common time history{}, {:.2f} {} rms", toString(c),
                                period ? fmt::format(" with a period of about {:.0f} s", *period) : "",
                                noise.of(c).common, printedUnit(unitOf(c))));
  }
  for (const Remainder::OfComponent& r : remainder.components) {
    if (r.evidence < remainder_evidence || std::find(together.begin(), together.end(), r.component) != together.end())
      continue;
    std::vector<std::string> points;
    for (std::size_t s = 0; s < remainder.series_evidence.size(); ++s) {
      const auto from = static_cast<std::size_t>(problem.series_begin[s]);
      if (problem.component[from] == r.component && remainder.series_evidence[s] >= remainder_evidence)
        points.push_back(problem.series_point[s]);
    }
    const bool some = !points.empty() && points.size() <= 3;
    const auto period = some ? std::nullopt : commonPeriod(problem, fit, r.component);
    parts.push_back(fmt::format("{} of {} has {}{}, {:.2f} {} rms", toString(r.component),
                                some ? joinedList(points) : "all points",
                                some ? "a time history of its own" : "a common time history",
                                period ? fmt::format(" with a period of about {:.0f} s", *period) : "", r.rms_um,
                                printedUnit(unitOf(r.component))));
  }
  return joinedList(parts);
}

/// Takes the shift of every state off `left`, its median over the points, in components whose shifts are noise.
void takeShifts(const ResidualProblem& problem, Eigen::VectorXd& left) {
  const std::vector<Component> more = movedTogether(problem, problem.noise);
  std::map<std::pair<Component, int>, std::vector<double>> values;
  for (std::size_t u = 0; u < problem.component.size(); ++u) {
    const Component c = problem.component[u];
    if (problem.noise.of(c).common > 0.0 && std::find(more.begin(), more.end(), c) == more.end())
      values[{c, problem.epoch[u]}].push_back(left[static_cast<Index>(u)]);
  }
  std::map<std::pair<Component, int>, double> shifts;
  for (const auto& [key, of_state] : values) shifts[key] = median(of_state);
  for (std::size_t u = 0; u < problem.component.size(); ++u) {
    const auto shift = shifts.find({problem.component[u], problem.epoch[u]});
    if (shift != shifts.end()) left[static_cast<Index>(u)] -= shift->second;
  }
}

/// Scatter that is far from what is stated because most of it is one pattern over the points that comes and goes from
/// state to state, too fast to be smooth: one time history times one pattern against noise that is as large, by BIC.
std::string patternInScatter(const ResidualProblem& problem, const JointFit& fit) {
  constexpr double implausible_scale = 2.0;  // rms of the readings over their stated sigma
  constexpr Index least = 4;                 // points, and states
  constexpr double far_out = 5.0;            // robust standard deviations: one reading far out is no pattern
  Eigen::VectorXd left = problem.without(fit.contribution);
  left -= problem.nuisancePart(left).values;
  // The constant of every series: its median, which one reading far out does not move.
  for (int s = 0; s < problem.seriesCount(); ++s) {
    const Index from = problem.series_begin[static_cast<std::size_t>(s)];
    auto series = left.segment(from, problem.series_begin[static_cast<std::size_t>(s) + 1] - from);
    series.array() -= median(std::vector<double>(series.begin(), series.end()));
  }
  takeShifts(problem, left);
  std::vector<std::string> parts;
  for (const Component c : all_components) {
    std::map<int, Index> row;
    std::map<int, Index> column;
    std::vector<double> sizes;
    double power = 0.0;
    for (std::size_t u = 0; u < problem.component.size(); ++u) {
      if (problem.component[u] != c) continue;
      const auto unit = static_cast<Index>(u);
      power += std::pow(left[unit] / problem.sigma[unit], 2);
      row.try_emplace(problem.series[u], static_cast<Index>(row.size()));
      column.try_emplace(problem.epoch[u], static_cast<Index>(column.size()));
      sizes.push_back(std::abs(left[unit]));
    }
    const auto points = static_cast<Index>(row.size());
    const auto states = static_cast<Index>(column.size());
    if (points < least || states < least) continue;
    if (power < implausible_scale * implausible_scale * static_cast<double>(sizes.size())) continue;
    std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2), sizes.end());
    const double most = far_out * 1.4826 * sizes[sizes.size() / 2];
    Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(points, states);
    for (std::size_t u = 0; u < problem.component.size(); ++u) {
      if (problem.component[u] != c) continue;
      moved(row[problem.series[u]], column[problem.epoch[u]]) = std::clamp(left[static_cast<Index>(u)], -most, most);
    }
    moved.colwise() -= moved.rowwise().mean().eval();
    const Eigen::VectorXd singular = singularValues(moved).values;
    const auto readings = static_cast<double>(sizes.size());
    const double all = singular.squaredNorm();
    const double beside = all - singular[0] * singular[0];
    const double evidence = readings * std::log(all / std::max(1e-12 * all, beside)) -
                            static_cast<double>(points + states) * std::log(readings);
    if (!(all > 0.0) || evidence < remainder_evidence) continue;
    parts.push_back(fmt::format("{} of all points moves in one pattern from state to state, {:.2f} {} rms", toString(c),
                                singular[0] / std::sqrt(readings), printedUnit(unitOf(c))));
  }
  return joinedList(parts);
}

double probabilityAt(double evidence) {
  return 1.0 / (1.0 + std::exp(-0.5 * evidence));
}

/// 2 ln of the odds of effects that share a component, and not an unknown cause in their place; of what is not named
/// there the unknown cause has taken the place already.
double overUnknown(const EffectPosterior& posterior, std::vector<std::size_t> slots, const std::vector<bool>& unnamed) {
  const Component main = posterior.slots[slots.front()].main;
  std::vector<std::size_t> given_up;
  for (std::size_t t = 0; t < unnamed.size(); ++t)
    if (unnamed[t] && posterior.slots[t].main == main) given_up.push_back(t);
  slots.insert(slots.end(), given_up.begin(), given_up.end());
  std::sort(slots.begin(), slots.end());
  return posterior.choice_over_unknown.at(slots) -
         (given_up.empty() ? 0.0 : posterior.choice_over_unknown.at(given_up));
}

}  // namespace

Judgement judge(const ResidualProblem& problem, const EffectSearch& search, const EffectPosterior& posterior,
                const Remainder& remainder, const std::vector<SimulationPart>& parts, const DiscrepancyPriors& priors,
                const DiscrepancyOptions& options, const HeldOutCheck& held_out) {
  Judgement out;
  const JointFit& fit = posterior.fit;
  std::vector<ModelTerm> terms;
  bool ambiguous = false;
  std::vector<std::string> unnamed;
  // Effects that may imitate: the weakest claim goes first, and what it explained counts as left for the others.
  std::vector<bool> imitates(fit.terms.size(), false);
  std::vector<double> ratios(fit.terms.size(), 0.0);
  std::vector<double> claim(fit.terms.size(), 0.0);
  std::vector<double> over_unknown(fit.terms.size(), 0.0);
  std::vector<double> patterns;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) patterns.push_back(otherPattern(problem, fit, t));
  for (std::size_t round = 0; round <= fit.terms.size(); ++round) {
    std::size_t weakest = fit.terms.size();
    const auto weaker = [&](std::size_t t) { return weakest == fit.terms.size() || claim[t] < claim[weakest]; };
    for (std::size_t t = 0; t < fit.terms.size(); ++t) {
      if (imitates[t]) continue;
      const SlotEvidence& slot = posterior.slots[t];
      over_unknown[t] = overUnknown(posterior, {t}, imitates);
      const double beside = imitationRatio(problem, search, fit, t, remainder, imitates);
      const double other_pattern = uneven_bodies * patterns[t];
      ratios[t] = std::max(other_pattern, beside);
      const bool driven = drivenByLog(fit.terms[t]) && !drivenByStandIn(fit.terms[t]);
      const double surely = driven ? std::min(slot.over_noise, over_unknown[t]) / told_from_the_rest : 1.0;
      const double doubtful = std::max(other_pattern, beside / std::max(1.0, surely));
      // What smooth courses in simple patterns cannot take up, whatever their size, imitates nothing that drifts.
      const bool beyond_drifts = fit.terms[t].effect->own && over_unknown[t] > remainder_evidence;
      const double known = 1.0 / (1.0 + std::pow(doubtful / (beyond_drifts ? 1.0 : priors.imitation), 4));
      const double there =
          probabilityAt(std::min({slot.delta_evidence, slot.over_noise, over_unknown[t] + unknown_price}));
      claim[t] = known * there;
      if (!posterior.forced[t] && claim[t] < least_confidence && weaker(t)) weakest = t;
    }
    // One unknown cause in place of several effects that share a component: they must be far better than it. Where they
    // are not, the one that brings least goes.
    for (const Component c : all_components) {
      std::vector<std::size_t> sharing;
      for (std::size_t t = 0; t < fit.terms.size(); ++t)
        if (!imitates[t] && posterior.slots[t].main == c) sharing.push_back(t);
      if (sharing.size() < 2) continue;
      const double jointly = probabilityAt(overUnknown(posterior, sharing, imitates) + unknown_price -
                                           further_price * (static_cast<double>(sharing.size()) - 1.0));
      std::size_t least = fit.terms.size();
      for (const std::size_t t : sharing) {
        if (posterior.forced[t]) continue;
        if (least == fit.terms.size() || posterior.slots[t].delta_evidence < posterior.slots[least].delta_evidence)
          least = t;
      }
      if (least == fit.terms.size()) continue;
      claim[least] *= jointly;
      if (claim[least] < least_confidence && weaker(least)) weakest = least;
    }
    if (weakest == fit.terms.size()) break;
    imitates[weakest] = true;
  }
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    const SlotEvidence& slot = posterior.slots[t];
    const Effect& effect = *fit.terms[t].effect;
    NamedEffect name;
    name.id = effect.id;
    name.delta_chi2 = slot.delta_chi2;
    name.delta_evidence = slot.delta_evidence;
    name.forced = posterior.forced[t];
    for (const Alternative& a : slot.others) {
      name.margin = std::min(name.margin, posterior.evidence - a.evidence);
      if (a.probability < least_rival * slot.probability) continue;
      if (a.rejected) continue;  // told with all that was rejected
      const Effect* other = search.find(a.id);
      if (other != nullptr && (sameCause(effect, a.id) || sameCause(*other, effect.id))) continue;
      if (a.container) {
        name.containers.push_back(a.id);
        continue;
      }
      if (!name.closest) name.closest = a.joint;
      name.rivals.push_back(a.id);
    }
    const bool slow_course = couldBeAnySlowCourse(problem, fit, t);
    // What rivals that the log cannot show are more probable than their fit: each is as probable as this effect.
    double unseen = 0.0;
    for (const Effect& other : search.catalogue()) {
      if (other.id == effect.id) continue;
      if (!other.variants.empty() && !(slow_course && seenElsewhere(other))) continue;
      // Whoever wrote down what drives an effect knows what it is; that its course follows speaks for it.
      if (effect.own && (effect.over_time || !fit.terms[t].variant.inputs[0].driver.empty())) continue;
      // One that holds a simpler effect is seen through that one.
      const bool seen = std::any_of(other.contains.begin(), other.contains.end(), [&](const std::string& id) {
        const Effect* simple = search.find(id);
        return simple != nullptr && !simple->variants.empty();
      });
      if (seen) continue;
      if (!hasPatternOf(problem, search, other, fit, t)) continue;
      const auto shown =
          std::find_if(slot.others.begin(), slot.others.end(), [&](const Alternative& a) { return a.id == other.id; });
      if (shown != slot.others.end() && shown->rejected) continue;
      unseen += std::max(0.0, slot.probability - (shown == slot.others.end() ? 0.0 : shown->probability));
      if (std::find(name.rivals.begin(), name.rivals.end(), other.id) != name.rivals.end()) continue;
      name.rivals.push_back(other.id);
      out.warnings.push_back(fmt::format(
          "{} cannot be distinguished from {}, because the log lacks what drives the latter: log it next time.",
          effect.id, other.id));
    }
    name.confidence = std::clamp(slot.probability * claim[t] / (1.0 + unseen), 0.01, 1.0 - priors.unforeseen);
    if (name.forced && !(slot.delta_evidence > 0.0)) {
      // What is not there has no rivals either.
      name.rivals.clear();
      name.containers.clear();
      name.closest.reset();
    }
    if (name.forced && slot.delta_evidence > 0.0 && !slot.others.empty()) {
      const Alternative& best = slot.others.front();
      if (!best.rejected && best.probability > slot.probability) {
        out.warnings.push_back(fmt::format(
            "{} was accepted by hand; {} in its place is more probable with these data ({:.2f} against {:.2f}).",
            effect.id, best.id, best.probability, slot.probability));
      }
    }
    DiscrepancyStep step{effect.id, true, slot.delta_evidence, slot.delta_chi2, ""};
    if (name.forced) {
      step.reason = slot.delta_evidence > 0.0 ? "added by the user" : "added by the user; the data do not support it";
      if (!(slot.delta_evidence > 0.0)) {
        out.warnings.push_back(fmt::format("{} was accepted by hand; the data do not support it.", effect.id));
      }
    } else if (imitates[t]) {
      step.accepted = false;
      step.reason = fmt::format(
          "what it leaves is too large beside it ({:.2f}), or noise would do ({:.0f}): it may imitate a cause outside "
          "the catalogue",
          ratios[t], std::min(slot.over_noise, over_unknown[t]));
      unnamed.push_back(effect.id);
    } else if (name.rivals.size() > most_rivals) {
      step.accepted = false;
      step.reason = fmt::format("{} others explain the same as well", name.rivals.size());
      unnamed.push_back(effect.id);
    } else {
      step.reason =
          fmt::format("more probable than all sets without it (left beside it: {:.2f} of its size)", ratios[t]);
    }
    out.steps.push_back(step);
    if (!step.accepted) continue;
    terms.push_back(fit.terms[t]);
    out.names.push_back(std::move(name));
  }
  // Two that share a rival which nothing in the log drives: together they look like that one.
  for (const Effect& other : search.catalogue()) {
    if (!other.variants.empty()) continue;
    std::vector<std::size_t> sharing;
    for (std::size_t k = 0; k < out.names.size(); ++k) {
      const auto& rivals = out.names[k].rivals;
      if (!out.names[k].forced && std::find(rivals.begin(), rivals.end(), other.id) != rivals.end())
        sharing.push_back(k);
    }
    if (sharing.size() < 2) continue;
    for (auto k = sharing.rbegin(); k != sharing.rend(); ++k) {
      unnamed.push_back(out.names[*k].id);
      for (DiscrepancyStep& step : out.steps) {
        if (step.id != out.names[*k].id) continue;
        step.accepted = false;
        step.reason = fmt::format("together with another it looks like {}, whose driver the log lacks", other.id);
      }
      terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(*k));
      out.names.erase(out.names.begin() + static_cast<std::ptrdiff_t>(*k));
    }
  }
  out.named = terms.size() == fit.terms.size() ? fit : search.solve(terms);
  // Something is there, though what it was taken for does not foretell it, or has not its pattern: that is no noise.
  bool is_there = false;
  for (std::size_t t = 0; t < fit.terms.size(); ++t)
    is_there = is_there || (imitates[t] && uneven_bodies * patterns[t] > priors.imitation &&
                            posterior.slots[t].over_noise > remainder_evidence);
  const auto takeBack = [&](std::size_t k, const std::string& why) {
    unnamed.push_back(out.names[k].id);
    for (DiscrepancyStep& step : out.steps) {
      if (step.id != out.names[k].id) continue;
      step.accepted = false;
      step.reason = why;
    }
    terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(k));
    out.names.erase(out.names.begin() + static_cast<std::ptrdiff_t>(k));
    out.named = search.solve(terms);
  };
  // One that may as well be another that is named: a second course of the same cause, not known to be a second cause.
  for (std::size_t k = out.names.size(); k-- > 0;) {
    const std::vector<std::string>& rivals = out.names[k].rivals;
    const auto same = std::find_if(out.names.begin(), out.names.end(), [&](const NamedEffect& other) {
      return std::find(rivals.begin(), rivals.end(), other.id) != rivals.end();
    });
    if (out.names[k].forced || same == out.names.end()) continue;
    takeBack(k, fmt::format("{}, already named, would explain it equally well with a separate time history", same->id));
  }
  // What stands only beside those that were taken out has nothing to stand on.
  while (terms.size() < fit.terms.size()) {
    std::size_t worst = terms.size();
    for (std::size_t k = 0; k < terms.size(); ++k) {
      if (out.names[k].forced || search.admissible(terms[k], out.named.gains[k])) continue;
      if (worst == terms.size() || out.names[k].confidence < out.names[worst].confidence) worst = k;
    }
    if (worst == terms.size()) break;
    takeBack(worst, "without the effects that cannot be named it breaks its sign or its bounds");
  }
  // A weak one that may as well be a part of the simulation that is off by no more than a rough simulation may be. Of
  // its own part the search has weighed that already.
  for (std::size_t k = out.names.size(); k-- > 0;) {
    if (out.names[k].forced || parts.empty()) continue;
    std::vector<ModelTerm> others = terms;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    // The others have made room for it, as they had when it was weighed.
    const Eigen::VectorXd left = problem.projected(problem.without(search.refine(others, 1).contribution)).col(0);
    const PartInstead* best = nullptr;
    std::vector<PartInstead> all;
    for (const SimulationPart& part : parts) all.push_back(partInstead(problem, part, left, priors));
    for (const PartInstead& p : all)
      if (p.possible && p.id != out.names[k].id && (best == nullptr || p.evidence > best->evidence)) best = &p;
    if (best == nullptr || !(best->evidence > 0.0)) continue;
    // Its own part, off by what is missing, explains it better than that other one.
    if (std::any_of(all.begin(), all.end(),
                    [&](const PartInstead& p) { return p.id == out.names[k].id && p.evidence > best->evidence; }))
      continue;
    if (best->evidence + instead_as_well < out.names[k].delta_evidence) continue;
    out.warnings.push_back(
        fmt::format("The simulation has {:.0f} ± {:.0f} % too {} of {}: no more than a rough simulation may be off by, "
                    "so it is taken "
                    "as its error and not for {}.",
                    100.0 * std::abs(best->missing), std::max(1.0, 100.0 * best->uncertainty),
                    best->missing < 0.0 ? "much" : "little", best->id, out.names[k].id));
    takeBack(k, fmt::format("{} of the simulation, off by {:.0f} %, would explain it as well", best->id,
                            100.0 * std::abs(best->missing)));
    unnamed.pop_back();
  }
  // What predicts the held-out states worse than the others do without it, more than a few states with shifts of their
  // own do by chance.
  const HeldOutErrors of_none = held_out.errors(search.solve({}));
  const auto worse = [&](const HeldOutErrors& with, const HeldOutErrors& without, double surely) {
    return with.rms_um > worse_held_out * without.rms_um && held_out.leaves_more(with, without) > surely;
  };
  while (!terms.empty()) {
    const HeldOutErrors with = held_out.errors(out.named);
    const bool enlarges = worse(with, of_none, surely_worse);
    std::size_t worst = terms.size();
    double least = with.rms_um;
    for (std::size_t k = 0; k < terms.size(); ++k) {
      // What has moved stays where it is: no reason to foretell it badly. What stands in for a driver is believed as
      // far as it foretells.
      const bool stays = terms[k].variant.inputs[0].dynamics == Dynamics::Step;
      const bool beyond = out.names[k].delta_evidence > beyond_held_out && !stays && !drivenByStandIn(terms[k]);
      if (out.names[k].forced || (!enlarges && beyond)) continue;
      std::vector<ModelTerm> others = terms;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      const HeldOutErrors without = held_out.errors(search.solve(others));
      // What the log drives may be foretold badly by chance; what has found its own begin has to be seen after it.
      const double surely = drivenByLog(terms[k]) ? surely_worse : 0.5;
      if (!(without.rms_um < least) || !worse(with, without, surely)) continue;
      least = without.rms_um;
      worst = k;
    }
    if (worst == terms.size()) break;
    is_there = is_there || out.names[worst].delta_evidence > remainder_evidence;
    takeBack(worst, fmt::format("with it the held-out states are predicted worse ({:.2f} µm rms, without it {:.2f})",
                                with.rms_um, least));
  }
  ambiguous = std::any_of(out.names.begin(), out.names.end(), [](const NamedEffect& n) { return !n.rivals.empty(); });
  std::string left = describedRemainder(problem, problem.noise, fit, remainder);
  if (!unnamed.empty() && !is_there) {
    std::optional<NoiseModel> noise = explainingNoise(problem, fit, out.named);
    if (noise) {
      unnamed.clear();
      if (out.names.empty()) {
        left = describedRemainder(problem, *noise, out.named, remainder);
        out.noise = std::move(noise);
      }
    }
  }
  if (left.empty() && unnamed.empty() && out.names.empty()) left = patternInScatter(problem, fit);
  if (!unnamed.empty()) {
    out.leftover = fmt::format("what {} would explain, but cannot be named{}", joinedList(unnamed),
                               left.empty() ? "" : ", and " + left);
  } else if (!left.empty()) {
    out.leftover = left;
  }
  // What is explained of all that is structured: chi-squared beyond that of noise.
  const double before = problem.projectedResidual().squaredNorm();
  double remaining = 0.0;
  for (const Remainder::OfComponent& r : remainder.components)
    remaining += r.evidence >= remainder_evidence ? r.power : 0.0;
  const double structured = std::max(1e-9, before - fit.chi2 + remaining);
  out.explained_fraction = std::clamp((before - out.named.chi2) / structured, 0.0, 1.0);
  if (fit.terms.empty()) out.explained_fraction = 0.0;
  const bool by_hand = std::all_of(out.names.begin(), out.names.end(), [](const NamedEffect& n) { return n.forced; });
  if (out.names.empty() || (by_hand && !out.leftover.empty() && options.max_effects > 0)) {
    out.verdict = out.leftover.empty() && out.names.empty() ? DiscrepancyVerdict::None : DiscrepancyVerdict::Unknown;
    if (!out.names.empty() && by_hand)
      out.verdict = ambiguous ? DiscrepancyVerdict::Ambiguous : DiscrepancyVerdict::Named;
  } else {
    out.verdict = ambiguous ? DiscrepancyVerdict::Ambiguous : DiscrepancyVerdict::Named;
  }
  return out;
}

}  // namespace spindrift
