// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/input_projection.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/base/error.h"
#include "core/base/random.h"

namespace spindrift {
namespace {

using Eigen::Index;

struct Course {
  std::vector<std::string> names;
  std::vector<std::vector<Index>> columns;  ///< of X, per name
  Eigen::MatrixXd X;                        ///< bins x lags
  Eigen::MatrixXd f;                        ///< bins x outputs
};

/// Means over bins are linear: those of a prediction follow from those of its lags, and no row of a long record is
/// predicted for itself.
Course courseOf(const TimeSeries& series, const std::vector<ThermalModel>& models, double from_s, double to_s) {
  constexpr double bins_of_training = 400.0;
  const double span = std::min(to_s, series.time_s.back()) - std::max(from_s, series.time_s.front());
  const BinnedSeries bins =
      binSeries(series.time_s, std::max(series.medianPeriod_s(), span / bins_of_training), from_s, to_s);
  const auto rows = static_cast<Index>(bins.rows.size());
  Course course;
  struct Lag {
    ThermalInput input;
    double tau_s = 0.0;
  };
  std::vector<Lag> lags;
  std::vector<std::vector<Index>> lag_of_term(models.size());
  for (std::size_t m = 0; m < models.size(); ++m) {
    SPINDRIFT_ASSERT(models[m].outputs.size() == 1, "one output a model");
    for (const LagTerm& term : models[m].outputs.front().terms) {
      const ThermalInput& input = models[m].inputs[static_cast<std::size_t>(term.input)];
      const auto known = std::find_if(lags.begin(), lags.end(), [&](const Lag& l) {
        return l.input.name == input.name && l.input.power == input.power && l.input.scale == input.scale &&
               l.tau_s == term.tau_s;
      });
      lag_of_term[m].push_back(known - lags.begin());
      if (known == lags.end()) lags.push_back({input, term.tau_s});
    }
  }
  course.X.resize(rows, static_cast<Index>(lags.size()));
  // A lag knows nothing of what comes after the bins.
  const std::size_t until = bins.rows.empty() ? 0 : static_cast<std::size_t>(bins.rows.back().second);
  const std::span<const double> time_s = std::span(series.time_s).first(until);
  std::vector<double> u;
  for (std::size_t k = 0; k < lags.size(); ++k) {
    const ThermalInput& input = lags[k].input;
    const bool hold = holdsUntilNextRow(input.kind);
    const bool same = k > 0 && lags[k - 1].input.name == input.name && lags[k - 1].input.power == input.power &&
                      lags[k - 1].input.scale == input.scale;
    if (!same) {
      u = bridged(series.time_s, series.at(input.name).values, hold);
      u.resize(until);
      for (double& v : u) v = input.transformed(v);
    }
    const std::vector<double> x = bins.mean(lagFiltered(time_s, u, lags[k].tau_s, hold));
    course.X.col(static_cast<Index>(k)) = Eigen::Map<const Eigen::VectorXd>(x.data(), rows);
    auto place = std::find(course.names.begin(), course.names.end(), input.name) - course.names.begin();
    if (place == std::ssize(course.names)) {
      course.names.push_back(input.name);
      course.columns.emplace_back();
    }
    course.columns[static_cast<std::size_t>(place)].push_back(static_cast<Index>(k));
  }
  course.f.resize(rows, static_cast<Index>(models.size()));
  for (std::size_t m = 0; m < models.size(); ++m) {
    const ThermalOutput& output = models[m].outputs.front();
    auto f = course.f.col(static_cast<Index>(m));
    f.setConstant(output.offset);
    for (std::size_t k = 0; k < output.terms.size(); ++k) {
      const LagTerm& term = output.terms[k];
      const double reference = models[m].inputs[static_cast<std::size_t>(term.input)].reference;
      f.array() += term.gain * (course.X.col(lag_of_term[m][k]).array() - reference);
    }
  }
  return course;
}

/// Normal matrices of some rows, centred; what a set of inputs leaves.
class Projection {
 public:
  Projection(const Course& course, const std::vector<Index>& rows, double shrinkage) : course_(course) {
    Eigen::MatrixXd X = course.X(rows, Eigen::all);
    Eigen::MatrixXd f = course.f(rows, Eigen::all);
    X.rowwise() -= X.colwise().mean().eval();
    f.rowwise() -= f.colwise().mean().eval();
    for (Index o = 0; o < f.cols(); ++o) {
      const double size = f.col(o).norm();
      if (size > 0.0) f.col(o) /= size;
    }
    outputs_ = static_cast<double>(f.cols());
    A_ = X.transpose() * X;
    B_ = X.transpose() * f;
    whole_ = f.squaredNorm();
    // A lag that is constant in these rows still has a positive diagonal.
    ridge_ = (shrinkage * A_.diagonal()).cwiseMax(1e-12 * A_.diagonal().maxCoeff());
  }

  /// Root of the mean square over the outputs, relative.
  [[nodiscard]] double left(const std::vector<std::size_t>& set) const {
    std::vector<Index> columns;
    for (const std::size_t i : set) columns.insert(columns.end(), course_.columns[i].begin(), course_.columns[i].end());
    if (columns.empty()) return std::sqrt(whole_ / outputs_);
    const Eigen::MatrixXd plain = A_(columns, columns);
    Eigen::MatrixXd A = plain;
    A.diagonal() += ridge_(columns);
    const Eigen::MatrixXd B = B_(columns, Eigen::all);
    const Eigen::MatrixXd w = A.ldlt().solve(B);
    const double sum = whole_ - 2.0 * w.cwiseProduct(B).sum() + w.cwiseProduct(plain * w).sum();
    return std::sqrt(std::max(0.0, sum) / outputs_);
  }

  [[nodiscard]] std::vector<std::size_t> forward(const ProjectionOptions& options) const {
    std::vector<std::size_t> set;
    while (std::ssize(set) < std::min<std::ptrdiff_t>(options.maximum_inputs, std::ssize(course_.names))) {
      double best = std::numeric_limits<double>::infinity();
      std::size_t winner = 0;
      for (std::size_t i = 0; i < course_.names.size(); ++i) {
        if (std::find(set.begin(), set.end(), i) != set.end()) continue;
        std::vector<std::size_t> trial = set;
        trial.push_back(i);
        if (const double here = left(trial); here < best) {
          best = here;
          winner = i;
        }
      }
      set.push_back(winner);
      if (best <= options.tolerance) break;
    }
    return set;
  }

 private:
  const Course& course_;
  Eigen::MatrixXd A_;
  Eigen::MatrixXd B_;
  Eigen::VectorXd ridge_;
  double whole_ = 0.0;
  double outputs_ = 1.0;
};

}  // namespace

ProjectionResult projectOntoFewInputs(const TimeSeries& series, const std::vector<ThermalModel>& models, double from_s,
                                      double to_s, const ProjectionOptions& options, const JobContext& job) {
  SPINDRIFT_ASSERT(!models.empty(), "at least one model is needed");
  const Course course = courseOf(series, models, from_s, to_s);
  std::vector<Index> all(static_cast<std::size_t>(course.X.rows()));
  for (std::size_t r = 0; r < all.size(); ++r) all[r] = static_cast<Index>(r);
  const Projection whole(course, all, options.shrinkage);
  const std::vector<std::size_t> kept = whole.forward(options);

  // Halves made of blocks of time: neighbours in time stay together.
  std::vector<std::vector<std::size_t>> chosen(static_cast<std::size_t>(std::max(0, options.resamples)));
  std::vector<Random> streams;
  Random random(options.seed);
  for (std::size_t r = 0; r < chosen.size(); ++r) streams.push_back(random.split());
  parallelFor(chosen.size(), job, [&](std::size_t r) {
    const std::size_t piece = std::max<std::size_t>(1, all.size() / 24);
    std::vector<Index> rows;
    while (rows.size() < std::min<std::size_t>(20, all.size())) {
      rows.clear();
      for (std::size_t first = 0; first < all.size(); first += piece) {
        if (streams[r].uniform() < 0.5) continue;
        for (std::size_t i = first; i < std::min(first + piece, all.size()); ++i) rows.push_back(all[i]);
      }
    }
    chosen[r] = Projection(course, rows, options.shrinkage).forward(options);
  });

  ProjectionResult result;
  result.left = whole.left(kept);
  std::vector<std::size_t> order = kept;
  for (std::size_t i = 0; i < course.names.size(); ++i)
    if (std::find(kept.begin(), kept.end(), i) == kept.end()) order.push_back(i);
  for (const std::size_t i : order) {
    ProjectedInput input;
    input.name = course.names[i];
    std::vector<std::size_t> other = kept;
    if (const auto place = std::find(other.begin(), other.end(), i); place != other.end()) {
      input.kept = true;
      other.erase(place);
      result.kept.push_back(input.name);
    } else {
      other.push_back(i);
    }
    input.left = whole.left(other);
    for (const auto& set : chosen)
      if (std::find(set.begin(), set.end(), i) != set.end())
        input.frequency += 1.0 / static_cast<double>(chosen.size());
    result.inputs.push_back(std::move(input));
  }
  return result;
}

ProjectedModel projectModel(const TimeSeries& series, const ThermalModel& model, const std::vector<std::string>& kept,
                            double from_s, double to_s, const ProjectionOptions& options) {
  SPINDRIFT_ASSERT(model.outputs.size() == 1, "one output");
  const ThermalOutput& all = model.outputs.front();
  const Course course = courseOf(series, {model}, from_s, to_s);
  // The lags of the course stand in the order of the terms, each once.
  SPINDRIFT_ASSERT(course.X.cols() == std::ssize(all.terms), "every time constant once");
  Eigen::VectorXd mean = course.X.colwise().mean().transpose();
  const Eigen::MatrixXd X = course.X.rowwise() - mean.transpose();
  for (Index k = 0; k < mean.size(); ++k)
    mean[k] -= model.inputs[static_cast<std::size_t>(all.terms[static_cast<std::size_t>(k)].input)].reference;
  std::vector<Index> columns;
  std::vector<std::size_t> owner;
  ProjectedModel out;
  out.model = model;
  out.model.inputs.clear();
  ThermalOutput& few = out.model.outputs.front();
  few.terms.clear();
  few.pattern.reset();
  std::vector<int> place(model.inputs.size(), -1);
  for (std::size_t k = 0; k < all.terms.size(); ++k) {
    const auto i = static_cast<std::size_t>(all.terms[k].input);
    const auto found = std::find(kept.begin(), kept.end(), model.inputs[i].name);
    if (found == kept.end()) continue;
    if (place[i] < 0) {
      place[i] = static_cast<int>(out.model.inputs.size());
      out.model.inputs.push_back(model.inputs[i]);
    }
    columns.push_back(static_cast<Index>(k));
    owner.push_back(static_cast<std::size_t>(found - kept.begin()));
    few.terms.push_back({place[i], all.terms[k].tau_s, 0.0});
  }
  const Eigen::MatrixXd S = X(Eigen::all, columns);
  Eigen::MatrixXd A = S.transpose() * S;
  const Eigen::VectorXd ridge = (options.shrinkage * A.diagonal()).cwiseMax(1e-12 * A.diagonal().maxCoeff());
  A.diagonal() += ridge;
  // Shrunk is what the gains change by: a kept input goes on telling what it told, also where training did not lead.
  Eigen::MatrixXd right = S.transpose() * X;
  for (std::size_t k = 0; k < columns.size(); ++k)
    right(static_cast<Index>(k), columns[k]) += ridge[static_cast<Index>(k)];
  const Eigen::MatrixXd M = A.ldlt().solve(right);
  const auto n = static_cast<Index>(columns.size());
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(n + 1, X.cols() + 1);
  T(0, 0) = 1.0;
  T.row(0).tail(X.cols()) = mean.transpose() - mean(columns).transpose() * M;
  T.bottomRightCorner(n, X.cols()) = M;
  Eigen::VectorXd coefficients(X.cols() + 1);
  coefficients[0] = all.offset;
  for (Index k = 0; k < X.cols(); ++k) coefficients[k + 1] = all.terms[static_cast<std::size_t>(k)].gain;
  const Eigen::VectorXd projected = T * coefficients;
  few.offset = projected[0];
  for (Index k = 0; k < n; ++k) few.terms[static_cast<std::size_t>(k)].gain = projected[k + 1];
  if (all.covariance.rows() == T.cols()) few.covariance = T * all.covariance * T.transpose();
  Eigen::MatrixXd part = Eigen::MatrixXd::Zero(X.rows(), static_cast<Index>(kept.size()));
  for (Index k = 0; k < n; ++k)
    part.col(static_cast<Index>(owner[static_cast<std::size_t>(k)])) += projected[k + 1] * S.col(k);
  for (Index i = 0; i < part.cols(); ++i)
    out.contribution_rms.push_back(std::sqrt(part.col(i).squaredNorm() / static_cast<double>(part.rows())));
  out.model.learnPattern(series, 0, from_s, to_s);
  return out;
}

}  // namespace spindrift
