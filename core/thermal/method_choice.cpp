// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/method_choice.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/math/distributions.h"
#include "core/math/least_squares.h"
#include "core/math/statistics.h"
#include "core/thermal/response_dictionary.h"

namespace spindrift {
namespace {

using Eigen::Index;
using namespace response;

constexpr double negligible_weight = 0.01;  ///< of the largest: such candidates are left out of the average
constexpr std::size_t all_sets_up_to = 4;   ///< inputs: every set of them is tried

/// One fit on a part of the training range and free run over the rest. Normal matrices of (1, features, y).
struct Run {
  Eigen::MatrixXd fit;
  Eigen::MatrixXd fit_whitened;
  Eigen::MatrixXd held;
  std::vector<Index> held_rows;
};

enum class Method { Line, FewLags, Ridge, Response };

struct Candidate {
  Method method = Method::Line;
  std::vector<Index> columns;  ///< of the dictionary
  Eigen::VectorXd precision;
  std::vector<std::size_t> inputs;  ///< numbers of the usable inputs
  std::vector<double> log_error;    ///< ln of the mean squared error of every run
};

struct Solution {
  Eigen::VectorXd w;        ///< offset, gains of its columns
  Eigen::MatrixXd inverse;  ///< of the regularised normal matrix
};

/// Columns of the response dictionary with this exponent of speed.
std::vector<Index> responseColumns(const Dictionary& d, double power, const std::vector<double>& taus) {
  std::vector<Index> columns;
  for (std::size_t k = 0; k < d.features.size(); ++k) {
    const Feature& f = d.features[k];
    const ThermalInput& in = d.inputs[static_cast<std::size_t>(f.input)];
    if (isDriven(in.kind) && in.power != power) continue;
    if (std::find(taus.begin(), taus.end(), f.tau_s) != taus.end()) columns.push_back(static_cast<Index>(k));
  }
  return columns;
}

/// Huber weights of the innovations of the middle member of the response, as core/thermal/response_fit.cpp takes them:
/// a slip, or a state at the start that nobody knows, costs a few samples and not the gains.
Eigen::VectorXd robustWeights(const Dictionary& d, const Whitened& w, const ResponseFitOptions& options) {
  const auto middle = [](const std::vector<double>& v) { return v[v.size() / 2]; };
  const std::vector<Index> columns = responseColumns(d, middle(options.speed_powers), options.taus_s);
  const Eigen::VectorXd precision =
      priorPrecision(d, columns, middle(options.strengths), middle(options.slow_preferences), options);
  Eigen::MatrixXd X(w.X.rows(), static_cast<Index>(columns.size()) + 1);
  X.col(0) = w.X.col(0);
  for (std::size_t k = 0; k < columns.size(); ++k) X.col(static_cast<Index>(k) + 1) = w.X.col(columns[k] + 1);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(d.y.size());
  for (int round = 0; round < 2; ++round) {
    Eigen::MatrixXd A = X.transpose() * weights.asDiagonal() * X;
    A.diagonal().tail(precision.size()) += precision;
    const Eigen::VectorXd e = w.y - X * A.ldlt().solve(X.transpose() * weights.asDiagonal() * w.y);
    const double sigma = robustSigma(std::vector<double>(e.data(), e.data() + e.size()));
    if (!(sigma > 0.0)) break;
    for (Index i = 0; i < e.size(); ++i) weights[i] = huberWeight(e[i] / sigma, 3.0);
  }
  return weights;
}

class Evidence {
 public:
  Evidence(const Dictionary& d, const MethodChoiceOptions& options) : d_(d) {
    const Index n = d.y.size();
    const Index p = d.X.cols();
    rows_.resize(n, p + 2);
    rows_.col(0).setOnes();
    rows_.middleCols(1, p) = d.X;
    rows_.col(p + 1) = d.y.array() - d.y_mean;
    Whitened w = whiten(d, options.response.noise_tau_s);
    const Eigen::VectorXd root = robustWeights(d, w, options.response).cwiseSqrt();
    w.X = root.asDiagonal() * w.X;
    w.y = root.asDiagonal() * w.y;
    whitened_.resize(n, p + 2);
    whitened_.leftCols(p + 1) = w.X;
    whitened_.col(p + 1) = w.y;
    all_ = rows_.transpose() * rows_;
    all_whitened_ = whitened_.transpose() * whitened_;
    // Nothing is known better than to a hundredth of the course.
    floor_ = 1e-4 * all_(p + 1, p + 1) / static_cast<double>(n);
    const double first = d.time_s.front();
    const double span = d.time_s.back() - first;
    for (const double part : options.origins) add([&](std::size_t i) { return d.time_s[i] >= first + part * span; });
    for (int b = 0; b < d.blocks; ++b) add([&](std::size_t i) { return d.block[i] == b; });
  }

  [[nodiscard]] const std::vector<Run>& runs() const { return runs_; }
  [[nodiscard]] double sumOfSquares(Index column) const { return all_(column + 1, column + 1); }
  [[nodiscard]] const Eigen::MatrixXd& rows() const { return rows_; }
  [[nodiscard]] double floor() const { return floor_; }

  /// `run` null: all of training.
  [[nodiscard]] Solution solve(const Candidate& c, const Run* run, bool with_inverse) const {
    const bool white = c.method == Method::Response;  // the others have no model of a drifting zero
    const Eigen::MatrixXd& gram =
        run == nullptr ? (white ? all_whitened_ : all_) : (white ? run->fit_whitened : run->fit);
    const auto n = static_cast<Index>(c.columns.size()) + 1;
    Eigen::MatrixXd A(n, n);
    Eigen::VectorXd b(n);
    const auto at = [&](Index k) { return k == 0 ? Index{0} : c.columns[static_cast<std::size_t>(k - 1)] + 1; };
    for (Index r = 0; r < n; ++r) {
      b[r] = gram(at(r), gram.cols() - 1);
      for (Index k = 0; k < n; ++k) A(r, k) = gram(at(r), at(k));
      if (r > 0) A(r, r) += c.precision[r - 1];
    }
    const Eigen::LDLT<Eigen::MatrixXd> ldlt(A);
    Solution s;
    s.w = ldlt.solve(b);
    if (with_inverse) s.inverse = ldlt.solve(Eigen::MatrixXd::Identity(n, n));
    return s;
  }

  /// Coefficients over all columns of the dictionary, offset first.
  [[nodiscard]] Eigen::VectorXd spread(const Candidate& c, const Eigen::VectorXd& w) const {
    Eigen::VectorXd full = Eigen::VectorXd::Zero(rows_.cols() - 1);
    full[0] = w[0];
    for (std::size_t k = 0; k < c.columns.size(); ++k) full[c.columns[k] + 1] = w[static_cast<Index>(k) + 1];
    return full;
  }

  /// Of the candidate with the best score, from the whitened rows.
  [[nodiscard]] double innovationVariance(const std::vector<Candidate>& candidates) const;

  void judge(Candidate& c) const {
    c.log_error.clear();
    for (const Run& run : runs_) {
      const Eigen::VectorXd w = solve(c, &run, false).w;
      const Index y = run.held.cols() - 1;
      double sum = run.held(y, y);
      const auto n = static_cast<Index>(c.columns.size()) + 1;
      const auto at = [&](Index k) { return k == 0 ? Index{0} : c.columns[static_cast<std::size_t>(k - 1)] + 1; };
      for (Index r = 0; r < n; ++r) {
        sum -= 2.0 * w[r] * run.held(at(r), y);
        for (Index k = 0; k < n; ++k) sum += w[r] * w[k] * run.held(at(r), at(k));
      }
      const double mean_square = std::max(0.0, sum) / static_cast<double>(run.held_rows.size());
      c.log_error.push_back(std::isfinite(mean_square) ? std::log(mean_square + floor_) : 700.0);
    }
  }

 private:
  template <typename Held>
  void add(const Held& held) {
    Run run;
    std::vector<Index> used;
    for (std::size_t i = 0; i < d_.time_s.size(); ++i)
      (held(i) ? run.held_rows : used).push_back(static_cast<Index>(i));
    if (run.held_rows.size() < 5 || used.size() < 20) return;
    const auto gram = [](const Eigen::MatrixXd& rows, const std::vector<Index>& which) {
      const Eigen::MatrixXd part = rows(which, Eigen::all);
      return Eigen::MatrixXd(part.transpose() * part);
    };
    run.fit = gram(rows_, used);
    run.fit_whitened = gram(whitened_, used);
    run.held = gram(rows_, run.held_rows);
    runs_.push_back(std::move(run));
  }

  const Dictionary& d_;
  Eigen::MatrixXd rows_;
  Eigen::MatrixXd whitened_;
  Eigen::MatrixXd all_;
  Eigen::MatrixXd all_whitened_;
  double floor_ = 0.0;
  std::vector<Run> runs_;
};

/// Mean of ln(mean squared error) over the runs but one.
double scoreOf(const Candidate& c, std::ptrdiff_t without = -1) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t r = 0; r < c.log_error.size(); ++r) {
    if (static_cast<std::ptrdiff_t>(r) == without) continue;
    sum += c.log_error[r];
    ++count;
  }
  return sum / std::max(1, count);
}

double Evidence::innovationVariance(const std::vector<Candidate>& candidates) const {
  const auto best = std::min_element(candidates.begin(), candidates.end(),
                                     [](const Candidate& a, const Candidate& b) { return scoreOf(a) < scoreOf(b); });
  if (best == candidates.end()) return 0.0;
  Eigen::VectorXd full(whitened_.cols());
  full.head(full.size() - 1) = spread(*best, solve(*best, nullptr, false).w);
  full[full.size() - 1] = -1.0;
  return std::max(0.0, full.dot(all_whitened_ * full)) / static_cast<double>(whitened_.rows());
}

struct Weighted {
  const Candidate* candidate = nullptr;
  double weight = 0.0;
};

/// The average of candidates by the runs but one. `keep`: which candidates take part.
template <typename Keep>
std::vector<Weighted> weightsOf(const std::vector<Candidate>& candidates, std::ptrdiff_t without,
                                const MethodChoiceOptions& options, const Keep& keep) {
  std::vector<Weighted> out;
  const Candidate* best = nullptr;
  double score = std::numeric_limits<double>::infinity();
  for (const Candidate& c : candidates) {
    if (!keep(c)) continue;
    out.push_back({&c, scoreOf(c, without)});
    if (out.back().weight < score) {
      score = out.back().weight;
      best = &c;
    }
  }
  if (best == nullptr) return out;
  double scatter = 0.0;
  int runs = 0;
  for (std::size_t r = 0; r < best->log_error.size(); ++r) {
    if (static_cast<std::ptrdiff_t>(r) == without) continue;
    scatter += (best->log_error[r] - score) * (best->log_error[r] - score);
    ++runs;
  }
  scatter = std::sqrt(scatter / std::max(1, runs - 1));
  const double sharpness = std::clamp(options.sharpness / std::max(scatter, 1e-6), 1.0, options.sharpest);
  double largest = -std::numeric_limits<double>::infinity();
  for (Weighted& w : out) {
    const double penalty = w.candidate->method == Method::Response
                               ? 0.0
                               : options.input_penalty * static_cast<double>(w.candidate->inputs.size());
    w.weight = -sharpness * w.weight - penalty;
    largest = std::max(largest, w.weight);
  }
  std::erase_if(out, [&](const Weighted& w) { return w.weight < largest + std::log(negligible_weight); });
  double total = 0.0;
  for (Weighted& w : out) total += w.weight = std::exp(w.weight - largest);
  for (Weighted& w : out) w.weight /= total;
  return out;
}

/// Mean of ln(mean squared error) of the average, every run predicted with weights from the other runs only.
template <typename Keep>
double averagedEvidence(const Evidence& evidence, const std::vector<Candidate>& candidates,
                        const MethodChoiceOptions& options, const Keep& keep) {
  double sum = 0.0;
  const std::vector<Run>& runs = evidence.runs();
  for (std::size_t r = 0; r < runs.size(); ++r) {
    Eigen::VectorXd error = Eigen::VectorXd::Zero(evidence.rows().cols());
    for (const Weighted& w : weightsOf(candidates, static_cast<std::ptrdiff_t>(r), options, keep))
      error.head(error.size() - 1) +=
          w.weight * evidence.spread(*w.candidate, evidence.solve(*w.candidate, &runs[r], false).w);
    error[error.size() - 1] = -1.0;
    const double mean_square =
        std::max(0.0, error.dot(runs[r].held * error)) / static_cast<double>(runs[r].held_rows.size());
    sum += std::log(mean_square + evidence.floor());
  }
  return sum / static_cast<double>(runs.size());
}

/// All candidates but `response`, on sets of inputs.
class Candidates {
 public:
  Candidates(const Dictionary& d, const Evidence& evidence, const std::vector<std::string>& names,
             const MethodChoiceOptions& options)
      : d_(d), evidence_(evidence), names_(names), options_(options) {
    std::set<double> powers;
    for (const ThermalInput& input : d.inputs)
      if (isDriven(input.kind)) powers.insert(input.power);
    powers_.assign(powers.begin(), powers.end());
    if (powers_.empty()) powers_.push_back(1.0);
  }

  /// Tries every method on this set; the best score of them.
  double visit(const std::vector<std::size_t>& set) {
    const auto [known, fresh] = visited_.try_emplace(set, std::numeric_limits<double>::infinity());
    if (!fresh) return known->second;
    double best = known->second;
    const bool driven = std::any_of(set.begin(), set.end(), [&](std::size_t i) {
      return std::any_of(d_.inputs.begin(), d_.inputs.end(),
                         [&](const ThermalInput& in) { return in.name == names_[i] && isDriven(in.kind); });
    });
    for (const double power : powers_) {
      if (!driven && power != powers_.front()) continue;
      std::vector<std::vector<Index>> per_input;
      std::vector<Index> still;
      std::vector<Index> dense;
      for (const std::size_t i : set) {
        per_input.push_back(columnsOf(i, power));
        for (const Index k : per_input.back()) {
          dense.push_back(k);
          if (d_.features[static_cast<std::size_t>(k)].tau_s == 0.0) still.push_back(k);
        }
      }
      const bool complete = std::none_of(per_input.begin(), per_input.end(), [](const auto& c) { return c.empty(); });
      if (!complete) continue;
      if (still.size() == set.size()) best = std::min(best, keep(make(Method::Line, still, set, 1e-6)));
      for (const double shrinkage : options_.shrinkages)
        best = std::min(best, keep(make(Method::Ridge, dense, set, shrinkage)));
      if (set.size() <= all_sets_up_to) best = std::min(best, keep(fewLags(per_input, set)));
    }
    visited_[set] = best;
    return best;
  }

  void search(const JobContext& job) {
    const std::size_t count = names_.size();
    if (count <= all_sets_up_to) {
      for (std::size_t mask = 1; mask < (std::size_t{1} << count); ++mask) {
        std::vector<std::size_t> set;
        for (std::size_t i = 0; i < count; ++i)
          if ((mask >> i) & 1U) set.push_back(i);
        visit(set);
      }
      return;
    }
    std::vector<std::size_t> chosen;
    double score = std::numeric_limits<double>::infinity();
    for (int step = 0; step < options_.maximum_inputs && chosen.size() < count; ++step) {
      job.throwIfCancelled();
      std::vector<std::size_t> best_set;
      double best = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < count; ++i) {
        if (std::find(chosen.begin(), chosen.end(), i) != chosen.end()) continue;
        std::vector<std::size_t> trial = chosen;
        trial.push_back(i);
        std::sort(trial.begin(), trial.end());
        const double here = visit(trial);
        if (here < best) {
          best = here;
          best_set = std::move(trial);
        }
      }
      if (best_set.empty() || best > score + options_.input_penalty) break;
      score = std::min(score, best);
      chosen = std::move(best_set);
    }
  }

  /// Sets of inputs among which the runs themselves have chosen; 1 if all sets take part.
  [[nodiscard]] std::size_t setsChosenFrom() const { return names_.size() > all_sets_up_to ? visited_.size() : 1; }

  std::vector<Candidate> all;

 private:
  [[nodiscard]] std::vector<Index> columnsOf(std::size_t input, double power) const {
    std::vector<Index> columns;
    for (std::size_t k = 0; k < d_.features.size(); ++k) {
      const Feature& f = d_.features[k];
      const ThermalInput& in = d_.inputs[static_cast<std::size_t>(f.input)];
      if (in.name != names_[input] || (isDriven(in.kind) && in.power != power)) continue;
      if (std::find(options_.taus_s.begin(), options_.taus_s.end(), f.tau_s) == options_.taus_s.end()) continue;
      columns.push_back(static_cast<Index>(k));
    }
    return columns;
  }

  [[nodiscard]] Candidate make(Method method, std::vector<Index> columns, const std::vector<std::size_t>& set,
                               double shrinkage) const {
    Candidate c;
    c.method = method;
    c.precision.resize(static_cast<Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k)
      c.precision[static_cast<Index>(k)] = shrinkage * evidence_.sumOfSquares(columns[k]);
    c.columns = std::move(columns);
    c.inputs = set;
    evidence_.judge(c);
    return c;
  }

  double keep(Candidate c) {
    const double score = scoreOf(c);
    all.push_back(std::move(c));
    return score;
  }

  /// One time constant per input, one input after the other until none changes.
  [[nodiscard]] Candidate fewLags(const std::vector<std::vector<Index>>& per_input,
                                  const std::vector<std::size_t>& set) const {
    std::vector<Index> now;
    for (const std::vector<Index>& columns : per_input)
      now.push_back(columns[std::min<std::size_t>(2, columns.size() - 1)]);
    Candidate best = make(Method::FewLags, now, set, 1e-6);
    for (int round = 0; round < 4; ++round) {
      bool changed = false;
      for (std::size_t i = 0; i < per_input.size(); ++i) {
        for (const Index column : per_input[i]) {
          if (best.columns[i] == column) continue;
          std::vector<Index> trial = best.columns;
          trial[i] = column;
          Candidate c = make(Method::FewLags, std::move(trial), set, 1e-6);
          if (scoreOf(c) >= scoreOf(best)) continue;
          best = std::move(c);
          changed = true;
        }
      }
      if (!changed) break;
    }
    return best;
  }

  const Dictionary& d_;
  const Evidence& evidence_;
  const std::vector<std::string>& names_;
  const MethodChoiceOptions& options_;
  std::vector<double> powers_;
  std::map<std::vector<std::size_t>, double> visited_;
};

/// The members of core/thermal/response_fit.h on all inputs; their projection onto few is as good.
std::vector<Candidate> responseMembers(const Dictionary& d, const Evidence& evidence,
                                       const MethodChoiceOptions& options) {
  const bool driven =
      std::any_of(d.inputs.begin(), d.inputs.end(), [](const ThermalInput& i) { return isDriven(i.kind); });
  std::vector<Candidate> members;
  for (const double power : driven ? options.response.speed_powers : std::vector<double>{1.0}) {
    Candidate c;
    c.method = Method::Response;
    c.columns = responseColumns(d, power, options.response.taus_s);
    for (const double strength : options.response.strengths) {
      for (const double slow : options.response.slow_preferences) {
        c.precision = priorPrecision(d, c.columns, strength, slow, options.response);
        evidence.judge(c);
        members.push_back(c);
      }
    }
  }
  return members;
}

/// Isolated slips of the probe: rows further from the median of their seven neighbours than noise and course allow.
/// A median follows every monotonic course exactly.
std::size_t removeSlips(const std::vector<double>& time_s, std::vector<double>& y, double from_s, double to_s) {
  std::vector<std::size_t> rows;
  for (std::size_t r = 0; r < y.size(); ++r)
    if (time_s[r] >= from_s && time_s[r] < to_s && std::isfinite(y[r])) rows.push_back(r);
  if (rows.size() < 20) return 0;
  std::vector<double> values;
  for (const std::size_t r : rows) values.push_back(y[r]);
  const double range = quantile(values, 0.95) - quantile(values, 0.05);
  std::vector<double> off(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t a = std::min(k >= 3 ? k - 3 : 0, rows.size() - 7);
    off[k] = values[k] - median(std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(a),
                                                    values.begin() + static_cast<std::ptrdiff_t>(a + 7)));
  }
  const double limit = std::max(8.0 * robustSigma(off), 0.25 * range);
  std::size_t removed = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (std::abs(off[k]) <= limit) continue;
    y[rows[k]] = std::nan("");
    ++removed;
  }
  return removed;
}

std::string nameOf(Method method) {
  switch (method) {
    case Method::Line:
      return "line";
    case Method::FewLags:
      return "few lags";
    case Method::Ridge:
      return "ridge";
    case Method::Response:
      break;
  }
  return "response";
}

/// Correlation of neighbours, as far as it tells how many independent samples there are.
double neighbourCorrelation(const Eigen::VectorXd& e) {
  const double zero = e.squaredNorm();
  if (!(zero > 0.0) || e.size() < 3) return 0.0;
  return std::clamp(e.head(e.size() - 1).dot(e.tail(e.size() - 1)) / zero, 0.0, 0.98);
}

/// The factor of the covariance with which errors and intervals agree over the runs that judge. `of_gains`: variance
/// per unit of the inverse normal matrix; `of_noise`: variance of what the model leaves, known from training and not
/// scaled.
template <typename Keep>
double calibration(const Evidence& evidence, const std::vector<Candidate>& candidates,
                   const MethodChoiceOptions& options, const Keep& keep, double of_gains, double of_noise) {
  const Eigen::MatrixXd& rows = evidence.rows();
  std::vector<std::pair<Eigen::ArrayXd, Eigen::ArrayXd>> judged;  // squared errors, variance stated for them
  for (std::size_t r = 0; r < evidence.runs().size(); ++r) {
    const Run& run = evidence.runs()[r];
    const std::vector<Weighted> there = weightsOf(candidates, static_cast<std::ptrdiff_t>(r), options, keep);
    const Eigen::MatrixXd held = rows(run.held_rows, Eigen::all);
    Eigen::MatrixXd predicted(held.rows(), static_cast<Index>(there.size()));
    Eigen::VectorXd variance = Eigen::VectorXd::Zero(held.rows());
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(held.rows());
    for (std::size_t m = 0; m < there.size(); ++m) {
      const Candidate& c = *there[m].candidate;
      const Solution s = evidence.solve(c, &run, true);
      Eigen::MatrixXd x(held.rows(), static_cast<Index>(c.columns.size()) + 1);
      x.col(0).setOnes();
      for (std::size_t k = 0; k < c.columns.size(); ++k) x.col(static_cast<Index>(k) + 1) = held.col(c.columns[k] + 1);
      predicted.col(static_cast<Index>(m)) = x * s.w;
      mean += there[m].weight * predicted.col(static_cast<Index>(m));
      variance += there[m].weight * of_gains * (x * s.inverse).cwiseProduct(x).rowwise().sum();
    }
    for (std::size_t m = 0; m < there.size(); ++m)
      variance += there[m].weight * (predicted.col(static_cast<Index>(m)) - mean).array().square().matrix();
    judged.emplace_back((held.col(held.cols() - 1) - mean).array().square(), variance.array());
  }
  if (judged.empty()) return 1.0;
  // By bisection of ln(factor). Few independent runs: Student's factor over the normal one at 95 %.
  const double noise = of_noise + evidence.floor();
  double low = std::log(1e-3);
  double high = std::log(1e2);
  for (int step = 0; step < 40; ++step) {
    const double middle = 0.5 * (low + high);
    double sum = 0.0;
    for (const auto& [error, variance] : judged) sum += (error / (std::exp(middle) * variance + noise)).mean();
    (sum > static_cast<double>(judged.size()) ? low : high) = middle;
  }
  const double independent = std::max(2.0, 0.5 * static_cast<double>(judged.size()));
  const double widening = studentQuantile(0.975, independent) / normalQuantile(0.975);
  return std::exp(high) * widening * widening;
}

/// Verdicts on all inputs of a projected response, those kept first.
std::vector<InputVerdict> explained(const ProjectionResult& few, const ProjectedModel& model,
                                    const std::vector<std::string>& usable) {
  std::vector<InputVerdict> verdicts;
  for (std::size_t i = 0; i < few.kept.size(); ++i) {
    InputVerdict v;
    v.name = few.kept[i];
    v.kept = true;
    v.contribution_rms = model.contribution_rms[i];
    v.error_without_percent = std::nan("");
    verdicts.push_back(std::move(v));
  }
  for (const std::string& name : usable) {
    if (std::find(few.kept.begin(), few.kept.end(), name) != few.kept.end()) continue;
    InputVerdict v;
    v.name = name;
    v.reason = "below 0.1 % of the prediction";
    v.error_without_percent = std::nan("");
    verdicts.push_back(std::move(v));
  }
  for (InputVerdict& v : verdicts) {
    const auto found =
        std::find_if(few.inputs.begin(), few.inputs.end(), [&](const ProjectedInput& p) { return p.name == v.name; });
    if (found == few.inputs.end()) continue;
    const std::string often = fmt::format("chosen in {:.0f} % of the resamples", 100.0 * found->frequency);
    if (v.kept) {
      v.reason = fmt::format(
          "its part of the prediction is {:.2g} rms; without it the kept inputs leave {:.2g} % of the course of the "
          "model with all inputs, with it {:.2g} %; {}{}",
          v.contribution_rms, 100.0 * found->left, 100.0 * few.left, often,
          found->frequency < 0.5 ? " (another sensor may do as well)" : "");
    } else {
      v.reason = fmt::format(
          "the kept inputs tell what it tells: they leave {:.2g} % of the course of the model with all inputs, with it "
          "{:.2g} %; {}",
          100.0 * few.left, 100.0 * found->left, often);
    }
  }
  return verdicts;
}

struct Averaged {
  ThermalModel model;
  std::vector<InputVerdict> verdicts;
  std::map<Method, double> shares;
};

/// The average of plain candidates as one model with its uncertainty.
Averaged averaged(const Dictionary& d, const Evidence& evidence, const std::vector<Candidate>& candidates,
                  const std::vector<std::string>& names, const std::string& output,
                  const MethodChoiceOptions& options) {
  Averaged out;
  const auto anything = [](const Candidate&) { return true; };
  std::vector<Weighted> members = weightsOf(candidates, -1, options, anything);
  // Inputs that next to nobody wants leave with those who do.
  std::vector<double> inclusion(names.size(), 0.0);
  for (const Weighted& w : members)
    for (const std::size_t i : w.candidate->inputs) inclusion[i] += w.weight;
  const auto wanted = [&](const Candidate& c) {
    return std::all_of(c.inputs.begin(), c.inputs.end(), [&](std::size_t i) { return inclusion[i] >= 0.05; });
  };
  members = weightsOf(candidates, -1, options, wanted);

  const Index p = d.X.cols();
  Eigen::VectorXd average = Eigen::VectorXd::Zero(p + 1);
  std::vector<Solution> solutions;
  for (const Weighted& w : members) {
    solutions.push_back(evidence.solve(*w.candidate, nullptr, true));
    average += w.weight * evidence.spread(*w.candidate, solutions.back().w);
    out.shares[w.candidate->method] += w.weight;
  }
  const Eigen::MatrixXd& rows = evidence.rows();
  const Eigen::VectorXd residual = rows.col(p + 1) - rows.leftCols(p + 1) * average;
  const double correlation = neighbourCorrelation(residual);
  const double fewer = (1.0 + correlation) / (1.0 - correlation);
  const double noise = std::sqrt(residual.squaredNorm() / static_cast<double>(residual.size()));
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(p + 1, p + 1);
  std::vector<double> variances;
  for (std::size_t m = 0; m < members.size(); ++m) {
    const Candidate& c = *members[m].candidate;
    const Eigen::VectorXd full = evidence.spread(c, solutions[m].w);
    const double variance =
        fewer * (rows.col(p + 1) - rows.leftCols(p + 1) * full).squaredNorm() / static_cast<double>(residual.size());
    const auto at = [&](Index k) { return k == 0 ? Index{0} : c.columns[static_cast<std::size_t>(k - 1)] + 1; };
    for (Index r = 0; r < solutions[m].inverse.rows(); ++r)
      for (Index k = 0; k < solutions[m].inverse.cols(); ++k)
        covariance(at(r), at(k)) += members[m].weight * variance * solutions[m].inverse(r, k);
    covariance.noalias() += members[m].weight * (full - average) * (full - average).transpose();
    variances.push_back(variance);
  }

  covariance *= calibration(evidence, candidates, options, wanted, fewer * noise * noise, noise * noise);

  // Original units; every lag has its own reference, which goes into the offset.
  ThermalOutput o;
  o.name = output;
  o.unit = output.ends_with("_urad") ? "urad" : output.ends_with("_um_per_m") ? "um/m" : "um";
  o.offset = d.y_mean + average[0];
  std::vector<int> place(d.inputs.size(), -1);
  std::vector<Index> used;
  for (Index k = 0; k < p; ++k) {
    if (average[k + 1] == 0.0) continue;
    const Feature& f = d.features[static_cast<std::size_t>(k)];
    const auto i = static_cast<std::size_t>(f.input);
    if (place[i] < 0) {
      place[i] = static_cast<int>(out.model.inputs.size());
      out.model.inputs.push_back(d.inputs[i]);
      out.model.inputs.back().reference = f.reference;
    }
    used.push_back(k);
    o.terms.push_back({place[i], f.tau_s, average[k + 1]});
  }
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(static_cast<Index>(used.size()) + 1, p + 1);
  T(0, 0) = 1.0;
  for (std::size_t k = 0; k < used.size(); ++k) {
    const double shift = out.model.inputs[static_cast<std::size_t>(o.terms[k].input)].reference -
                         d.features[static_cast<std::size_t>(used[k])].reference;
    o.offset += average[used[k] + 1] * shift;
    T(0, used[k] + 1) = shift;
    T(static_cast<Index>(k) + 1, used[k] + 1) = 1.0;
  }
  o.covariance = T * covariance * T.transpose();
  o.noise_sigma = noise;
  o.noise_tau_s = correlation > 0.0 ? -d.period_s / std::log(correlation) : 0.0;
  out.model.kind = "lags";
  out.model.period_s = d.period_s;
  out.model.outputs.push_back(std::move(o));

  const double with_all = averagedEvidence(evidence, candidates, options, wanted);
  for (std::size_t i = 0; i < names.size(); ++i) {
    InputVerdict v;
    v.name = names[i];
    Eigen::VectorXd part = Eigen::VectorXd::Zero(rows.rows());
    for (Index k = 0; k < p; ++k)
      if (d.inputs[static_cast<std::size_t>(d.features[static_cast<std::size_t>(k)].input)].name == names[i])
        part += average[k + 1] * rows.col(k + 1);
    v.contribution_rms = std::sqrt(part.squaredNorm() / static_cast<double>(part.size()));
    v.kept = inclusion[i] >= 0.05 && v.contribution_rms > 0.0;
    const auto without = [&](const Candidate& c) {
      return wanted(c) && std::find(c.inputs.begin(), c.inputs.end(), i) == c.inputs.end();
    };
    v.error_without_percent = std::nan("");
    if (v.kept && std::any_of(candidates.begin(), candidates.end(), without))
      v.error_without_percent =
          100.0 * (std::exp(0.5 * (averagedEvidence(evidence, candidates, options, without) - with_all)) - 1.0);
    if (!v.kept) {
      v.reason = fmt::format("models with it have {:.0f} % of the weight of blocked evidence; 5 % are needed",
                             100.0 * inclusion[i]);
    } else {
      v.reason = fmt::format("its part of the prediction is {:.2g} rms; models with it have {:.0f} % of the weight",
                             v.contribution_rms, 100.0 * inclusion[i]);
      if (std::isfinite(v.error_without_percent))
        v.reason +=
            fmt::format("; without it the error in runs left out changes by {:+.0f} %", v.error_without_percent);
    }
    out.verdicts.push_back(std::move(v));
  }
  return out;
}

}  // namespace

void MethodChoiceOptions::validate() const {
  response.validate();
  if (taus_s.empty() || shrinkages.empty() || maximum_inputs < 1)
    throw InputError("an option of the choice between methods is empty; allowed: at least one value each.");
  if (!(sharpness > 0.0) || !(sharpest >= 1.0) || !(input_penalty >= 0.0) || !(response_odds > 0.0))
    throw InputError("sharpness and odds of the choice between methods must be positive.");
  for (const double part : origins)
    if (!(part > 0.0 && part < 1.0)) throw InputError("an origin of the choice must lie between 0 and 1.");
}

ThermalModel weightedAverage(const std::vector<ThermalModel>& models, const std::vector<double>& weights) {
  SPINDRIFT_ASSERT(!models.empty() && models.size() == weights.size(), "a weight per model is needed");
  ThermalModel out = models.front();
  out.inputs.clear();
  out.kind = "lags";
  ThermalOutput& o = out.outputs.front();
  o.terms.clear();
  o.offset = 0.0;
  o.noise_sigma = o.noise_tau_s = o.uncertainty_factor = o.degrees_of_freedom = 0.0;
  o.verdict.reset();
  // Terms of all models on common references; coefficients of model m stand in the rows `row[m]` of the whole.
  bool covariances = true;
  std::vector<Eigen::MatrixXd> maps;
  std::vector<Eigen::VectorXd> values;
  std::size_t total_terms = 0;
  for (const ThermalModel& m : models) total_terms += m.outputs.front().terms.size();
  for (std::size_t m = 0; m < models.size(); ++m) {
    const ThermalOutput& from = models[m].outputs.front();
    Eigen::MatrixXd map =
        Eigen::MatrixXd::Zero(static_cast<Index>(total_terms) + 1, static_cast<Index>(from.terms.size()) + 1);
    Eigen::VectorXd value(static_cast<Index>(from.terms.size()) + 1);
    map(0, 0) = 1.0;
    value[0] = from.offset;
    covariances = covariances && from.covariance.rows() == value.size();
    for (std::size_t k = 0; k < from.terms.size(); ++k) {
      const ThermalInput& input = models[m].inputs[static_cast<std::size_t>(from.terms[k].input)];
      auto known = std::find_if(out.inputs.begin(), out.inputs.end(), [&](const ThermalInput& i) {
        return i.name == input.name && i.kind == input.kind && i.power == input.power && i.scale == input.scale;
      });
      if (known == out.inputs.end()) known = out.inputs.insert(out.inputs.end(), input);
      const int place = static_cast<int>(known - out.inputs.begin());
      auto term = std::find_if(o.terms.begin(), o.terms.end(),
                               [&](const LagTerm& t) { return t.input == place && t.tau_s == from.terms[k].tau_s; });
      if (term == o.terms.end()) term = o.terms.insert(o.terms.end(), {place, from.terms[k].tau_s, 0.0});
      const auto column = static_cast<Index>(k) + 1;
      map(static_cast<Index>(term - o.terms.begin()) + 1, column) = 1.0;
      map(0, column) = known->reference - input.reference;
      value[column] = from.terms[k].gain;
    }
    o.noise_sigma += weights[m] * from.noise_sigma;
    o.noise_tau_s += weights[m] * from.noise_tau_s;
    o.uncertainty_factor += weights[m] * from.uncertainty_factor;
    maps.push_back(std::move(map));
    values.push_back(std::move(value));
  }
  const auto size = static_cast<Index>(o.terms.size()) + 1;
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(size);
  for (std::size_t m = 0; m < models.size(); ++m) mean += weights[m] * (maps[m].topRows(size) * values[m]);
  o.offset = mean[0];
  for (std::size_t k = 0; k < o.terms.size(); ++k) o.terms[k].gain = mean[static_cast<Index>(k) + 1];
  o.covariance.resize(0, 0);
  if (!covariances) return out;
  o.covariance = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t m = 0; m < models.size(); ++m) {
    const Eigen::MatrixXd map = maps[m].topRows(size);
    const Eigen::VectorXd off = map * values[m] - mean;
    o.covariance += weights[m] * (map * models[m].outputs.front().covariance * map.transpose() + off * off.transpose());
  }
  return out;
}

MethodChoiceResult chooseMethod(const TimeSeries& series, const std::string& output,
                                const std::vector<std::string>& names, double from_s, double to_s,
                                const MethodChoiceOptions& options, const JobContext& job) {
  options.validate();
  MethodChoiceResult result;
  std::vector<InputVerdict> refused;
  const std::vector<std::string> usable = usableInputs(series, output, names, from_s, to_s, refused);
  const bool project =
      !options.shared_inputs.empty() || (!options.all_inputs && std::ssize(usable) > options.projection.maximum_inputs);
  ResponseFitOptions first = options.response;
  first.judge_inputs = options.response.judge_inputs && !project;
  ResponseFitResult response = fitResponse(series, output, names, from_s, to_s, first, job.part(0.0, 0.3));
  if (response.status != FitStatus::Converged) {
    result.status = response.status;
    result.message = response.message;
    return result;
  }
  std::vector<std::string> plain_names = usable;
  if (project) {
    ProjectionResult few;
    if (options.shared_inputs.empty()) {
      few = projectOntoFewInputs(series, {response.model}, from_s, to_s, options.projection, job.part(0.3, 0.4));
    } else {
      const auto used = [&](const std::string& name) {
        return std::any_of(response.model.inputs.begin(), response.model.inputs.end(),
                           [&](const ThermalInput& i) { return i.name == name; });
      };
      for (const std::string& name : options.shared_inputs)
        if (used(name)) few.kept.push_back(name);
      std::erase_if(plain_names, [&](const std::string& name) {
        return std::find(options.shared_inputs.begin(), options.shared_inputs.end(), name) ==
               options.shared_inputs.end();
      });
    }
    if (!few.kept.empty()) {
      ProjectedModel projected = projectModel(series, response.model, few.kept, from_s, to_s, options.projection);
      response.verdicts = explained(few, projected, usable);
      response.verdicts.insert(response.verdicts.end(), refused.begin(), refused.end());
      response.model = std::move(projected.model);
    }
  }
  std::vector<double> clean = series.at(output).values;
  if (const std::size_t slips = removeSlips(series.time_s, clean, from_s, to_s); slips > 0)
    result.notes.push_back(
        fmt::format("{} isolated values of {} were left out of the choice between methods.", slips, output));
  ResponseFitOptions lags = options.response;
  lags.taus_s.insert(lags.taus_s.end(), options.taus_s.begin(), options.taus_s.end());
  std::sort(lags.taus_s.begin(), lags.taus_s.end());
  lags.taus_s.erase(std::unique(lags.taus_s.begin(), lags.taus_s.end()), lags.taus_s.end());
  const double span = std::min(to_s, series.time_s.back()) - std::max(from_s, series.time_s.front());
  lags.period_s = std::max({options.response.period_s, series.medianPeriod_s(), span / 400.0});
  const Dictionary d = buildDictionary(series, clean, usable, from_s, to_s, lags);
  if (d.y.size() < 40) {
    result.model = std::move(response.model);
    result.verdicts = std::move(response.verdicts);
    result.left_out_rms = response.left_out_rms;
    result.methods = {{"response", response.left_out_rms, 1.0}};
    result.notes.push_back("too few samples for a choice between methods: response.");
    result.status = FitStatus::Converged;
    return result;
  }
  const Evidence evidence(d, options);
  Candidates plain(d, evidence, plain_names, options);
  plain.search(job.part(0.4, 0.8));
  const std::vector<Candidate> members = responseMembers(d, evidence, options);
  const auto anything = [](const Candidate&) { return true; };
  {
    ThermalOutput& o = response.model.outputs.front();
    o.covariance *= calibration(evidence, members, options, anything, evidence.innovationVariance(members),
                                o.noise_sigma * o.noise_sigma);
    o.uncertainty_factor = 1.0;
  }
  const double of_plain = averagedEvidence(evidence, plain.all, options, anything);
  const double of_response = averagedEvidence(evidence, members, options, anything);
  // ln of the odds: half of ln(mean squared error) per independent run. Rolling origins overlap with each other and
  // with the blocks, so that about every second run is independent.
  const double independent = 0.5 * static_cast<double>(evidence.runs().size());
  // A forward selection has chosen by the runs that judge it: the prior is shared by the sets it has tried.
  const double odds = 0.5 * independent * (of_response - of_plain) -
                      (d.by_operation ? std::log(options.response_odds) : 0.0) -
                      std::log(static_cast<double>(plain.setsChosenFrom()));
  double plain_weight = 1.0 / (1.0 + std::exp(-odds));
  // Averaged where nothing tells them apart (odds below two to one), else the better of both.
  if (plain_weight < 1.0 / 3.0) plain_weight = 0.0;
  if (plain_weight > 2.0 / 3.0) plain_weight = 1.0;
  job.report(0.9, "averaging");

  std::map<Method, double> shares;
  if (plain_weight > 0.0) {
    Averaged average = averaged(d, evidence, plain.all, plain_names, output, options);
    average.model.train_from_s = response.model.train_from_s;
    average.model.train_to_s = response.model.train_to_s;
    average.model.source = response.model.source;
    for (const auto& [method, share] : average.shares) shares[method] = plain_weight * share;
    result.verdicts = plain_weight >= 0.5 ? std::move(average.verdicts) : std::move(response.verdicts);
    if (plain_weight >= 0.5) result.verdicts.insert(result.verdicts.end(), refused.begin(), refused.end());
    result.model = plain_weight < 1.0
                       ? weightedAverage({average.model, response.model}, {plain_weight, 1.0 - plain_weight})
                       : std::move(average.model);
    for (InputVerdict& v : result.verdicts)
      v.kept = std::any_of(result.model.inputs.begin(), result.model.inputs.end(),
                           [&](const ThermalInput& i) { return i.name == v.name; });
  } else {
    result.model = std::move(response.model);
    result.verdicts = std::move(response.verdicts);
  }
  for (const Method method : {Method::Line, Method::FewLags, Method::Ridge}) {
    const auto of_method = [&](const Candidate& c) { return c.method == method; };
    if (std::none_of(plain.all.begin(), plain.all.end(), of_method)) continue;
    result.methods.push_back(
        {nameOf(method), std::exp(0.5 * averagedEvidence(evidence, plain.all, options, of_method)), shares[method]});
  }
  result.methods.push_back({nameOf(Method::Response), std::exp(0.5 * of_response), 1.0 - plain_weight});
  result.left_out_rms = std::exp(0.5 * (plain_weight * of_plain + (1.0 - plain_weight) * of_response));
  result.notes.insert(result.notes.end(), response.notes.begin(), response.notes.end());
  result.status = FitStatus::Converged;
  result.message =
      fmt::format("{} inputs, {} lags", result.model.inputs.size(), result.model.outputs.front().terms.size());
  return result;
}

}  // namespace spindrift
