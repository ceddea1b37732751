// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/suggestion.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/base/text.h"
#include "core/discrepancy/measurement_design.h"
#include "core/discrepancy/planned_programme.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// Of the effect named; what is less probable is left out of the plan, but stays a candidate of the next search.
constexpr double least_probability = 0.02;
constexpr std::size_t most_suggested_alternatives = 5;
/// Drivers and dynamics of one effect: how many are kept, and how probable beside the best.
constexpr std::size_t most_ways = 3;
constexpr double least_way = 0.05;
/// A name stands alone when all rivals are below this part of its probability.
constexpr double least_suggested_rival = 0.1;
constexpr std::size_t most_measured_places = 16;
/// Times at which programmes are compared.
constexpr std::size_t coarse_times = 12;
constexpr std::size_t programmes_in_earnest = 4;
/// A place where the machine has no point yet must leave less unknown by this part.
constexpr double new_place_price = 0.15;
/// In which a plan that leaves more of what is not known is no plan.
constexpr double least_informative = 0.9;
constexpr int draws = 400;

/// One way in which the data may have come about.
struct Candidate {
  std::string id;
  int group = 0;
  double probability = 0.0;
  JointFit fit;
  Eigen::MatrixXd root;  ///< parameters (gains, then lags, term by term) x directions of unit variance
};

/// Gains and lags of all terms of a fit as the data leave them. Where they leave everything open, a gain may make three
/// times what the effect makes, a lag change by 0.7 of itself.
Eigen::MatrixXd uncertaintyRoot(const EffectSearch& search, const ResidualProblem& problem, const JointFit& fit) {
  std::vector<Eigen::MatrixXd> parts;
  std::vector<double> prior;
  Index total = 0;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    const ModelTerm& term = fit.terms[t];
    const Eigen::MatrixXd x = search.columns(term);
    Eigen::MatrixXd part(x.rows(), x.cols() + static_cast<Index>(term.parameters.size()));
    part.leftCols(x.cols()) = x;
    const double size = fit.contribution[t].norm();
    for (Index g = 0; g < x.cols(); ++g) {
      const double norm = x.col(g).norm();
      prior.push_back(norm > 0.0 ? std::max(std::abs(fit.gains[t][g]), 3.0 * size / norm) : 0.0);
    }
    for (std::size_t p = 0; p < term.parameters.size(); ++p) {
      part.col(x.cols() + static_cast<Index>(p)) = search.derivative(term, fit.gains[t], p);
      prior.push_back(search.parameterIsLag(term, p) ? std::max(120.0, 0.7 * term.parameters[p]) : 1800.0);
    }
    total += part.cols();
    parts.push_back(std::move(part));
  }
  Eigen::MatrixXd all(problem.size(), total);
  Index at = 0;
  for (const Eigen::MatrixXd& part : parts) {
    all.middleCols(at, part.cols()) = part;
    at += part.cols();
  }
  const Eigen::VectorXd scale = Eigen::Map<const Eigen::VectorXd>(prior.data(), total);
  const Eigen::MatrixXd x = problem.projected(all) * scale.asDiagonal();
  Eigen::MatrixXd information = x.transpose() * x;
  information.diagonal().array() += 1.0;
  const Eigen::LLT<Eigen::MatrixXd> llt(information);
  const Eigen::MatrixXd inverse = llt.matrixU().solve(Eigen::MatrixXd::Identity(total, total));
  return scale.asDiagonal() * inverse;
}

double scoreOf(const EffectSearch& search, const JointFit& fit) {
  return fit.chi2 + fit.parameter_count * search.logN();
}

bool sameWay(const EffectVariant& a, const EffectVariant& b) {
  if (a.inputs.size() != b.inputs.size() || a.shared_lag != b.shared_lag) return false;
  for (std::size_t i = 0; i < a.inputs.size(); ++i) {
    if (a.inputs[i].driver != b.inputs[i].driver || a.inputs[i].dynamics != b.inputs[i].dynamics) return false;
  }
  return true;
}

/// The other drivers and dynamics by which term `t` of a fit may act about as well.
std::vector<std::pair<JointFit, double>> otherWays(const EffectSearch& search, const JointFit& fit, std::size_t t) {
  std::vector<std::pair<JointFit, double>> out;
  const Effect& effect = *fit.terms[t].effect;
  const double own = scoreOf(search, fit);
  for (const EffectVariant& variant : effect.variants) {
    if (sameWay(variant, fit.terms[t].variant)) continue;
    const bool driven =
        std::all_of(variant.inputs.begin(), variant.inputs.end(), [](const auto& i) { return !i.driver.empty(); });
    if (!driven) continue;
    std::optional<JointFit> best;
    for (const double lag : {900.0, 3600.0, 10800.0}) {
      std::vector<ModelTerm> terms = fit.terms;
      terms[t].variant = variant;
      terms[t].parameters.assign(static_cast<std::size_t>(parameterCount(variant)), lag);
      JointFit trial = search.solve(terms);
      if (!best || trial.chi2 < best->chi2) best = std::move(trial);
      if (parameterCount(variant) == 0) break;
    }
    constexpr double worth_refining = 25.0;
    if (scoreOf(search, *best) > own + worth_refining) continue;
    JointFit refined = search.refine(best->terms, 1);
    if (!search.admissible(refined.terms[t], refined.gains[t])) continue;
    const double weight = std::exp(-0.5 * std::max(0.0, scoreOf(search, refined) - own));
    if (weight >= least_way) out.emplace_back(std::move(refined), weight);
  }
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  if (out.size() + 1 > most_ways) out.resize(most_ways - 1);
  return out;
}

/// What is compared, the set as it is named first.
struct Question {
  std::vector<Candidate> candidates;
  std::vector<std::string> groups;  ///< names; the first is what is named
  std::vector<std::string> separates;
};

Question questionOf(const EffectSearch& search, const ResidualProblem& problem, const EffectPosterior& posterior,
                    const std::vector<std::string>& ambiguous, const JobContext& job) {
  struct Source {
    int group = 0;
    double weight = 0.0;
    const JointFit* fit = nullptr;
    std::size_t term = 0;
  };
  Question q;
  std::vector<Source> sources;
  for (std::size_t t = 0; t < posterior.slots.size(); ++t) {
    const std::string& id = posterior.fit.terms[t].effect->id;
    if (std::find(ambiguous.begin(), ambiguous.end(), id) == ambiguous.end()) continue;
    const SlotEvidence& slot = posterior.slots[t];
    if (sources.empty()) {
      q.groups.push_back(id);
      sources.push_back({0, 1.0, &posterior.fit, t});
    }
    std::vector<std::string> rivals;
    std::size_t taken = 0;
    for (const Alternative& a : slot.others) {
      if (a.rejected || a.container || a.joint.terms.empty() || taken == most_suggested_alternatives) continue;
      const double weight = a.probability / std::max(1e-12, slot.probability);
      if (weight < least_probability) continue;
      sources.push_back({static_cast<int>(q.groups.size()), weight, &a.joint, a.joint.terms.size() - 1});
      q.groups.push_back(a.id);
      ++taken;
      if (weight >= least_suggested_rival) rivals.push_back(a.id);
    }
    if (!rivals.empty()) q.separates.push_back(fmt::format("{} from {}", id, joinedList(rivals, "or")));
  }
  std::vector<std::vector<std::pair<JointFit, double>>> ways(sources.size());
  parallelFor(sources.size(), job, [&](std::size_t i) {
    ways[i] = otherWays(search, *sources[i].fit, sources[i].term);
    ways[i].insert(ways[i].begin(), {*sources[i].fit, 1.0});
  });
  double total = 0.0;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    double sum = 0.0;
    for (const auto& [fit, weight] : ways[i]) sum += weight;
    for (const auto& [fit, weight] : ways[i]) {
      q.candidates.push_back({q.groups[static_cast<std::size_t>(sources[i].group)], sources[i].group,
                              sources[i].weight * weight / sum, fit, uncertaintyRoot(search, problem, fit)});
    }
    total += sources[i].weight;
  }
  for (Candidate& c : q.candidates) c.probability /= total;
  return q;
}

/// Where one can measure.
struct Place {
  std::string name;
  DeviationQuery query;
  bool is_new = false;  ///< nothing has been measured there
};

std::vector<Place> placesOf(const DiscrepancyInput& input, const ResidualProblem& problem) {
  std::vector<Place> all;
  std::set<std::string> seen;
  for (const DeviationQuery& q : problem.place) {
    if (seen.insert(q.point).second) all.push_back({q.point, q, false});
  }
  // Of very many those that are far from each other.
  std::vector<Place> places;
  std::vector<double> distance(all.size(), std::numeric_limits<double>::infinity());
  std::size_t next = 0;
  while (places.size() < std::min(all.size(), most_measured_places)) {
    places.push_back(all[next]);
    for (std::size_t i = 0; i < all.size(); ++i) {
      distance[i] = std::min(distance[i], (all[i].query.position_mm - all[next].query.position_mm).norm());
    }
    distance[next] = -1.0;
    next = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin());
  }
  DeviationQuery pattern = all.empty() ? DeviationQuery{} : all.front().query;
  const auto add = [&](const std::string& name, const Eigen::Vector3d& at) {
    const bool taken = std::any_of(all.begin(), all.end(), [&](const Place& p) {
      return p.name == name || (p.query.position_mm - at).norm() < 1.0;
    });
    if (taken) return;
    Place place{name, pattern, true};
    place.query.point = name;
    place.query.position_mm = at;
    places.push_back(place);
  };
  for (const MachinePoint& point : input.machine.points) add(point.id, point.position_mm);
  const auto travel = [&](char letter) { return input.machine.findAxis(std::string(1, letter)); };
  const LinearAxis* x = travel('X');
  const LinearAxis* y = travel('Y');
  const LinearAxis* z = travel('Z');
  if (x == nullptr || y == nullptr || z == nullptr) return places;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d at(x->travel_mm[corner & 1U], y->travel_mm[(corner >> 1U) & 1U],
                             z->travel_mm[(corner >> 2U) & 1U]);
    add(fmt::format("({:.0f}, {:.0f}, {:.0f}) mm", at.x(), at.y(), at.z()), at);
  }
  return places;
}

/// What stays the same whatever programme is run.
class Planner {
 public:
  Planner(const DiscrepancyInput& input, const DriverTable& drivers, const ResidualProblem& problem,
          const Question& question, const DiscrepancyOptions& options, const DiscrepancyPriors& priors)
      : input_(&input),
        drivers_(&drivers),
        question_(&question),
        sensors_(drivers),
        places_(placesOf(input, problem)),
        model_error_(priors.model_error) {
    const auto allowed = static_cast<std::size_t>(options.suggest_times);
    const std::size_t steps = coarse_times * std::clamp<std::size_t>((2 * allowed) / coarse_times + 1, 4, 20);
    for (std::size_t i = 0; i <= steps; ++i) {
      times_s_.push_back(
          std::round(3600.0 * options.suggest_hours * static_cast<double>(i) / static_cast<double>(steps)));
    }
    for (std::size_t i = 0; i <= steps; i += steps / coarse_times) coarse_.push_back(i);
    // Components that were measured, and how well one reading tells them.
    std::map<Component, std::pair<double, double>> sums;
    for (Index u = 0; u < problem.size(); ++u) {
      auto& [sum, count] = sums[problem.component[static_cast<std::size_t>(u)]];
      sum += problem.reading_sigma[u];
      count += 1.0;
    }
    for (const auto& [component, sum] : sums) {
      const ComponentNoise& n = problem.noise.of(component);
      components_.push_back(component);
      DesignNoise noise;
      noise.own = sum.first / sum.second * n.scale;
      // What a reading of heavy tails tells, as one of normal noise (Lange, Little and Taylor 1989).
      if (n.tail_dof > 0.0) noise.own *= std::sqrt((n.tail_dof + 3.0) / (n.tail_dof + 1.0));
      noise.common = n.common;
      noise.correlated_part = n.correlated_part;
      noise.correlation_time_s = n.correlation_time_s;
      noise_.push_back(noise);
    }
    Eigen::Vector3d low = Eigen::Vector3d::Constant(2.0);
    Eigen::Vector3d high = -low;
    std::set<double> angles;
    for (const DeviationQuery& q : problem.place) {
      low = low.cwiseMin(q.approach);
      high = high.cwiseMax(q.approach);
      if (angles.size() < 12) angles.insert(q.c_deg);
    }
    for (int axis = 0; axis < 3; ++axis) both_sides_[static_cast<std::size_t>(axis)] = high[axis] > low[axis];
    if (angles.size() > 1) angles_deg_.assign(angles.begin(), angles.end());
    Index first = 0;
    for (const Candidate& c : question.candidates) {
      design_.push_back({c.group, c.probability, first, c.root.cols()});
      first += c.root.cols() + 1;
    }
    columns_ = first;
  }

  [[nodiscard]] const std::vector<Place>& places() const { return places_; }
  [[nodiscard]] const std::vector<std::size_t>& coarse() const { return coarse_; }
  [[nodiscard]] double angleAt(std::size_t time) const { return angles_deg_[mixed(time) % angles_deg_.size()]; }
  [[nodiscard]] bool turns() const { return !angles_deg_.empty(); }

  /// What all candidates predict while a programme runs.
  [[nodiscard]] MeasurementDesign design(const PlannedProgramme& programme) const {
    const DriverTable planned = plannedDrivers(*input_, *drivers_, sensors_, programme);
    const auto n = static_cast<Index>(times_s_.size());
    std::vector<std::vector<Eigen::MatrixXd>> predicted(components_.size(),
                                                        std::vector<Eigen::MatrixXd>(places_.size()));
    std::vector<DesignNoise> noise = noise_;
    const auto count = static_cast<Index>(question_->candidates.size());
    for (DesignNoise& one : noise) one.misfit = Eigen::MatrixXd::Zero(n, count);
    for (Index k = 0; k < count; ++k) {
      const Candidate& candidate = question_->candidates[static_cast<std::size_t>(k)];
      addCandidate(candidate, design_[static_cast<std::size_t>(k)].first, planned, predicted);
      const Index m = design_[static_cast<std::size_t>(k)].first + candidate.root.cols();
      for (std::size_t c = 0; c < components_.size(); ++c) {
        double measured = 0.0;
        Eigen::VectorXd power = Eigen::VectorXd::Zero(n);
        for (std::size_t p = 0; p < places_.size(); ++p) {
          if (places_[p].is_new) continue;
          measured += 1.0;
          if (predicted[c][p].size() == 0) continue;
          const Eigen::VectorXd course = predicted[c][p].col(m).array() - predicted[c][p](0, m);
          power += course.cwiseAbs2();
        }
        noise[c].misfit.col(k) =
            model_error_ * std::sqrt(candidate.probability / std::max(1.0, measured)) * power.cwiseSqrt();
      }
    }
    return MeasurementDesign(design_, times_s_, std::move(noise), std::move(predicted));
  }

 private:
  void addCandidate(const Candidate& candidate, Index first, const DriverTable& planned,
                    std::vector<std::vector<Eigen::MatrixXd>>& predicted) const {
    const auto n = static_cast<Index>(times_s_.size());
    struct Term {
      Eigen::MatrixXd response;
      std::vector<Eigen::MatrixXd> derivative;
    };
    std::vector<Term> terms;
    for (const ModelTerm& term : candidate.fit.terms) {
      Term made;
      made.response = plannedResponses(planned, term.variant, term.parameters, times_s_);
      for (std::size_t p = 0; p < term.parameters.size(); ++p) {
        std::vector<double> moved = term.parameters;
        const double step = std::max(60.0, 0.1 * moved[p]);
        moved[p] += step;
        made.derivative.push_back((plannedResponses(planned, term.variant, moved, times_s_) - made.response) / step);
      }
      terms.push_back(std::move(made));
    }
    Eigen::MatrixXd raw(n, candidate.root.rows());
    for (std::size_t c = 0; c < components_.size(); ++c) {
      for (std::size_t p = 0; p < places_.size(); ++p) {
        raw.setZero();
        Eigen::VectorXd value = Eigen::VectorXd::Zero(n);
        bool moves = false;
        Index at = 0;
        for (std::size_t t = 0; t < terms.size(); ++t) {
          const Effect& effect = *candidate.fit.terms[t].effect;
          const Eigen::VectorXd& gains = candidate.fit.gains[t];
          const Eigen::MatrixXd& response = terms[t].response;
          const auto k = static_cast<Index>(effect.shape.size());
          const Index gain_count = response.cols() * k;
          for (Index s = 0; s < k; ++s) {
            const Eigen::VectorXd shape = shapeOf(effect.shape[static_cast<std::size_t>(s)], p, components_[c]);
            if (shape.isZero(0.0)) continue;
            moves = true;
            for (Index i = 0; i < response.cols(); ++i) {
              raw.col(at + i * k + s) = shape.cwiseProduct(response.col(i));
              value += gains[i * k + s] * raw.col(at + i * k + s);
              for (std::size_t d = 0; d < terms[t].derivative.size(); ++d) {
                raw.col(at + gain_count + static_cast<Index>(d)) +=
                    gains[i * k + s] * shape.cwiseProduct(terms[t].derivative[d].col(i));
              }
            }
          }
          at += gain_count + static_cast<Index>(terms[t].derivative.size());
        }
        if (!moves) continue;
        Eigen::MatrixXd& target = predicted[c][p];
        if (target.size() == 0) target = Eigen::MatrixXd::Zero(n, columns_);
        target.middleCols(first, candidate.root.cols()) = raw * candidate.root;
        target.col(first + candidate.root.cols()) = value;
      }
    }
  }

  /// Angles and sides must not repeat with any choice of times.
  static std::size_t mixed(std::size_t time) { return ((time + 1) * 2654435761U >> 13U) % 1009; }

  /// At every time: approached from one of both sides and at one of all angles of the table, where that was done
  /// before.
  [[nodiscard]] Eigen::VectorXd shapeOf(const ShapeColumn& column, std::size_t place, Component component) const {
    DeviationQuery q = places_[place].query;
    const auto n = static_cast<Index>(times_s_.size());
    if (!turns() && !both_sides_[0] && !both_sides_[1] && !both_sides_[2]) {
      return Eigen::VectorXd::Constant(n, column.value(q, component));
    }
    Eigen::VectorXd out(n);
    for (Index i = 0; i < n; ++i) {
      const auto time = static_cast<std::size_t>(i);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (both_sides_[axis]) q.approach[static_cast<Index>(axis)] = (mixed(time) >> axis) % 2 == 0 ? 1.0 : -1.0;
      }
      if (turns()) q.c_deg = angleAt(time);
      out[i] = column.value(q, component);
    }
    return out;
  }

  const DiscrepancyInput* input_;
  const DriverTable* drivers_;
  const Question* question_;
  SensorResponses sensors_;
  std::vector<Place> places_;
  double model_error_;
  std::vector<double> times_s_;
  std::vector<std::size_t> coarse_;
  std::vector<Component> components_;
  std::vector<DesignNoise> noise_;
  std::array<bool, 3> both_sides_{};
  std::vector<double> angles_deg_;
  std::vector<DesignCandidate> design_;
  Index columns_ = 0;
};

/// Logarithm of what remains unknown: what one more reading adds shows also where little is left.
double leftUnknown(const MeasurementDesign& design, const std::vector<std::size_t>& places,
                   const std::vector<std::size_t>& times) {
  return std::log(std::max(1e-30, design.remainingEntropy(design.gram(places, times))));
}

/// Adds points one by one, then exchanges them.
std::pair<std::vector<std::size_t>, double> choosePlaces(const MeasurementDesign& design,
                                                         const std::vector<Place>& places,
                                                         const std::vector<std::size_t>& times, std::size_t most) {
  const auto valueOf = [&](const std::vector<std::size_t>& chosen) {
    double value = leftUnknown(design, chosen, times);
    for (const std::size_t p : chosen) value += places[p].is_new ? new_place_price : 0.0;
    return value;
  };
  std::vector<std::size_t> chosen;
  double best = std::numeric_limits<double>::infinity();
  const auto holds = [&](std::size_t p) { return std::find(chosen.begin(), chosen.end(), p) != chosen.end(); };
  while (chosen.size() < std::min(most, places.size())) {
    double lowest = std::numeric_limits<double>::infinity();
    std::size_t next = places.size();
    for (std::size_t p = 0; p < places.size(); ++p) {
      if (holds(p)) continue;
      std::vector<std::size_t> trial = chosen;
      trial.push_back(p);
      const double value = valueOf(trial);
      if (value < lowest) {
        lowest = value;
        next = p;
      }
    }
    if (next == places.size()) break;
    chosen.push_back(next);
    best = lowest;
  }
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    for (std::size_t p = 0; p < places.size(); ++p) {
      if (holds(p)) continue;
      std::vector<std::size_t> trial = chosen;
      trial[i] = p;
      const double value = valueOf(trial);
      if (value < best - 1e-3) {
        best = value;
        chosen = trial;
      }
    }
  }
  return {chosen, best};
}

/// The start, so that everything has a reference, then the times that add most.
std::vector<std::size_t> chooseTimes(const MeasurementDesign& design, const std::vector<std::size_t>& places,
                                     std::size_t most, const JobContext& job) {
  const std::size_t all = design.times().size();
  std::vector<std::size_t> chosen{0};
  while (chosen.size() < std::min(most, all)) {
    std::vector<double> values(all, std::numeric_limits<double>::infinity());
    parallelFor(all, job, [&](std::size_t i) {
      if (std::find(chosen.begin(), chosen.end(), i) != chosen.end()) return;
      std::vector<std::size_t> trial = chosen;
      trial.push_back(i);
      values[i] = leftUnknown(design, places, trial);
    });
    chosen.push_back(static_cast<std::size_t>(std::min_element(values.begin(), values.end()) - values.begin()));
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

std::string durationText(double seconds) {
  const auto minutes = static_cast<int>(std::lround(seconds / 60.0));
  if (minutes < 60) return fmt::format("{} min", minutes);
  if (minutes % 60 == 0) return fmt::format("{} h", minutes / 60);
  return fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

/// "After a night at rest run X alone at 12 m/min for 2 h, then rest for 1 h; measure F3 and F9 at the start and after
/// 0:20 and 0:40 (h:min)"
std::string planSentence(const MeasurementSuggestion& s) {
  std::string text = "After a night at rest";
  if (s.restart_instrument) text += ", with the instrument off until the start,";
  bool first = true;
  for (const ProgrammeStep& step : s.programme) {
    const std::string duration = durationText(step.to_s - step.from_s);
    text += first ? " " : ", then ";
    if (step.action == "rest") {
      text += first ? fmt::format("leave everything at rest for {}", duration) : fmt::format("rest for {}", duration);
    } else {
      text += fmt::format("run {} for {}", step.action, duration);
    }
    first = false;
  }
  std::vector<std::string> after;
  for (const double t : s.times_s) {
    const auto minutes = static_cast<int>(std::lround(t / 60.0));
    if (minutes > 0) after.push_back(fmt::format("{}:{:02}", minutes / 60, minutes % 60));
  }
  text += fmt::format("; measure {} at the start and after {} (h:min)", joinedList(s.points), joinedList(after));
  if (!s.c_deg.empty()) text += ", with the table at its angles in turn";
  return text;
}

}  // namespace

std::optional<MeasurementSuggestion> suggestMeasurement(const DiscrepancyInput& input, const DriverTable& drivers,
                                                        const EffectSearch& search, const ResidualProblem& problem,
                                                        const EffectPosterior& posterior,
                                                        const std::vector<std::string>& ambiguous,
                                                        const DiscrepancyOptions& options,
                                                        const DiscrepancyPriors& priors, const JobContext& job) {
  if (problem.size() == 0 || !input.log || input.log->empty() || drivers.empty()) return std::nullopt;
  const Question question = questionOf(search, problem, posterior, ambiguous, job);
  if (question.groups.size() < 2 || question.separates.empty()) return std::nullopt;
  const Planner planner(input, drivers, problem, question, options, priors);
  ProgrammeQuestion asked;
  asked.hours = options.suggest_hours;
  for (const Candidate& c : question.candidates) {
    for (const ModelTerm& term : c.fit.terms) {
      for (const EffectInput& i : term.variant.inputs) {
        asked.instrument = asked.instrument || i.driver.starts_with("instrument_on");
        asked.positions = asked.positions || i.driver.find("*pos_") != std::string::npos;
      }
    }
  }
  const std::vector<PlannedProgramme> programmes = possibleProgrammes(input, asked);
  std::vector<std::size_t> measured;
  for (std::size_t p = 0; p < planner.places().size(); ++p) {
    if (!planner.places()[p].is_new) measured.push_back(p);
  }
  std::vector<std::pair<double, std::size_t>> scores(programmes.size());
  parallelFor(programmes.size(), job, [&](std::size_t i) {
    const MeasurementDesign design = planner.design(programmes[i]);
    scores[i] = {leftUnknown(design, measured, planner.coarse()), i};
  });
  std::stable_sort(scores.begin(), scores.end());
  struct Trial {
    std::vector<std::size_t> places;
    double value = std::numeric_limits<double>::infinity();
  };
  std::vector<Trial> trials(std::min(programmes_in_earnest, scores.size()));
  parallelFor(trials.size(), job, [&](std::size_t i) {
    const MeasurementDesign design = planner.design(programmes[scores[i].second]);
    std::tie(trials[i].places, trials[i].value) =
        choosePlaces(design, planner.places(), planner.coarse(), static_cast<std::size_t>(options.suggest_points));
  });
  const auto best = static_cast<std::size_t>(
      std::min_element(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) { return a.value < b.value; }) -
      trials.begin());
  const PlannedProgramme& programme = programmes[scores[best].second];
  const MeasurementDesign design = planner.design(programme);
  const std::vector<std::size_t> times =
      chooseTimes(design, trials[best].places, static_cast<std::size_t>(options.suggest_times), job);
  const Eigen::MatrixXd gram = design.gram(trials[best].places, times);
  const double before = design.entropy();
  const double after = design.remainingEntropy(gram);
  if (!std::isfinite(after) || after > least_informative * before) return std::nullopt;

  MeasurementSuggestion out;
  std::vector<std::size_t> places = trials[best].places;
  std::sort(places.begin(), places.end());
  for (const std::size_t p : places) out.points.push_back(planner.places()[p].name);
  for (const std::size_t t : times) {
    out.times_s.push_back(design.times()[t]);
    if (planner.turns()) out.c_deg.push_back(planner.angleAt(t));
  }
  out.programme = programme.steps;
  out.restart_instrument = programme.restart_instrument;
  std::string separates;
  for (const std::string& part : question.separates) separates += (separates.empty() ? "" : "; ") + part;
  out.separates = separates;
  std::size_t rival = 0;
  std::map<int, double> groups;
  for (std::size_t i = 0; i < question.candidates.size(); ++i) {
    const Candidate& c = question.candidates[i];
    groups[c.group] += c.probability;
    if (c.group == 1 && rival == 0) rival = i;
  }
  for (const auto& [group, p] : groups) out.probability_alone_now = std::max(out.probability_alone_now, p);
  out.expected_information_nats = std::max(0.0, before - after);
  out.present_entropy_nats = before;
  out.probability_alone_expected = design.probabilityAlone(gram, least_suggested_rival, draws, 1);
  // A fit that the data at hand do not determine elsewhere promises anything.
  constexpr double most_believable = 1e5;
  out.expected_delta_bic = std::min(most_believable, design.expectedEvidence(gram, 0, rival));
  out.conditions = planSentence(out);
  return out;
}

}  // namespace spindrift
