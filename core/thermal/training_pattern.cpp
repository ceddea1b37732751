// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/training_pattern.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "core/thermal/thermal_model.h"
#include "core/thermal/time_series.h"

namespace spindrift {
namespace {

using Eigen::Index;

constexpr double noise_floor = 0.1;   // of the spread
constexpr Index rows_at_once = 4096;  // of a long record
constexpr Index most_places = 48;
constexpr std::size_t learnt_rows = 2000;  // of training; more tell nothing new

/// Column by column: the input and its lag.
std::vector<std::vector<double>> valuesOf(const TimeSeries& series, const std::string& name, double lag_s) {
  const Signal& signal = series.at(name);
  const bool hold = holdsUntilNextRow(signal.kind);
  std::vector<double> now = bridged(series.time_s, signal.values, hold);
  std::vector<double> late = lagFiltered(series.time_s, now, lag_s, hold);
  return {std::move(now), std::move(late)};
}

}  // namespace

TrainingPattern trainingPattern(const TimeSeries& series, const std::vector<std::string>& inputs, double from_s,
                                double to_s) {
  TrainingPattern pattern;
  std::vector<std::size_t> rows;
  for (std::size_t r = 0; r < series.time_s.size(); ++r)
    if (series.time_s[r] >= from_s && series.time_s[r] < to_s) rows.push_back(r);
  if (rows.size() < 2) return pattern;
  pattern.lag_s = std::min(3600.0, (series.time_s[rows.back()] - series.time_s[rows.front()]) / 20.0);
  const std::size_t stride = std::max<std::size_t>(1, rows.size() / learnt_rows);
  std::vector<Eigen::VectorXd> now;
  std::vector<Eigen::VectorXd> late;
  for (const std::string& name : inputs) {
    if (std::find(pattern.inputs.begin(), pattern.inputs.end(), name) != pattern.inputs.end()) continue;
    const std::vector<std::vector<double>> values = valuesOf(series, name, pattern.lag_s);
    std::vector<Eigen::VectorXd> both;
    for (const std::vector<double>& v : values) {
      Eigen::VectorXd column(static_cast<Index>((rows.size() + stride - 1) / stride));
      for (Index k = 0; k < column.size(); ++k) column[k] = v[rows[static_cast<std::size_t>(k) * stride]];
      both.push_back(std::move(column));
    }
    const double range = both[0].maxCoeff() - both[0].minCoeff();
    if (!both[0].allFinite() || !(range > 1e-9 * std::max(1.0, both[0].cwiseAbs().maxCoeff()))) continue;
    pattern.inputs.push_back(name);
    now.push_back(std::move(both[0]));
    late.push_back(std::move(both[1]));
  }
  if (pattern.inputs.empty()) return pattern;
  std::move(late.begin(), late.end(), std::back_inserter(now));
  const auto width = static_cast<Index>(now.size());
  Eigen::MatrixXd z(now.front().size(), width);
  Eigen::VectorXd spread(width);
  pattern.mean.resize(width);
  for (Index k = 0; k < width; ++k) {
    const Eigen::VectorXd& v = now[static_cast<std::size_t>(k)];
    pattern.mean[k] = v.mean();
    spread[k] = std::sqrt((v.array() - pattern.mean[k]).square().mean());
    // A lag that hardly moves is measured by the spread of its input.
    const Index own = k % static_cast<Index>(pattern.inputs.size());
    if (k != own) spread[k] = std::max(spread[k], noise_floor * spread[own]);
    z.col(k) = (v.array() - pattern.mean[k]) / spread[k];
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(z.transpose() * z / static_cast<double>(z.rows()));
  const Eigen::VectorXd scale =
      (solver.eigenvalues().cwiseMax(0.0).array() + noise_floor * noise_floor).rsqrt().matrix();
  const Eigen::MatrixXd turned = scale.asDiagonal() * solver.eigenvectors().transpose();
  const Eigen::MatrixXd places = z * turned.transpose();
  pattern.directions = turned * spread.cwiseInverse().asDiagonal();
  // Each place the furthest from those before.
  std::vector<Index> chosen = {0};
  Eigen::VectorXd distance = (places.rowwise() - places.row(0)).rowwise().norm();
  Index furthest = 0;
  while (distance.maxCoeff(&furthest) > noise_floor && std::ssize(chosen) < most_places) {
    chosen.push_back(furthest);
    distance = distance.cwiseMin((places.rowwise() - places.row(furthest)).rowwise().norm());
  }
  pattern.seen = places(chosen, Eigen::all);
  pattern.reach = 1.0 + distance.maxCoeff();
  return pattern;
}

std::vector<double> TrainingPattern::novelty(const TimeSeries& series) const {
  const auto all = static_cast<Index>(series.time_s.size());
  std::vector<double> out(series.time_s.size(), 0.0);
  if (inputs.empty() || !(reach > 0.0)) return out;
  const auto count = static_cast<Index>(inputs.size());
  std::vector<std::vector<double>> values;
  std::vector<std::size_t> held;  // 1: holds until the next row
  for (const std::string& name : inputs) {
    const Signal& signal = series.at(name);
    const bool hold = holdsUntilNextRow(signal.kind);
    values.push_back(bridged(series.time_s, signal.values, hold));
    held.push_back(hold ? 1 : 0);
  }
  Eigen::VectorXd late(count);
  std::array<LagStep, 2> step;  // linear between rows, held
  double last_dt_s = -1.0;
  Eigen::MatrixXd z(2 * count, std::min(rows_at_once, all));
  const Eigen::MatrixXd places = seen.transpose();
  const Eigen::VectorXd half_square = 0.5 * places.colwise().squaredNorm().transpose();
  for (Index first = 0; first < all; first += rows_at_once) {
    const Index rows = std::min(rows_at_once, all - first);
    for (Index r = 0; r < rows; ++r) {
      const auto row = static_cast<std::size_t>(first + r);
      const double dt_s = row > 0 ? series.time_s[row] - series.time_s[row - 1] : 0.0;
      if (row > 0 && dt_s != last_dt_s) {
        step = {lagStep(dt_s, lag_s, false), lagStep(dt_s, lag_s, true)};
        last_dt_s = dt_s;
      }
      for (Index k = 0; k < count; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const double u = values[i][row];
        const LagStep& s = step[held[i]];
        late[k] = row == 0 ? u : s.a * late[k] + s.b0 * values[i][row - 1] + s.b1 * u;
        z(k, r) = u - mean[k];
        z(count + k, r) = late[k] - mean[count + k];
      }
    }
    // The nearest place has the largest p's - s's / 2; its distance is then taken without cancellation.
    const Eigen::MatrixXd here = directions * z.leftCols(rows);
    const Eigen::MatrixXd likeness = (places.transpose() * here).colwise() - half_square;
    for (Index r = 0; r < rows; ++r) {
      Index nearest = 0;
      likeness.col(r).maxCoeff(&nearest);
      out[static_cast<std::size_t>(first + r)] = (here.col(r) - places.col(nearest)).norm() / reach;
    }
  }
  return out;
}

std::vector<std::string> TrainingPattern::apart(const TimeSeries& series, std::size_t row) const {
  const auto count = static_cast<Index>(inputs.size());
  if (count < 2) return {};
  const Eigen::MatrixXd covariance = (directions.transpose() * directions).inverse().topLeftCorner(count, count);
  Eigen::VectorXd z(count);
  for (Index k = 0; k < count; ++k) {
    const std::string& name = inputs[static_cast<std::size_t>(k)];
    const Signal& signal = series.at(name);
    z[k] = bridged(series.time_s, signal.values, holdsUntilNextRow(signal.kind))[row] - mean[k];
  }
  std::vector<std::string> out;
  double largest = 0.0;
  for (Index i = 0; i < count; ++i) {
    for (Index k = i + 1; k < count; ++k) {
      const std::array<Index, 2> pair{i, k};
      const Eigen::Matrix2d of_pair = covariance(pair, pair);
      const Eigen::Vector2d here = z(pair);
      const double together = here.dot(of_pair.ldlt().solve(here));
      const double alone = (here.array().square() / of_pair.diagonal().array()).maxCoeff();
      if (!(together > largest) || !(together > 2.0 * alone)) continue;
      largest = together;
      out = {inputs[static_cast<std::size_t>(i)], inputs[static_cast<std::size_t>(k)]};
    }
  }
  return out;
}

}  // namespace spindrift
