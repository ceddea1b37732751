// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/method_evidence.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/math/least_squares.h"
#include "core/math/statistics.h"
#include "core/thermal/interval_calibration.h"

namespace spindrift::choice {

using Eigen::Index;
using namespace response;

namespace {

constexpr double runs_of_training = 4.0;    ///< what is left of training counts as the rolling origins do
constexpr Index batches = 20;               ///< of the residual, for the number of independent rows
constexpr double negligible_weight = 0.01;  ///< of the largest: such candidates are left out of the average

constexpr double unusable = 700.0;  ///< ln of a mean squared error that is no number

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

/// About every second run is independent of the others.
double independentRuns(std::size_t runs) {
  return 0.5 * static_cast<double>(runs);
}

}  // namespace

double scoreOf(const Candidate& c, const std::vector<Run>& runs, std::ptrdiff_t of) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t r = 0; r < c.log_error.size(); ++r) {
    if (of >= 0 && runs[static_cast<std::size_t>(of)].judges[r] == 0) continue;
    sum += c.log_error[r];
    count += 1.0;
  }
  if (!c.log_expected.empty()) {
    sum += runs_of_training * c.log_expected[static_cast<std::size_t>(of + 1)];
    count += runs_of_training;
  }
  return sum / std::max(1.0, count);
}

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

Evidence::Evidence(const Dictionary& d, const MethodChoiceOptions& options) {
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
  floor_ = 1e-4 * all_(p + 1, p + 1) / static_cast<double>(n);
  const double first = d.time_s.front();
  const double span = d.time_s.back() - first;
  for (const double part : options.origins) add(d, [&](std::size_t i) { return d.time_s[i] >= first + part * span; });
  origins_ = runs_.size();
  for (int b = 0; b < d.blocks; ++b) add(d, [&](std::size_t i) { return d.block[i] == b; });
  nameJudges();
}

template <typename Held>
void Evidence::add(const Dictionary& d, const Held& held) {
  Run run;
  std::vector<Index> used;
  for (std::size_t i = 0; i < d.time_s.size(); ++i) (held(i) ? run.held_rows : used).push_back(static_cast<Index>(i));
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

/// Runs that share no row; where there is none, all others.
void Evidence::nameJudges() {
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    std::vector<char>& judges = runs_[r].judges;
    judges.assign(runs_.size(), 0);
    for (std::size_t q = 0; q < runs_.size(); ++q) {  // held rows are contiguous
      const std::vector<Index>& a = runs_[r].held_rows;
      const std::vector<Index>& b = runs_[q].held_rows;
      judges[q] = a.back() < b.front() || b.back() < a.front() ? 1 : 0;
    }
    if (std::find(judges.begin(), judges.end(), char{1}) != judges.end()) continue;
    judges.assign(runs_.size(), 1);
    judges[r] = 0;
  }
}

Solution Evidence::solve(const Candidate& c, const Run* run, bool with_inverse) const {
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

Eigen::VectorXd Evidence::spread(const Candidate& c, const Eigen::VectorXd& w) const {
  Eigen::VectorXd full = Eigen::VectorXd::Zero(rows_.cols() - 1);
  full[0] = w[0];
  for (std::size_t k = 0; k < c.columns.size(); ++k) full[c.columns[k] + 1] = w[static_cast<Index>(k) + 1];
  return full;
}

void Evidence::judge(Candidate& c) const {
  c.log_error.clear();
  c.log_expected.clear();
  const bool expects = c.method != Method::Response;
  const bool shrunk = c.method == Method::Ridge;  // else every coefficient counts in full
  if (expects) c.log_expected.push_back(logExpected(c, solve(c, nullptr, shrunk), nullptr));
  for (const Run& run : runs_) {
    const Solution s = solve(c, &run, expects && shrunk);
    if (expects) c.log_expected.push_back(logExpected(c, s, &run));
    const Eigen::VectorXd& w = s.w;
    const Index y = run.held.cols() - 1;
    double sum = run.held(y, y);
    const auto n = static_cast<Index>(c.columns.size()) + 1;
    const auto at = [&](Index k) { return k == 0 ? Index{0} : c.columns[static_cast<std::size_t>(k - 1)] + 1; };
    for (Index r = 0; r < n; ++r) {
      sum -= 2.0 * w[r] * run.held(at(r), y);
      for (Index k = 0; k < n; ++k) sum += w[r] * w[k] * run.held(at(r), at(k));
    }
    const double mean_square = std::max(0.0, sum) / static_cast<double>(run.held_rows.size());
    c.log_error.push_back(std::isfinite(mean_square) ? std::log(mean_square + floor_) : unusable);
  }
}

double Evidence::logExpected(const Candidate& c, const Solution& s, const Run* run) const {
  Eigen::VectorXd left = rows_.col(rows_.cols() - 1).array() - s.w[0];
  for (std::size_t k = 0; k < c.columns.size(); ++k)
    left -= s.w[static_cast<Index>(k) + 1] * rows_.col(c.columns[k] + 1);
  if (run != nullptr) {  // held rows are contiguous
    const Index from = run->held_rows.front();
    const Index after = left.size() - run->held_rows.back() - 1;
    Eigen::VectorXd fitted(from + after);
    fitted << left.head(from), left.tail(after);
    left = std::move(fitted);
  }
  const auto rows = static_cast<double>(left.size());
  const double mean_square = left.squaredNorm() / rows;
  if (!std::isfinite(mean_square)) return unusable;
  const Index length = std::max<Index>(1, left.size() / batches);
  const Index count = left.size() / length;
  double of_means = 0.0;
  for (Index b = 0; b < count; ++b) of_means += std::pow(left.segment(b * length, length).mean(), 2);
  const double independent = of_means > 0.0 ? std::clamp(static_cast<double>(count * count) * mean_square / of_means,
                                                         static_cast<double>(count), rows)
                                            : rows;
  double coefficients = static_cast<double>(s.w.size()) + static_cast<double>(c.time_constants);
  for (Index k = 1; k < s.inverse.rows(); ++k) coefficients -= c.precision[k - 1] * s.inverse(k, k);
  const double part = std::min(0.9, coefficients / independent);
  return std::log(mean_square * (1.0 + part) / (1.0 - part) + floor_);
}

double Evidence::innovationVariance(const std::vector<Candidate>& candidates) const {
  const auto best = std::min_element(candidates.begin(), candidates.end(), [&](const Candidate& a, const Candidate& b) {
    return scoreOf(a, runs_) < scoreOf(b, runs_);
  });
  if (best == candidates.end()) return 0.0;
  Eigen::VectorXd full(whitened_.cols());
  full.head(full.size() - 1) = spread(*best, solve(*best, nullptr, false).w);
  full[full.size() - 1] = -1.0;
  return std::max(0.0, full.dot(all_whitened_ * full)) / static_cast<double>(whitened_.rows());
}

std::vector<Weighted> weightsOf(const Evidence& evidence, const std::vector<Candidate>& candidates, std::ptrdiff_t of,
                                const MethodChoiceOptions& options, const Keep& keep) {
  const auto place = static_cast<std::size_t>(of + 1);
  const std::vector<char> judges =
      of < 0 ? std::vector<char>(evidence.runs().size(), 1) : evidence.runs()[static_cast<std::size_t>(of)].judges;
  std::vector<Weighted> out;
  const Candidate* best = nullptr;
  double score = std::numeric_limits<double>::infinity();
  for (const Candidate& c : candidates) {
    if (c.found[place] == 0 || !keep(c)) continue;
    out.push_back({&c, scoreOf(c, evidence.runs(), of)});
    if (out.back().weight < score) {
      score = out.back().weight;
      best = &c;
    }
  }
  if (best == nullptr) return out;
  double scatter = 0.0;  // also of the runs about what training lets expect
  int runs = 0;
  for (std::size_t r = 0; r < best->log_error.size(); ++r) {
    if (judges[r] == 0) continue;
    scatter += (best->log_error[r] - score) * (best->log_error[r] - score);
    ++runs;
  }
  scatter = std::sqrt(scatter / std::max(1, runs - 1));
  const double sharpness = std::clamp(options.sharpness / std::max(scatter, 1e-6), 1.0, options.sharpest);
  double largest = -std::numeric_limits<double>::infinity();
  for (Weighted& w : out) {
    const double penalty = w.candidate->method == Method::Response
                               ? 0.0
                               : options.input_penalty * static_cast<double>(w.candidate->picked);
    w.weight = -sharpness * w.weight - penalty;
    largest = std::max(largest, w.weight);
  }
  std::erase_if(out, [&](const Weighted& w) { return w.weight < largest + std::log(negligible_weight); });
  double total = 0.0;
  for (Weighted& w : out) total += w.weight = std::exp(w.weight - largest);
  for (Weighted& w : out) w.weight /= total;
  return out;
}

std::vector<double> averagedErrors(const Evidence& evidence, const std::vector<Candidate>& candidates,
                                   const MethodChoiceOptions& options, const Keep& keep) {
  std::vector<double> out;
  const std::vector<Run>& runs = evidence.runs();
  for (std::size_t r = 0; r < runs.size(); ++r) {
    Eigen::VectorXd error = Eigen::VectorXd::Zero(evidence.rows().cols());
    for (const Weighted& w : weightsOf(evidence, candidates, static_cast<std::ptrdiff_t>(r), options, keep))
      error.head(error.size() - 1) +=
          w.weight * evidence.spread(*w.candidate, evidence.solve(*w.candidate, &runs[r], false).w);
    error[error.size() - 1] = -1.0;
    const double mean_square =
        std::max(0.0, error.dot(runs[r].held * error)) / static_cast<double>(runs[r].held_rows.size());
    out.push_back(std::log(mean_square + evidence.floor()));
  }
  return out;
}

double averagedEvidence(const Evidence& evidence, const std::vector<Candidate>& candidates,
                        const MethodChoiceOptions& options, const Keep& keep) {
  return mean(averagedErrors(evidence, candidates, options, keep));
}

double logOdds(const std::vector<double>& of_a, const std::vector<double>& of_b) {
  SPINDRIFT_ASSERT(of_a.size() == of_b.size(), "both from the same runs");
  if (of_a.size() < 2) return 0.0;
  std::vector<double> difference;
  for (std::size_t r = 0; r < of_a.size(); ++r) difference.push_back(of_b[r] - of_a[r]);
  const double middle = mean(difference);
  const double squared = middle * middle;
  double variance = 0.0;
  for (const double d : difference) variance += (d - middle) * (d - middle);
  variance /= static_cast<double>(difference.size() - 1);
  const double independent = independentRuns(difference.size());
  if (!(squared > 0.0)) return 0.0;
  return 0.5 * independent * middle * squared / (squared + variance / independent);
}

double calibration(const Evidence& evidence, const std::vector<Candidate>& candidates,
                   const MethodChoiceOptions& options, const Keep& keep, double of_gains, double of_noise) {
  const Eigen::MatrixXd& rows = evidence.rows();
  std::vector<JudgedRun> judged;
  std::vector<JudgedRun> ahead;
  for (std::size_t r = 0; r < evidence.runs().size(); ++r) {
    const Run& run = evidence.runs()[r];
    const std::vector<Weighted> there = weightsOf(evidence, candidates, static_cast<std::ptrdiff_t>(r), options, keep);
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
    judged.push_back({(held.col(held.cols() - 1) - mean).array().square(), variance.array()});
    if (r < evidence.origins()) ahead.push_back(judged.back());
  }
  const double noise = of_noise + evidence.floor();
  const double independent = independentRuns(judged.size());
  const double of_all = calibratedFactor(judged, noise, independent);
  return ahead.empty() ? of_all : std::max(of_all, calibratedFactor(ahead, noise, independent));
}

}  // namespace spindrift::choice
