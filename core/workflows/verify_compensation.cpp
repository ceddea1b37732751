// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/verify_compensation.h"

#include <fmt/format.h>

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "core/base/count_text.h"
#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/base/natural_order.h"
#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/workflows/compensated_data.h"

namespace spindrift {
namespace {

constexpr double coverage = 2.0;

/// Point, component and angle of the table (deg): what stands at another angle is another place.
using SeriesKey = std::pair<std::string, std::pair<Component, double>>;

struct Value {
  /// Repeats, by the direction of approach along the component; 0: not stated, or of a rotation.
  std::map<double, std::vector<std::size_t>> rows;
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();
};

/// A sum of rows with weights.
using Combination = std::vector<std::pair<std::size_t, double>>;

/// The readings of every state, states in order of time; the first one is what the others are relative to.
struct Course {
  std::vector<std::string> states;
  std::map<std::string, Value> values;
};

/// Points of one name further apart than this are not the same point.
constexpr double same_place_mm = 1.0;

std::map<SeriesKey, Course, NaturalOrder> coursesOf(const ObservationSet& set) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < set.rows.size(); ++i)
    if (set.rows[i].use != ObservationUse::Exclude) rows.push_back(i);
  std::stable_sort(rows.begin(), rows.end(),
                   [&](std::size_t a, std::size_t b) { return set.rows[a].time_s < set.rows[b].time_s; });
  std::map<SeriesKey, Course, NaturalOrder> out;
  for (const std::size_t i : rows) {
    const Observation& o = set.rows[i];
    Course& course = out[{o.point, {o.component, o.c_deg}}];
    if (!course.values.contains(o.state)) course.states.push_back(o.state);
    Value& v = course.values[o.state];
    v.rows[isRotation(o.component) ? 0.0 : o.approach[axisIndex(o.component)]].push_back(i);
    v.position_mm = o.position_mm;
  }
  return out;
}

/// Names of the states of all series.
template <typename Courses>
std::set<std::string> statesOf(const Courses& courses) {
  std::set<std::string> out;
  for (const auto& [key, course] : courses) out.insert(course.states.begin(), course.states.end());
  return out;
}

/// The state that was measured first; empty without any.
std::string firstState(const ObservationSet& set) {
  const Observation* first = nullptr;
  for (const Observation& o : set.rows)
    if (o.use != ObservationUse::Exclude && (first == nullptr || o.time_s < first->time_s)) first = &o;
  return first == nullptr ? std::string() : first->state;
}

/// Which states of two courses are the same, their common zero first: by name, and by their order where campaigns share
/// no name. Empty where they have no common zero.
std::vector<std::pair<std::string, std::string>> sameStates(const Course& before, const Course& after, bool by_name) {
  std::vector<std::pair<std::string, std::string>> pairs;
  if (!by_name) {
    if (before.states.size() != after.states.size()) return pairs;
    for (std::size_t k = 0; k < before.states.size(); ++k) pairs.emplace_back(before.states[k], after.states[k]);
    return pairs;
  }
  if (!after.values.contains(before.states.front())) return pairs;
  for (const std::string& state : before.states)
    if (after.values.contains(state)) pairs.emplace_back(state, state);
  return pairs;
}

/// The weighted mean of rows, times `factor`.
void addMean(const ObservationSet& set, const std::vector<std::size_t>& rows, double factor, Combination& sum) {
  double total = 0.0;
  for (const std::size_t row : rows) total += 1.0 / (set.rows[row].sigma * set.rows[row].sigma);
  for (const std::size_t row : rows)
    sum.emplace_back(row, factor / (set.rows[row].sigma * set.rows[row].sigma) / total);
}

struct ChangeOfRows {
  Combination rows;
  bool from_another_side = false;  ///< nothing was approached from one side in both states
};

/// One state minus another: side by side where there are readings from the same side in both, for a reversal error is
/// no change.
ChangeOfRows changeOf(const ObservationSet& set, const Value& value, const Value& zero) {
  std::vector<double> sides;
  for (const auto& [side, rows] : value.rows)
    if (zero.rows.contains(side)) sides.push_back(side);
  ChangeOfRows out;
  for (const double side : sides) {
    const double part = 1.0 / static_cast<double>(sides.size());
    addMean(set, value.rows.at(side), part, out.rows);
    addMean(set, zero.rows.at(side), -part, out.rows);
  }
  if (!sides.empty()) return out;
  const auto all = [](const Value& v) {
    std::vector<std::size_t> rows;
    for (const auto& [side, some] : v.rows) rows.insert(rows.end(), some.begin(), some.end());
    return rows;
  };
  addMean(set, all(value), 1.0, out.rows);
  addMean(set, all(zero), -1.0, out.rows);
  out.from_another_side = !value.rows.contains(0.0) && !zero.rows.contains(0.0);
  return out;
}

double valueOf(const ObservationSet& set, const Combination& sum) {
  double value = 0.0;
  for (const auto& [row, weight] : sum) value += weight * set.rows[row].value;
  return value;
}

/// Own noise of rows, and what they share.
class NoiseOfRows {
 public:
  explicit NoiseOfRows(const ObservationSet& set) : set_(&set), factors_(set.shared.factors().size()) {
    std::vector<std::size_t> all(set.rows.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    if (factors_ > 0) loads_ = set.shared.loads(all);
  }
  [[nodiscard]] NoiseCauses causesOf(const Combination& rows) const {
    std::map<std::size_t, double> sum;
    for (const auto& [row, weight] : rows) {
      sum[factors_ + row] += weight * std::sqrt(set_->shared.ownVariance(row, set_->rows[row].sigma));
      if (factors_ == 0) continue;
      for (Loads::InnerIterator it(loads_, static_cast<Eigen::Index>(row)); it; ++it)
        sum[static_cast<std::size_t>(it.col())] += weight * it.value();
    }
    return {sum.begin(), sum.end()};
  }

 private:
  using Loads = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  const ObservationSet* set_;
  std::size_t factors_;
  Loads loads_;
};

double sigmaOf(const NoiseCauses& causes) {
  double variance = 0.0;
  for (const auto& [cause, load] : causes) variance += load * load;
  return std::sqrt(variance);
}

/// Causes x changes.
Eigen::SparseMatrix<double> loadsOf(const std::vector<const VerifyPoint*>& points, bool after) {
  std::map<std::size_t, Eigen::Index> number;
  std::vector<Eigen::Triplet<double>> loads;
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (const auto& [cause, load] : after ? points[k]->after_causes : points[k]->before_causes) {
      const auto row = number.try_emplace(cause, static_cast<Eigen::Index>(number.size())).first->second;
      loads.emplace_back(row, static_cast<Eigen::Index>(k), load);
    }
  }
  Eigen::SparseMatrix<double> out(static_cast<Eigen::Index>(number.size()), static_cast<Eigen::Index>(points.size()));
  out.setFromTriplets(loads.begin(), loads.end());
  return out;
}

VerifyVerdict judge(double value, double sigma, double goal) {
  if (!(goal > 0.0)) return VerifyVerdict::NotJudged;
  if (value + coverage * sigma <= goal) return VerifyVerdict::Met;
  if (value - coverage * sigma > goal) return VerifyVerdict::NotMet;
  return VerifyVerdict::Undecided;
}

/// The largest value: every one decides, not only the one that happens to be largest.
VerifyVerdict judgeLargest(const std::vector<const VerifyPoint*>& points, double goal) {
  VerifyVerdict verdict = VerifyVerdict::Met;
  for (const VerifyPoint* p : points) {
    const VerifyVerdict v = judge(std::abs(p->after), p->after_sigma, goal);
    if (v == VerifyVerdict::NotMet || v == VerifyVerdict::NotJudged) return v;
    if (v == VerifyVerdict::Undecided) verdict = v;
  }
  return verdict;
}

/// Fewer equal values than this can be equal by chance, when instruments round.
constexpr std::size_t telling_values = 3;

/// Two measurements never agree to the last digit: the same data twice is no proof.
void rejectSameData(const ObservationSet& after, VerifyResult& result) {
  std::size_t equal = 0;
  for (const VerifyPoint& p : result.points) equal += p.before == p.after && p.before != 0.0 ? 1 : 0;
  if (equal == 0) return;
  const std::size_t all = result.points.size();
  if (equal == all && equal >= telling_values) {
    throw InputError({after.file, ""},
                     fmt::format("all {} values equal those before compensation; allowed: the same plan measured "
                                 "again with the compensation on.",
                                 all));
  }
  if (equal < telling_values && equal < all) return;
  result.notes.push_back(fmt::format("The same as before to the last digit: {} of {}. Is it the same measurement?",
                                     equal, countOf(all, "value")));
}

nlohmann::json figuresJson(const VerifyFigures& f) {
  return {{"rms", jsonNumber(f.rms)},
          {"rms_standard_uncertainty", jsonNumber(f.rms_sigma)},
          {"largest", jsonNumber(f.largest)},
          {"largest_standard_uncertainty", jsonNumber(f.largest_sigma)},
          {"largest_at", f.largest_at}};
}

void conclude(VerifyResult& r) {
  const bool largest = r.request.criterion == VerifyCriterion::Largest;
  const VerifyComponent* worst = nullptr;
  r.verdict = VerifyVerdict::NotJudged;
  for (const VerifyComponent& c : r.components) {
    if (c.verdict == VerifyVerdict::NotJudged) continue;
    const auto rank = [](VerifyVerdict v) {
      return v == VerifyVerdict::NotMet ? 2 : v == VerifyVerdict::Undecided ? 1 : 0;
    };
    const auto size = [&](const VerifyComponent& x) {
      const double goal = isRotation(x.component) ? r.request.goal_urad : r.request.goal_um;
      return (largest ? x.after.largest : x.after.rms) / goal;
    };
    if (worst == nullptr || rank(c.verdict) > rank(worst->verdict) ||
        (rank(c.verdict) == rank(worst->verdict) && size(c) > size(*worst)))
      worst = &c;
  }
  if (worst == nullptr) {
    r.reason = "No component has a goal: nothing was judged.";
    return;
  }
  r.verdict = worst->verdict;
  const VerifyFigures& f = worst->after;
  const std::string unit = printedUnit(unitOf(worst->component));
  const std::string figure =
      largest ? fmt::format("largest deviation {} is {} at {}", toString(worst->component),
                            withUncertainty(f.largest, f.largest_sigma, unit), f.largest_at)
              : fmt::format("rms of {} is {}", toString(worst->component), withUncertainty(f.rms, f.rms_sigma, unit));
  const double goal = isRotation(worst->component) ? r.request.goal_urad : r.request.goal_um;
  switch (r.verdict) {
    case VerifyVerdict::Met:
      r.reason = fmt::format("The goal of {:g} {} is met: {}.", goal, unit, figure);
      break;
    case VerifyVerdict::NotMet:
      r.reason = fmt::format("The goal of {:g} {} is not met: {}.", goal, unit, figure);
      break;
    default:
      r.reason = fmt::format(
          "It cannot be decided whether the goal of {:g} {} is met: {}, and its expanded uncertainty (k = 2) reaches "
          "across the goal; measure more often or more precisely.",
          goal, unit, figure);
  }
}

}  // namespace

VerifyFigures verifyFigures(const std::vector<const VerifyPoint*>& points, bool after) {
  VerifyFigures f;
  double squares = 0.0;
  double noise = 0.0;
  const auto n = static_cast<double>(points.size());
  Eigen::VectorXd changes(static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const VerifyPoint* p = points[k];
    const double d = after ? p->after : p->before;
    const double s = after ? p->after_sigma : p->before_sigma;
    changes[static_cast<Eigen::Index>(k)] = d;
    squares += d * d / n;
    noise += s * s / n;
    if (std::abs(d) <= f.largest) continue;
    f.largest = std::abs(d);
    f.largest_sigma = s;
    f.largest_at = p->point + ", " + p->state;
  }
  if (points.size() == 1) {
    // Nothing to average: the value itself, with its uncertainty.
    f.rms = std::sqrt(squares);
    f.rms_sigma = std::sqrt(noise);
    return f;
  }
  const double left = std::max(0.0, squares - noise);
  f.rms = std::sqrt(left);
  // C = L'L, so that tr(C^2) is the squared norm of L L': as sparse as causes are shared.
  const Eigen::SparseMatrix<double> loads = loadsOf(points, after);
  const Eigen::SparseMatrix<double> crossed = loads * loads.transpose();
  // d holds the noise as well: d'Cd is larger than that of the changes themselves by tr(C^2) in the mean.
  const double squared = crossed.squaredNorm();
  const double along = (loads * changes).squaredNorm();
  const double spread = std::max(2.0 * squared, 4.0 * along - 2.0 * squared) / (n * n);
  const double u = std::sqrt(std::max(0.0, spread));
  // u of the root; near zero by the distance to the root of the upper end.
  f.rms_sigma = std::sqrt(left + u) - f.rms;
  return f;
}

std::vector<VerifyPointFigures> verifyFiguresOfPoints(const VerifyResult& result, Component component, double c_deg) {
  std::vector<VerifyPointFigures> figures;
  std::vector<std::vector<const VerifyPoint*>> values;
  for (const VerifyPoint& p : result.points) {
    if (p.component != component || p.c_deg != c_deg) continue;
    const auto found = std::find_if(figures.begin(), figures.end(), [&](const auto& f) { return f.point == p.point; });
    if (found == figures.end()) {
      figures.push_back({p.point, {}, {}});
      values.push_back({&p});
    } else {
      values[static_cast<std::size_t>(found - figures.begin())].push_back(&p);
    }
  }
  for (std::size_t i = 0; i < figures.size(); ++i) {
    figures[i].before = verifyFigures(values[i], false);
    figures[i].after = verifyFigures(values[i], true);
  }
  return figures;
}

std::string_view toString(VerifyVerdict verdict) noexcept {
  switch (verdict) {
    case VerifyVerdict::Met:
      return "met";
    case VerifyVerdict::NotMet:
      return "not met";
    case VerifyVerdict::Undecided:
      return "cannot be decided";
    case VerifyVerdict::NotJudged:
      return "not judged";
  }
  return "";
}

void VerifyRequest::validate() const {
  if (!(goal_um > 0.0) || !std::isfinite(goal_um))
    throw InputError(fmt::format("a goal of {:g} µm cannot be met; allowed: a positive number.", goal_um));
  if (!(goal_urad >= 0.0) || !std::isfinite(goal_urad))
    throw InputError(
        fmt::format("a goal of {:g} µrad cannot be met; allowed: a positive number, or 0 for none.", goal_urad));
}

VerifyResult verifyCompensation(const ObservationSet& before, const ObservationSet& after,
                                const VerifyRequest& request) {
  request.validate();
  VerifyResult result;
  result.request = request;
  const auto first = coursesOf(before);
  const auto second = coursesOf(after);
  const NoiseOfRows noise_before(before);
  const NoiseOfRows noise_after(after);
  const std::set<std::string> states_before = statesOf(first);
  const std::set<std::string> states_after = statesOf(second);
  std::vector<std::string> only_before;
  std::vector<std::string> only_after;
  std::set_difference(states_before.begin(), states_before.end(), states_after.begin(), states_after.end(),
                      std::back_inserter(only_before));
  std::set_difference(states_after.begin(), states_after.end(), states_before.begin(), states_before.end(),
                      std::back_inserter(only_after));
  const bool by_name = only_before.size() < states_before.size();
  const std::string zero_state = firstState(before);
  if (by_name && !states_after.contains(zero_state)) {
    throw InputError({after.file, ""},
                     fmt::format("holds no usable reading of {}, the first state before, which all changes are "
                                 "relative to: what is left of them is not known; allowed: the same plan measured "
                                 "again, its first state included.",
                                 zero_state));
  }
  std::size_t missing = 0;
  std::size_t other_side = 0;
  std::set<std::string> moved;
  for (const auto& [key, course] : first) {
    const auto other = second.find(key);
    const auto pairs = other == second.end() ? std::vector<std::pair<std::string, std::string>>()
                                             : sameStates(course, other->second, by_name);
    if (pairs.size() < 2) {
      ++missing;
      continue;
    }
    const Value& zero = course.values.at(pairs.front().first);
    const Value& elsewhere = other->second.values.at(pairs.front().second);
    if ((zero.position_mm - elsewhere.position_mm).norm() > same_place_mm) {
      moved.insert(key.first);
      continue;
    }
    if (pairs.size() < std::max(course.states.size(), other->second.states.size())) ++missing;
    for (std::size_t k = 1; k < pairs.size(); ++k) {
      const Value& a = course.values.at(pairs[k].first);
      const Value& b = other->second.values.at(pairs[k].second);
      const ChangeOfRows change_before = changeOf(before, a, zero);
      const ChangeOfRows change_after = changeOf(after, b, elsewhere);
      other_side += change_before.from_another_side || change_after.from_another_side ? 1U : 0U;
      NoiseCauses before_causes = noise_before.causesOf(change_before.rows);
      NoiseCauses after_causes = noise_after.causesOf(change_after.rows);
      const double before_sigma = sigmaOf(before_causes);
      const double after_sigma = sigmaOf(after_causes);
      result.points.push_back({key.first, pairs[k].second, b.position_mm, key.second.first,
                               valueOf(before, change_before.rows), before_sigma, valueOf(after, change_after.rows),
                               after_sigma, key.second.second, std::move(before_causes), std::move(after_causes)});
    }
  }
  for (const auto& [key, course] : second) missing += first.contains(key) ? 0U : 1U;
  if (result.points.empty()) {
    throw InputError(
        {after.file, ""},
        moved.empty()
            ? "nothing can be compared: no point and component was measured in at least two states both before "
              "and after; allowed: the same plan measured again with the compensation on."
            : "nothing can be compared: the points of the same name are elsewhere than before; "
              "allowed: the same plan measured again on the same machine.");
  }
  if (!moved.empty()) {
    result.notes.push_back(fmt::format("{} stood more than {:g} mm elsewhere before, and is left out.",
                                       joinedList(std::vector<std::string>(moved.begin(), moved.end())),
                                       same_place_mm));
  }
  const auto leftOut = [&](std::vector<std::string> states, const char* where) {
    if (!by_name || states.empty()) return;
    std::sort(states.begin(), states.end(), NaturalOrder());
    result.notes.push_back(fmt::format("Measured only {}, and left out: {}.", where, shortenedList(states)));
  };
  leftOut(only_before, "before");
  leftOut(only_after, "after");
  if (missing > 0) {
    result.notes.push_back(fmt::format(
        "Not measured alike before and after: {} of points and components. Only what both have is compared.",
        countOf(missing, "series", "series")));
  }
  if (other_side > 0) {
    result.notes.push_back(fmt::format(
        "Compared with readings that were approached from another side: {} of {}. The reversal error counts as a "
        "change in them.",
        other_side, countOf(result.points.size(), "value")));
  }
  rejectSameData(after, result);
  for (int c = 0; c < 6; ++c) {
    const auto component = static_cast<Component>(c);
    std::vector<const VerifyPoint*> points;
    for (const VerifyPoint& p : result.points)
      if (p.component == component) points.push_back(&p);
    if (points.empty()) continue;
    VerifyComponent row;
    row.component = component;
    row.values = points.size();
    row.before = verifyFigures(points, false);
    row.after = verifyFigures(points, true);
    const double goal = isRotation(component) ? request.goal_urad : request.goal_um;
    row.verdict = request.criterion == VerifyCriterion::Largest ? judgeLargest(points, goal)
                                                                : judge(row.after.rms, row.after.rms_sigma, goal);
    result.components.push_back(std::move(row));
  }
  conclude(result);
  return result;
}

VerifyResult verifyCampaigns(const Campaign& before, const ObservationSet& before_observations, const Campaign& after,
                             const ObservationSet& after_observations, const VerifyRequest& request) {
  ObservationSet first = before_observations;
  const std::string left_out = leaveOutCompensated(first, before.log.get());
  ObservationSet second = after_observations;
  std::vector<std::string> notes;
  if (before.machine.name != after.machine.name) {
    notes.push_back(fmt::format("The machines have different names: \"{}\" before, \"{}\" after.", before.machine.name,
                                after.machine.name));
  }
  const auto described = [](const Campaign& campaign, const char* key) {
    const nlohmann::json& source = campaign.machine.source;
    return source.is_object() && source.contains(key) ? source[key] : nlohmann::json();
  };
  for (const char* key : {"chain", "axes"}) {
    if (described(before, key) == described(after, key)) continue;
    notes.push_back(fmt::format("The machine files differ in \"{}\": the same machine is to be compared.", key));
  }
  if (!left_out.empty()) notes.push_back("Before: " + left_out);
  if (after.log && after.log->has(compensation_signal)) {
    std::size_t off = 0;
    std::size_t on = 0;
    // The first state is what the others are compared with, compensated or not: the machine is cold then.
    const std::string zero = firstState(second);
    bool zero_off = false;
    for (Observation& o : second.rows) {
      if (o.use == ObservationUse::Exclude) continue;
      if (wasCompensating(*after.log, o.time_s)) {
        ++on;
      } else if (o.state == zero) {
        zero_off = true;
      } else {
        o.use = ObservationUse::Exclude;
        ++off;
      }
    }
    if (on == 0) {
      throw InputError({after.path("log.csv"), std::string("column ") + compensation_signal},
                       "is 0 whenever something was measured, so there is nothing to verify; allowed: a campaign that "
                       "was measured with the compensation on.");
    }
    if (zero_off)
      notes.push_back(
          fmt::format("After: {} was taken without compensation; it remains what the others are compared "
                      "with.",
                      zero));
    if (off > 0)
      notes.push_back(fmt::format("After, taken without compensation and left out: {} of {}.", off,
                                  countOf(on + off, "observation")));
  } else {
    notes.push_back(
        "After: no column compensation_on in the log: nothing but the operator's word says that the control was "
        "compensating.");
  }
  VerifyResult result = verifyCompensation(first, second, request);
  result.notes.insert(result.notes.begin(), notes.begin(), notes.end());
  return result;
}

nlohmann::json VerifyResult::json() const {
  nlohmann::json out = {{"verdict", toString(verdict)},
                        {"reason", reason},
                        {"goal_um", request.goal_um},
                        {"goal_urad", request.goal_urad > 0.0 ? nlohmann::json(request.goal_urad) : nlohmann::json()},
                        {"criterion", request.criterion == VerifyCriterion::Largest ? "largest" : "rms"},
                        {"notes", notes}};
  out["components"] = nlohmann::json::array();
  for (const VerifyComponent& c : components) {
    out["components"].push_back({{"component", toString(c.component)},
                                 {"unit", unitOf(c.component)},
                                 {"values", c.values},
                                 {"before", figuresJson(c.before)},
                                 {"after", figuresJson(c.after)},
                                 {"verdict", toString(c.verdict)}});
  }
  out["points"] = nlohmann::json::array();
  for (const VerifyPoint& p : points) {
    out["points"].push_back({{"point", p.point},
                             {"state", p.state},
                             {"component", toString(p.component)},
                             {"before", p.before},
                             {"before_standard_uncertainty", p.before_sigma},
                             {"after", p.after},
                             {"after_standard_uncertainty", p.after_sigma}});
  }
  return out;
}

std::string VerifyResult::summary() const {
  std::string text = reason + "\n";
  for (const VerifyComponent& c : components) {
    const std::string unit = printedUnit(unitOf(c.component));
    text += fmt::format(
        "  {}: rms {} before, {} after; largest {} before, {} after ({}): {}\n", toString(c.component),
        withUncertainty(c.before.rms, c.before.rms_sigma, unit), withUncertainty(c.after.rms, c.after.rms_sigma, unit),
        withUncertainty(c.before.largest, c.before.largest_sigma, unit),
        withUncertainty(c.after.largest, c.after.largest_sigma, unit), countOf(c.values, "value"), toString(c.verdict));
  }
  const bool averaged = std::any_of(components.begin(), components.end(), [](const auto& c) { return c.values > 1; });
  if (averaged) text += "rms: without the measuring noise, so that it may be smaller than the values show\n";
  for (const std::string& n : notes) text += "note: " + n + "\n";
  return text;
}

}  // namespace spindrift
