// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/text.h"
#include "core/discrepancy/suggestion.h"

namespace spindrift {
namespace {

using Eigen::Index;

double valueAt(const JointFit& fit, const DeviationQuery& query, Component component, std::size_t time_index,
               const std::vector<Eigen::MatrixXd>& responses) {
  double sum = 0.0;
  for (std::size_t t = 0; t < fit.terms.size(); ++t) {
    const Effect& effect = *fit.terms[t].effect;
    const auto k = static_cast<Index>(effect.shape.size());
    for (Index c = 0; c < k; ++c) {
      const double shape = effect.shape[static_cast<std::size_t>(c)].value(query, component);
      if (shape == 0.0) continue;
      for (Index i = 0; i < responses[t].cols(); ++i) {
        sum += shape * responses[t](static_cast<Index>(time_index), i) * fit.gains[t][i * k + c];
      }
    }
  }
  return sum;
}

/// How the prediction of a fit changes with its gains and non-linear parameters, and what the data at hand know of
/// them.
class Tangent {
 public:
  Tangent(const EffectSearch& search, const ResidualProblem& problem, const JointFit& fit) {
    std::vector<Eigen::MatrixXd> parts;
    for (std::size_t t = 0; t < fit.terms.size(); ++t) {
      const Eigen::MatrixXd x = search.columns(fit.terms[t]);
      Eigen::MatrixXd part(x.rows(), x.cols() + static_cast<Index>(fit.terms[t].parameters.size()));
      part.leftCols(x.cols()) = x;
      for (std::size_t p = 0; p < fit.terms[t].parameters.size(); ++p) {
        const auto [term, step] = moved(fit.terms[t], p);
        part.col(x.cols() + static_cast<Index>(p)) = (search.columns(term) - x) * fit.gains[t] / step;
      }
      parameters_ += part.cols();
      parts.push_back(std::move(part));
    }
    Eigen::MatrixXd all(problem.size(), parameters_);
    Index at = 0;
    for (const Eigen::MatrixXd& part : parts) {
      all.middleCols(at, part.cols()) = part;
      at += part.cols();
    }
    const Eigen::MatrixXd x = problem.projected(all);
    information_ = x.transpose() * x;
  }

  [[nodiscard]] Index parameters() const { return parameters_; }
  [[nodiscard]] const Eigen::MatrixXd& information() const { return information_; }

  /// The responses after a small change of every non-linear parameter, term by term.
  using Moved = std::vector<std::vector<std::pair<Eigen::MatrixXd, double>>>;
  [[nodiscard]] static Moved movedResponses(const DriverTable& drivers, const JointFit& fit,
                                            const std::vector<double>& times) {
    Moved out;
    for (const ModelTerm& term : fit.terms) {
      auto& responses = out.emplace_back();
      for (std::size_t p = 0; p < term.parameters.size(); ++p) {
        const auto [changed, step] = moved(term, p);
        responses.emplace_back(inputResponses(drivers, changed.variant, changed.parameters, times), step);
      }
    }
    return out;
  }

  [[nodiscard]] Eigen::RowVectorXd row(const JointFit& fit, const DeviationQuery& query, Component component,
                                       std::size_t time_index, const std::vector<Eigen::MatrixXd>& responses,
                                       const Moved& moved_responses) const {
    Eigen::RowVectorXd out = Eigen::RowVectorXd::Zero(parameters_);
    const auto at_time = static_cast<Index>(time_index);
    Index at = 0;
    for (std::size_t t = 0; t < fit.terms.size(); ++t) {
      const Effect& effect = *fit.terms[t].effect;
      const auto k = static_cast<Index>(effect.shape.size());
      const Index gains = responses[t].cols() * k;
      for (Index c = 0; c < k; ++c) {
        const double shape = effect.shape[static_cast<std::size_t>(c)].value(query, component);
        if (shape == 0.0) continue;
        for (Index i = 0; i < responses[t].cols(); ++i) {
          out[at + i * k + c] = shape * responses[t](at_time, i);
          for (std::size_t p = 0; p < moved_responses[t].size(); ++p) {
            const auto& [response, step] = moved_responses[t][p];
            out[at + gains + static_cast<Index>(p)] +=
                shape * fit.gains[t][i * k + c] * (response(at_time, i) - responses[t](at_time, i)) / step;
          }
        }
      }
      at += gains + static_cast<Index>(moved_responses[t].size());
    }
    return out;
  }

 private:
  static std::pair<ModelTerm, double> moved(const ModelTerm& term, std::size_t p) {
    ModelTerm out = term;
    const double step = std::max(30.0, 0.05 * std::abs(term.parameters[p]));
    out.parameters[p] += step;
    return {out, step};
  }

  Index parameters_ = 0;
  Eigen::MatrixXd information_;
};

/// One component at one place over all candidate times, in units of sigma.
struct SuggestedSeries {
  Eigen::VectorXd difference;
  Eigen::MatrixXd tangent;
};

/// Chi-squared by which the first fit would be ahead after measuring at these times and fitting the second again.
double expectedGain(const std::vector<SuggestedSeries>& series, const std::vector<std::size_t>& times,
                    const Eigen::MatrixXd& information) {
  const auto n = static_cast<Index>(times.size());
  const Index m = information.cols();
  double power = 0.0;
  Eigen::MatrixXd known = information;
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(m);
  for (const SuggestedSeries& s : series) {
    Eigen::VectorXd d(n);
    Eigen::MatrixXd j(n, m);
    for (Index i = 0; i < n; ++i) {
      d[i] = s.difference[static_cast<Index>(times[static_cast<std::size_t>(i)])];
      j.row(i) = s.tangent.row(static_cast<Index>(times[static_cast<std::size_t>(i)]));
    }
    d.array() -= d.mean();
    j.rowwise() -= j.colwise().mean().eval();
    power += d.squaredNorm();
    known.noalias() += j.transpose() * j;
    pull.noalias() += j.transpose() * d;
  }
  if (m == 0) return power;
  const Eigen::VectorXd scale = known.diagonal().cwiseMax(1e-30).cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd scaled = scale.asDiagonal() * known * scale.asDiagonal();
  scaled.diagonal().array() += 1e-9;
  const Eigen::VectorXd b = scale.cwiseProduct(pull);
  return std::max(0.0, power - b.dot(scaled.ldlt().solve(b)));
}

}  // namespace

std::optional<MeasurementSuggestion> suggestMeasurement(const DiscrepancyInput& input, const DriverTable& drivers,
                                                        const EffectSearch& search, const ResidualProblem& problem,
                                                        const JointFit& first, const JointFit& second,
                                                        const std::string& separates, double log_n) {
  if (problem.size() == 0) return std::nullopt;
  // Candidate times: the whole log, in 96 steps; candidate places: the points measured and the corners of the travel.
  double start = problem.node_time_s.front();
  double end = problem.node_time_s.back();
  if (!drivers.empty()) {
    start = std::min(start, drivers.time_s().front());
    end = std::max(end, drivers.time_s().back());
  }
  std::vector<double> times;
  for (int i = 0; i <= 96; ++i) times.push_back(start + (end - start) * i / 96.0);
  const auto responsesOf = [&](const JointFit& fit) {
    std::vector<Eigen::MatrixXd> out;
    for (const ModelTerm& term : fit.terms)
      out.push_back(inputResponses(drivers, term.variant, term.parameters, times));
    return out;
  };
  const auto first_responses = responsesOf(first);
  const auto second_responses = responsesOf(second);
  const auto moved_responses = Tangent::movedResponses(drivers, second, times);
  struct Place {
    std::string name;
    DeviationQuery query;
  };
  std::vector<Place> places;
  std::set<std::string> seen;
  for (const DeviationQuery& q : problem.place) {
    if (seen.insert(q.point).second) places.push_back({q.point, q});
  }
  const auto travel = [&](char letter) -> const LinearAxis* {
    for (const LinearAxis& a : input.machine.axes) {
      if (!a.name.empty() && a.name[0] == letter) return &a;
    }
    return nullptr;
  };
  if (const LinearAxis* x = travel('X'), *y = travel('Y'), *z = travel('Z');
      x != nullptr && y != nullptr && z != nullptr) {
    for (int corner = 0; corner < 8; ++corner) {
      Place p;
      p.query.position_mm = {x->travel_mm[static_cast<std::size_t>(corner & 1)],
                             y->travel_mm[static_cast<std::size_t>((corner >> 1) & 1)],
                             z->travel_mm[static_cast<std::size_t>((corner >> 2) & 1)]};
      p.name = fmt::format("({:.0f}, {:.0f}, {:.0f}) mm", p.query.position_mm.x(), p.query.position_mm.y(),
                           p.query.position_mm.z());
      p.query.point = p.name;
      places.push_back(p);
    }
  }
  std::map<Component, double> sigmas;
  std::map<Component, int> counts;
  for (Index u = 0; u < problem.size(); ++u) {
    sigmas[problem.component[static_cast<std::size_t>(u)]] += problem.sigma[u];
    ++counts[problem.component[static_cast<std::size_t>(u)]];
  }
  // What a place gives in one run over the times: the difference of the two fits, less what the second could take up by
  // other gains and lags (its tangent), given what is known from the data at hand, and less a constant per series.
  const Tangent tangent(search, problem, second);
  struct Value {
    double power = 0.0;
    std::size_t place = 0;
  };
  const auto seriesOf = [&](std::size_t place) {
    std::vector<SuggestedSeries> out;
    for (auto& [component, sum] : sigmas) {
      SuggestedSeries s;
      const double sigma = sum / counts[component] * problem.noise.of(component).scale;
      s.difference.resize(static_cast<Index>(times.size()));
      s.tangent.resize(static_cast<Index>(times.size()), tangent.parameters());
      for (std::size_t t = 0; t < times.size(); ++t) {
        DeviationQuery q = places[place].query;
        q.time_s = times[t];
        const auto row = static_cast<Index>(t);
        s.difference[row] =
            (valueAt(first, q, component, t, first_responses) - valueAt(second, q, component, t, second_responses)) /
            sigma;
        s.tangent.row(row) = tangent.row(second, q, component, t, second_responses, moved_responses) / sigma;
      }
      out.push_back(std::move(s));
    }
    return out;
  };
  std::vector<std::size_t> every(times.size());
  for (std::size_t i = 0; i < every.size(); ++i) every[i] = i;
  std::vector<Value> values;
  std::vector<std::vector<SuggestedSeries>> series(places.size());
  for (std::size_t p = 0; p < places.size(); ++p) {
    series[p] = seriesOf(p);
    values.push_back({expectedGain(series[p], every, tangent.information()), p});
  }
  std::stable_sort(values.begin(), values.end(), [](const Value& a, const Value& b) { return a.power > b.power; });
  const std::size_t best_places = std::min<std::size_t>(3, values.size());
  std::vector<SuggestedSeries> best;
  for (std::size_t p = 0; p < best_places; ++p) {
    for (const SuggestedSeries& s : series[values[p].place]) best.push_back(s);
  }
  // Times one by one, each the one that adds most to those before it. A single time tells nothing beside a free
  // constant, so the first two are found together, on a coarse grid.
  std::vector<std::size_t> chosen;
  double expected = -1.0;
  for (std::size_t i = 0; i < times.size(); i += 4) {
    for (std::size_t j = i + 4; j < times.size(); j += 4) {
      const double gain = expectedGain(best, {i, j}, tangent.information());
      if (gain > expected) {
        expected = gain;
        chosen = {i, j};
      }
    }
  }
  while (chosen.size() < 8) {
    std::size_t next = times.size();
    double largest = expected;
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (std::find(chosen.begin(), chosen.end(), i) != chosen.end()) continue;
      std::vector<std::size_t> trial = chosen;
      trial.push_back(i);
      const double gain = expectedGain(best, trial, tangent.information());
      if (gain > largest) {
        largest = gain;
        next = i;
      }
    }
    if (next == times.size()) break;
    expected = largest;
    chosen.push_back(next);
  }
  const std::size_t clearest = chosen.empty() ? 0 : chosen.front();
  MeasurementSuggestion out;
  if (!(expected > 0.0) || !std::isfinite(expected)) return std::nullopt;
  // So often that the evidence becomes clear (a difference of 20), at most 20 times.
  const double wanted = 20.0 + log_n;
  const int repeats = static_cast<int>(std::clamp(std::ceil(wanted / expected), 1.0, 20.0));
  std::sort(chosen.begin(), chosen.end());
  for (const std::size_t i : chosen) out.times_s.push_back(times[i]);
  for (std::size_t p = 0; p < best_places; ++p) out.points.push_back(places[values[p].place].name);
  out.expected_delta_bic = expected * repeats;
  // A fit that the data at hand do not determine elsewhere promises anything.
  constexpr double most_believable = 1e6;
  if (!(out.expected_delta_bic < most_believable)) return std::nullopt;
  out.separates = separates;
  std::vector<std::string> conditions;
  if (input.log && !input.log->empty()) {
    const double t = times[clearest];
    if (input.log->has("spindle_rpm")) {
      const double rpm = input.log->at("spindle_rpm", t);
      conditions.push_back(rpm > 0.0 ? fmt::format("spindle at {:.0f} rpm", rpm) : std::string("spindle at rest"));
    }
    for (const char* axis : axis_letters) {
      const std::string name = fmt::format("feed_{}_mm_min", axis);
      if (input.log->has(name) && input.log->at(name, t) > 0.0) {
        conditions.push_back(fmt::format("{} moving at {:.0f} mm/min", std::string(1, static_cast<char>(axis[0] - 32)),
                                         input.log->at(name, t)));
      }
    }
    if (input.log->has("coolant"))
      conditions.push_back(input.log->at("coolant", t) > 0.0 ? "coolant on" : "coolant off");
  }
  out.conditions = "run the same programme";
  if (!conditions.empty()) out.conditions += " (at the clearest time: " + joinedList(conditions) + ")";
  if (repeats > 1) out.conditions += fmt::format(", {} readings at every time", repeats);
  return out;
}

}  // namespace spindrift
