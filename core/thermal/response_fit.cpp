// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/response_fit.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "core/base/text.h"
#include "core/base/unit_text.h"
#include "core/math/least_squares.h"
#include "core/math/statistics.h"
#include "core/thermal/interval_calibration.h"
#include "core/thermal/response_dictionary.h"

namespace spindrift {
namespace {

using Eigen::Index;
using namespace response;

struct Member {
  double power = 0.0;  ///< of the speeds; 0 if there are none
  double strength = 0.0;
  double slow = 0.0;
  double left_out = 0.0;  ///< mean squared error of left-out blocks
  double weight = 0.0;
  double innovation_variance = 0.0;
};

/// Parts of the training range after which the rest is predicted from the past, when intervals are calibrated.
constexpr double origins[] = {0.4, 0.55, 0.7, 0.85};
constexpr double slip_weight = 0.2;  ///< rows that the innovations call a slip judge no interval

/// Columns of a member: all features of linear inputs and of speeds with its power.
std::vector<Index> columnsOf(const Dictionary& d, double power, const std::string& without = {}) {
  std::vector<Index> columns;
  for (std::size_t k = 0; k < d.features.size(); ++k) {
    const ThermalInput& input = d.inputs[d.features[k].input];
    if (isDriven(input.kind) && input.power != power) continue;
    if (!without.empty() && input.name == without) continue;
    columns.push_back(static_cast<Index>(k));
  }
  return columns;
}

struct Gram {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
};

template <typename Wanted>
Gram gramOf(const Whitened& w, const Eigen::VectorXd& weights, const Wanted& wanted) {
  const Index p = w.X.cols();
  Eigen::MatrixXd rows(w.X.rows(), p);
  Eigen::VectorXd y(w.X.rows());
  Index count = 0;
  for (Index i = 0; i < w.X.rows(); ++i) {
    if (!wanted(i)) continue;
    const double s = std::sqrt(weights[i]);
    rows.row(count) = s * w.X.row(i);
    y[count++] = s * w.y[i];
  }
  Gram gram;
  gram.A = Eigen::MatrixXd::Zero(p, p);
  gram.A.selfadjointView<Eigen::Lower>().rankUpdate(rows.topRows(count).transpose());
  gram.A.triangularView<Eigen::StrictlyUpper>() = gram.A.transpose();
  gram.b = rows.topRows(count).transpose() * y.head(count);
  return gram;
}

/// Solves for (offset, gains) of the given columns.
struct Solution {
  Eigen::VectorXd w;
  Eigen::MatrixXd inverse;  ///< of the regularised normal matrix
};

Solution solve(const Gram& gram, const std::vector<Index>& columns, const Eigen::VectorXd& precision,
               bool with_inverse) {
  const Index n = static_cast<Index>(columns.size()) + 1;
  Eigen::MatrixXd A(n, n);
  Eigen::VectorXd b(n);
  const auto at = [&](Index k) { return k == 0 ? Index{0} : columns[k - 1] + 1; };
  for (Index r = 0; r < n; ++r) {
    b[r] = gram.b[at(r)];
    for (Index c = 0; c < n; ++c) A(r, c) = gram.A(at(r), at(c));
    if (r > 0) A(r, r) += precision[r - 1];
  }
  Eigen::LDLT<Eigen::MatrixXd> ldlt(A);
  Solution s;
  s.w = ldlt.solve(b);
  if (with_inverse) s.inverse = ldlt.solve(Eigen::MatrixXd::Identity(n, n));
  return s;
}

/// Mean squared free-run error over blocks left out, each predicted from a fit to all others.
double leftOutError(const Dictionary& d, const std::vector<Gram>& by_block, const Gram& all,
                    const std::vector<Index>& columns, const Eigen::VectorXd& precision) {
  double sum = 0.0;
  Index count = 0;
  for (int b = 0; b < d.blocks; ++b) {
    const Gram rest{all.A - by_block[b].A, all.b - by_block[b].b};
    const Eigen::VectorXd w = solve(rest, columns, precision, false).w;
    for (Index i = 0; i < d.y.size(); ++i) {
      if (d.block[i] != b) continue;
      double e = d.y[i] - d.y_mean - w[0];
      for (std::size_t k = 0; k < columns.size(); ++k) e -= w[static_cast<Index>(k) + 1] * d.X(i, columns[k]);
      sum += e * e;
      ++count;
    }
  }
  return sum / static_cast<double>(std::max<Index>(1, count));
}

/// Means over the correlation time of the noise: what the noise leaves of them is small, and wrong gains show.
struct Segments {
  Eigen::MatrixXd X;
  Eigen::VectorXd y;  ///< about the mean of the output
};

Segments segmentsOf(const Dictionary& d, const std::vector<Index>& rows, double length_s) {
  std::vector<Index> first;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto place = [&](std::size_t r) {
      return std::floor(d.time_s[static_cast<std::size_t>(rows[r])] / length_s);
    };
    if (k == 0 || place(k) != place(k - 1)) first.push_back(static_cast<Index>(k));
  }
  first.push_back(std::ssize(rows));
  Segments out;
  out.X = Eigen::MatrixXd::Zero(std::ssize(first) - 1, d.X.cols());
  out.y = Eigen::VectorXd::Zero(std::ssize(first) - 1);
  for (Index s = 0; s < out.y.size(); ++s) {
    const Index from = first[static_cast<std::size_t>(s)];
    const Index to = first[static_cast<std::size_t>(s) + 1];
    for (Index k = from; k < to; ++k) {
      out.X.row(s) += d.X.row(rows[static_cast<std::size_t>(k)]);
      out.y[s] += d.y[rows[static_cast<std::size_t>(k)]] - d.y_mean;
    }
    out.X.row(s) /= static_cast<double>(to - from);
    out.y[s] /= static_cast<double>(to - from);
  }
  return out;
}

/// The factor of the covariance with which errors and intervals agree over rows left out: every block, and what follows
/// each origin, predicted from the rest by the average of the members. `average`: their coefficients, `unseen`: the
/// variance of what a model leaves of new data over that of what it left in training.
double calibration(const Dictionary& d, const Whitened& w, const Eigen::VectorXd& weights,
                   const std::vector<Gram>& by_block, const Gram& all, const std::vector<Member>& members,
                   const Eigen::VectorXd& average, double unseen, const ResponseFitOptions& options,
                   const JobContext& job) {
  const auto rowsWhere = [&](const auto& held) {
    std::vector<Index> rows;
    for (Index i = 0; i < d.y.size(); ++i)
      if (held(i) && weights[i] >= slip_weight) rows.push_back(i);
    return rows;
  };
  struct Run {
    Gram rest;
    std::vector<Index> held;
  };
  std::vector<Run> runs;
  const auto add = [&](Gram rest, const auto& held) {
    Run run{std::move(rest), rowsWhere(held)};
    if (!run.held.empty()) runs.push_back(std::move(run));
  };
  for (int b = 0; b < d.blocks; ++b)
    add({all.A - by_block[static_cast<std::size_t>(b)].A, all.b - by_block[static_cast<std::size_t>(b)].b},
        [&](Index i) { return d.block[static_cast<std::size_t>(i)] == b; });
  const double first = d.time_s.front();
  for (const double part : origins) {
    const double until = first + part * (d.time_s.back() - first);
    const auto held = [&](Index i) { return d.time_s[static_cast<std::size_t>(i)] >= until; };
    add(gramOf(w, weights, [&](Index i) { return !held(i); }), held);
  }
  std::vector<JudgedRun> judged(runs.size());
  std::vector<double> independent(runs.size(), 0.0);
  parallelFor(runs.size(), job, [&](std::size_t r) {
    const Run& run = runs[r];
    const Segments held = segmentsOf(d, run.held, options.noise_tau_s);
    Eigen::MatrixXd predicted(held.y.size(), std::ssize(members));
    Eigen::VectorXd variance = Eigen::VectorXd::Zero(held.y.size());
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(held.y.size());
    for (std::size_t m = 0; m < members.size(); ++m) {
      const Member& member = members[m];
      const std::vector<Index> columns = columnsOf(d, member.power);
      const Solution s =
          solve(run.rest, columns, priorPrecision(d, columns, member.strength, member.slow, options), true);
      Eigen::MatrixXd x(held.y.size(), static_cast<Index>(columns.size()) + 1);
      x.col(0).setOnes();
      x.rightCols(static_cast<Index>(columns.size())) = held.X(Eigen::all, columns);
      predicted.col(static_cast<Index>(m)) = x * s.w;
      mean += member.weight * predicted.col(static_cast<Index>(m));
      variance += member.weight * member.innovation_variance * (x * s.inverse).cwiseProduct(x).rowwise().sum();
    }
    for (std::size_t m = 0; m < members.size(); ++m)
      variance += members[m].weight * (predicted.col(static_cast<Index>(m)) - mean).array().square().matrix();
    const Eigen::VectorXd error = held.y - mean;
    judged[r] = {error.array().square(), variance.array()};
    // Blocks do not overlap. Segments of one block that follow each other tell the same in part, never less than one.
    const double correlation = neighbourCorrelation(error);
    if (r < static_cast<std::size_t>(d.blocks))
      independent[r] = std::max(1.0, static_cast<double>(error.size()) * (1.0 - correlation) / (1.0 + correlation));
  });
  const Segments trained = segmentsOf(d, rowsWhere([](Index /*row*/) { return true; }), options.noise_tau_s);
  const double noise =
      unseen * (trained.y.array() - average[0] - (trained.X * average.tail(d.X.cols())).array()).square().mean();
  return calibratedFactor(judged, noise, std::accumulate(independent.begin(), independent.end(), 0.0));
}

}  // namespace

void ResponseFitOptions::validate() const {
  if (taus_s.empty() || speed_powers.empty() || strengths.empty() || slow_preferences.empty()) {
    throw InputError("an option of the response fit is an empty list; allowed: at least one value each.");
  }
  if (!(noise_tau_s > 0.0) || !(speed_freedom > 0.0) || period_s < 0.0) {
    throw InputError("noise time constant, speed freedom and period must be positive (period 0: automatic).");
  }
}

std::vector<std::string> automaticInputs(const TimeSeries& series, const std::string& output) {
  std::vector<std::string> names;
  for (const Signal& s : series.signals) {
    const bool eligible = s.kind == SignalKind::Temperature || s.kind == SignalKind::Speed ||
                          s.kind == SignalKind::Feed || (s.kind == SignalKind::Switch && s.name != "compensation_on");
    if (eligible && s.name != output) names.push_back(s.name);
  }
  return names;
}

ResponseFitResult fitResponse(const TimeSeries& series, const std::string& output,
                              const std::vector<std::string>& names, double from_s, double to_s,
                              const ResponseFitOptions& options, const JobContext& job) {
  options.validate();
  ResponseFitResult result;
  static_cast<void>(series.at(output));
  if (names.empty()) {
    throw InputError({series.file, ""},
                     "there is no temperature, speed, feed or switch to choose inputs from; allowed: --inputs with the "
                     "names of columns.");
  }
  const std::vector<std::string> usable = usableInputs(series, output, names, from_s, to_s, result.verdicts);
  if (usable.empty()) {
    throw InputError(
        {series.file, fmt::format("column {}", names.front())},
        fmt::format("no input can be used: {}; allowed: at least one input that changes in the training range.",
                    result.verdicts.empty() ? std::string("none given") : result.verdicts.front().reason));
  }
  Dictionary d = buildDictionary(series, series.at(output).values, usable, from_s, to_s, options);
  result.samples = static_cast<std::size_t>(d.y.size());
  if (result.samples < options.minimum_samples) {
    throw InputError(
        {series.file, fmt::format("column {}", output)},
        fmt::format(
            "the training range holds {} samples of the output at a period of {:.6g} s; allowed: at least {} (a longer "
            "training range, or a shorter --period).",
            result.samples, d.period_s, options.minimum_samples));
  }
  const double spread = std::sqrt((d.y.array() - d.y_mean).square().mean());
  if (spread <= 1e-12 * std::max(1.0, std::abs(d.y_mean))) {
    throw InputError(
        {series.file, fmt::format("column {}", output)},
        "it is constant in the training range, there is nothing to model; allowed: an output that changes.");
  }
  job.throwIfCancelled();

  Whitened w = whiten(d, options.noise_tau_s);
  const bool has_speed =
      std::any_of(d.inputs.begin(), d.inputs.end(), [](const ThermalInput& i) { return isDriven(i.kind); });
  std::vector<Member> members;
  for (const double power : has_speed ? options.speed_powers : std::vector<double>{0.0})
    for (const double strength : options.strengths)
      for (const double slow : options.slow_preferences) members.push_back({power, strength, slow, 0.0, 0.0});

  // Huber weights of the innovations from the middle member, twice.
  const auto every = [](Index /*row*/) { return true; };
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(d.y.size());
  const Member middle = members[members.size() / 2];
  {
    const std::vector<Index> columns = columnsOf(d, middle.power);
    const Eigen::VectorXd precision = priorPrecision(d, columns, middle.strength, middle.slow, options);
    for (int round = 0; round < 2; ++round) {
      const Eigen::VectorXd solution = solve(gramOf(w, weights, every), columns, precision, false).w;
      std::vector<double> innovation(d.y.size());
      for (Index i = 0; i < d.y.size(); ++i) {
        innovation[i] = w.y[i] - solution[0] * w.X(i, 0);
        for (std::size_t k = 0; k < columns.size(); ++k)
          innovation[i] -= solution[static_cast<Index>(k) + 1] * w.X(i, columns[k] + 1);
      }
      const double sigma = std::max(robustSigma(innovation), 1e-12 * spread);
      for (Index i = 0; i < d.y.size(); ++i) weights[i] = huberWeight(innovation[i] / sigma, 3.0);
    }
  }
  const Gram all = gramOf(w, weights, every);
  std::vector<Gram> by_block;
  for (int b = 0; b < d.blocks; ++b)
    by_block.push_back(gramOf(w, weights, [&](Index i) { return d.block[static_cast<std::size_t>(i)] == b; }));
  job.report(0.3, "comparing priors on blocks left out");
  parallelFor(members.size(), job, [&](std::size_t m) {
    const std::vector<Index> columns = columnsOf(d, members[m].power);
    members[m].left_out = leftOutError(d, by_block, all, columns,
                                       priorPrecision(d, columns, members[m].strength, members[m].slow, options));
  });
  double total = 0.0;
  double best = std::numeric_limits<double>::infinity();
  for (const Member& m : members) best = std::min(best, m.left_out);
  for (Member& m : members) {
    m.weight = std::pow((best + 1e-30) / (m.left_out + 1e-30), 2.0);
    total += m.weight;
  }
  // Average of the members; all columns, zeros where a member has none.
  const Index p = d.X.cols();
  Eigen::VectorXd average = Eigen::VectorXd::Zero(p + 1);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(p + 1, p + 1);
  std::vector<Eigen::VectorXd> solutions;
  double left_out = 0.0;
  double coefficients = 0.0;  // that the data determine
  for (Member& m : members) {
    m.weight /= total;
    const std::vector<Index> columns = columnsOf(d, m.power);
    const Eigen::VectorXd precision = priorPrecision(d, columns, m.strength, m.slow, options);
    const Solution s = solve(all, columns, precision, true);
    coefficients +=
        m.weight * (static_cast<double>(s.w.size()) - precision.dot(s.inverse.diagonal().tail(precision.size())));
    Eigen::VectorXd full = Eigen::VectorXd::Zero(p + 1);
    full[0] = s.w[0];
    for (std::size_t k = 0; k < columns.size(); ++k) full[columns[k] + 1] = s.w[static_cast<Index>(k) + 1];
    const Eigen::VectorXd e = (w.y - w.X * full).cwiseProduct(weights.cwiseSqrt());
    const double variance = e.squaredNorm() / std::max(1.0, weights.sum() - 1.0);
    m.innovation_variance = variance;
    left_out += m.weight * m.left_out;
    const auto at = [&](Index k) { return k == 0 ? Index{0} : columns[k - 1] + 1; };
    for (Index r = 0; r < s.inverse.rows(); ++r)
      for (Index c = 0; c < s.inverse.cols(); ++c) covariance(at(r), at(c)) += m.weight * variance * s.inverse(r, c);
    average += m.weight * full;
    result.speed_power += m.weight * m.power;
    solutions.push_back(std::move(full));
  }
  for (std::size_t m = 0; m < members.size(); ++m) {
    const Eigen::VectorXd difference = solutions[m] - average;
    covariance.noalias() += members[m].weight * difference * difference.transpose();
  }
  if (!average.allFinite()) {
    result.status = FitStatus::Degenerate;
    result.message = "the gains could not be determined; give fewer inputs or a longer training range.";
    return result;
  }
  job.report(0.7, "judging the inputs");

  // Reasons: what each input contributes and what is lost without it.
  const Member* leader = &members.front();
  for (const Member& m : members)
    if (m.left_out < leader->left_out) leader = &m;
  std::vector<InputVerdict> kept(usable.size());
  parallelFor(usable.size(), job, [&](std::size_t i) {
    InputVerdict& verdict = kept[i];
    verdict.name = usable[i];
    Eigen::VectorXd part = Eigen::VectorXd::Zero(d.y.size());
    for (std::size_t k = 0; k < d.features.size(); ++k)
      if (d.inputs[d.features[k].input].name == usable[i])
        part += average[static_cast<Index>(k) + 1] * d.X.col(static_cast<Index>(k));
    verdict.contribution_rms = std::sqrt(part.squaredNorm() / static_cast<double>(part.size()));
    const std::vector<Index> columns = columnsOf(d, leader->power, usable[i]);
    if (columns.empty() || !options.judge_inputs) {
      verdict.error_without_percent = std::numeric_limits<double>::quiet_NaN();
    } else {
      const double without =
          leftOutError(d, by_block, all, columns, priorPrecision(d, columns, leader->strength, leader->slow, options));
      verdict.error_without_percent = 100.0 * (std::sqrt(without / leader->left_out) - 1.0);
    }
    verdict.kept = verdict.contribution_rms >= 1e-3 * spread;
    verdict.reason =
        !verdict.kept
            ? fmt::format("its part of the prediction is below 0.1 % of the output ({:.2g})", verdict.contribution_rms)
        : !options.judge_inputs ? fmt::format("its part of the prediction is {:.2g} rms", verdict.contribution_rms)
        : std::isnan(verdict.error_without_percent)
            ? fmt::format("the only input; its part of the prediction is {:.2g} rms", verdict.contribution_rms)
            : fmt::format(
                  "its part of the prediction is {:.2g} rms; without it the error in blocks left out changes by "
                  "{:+.0f} %",
                  verdict.contribution_rms, verdict.error_without_percent);
  });
  result.verdicts.insert(result.verdicts.begin(), kept.begin(), kept.end());

  // The averaged model in original units. Each feature has its own reference: fold it into the offset.
  ThermalModel& model = result.model;
  model.kind = "response";
  model.period_s = d.period_s;
  model.train_from_s = std::max(from_s, series.time_s.front());
  model.train_to_s = std::min(to_s, series.time_s.back());
  model.source = series.file.string();
  ThermalOutput out;
  out.name = output;
  out.unit = unitOfSignal(output);
  std::vector<Index> columns;
  std::vector<int> place(d.inputs.size(), -1);
  for (Index k = 0; k < p; ++k) {
    const Feature& f = d.features[k];
    const auto verdict =
        std::find_if(kept.begin(), kept.end(), [&](const InputVerdict& v) { return v.name == d.inputs[f.input].name; });
    if (!verdict->kept) continue;
    if (place[f.input] < 0) {
      place[f.input] = static_cast<int>(model.inputs.size());
      model.inputs.push_back(d.inputs[f.input]);
      model.inputs.back().reference = f.reference;
    }
    columns.push_back(k);
    out.terms.push_back({place[f.input], f.tau_s, average[k + 1]});
  }
  if (columns.empty()) {
    result.status = FitStatus::Degenerate;
    result.message = "no input explains anything of the output in the training range; give other inputs.";
    return result;
  }
  // y = y_mean + w0 + sum w_k (x_k - r_k) = offset + sum w_k (x_k - r_input): offset = y_mean + w0 + sum w_k (r_input -
  // r_k).
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(static_cast<Index>(columns.size()) + 1, p + 1);
  T(0, 0) = 1.0;
  out.offset = d.y_mean + average[0];
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const double shift = model.inputs[out.terms[k].input].reference - d.features[columns[k]].reference;
    out.offset += average[columns[k] + 1] * shift;
    T(0, columns[k] + 1) = shift;
    T(static_cast<Index>(k) + 1, columns[k] + 1) = 1.0;
  }
  const Eigen::ArrayXd left = d.y.array() - d.y_mean - average[0] - (d.X * average.tail(p)).array();
  const double noise = (weights.array() * left.square()).sum() / weights.sum();
  // As many rows as are independent of each other lost what the coefficients took of them.
  const double correlation = neighbourCorrelation(left.matrix());
  const double independent = weights.sum() * (1.0 - correlation) / (1.0 + correlation);
  const double unseen = independent / std::max(independent - coefficients, 0.25 * independent);
  out.noise_sigma = std::sqrt(unseen * noise + (weights.array() * d.scatter.array()).sum() / weights.sum());
  result.calibration = calibration(d, w, weights, by_block, all, members, average, unseen, options, job.part(0.8, 1.0));
  covariance *= result.calibration;
  out.covariance = T * covariance * T.transpose();
  out.noise_tau_s = options.noise_tau_s;
  result.left_out_rms = std::sqrt(left_out);
  model.outputs.push_back(std::move(out));
  model.learnPattern(series, 0, from_s, to_s);
  result.status = FitStatus::Converged;
  result.message = fmt::format("{} inputs, {} time constants, {} bins of {:.6g} s", model.inputs.size(), columns.size(),
                               d.y.size(), d.period_s);
  return result;
}

}  // namespace spindrift
