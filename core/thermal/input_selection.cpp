// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/input_selection.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/math/singular_values.h"
#include "core/thermal/thermal_model.h"

namespace spindrift {
namespace {

using Eigen::Index;

struct Groups {
  std::vector<std::string> names;
  std::vector<std::string> refused;  ///< constant in the range
  std::vector<Eigen::MatrixXd> X;    ///< orthonormal columns (times sqrt n) per input
  Eigen::VectorXd y;
  std::vector<int> block;
};

Groups prepare(const TimeSeries& series, const std::string& output, const std::vector<std::string>& candidates,
               double from_s, double to_s, const SelectionOptions& options) {
  Groups g;
  const double span = std::min(to_s, series.time_s.back()) - std::max(from_s, series.time_s.front());
  const double period = std::max(series.medianPeriod_s(), span / 600.0);
  const BinnedSeries bins = binSeries(series.time_s, period, from_s, to_s);
  const std::vector<double> y = bins.mean(series.at(output).values);
  std::vector<std::size_t> used;
  for (std::size_t k = 0; k < y.size(); ++k)
    if (std::isfinite(y[k])) used.push_back(k);
  if (used.size() < 40) {
    throw InputError({series.file, fmt::format("column {}", output)},
                     fmt::format("{} samples are too few to choose inputs; allowed: at least 40 in the training range.",
                                 used.size()));
  }
  const auto n = static_cast<Index>(used.size());
  g.y.resize(n);
  for (Index i = 0; i < n; ++i) {
    g.y[i] = y[used[static_cast<std::size_t>(i)]];
    g.block.push_back(static_cast<int>(i * options.blocks / n));
  }
  g.y.array() -= g.y.mean();
  const double scale = std::sqrt(g.y.squaredNorm() / static_cast<double>(n));
  if (!(scale > 0.0))
    throw InputError({series.file, fmt::format("column {}", output)},
                     "it is constant in the training range; allowed: an output that changes.");
  g.y /= scale;
  for (const std::string& name : candidates) {
    const Signal& signal = series.at(name);
    const bool hold = holdsUntilNextRow(signal.kind);
    std::vector<double> u = bridged(series.time_s, signal.values, hold);
    const bool driven = isDriven(signal.kind);
    if (driven)
      for (double& v : u) v = std::copysign(std::pow(std::abs(v) * 1e-3, options.speed_power), v);
    Eigen::MatrixXd X(n, static_cast<Index>(options.taus_s.size()));
    for (std::size_t k = 0; k < options.taus_s.size(); ++k) {
      const std::vector<double> x = bins.mean(lagFiltered(series.time_s, u, options.taus_s[k], hold));
      for (Index i = 0; i < n; ++i) X(i, static_cast<Index>(k)) = x[used[static_cast<std::size_t>(i)]];
      X.col(static_cast<Index>(k)).array() -= X.col(static_cast<Index>(k)).mean();
    }
    const SingularValues svd = singularValues(X);
    if (!(svd.values[0] > 1e-9 * std::sqrt(static_cast<double>(n)))) {
      g.refused.push_back(name);
      continue;
    }
    g.names.push_back(name);
    g.X.push_back(svd.left.leftCols(svd.rank(1e-2)) * std::sqrt(static_cast<double>(n)));
  }
  if (g.X.empty())
    throw InputError({series.file, ""},
                     "all candidate inputs are constant in the training range; allowed: inputs that change.");
  return g;
}

/// Held-out rms (relative to the output's spread) of a ridge refit on a set, over blocks left out.
double heldOut(const Groups& g, const std::vector<std::size_t>& set, int blocks, double* standard_error = nullptr) {
  Index p = 1;
  for (const std::size_t k : set) p += g.X[k].cols();
  Eigen::MatrixXd A(g.y.size(), p);
  A.col(0).setOnes();
  Index at = 1;
  for (const std::size_t k : set) {
    A.middleCols(at, g.X[k].cols()) = g.X[k];
    at += g.X[k].cols();
  }
  const auto n = static_cast<double>(g.y.size());
  const Eigen::MatrixXd full = A.transpose() * A;
  const Eigen::VectorXd rhs = A.transpose() * g.y;
  std::vector<double> errors;
  double total = 0.0;
  for (int b = 0; b < blocks; ++b) {
    Index first = 0;
    while (first < g.y.size() && g.block[static_cast<std::size_t>(first)] != b) ++first;
    Index last = first;
    while (last < g.y.size() && g.block[static_cast<std::size_t>(last)] == b) ++last;
    if (last == first) continue;
    const auto Ab = A.middleRows(first, last - first);
    const auto yb = g.y.segment(first, last - first);
    Eigen::MatrixXd normal = full - Ab.transpose() * Ab;
    normal.diagonal().array() += 3e-3 * n;
    const Eigen::VectorXd w = normal.ldlt().solve(rhs - Ab.transpose() * yb);
    const double e = (yb - Ab * w).squaredNorm();
    total += e;
    errors.push_back(e / static_cast<double>(last - first));
  }
  if (standard_error != nullptr) {
    const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
    double square = 0.0;
    for (const double e : errors) square += (e - mean) * (e - mean);
    *standard_error =
        std::sqrt(square / std::max<std::size_t>(1, errors.size() - 1) / static_cast<double>(errors.size()));
  }
  return std::sqrt(total / n);
}

/// Group LASSO along a descending path on some rows. Gives, per step, which groups are in.
std::vector<std::vector<std::size_t>> lassoPath(const Groups& g, const std::vector<Index>& rows, int steps,
                                                std::vector<double>* entry) {
  const auto groups = g.X.size();
  const auto n = static_cast<double>(rows.size());
  std::vector<Index> start(groups + 1, 0);
  for (std::size_t k = 0; k < groups; ++k) start[k + 1] = start[k] + g.X[k].cols();
  const Index p = start[groups];
  Eigen::MatrixXd A(static_cast<Index>(rows.size()), p);
  Eigen::VectorXd y(static_cast<Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    y[static_cast<Index>(i)] = g.y[rows[i]];
    for (std::size_t k = 0; k < groups; ++k)
      A.row(static_cast<Index>(i)).segment(start[k], g.X[k].cols()) = g.X[k].row(rows[i]);
  }
  const Eigen::RowVectorXd centre = A.colwise().mean();
  A.rowwise() -= centre;
  y.array() -= y.mean();
  const Eigen::MatrixXd Q = A.transpose() * A / n;
  const Eigen::VectorXd c = A.transpose() * y / n;
  // On part of the rows a group is no longer exactly orthonormal: its largest eigenvalue bounds the step.
  std::vector<double> curvature(groups);
  double largest = 0.0;
  for (std::size_t k = 0; k < groups; ++k) {
    const Index m = g.X[k].cols();
    curvature[k] = std::max(
        1e-12, Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Q.block(start[k], start[k], m, m), Eigen::EigenvaluesOnly)
                   .eigenvalues()
                   .maxCoeff());
    largest = std::max(largest, c.segment(start[k], m).norm() / std::sqrt(static_cast<double>(m)));
  }
  Eigen::VectorXd w = Eigen::VectorXd::Zero(p);
  Eigen::VectorXd gradient = c;  // c - Q w
  std::vector<std::vector<std::size_t>> path;
  if (entry != nullptr) entry->assign(groups, 0.0);
  for (int s = 0; s < steps; ++s) {
    const double relative = std::pow(10.0, -2.5 * s / std::max(1, steps - 1));
    const double lambda = largest * relative;
    for (int sweep = 0; sweep < 200; ++sweep) {
      double change = 0.0;
      for (std::size_t k = 0; k < groups; ++k) {
        const Index m = g.X[k].cols();
        const Eigen::VectorXd old = w.segment(start[k], m);
        const Eigen::VectorXd z = old + gradient.segment(start[k], m) / curvature[k];
        const double shrink =
            1.0 - lambda * std::sqrt(static_cast<double>(m)) / curvature[k] / std::max(z.norm(), 1e-300);
        const Eigen::VectorXd next = shrink > 0.0 ? Eigen::VectorXd(shrink * z) : Eigen::VectorXd::Zero(m);
        const Eigen::VectorXd delta = next - old;
        if (delta.squaredNorm() == 0.0) continue;
        w.segment(start[k], m) = next;
        gradient.noalias() -= Q.middleCols(start[k], m) * delta;
        change = std::max(change, delta.cwiseAbs().maxCoeff());
      }
      if (change < 1e-5) break;
    }
    std::vector<std::size_t> in;
    for (std::size_t k = 0; k < groups; ++k) {
      if (w.segment(start[k], g.X[k].cols()).squaredNorm() == 0.0) continue;
      in.push_back(k);
      if (entry != nullptr && (*entry)[k] == 0.0) (*entry)[k] = relative;
    }
    path.push_back(std::move(in));
  }
  return path;
}

std::vector<Index> allRows(const Groups& g) {
  std::vector<Index> rows(static_cast<std::size_t>(g.y.size()));
  std::iota(rows.begin(), rows.end(), Index{0});
  return rows;
}

void explain(const Groups& g, const std::vector<std::size_t>& kept, const std::vector<double>& entry,
             const std::vector<double>& frequency, const SelectionOptions& options, SelectionResult& result) {
  result.held_out_rms = heldOut(g, kept, options.blocks);
  for (std::size_t k = 0; k < g.names.size(); ++k) {
    SelectedInput in;
    in.name = g.names[k];
    in.kept = std::find(kept.begin(), kept.end(), k) != kept.end();
    in.enters_at = k < entry.size() ? entry[k] : 0.0;
    in.frequency = k < frequency.size() ? frequency[k] : 0.0;
    std::vector<std::size_t> other = kept;
    if (in.kept) {
      other.erase(std::find(other.begin(), other.end(), k));
    } else {
      other.push_back(k);
    }
    in.error_without = heldOut(g, other, options.blocks);
    const double change = 100.0 * (in.error_without / result.held_out_rms - 1.0);
    in.reason =
        in.kept ? fmt::format("held-out error changes by {:+.0f} % without it; chosen in {:.0f} % of the resamples",
                              change, 100.0 * in.frequency)
                : fmt::format("held-out error would change by {:+.0f} % with it; chosen in {:.0f} % of the resamples",
                              change, 100.0 * in.frequency);
    if (in.kept && in.frequency < options.stable_from) in.reason += " (not stable: another sensor may do as well)";
    result.inputs.push_back(in);
  }
  for (const std::string& name : g.refused) {
    SelectedInput in;
    in.name = name;
    in.reason = "constant in the training range: its effect cannot be learnt from these data";
    result.inputs.push_back(in);
  }
  for (const std::size_t k : kept) result.kept.push_back(g.names[k]);
}

std::vector<double> stability(const Groups& g, std::size_t size, const SelectionOptions& options,
                              const JobContext& job) {
  std::vector<double> frequency(g.X.size(), 0.0);
  if (options.resamples <= 0) return frequency;
  std::vector<std::vector<std::size_t>> chosen(static_cast<std::size_t>(options.resamples));
  std::vector<Random> streams;
  Random random(options.seed);
  for (int r = 0; r < options.resamples; ++r) streams.push_back(random.split());
  parallelFor(chosen.size(), job, [&](std::size_t r) {
    // Random half of short blocks of time: neighbours in time stay together.
    const Index piece = std::max<Index>(1, g.y.size() / 24);
    std::vector<Index> rows;
    while (rows.size() < 20) {
      rows.clear();
      for (Index first = 0; first < g.y.size(); first += piece) {
        if (streams[r].uniform() < 0.5) continue;
        for (Index i = first; i < std::min(first + piece, g.y.size()); ++i) rows.push_back(i);
      }
    }
    // The first point of the path with a little more inputs than the model has: half the data order them less surely.
    for (const auto& in : lassoPath(g, rows, options.path, nullptr)) {
      chosen[r] = in;
      if (in.size() >= size + 2) break;
    }
  });
  for (const auto& in : chosen)
    for (const std::size_t k : in) frequency[k] += 1.0 / static_cast<double>(options.resamples);
  return frequency;
}

}  // namespace

SelectionResult selectByGroupLasso(const TimeSeries& series, const std::string& output,
                                   const std::vector<std::string>& candidates, double from_s, double to_s,
                                   const SelectionOptions& options, const JobContext& job) {
  const Groups g = prepare(series, output, candidates, from_s, to_s, options);
  std::vector<double> entry;
  const auto path = lassoPath(g, allRows(g), options.path, &entry);
  double best = std::numeric_limits<double>::infinity();
  double allowed = best;
  std::vector<double> errors;
  for (const auto& set : path) {
    double standard_error = 0.0;
    errors.push_back(set.empty() ? 1.0 : heldOut(g, set, options.blocks, &standard_error));
    const double square = errors.back() * errors.back();
    if (!set.empty() && square < best) {
      best = square;
      allowed = square + standard_error;
    }
    job.throwIfCancelled();
  }
  std::vector<std::size_t> kept = path.back();
  for (std::size_t s = 0; s < path.size(); ++s) {
    if (path[s].empty() || errors[s] * errors[s] > allowed) continue;
    kept = path[s];
    break;
  }
  std::stable_sort(kept.begin(), kept.end(), [&](std::size_t a, std::size_t b) { return entry[a] > entry[b]; });
  SelectionResult result;
  result.method = "group LASSO";
  explain(g, kept, entry, stability(g, kept.size(), options, job), options, result);
  return result;
}

std::vector<SensorCluster> clusterSensors(const TimeSeries& series, const std::vector<std::string>& names, int count) {
  std::vector<std::vector<double>> change;
  std::vector<double> range;
  for (const std::string& name : names) {
    std::vector<double> v = bridged(series.time_s, series.at(name).values, false);
    const auto [low, high] = std::minmax_element(v.begin(), v.end());
    range.push_back(*high - *low);
    const double first = v.front();
    for (double& x : v) x -= first;
    change.push_back(std::move(v));
  }
  const std::size_t n = names.size();
  if (n == 0) return {};
  Eigen::MatrixXd distance = Eigen::MatrixXd::Zero(static_cast<Index>(n), static_cast<Index>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      double sum = 0.0;
      double a = 0.0;
      double b = 0.0;
      for (std::size_t r = 0; r < change[i].size(); ++r) {
        sum += (change[i][r] - change[j][r]) * (change[i][r] - change[j][r]);
        a += change[i][r] * change[i][r];
        b += change[j][r] * change[j][r];
      }
      const double d = std::max(a, b) > 0.0 ? std::sqrt(sum / std::max(a, b)) : 0.0;
      distance(static_cast<Index>(i), static_cast<Index>(j)) = distance(static_cast<Index>(j), static_cast<Index>(i)) =
          d;
    }
  }
  std::vector<std::vector<std::size_t>> clusters;
  for (std::size_t i = 0; i < n; ++i) clusters.push_back({i});
  std::vector<std::vector<std::vector<std::size_t>>> history = {clusters};
  std::vector<double> height;
  while (clusters.size() > 1) {
    double best = std::numeric_limits<double>::infinity();
    std::size_t bi = 0;
    std::size_t bj = 1;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      for (std::size_t j = i + 1; j < clusters.size(); ++j) {
        double sum = 0.0;
        for (const std::size_t a : clusters[i])
          for (const std::size_t b : clusters[j]) sum += distance(static_cast<Index>(a), static_cast<Index>(b));
        sum /= static_cast<double>(clusters[i].size() * clusters[j].size());
        if (sum < best) {
          best = sum;
          bi = i;
          bj = j;
        }
      }
    }
    clusters[bi].insert(clusters[bi].end(), clusters[bj].begin(), clusters[bj].end());
    clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(bj));
    height.push_back(best);
    history.push_back(clusters);
  }
  std::size_t wanted = count > 0 ? std::min<std::size_t>(static_cast<std::size_t>(count), n) : 1;
  if (count <= 0) {
    double jump = 0.0;
    for (std::size_t k = 1; k < height.size(); ++k) {
      if (height[k] - height[k - 1] <= jump) continue;
      jump = height[k] - height[k - 1];
      wanted = n - k;
    }
  }
  std::vector<SensorCluster> out;
  for (const auto& members : history[n - wanted]) {
    SensorCluster cluster;
    double closest = std::numeric_limits<double>::infinity();
    for (const std::size_t i : members) {
      cluster.names.push_back(names[i]);
      cluster.mean_change += range[i] / static_cast<double>(members.size());
      double sum = 0.0;
      for (const std::size_t j : members) sum += distance(static_cast<Index>(i), static_cast<Index>(j));
      if (sum < closest) {
        closest = sum;
        cluster.representative = names[i];
      }
    }
    out.push_back(std::move(cluster));
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const SensorCluster& a, const SensorCluster& b) { return a.mean_change > b.mean_change; });
  return out;
}

}  // namespace spindrift
