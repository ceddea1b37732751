// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/residual_problem.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "core/math/statistics.h"

namespace spindrift {
namespace {

using Eigen::Index;

using PlaceKey = std::tuple<double, double, double, double, double, double, double, double, double, double>;

PlaceKey placeKey(const Observation& o) {
  return {o.position_mm.x(),    o.position_mm.y(),   o.position_mm.z(), o.c_deg,
          o.approach.x(),       o.approach.y(),      o.approach.z(),    o.tool_offset_mm.x(),
          o.tool_offset_mm.y(), o.tool_offset_mm.z()};
}

}  // namespace

ResidualProblem::ResidualProblem(const DiscrepancyInput& input, const std::vector<std::size_t>& rows,
                                 std::size_t unit_limit) {
  const auto& all = input.observations.rows;
  std::map<std::pair<std::string, int>, int> series_index;
  std::vector<std::pair<std::string, int>> series_names;
  std::vector<int> row_series(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Observation& o = all[rows[i]];
    const auto [at, fresh] =
        series_index.try_emplace({o.point, static_cast<int>(o.component)}, static_cast<int>(series_names.size()));
    if (fresh) series_names.emplace_back(o.point, static_cast<int>(o.component));
    row_series[i] = at->second;
  }
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (row_series[a] != row_series[b]) return row_series[a] < row_series[b];
    return all[rows[a]].time_s < all[rows[b]].time_s;
  });
  for (const std::size_t row : rows) node_time_s.push_back(all[row].time_s);
  std::sort(node_time_s.begin(), node_time_s.end());
  node_time_s.erase(std::unique(node_time_s.begin(), node_time_s.end()), node_time_s.end());
  const auto nodeOf = [&](double t) {
    return static_cast<int>(std::lower_bound(node_time_s.begin(), node_time_s.end(), t) - node_time_s.begin());
  };

  // Epochs: thermal states where they are named, else bins of time.
  std::map<std::string, int> states;
  for (const std::size_t row : rows) states.try_emplace(all[row].state, 0);
  const double span = node_time_s.empty() ? 0.0 : node_time_s.back() - node_time_s.front();
  const bool by_state = states.size() >= 3 && states.size() <= 400;
  std::map<std::string, std::pair<double, int>> state_time;
  if (by_state) {
    for (const std::size_t row : rows) {
      auto& [sum, count] = state_time[all[row].state];
      sum += all[row].time_s;
      ++count;
    }
    std::vector<std::pair<double, std::string>> by_time;
    for (const auto& [name, sum] : state_time) by_time.emplace_back(sum.first / sum.second, name);
    std::sort(by_time.begin(), by_time.end());
    for (std::size_t i = 0; i < by_time.size(); ++i) states[by_time[i].second] = static_cast<int>(i);
    epoch_count = static_cast<int>(by_time.size());
  } else {
    epoch_count = static_cast<int>(std::clamp<std::size_t>(node_time_s.size(), 1, 96));
  }
  const auto epochOf = [&](const Observation& o) {
    if (by_state) return states[o.state];
    if (!(span > 0.0)) return 0;
    return std::min(epoch_count - 1, static_cast<int>((o.time_s - node_time_s.front()) / span * epoch_count));
  };

  const std::size_t bin = std::max<std::size_t>(1, (rows.size() + unit_limit - 1) / unit_limit);
  std::vector<Index> unit_of_row(all.size(), -1);
  std::vector<double> values;
  std::vector<double> predictions;
  std::vector<double> sigmas;
  node_begin_.push_back(0);
  std::vector<double> epoch_sum;
  std::size_t i = 0;
  int current_series = -1;
  while (i < order.size()) {
    const int s = row_series[order[i]];
    // All rows of the series, grouped by place, each group cut into bins of neighbours in time.
    std::size_t end = i;
    std::map<PlaceKey, std::vector<std::size_t>> groups;
    while (end < order.size() && row_series[order[end]] == s) {
      groups[placeKey(all[rows[order[end]]])].push_back(order[end]);
      ++end;
    }
    struct Bin {
      double time;
      std::vector<std::size_t> members;
    };
    std::vector<Bin> bins;
    for (const auto& [key, members] : groups) {
      for (std::size_t from = 0; from < members.size(); from += bin) {
        const std::size_t to = std::min(members.size(), from + bin);
        Bin b{0.0,
              {members.begin() + static_cast<std::ptrdiff_t>(from), members.begin() + static_cast<std::ptrdiff_t>(to)}};
        for (const std::size_t m : b.members) b.time += all[rows[m]].time_s / static_cast<double>(b.members.size());
        bins.push_back(std::move(b));
      }
    }
    std::stable_sort(bins.begin(), bins.end(), [](const Bin& a, const Bin& b) { return a.time < b.time; });
    if (s != current_series) {
      series_begin.push_back(static_cast<Index>(values.size()));
      series_point.push_back(series_names[static_cast<std::size_t>(s)].first);
      current_series = s;
    }
    for (const Bin& b : bins) {
      double weight = 0.0;
      double value = 0.0;
      double prediction = 0.0;
      double mean_sigma = 0.0;
      const double count = static_cast<double>(b.members.size());
      for (const std::size_t m : b.members) {
        const std::size_t row = rows[m];
        weight += 1.0;
        value += all[row].value - input.predicted[row];
        prediction += input.predicted[row];
        mean_sigma += all[row].sigma * all[row].sigma;
        node_index_.push_back(nodeOf(all[row].time_s));
        unit_of_row[row] = static_cast<Index>(values.size());
      }
      const Observation& o = all[rows[b.members.front()]];
      DeviationQuery query = DeviationQuery::of(o);
      query.time_s = b.time;
      place.push_back(std::move(query));
      component.push_back(o.component);
      series.push_back(static_cast<int>(series_begin.size()) - 1);
      time_s.push_back(b.time);
      epoch.push_back(epochOf(o));
      values.push_back(value / weight);
      predictions.push_back(prediction / weight);
      sigmas.push_back(std::sqrt(mean_sigma) / count);
      node_begin_.push_back(node_index_.size());
    }
    i = end;
  }
  series_begin.push_back(static_cast<Index>(values.size()));
  y = Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
  simulated = Eigen::Map<Eigen::VectorXd>(predictions.data(), y.size());
  sigma = Eigen::Map<Eigen::VectorXd>(sigmas.data(), y.size());
  epoch_time_s.assign(static_cast<std::size_t>(epoch_count), 0.0);
  std::vector<int> counts(static_cast<std::size_t>(epoch_count), 0);
  for (std::size_t u = 0; u < epoch.size(); ++u) {
    epoch_time_s[static_cast<std::size_t>(epoch[u])] += time_s[u];
    ++counts[static_cast<std::size_t>(epoch[u])];
  }
  for (std::size_t e = 0; e < counts.size(); ++e) epoch_time_s[e] /= std::max(1, counts[e]);

  if (bin == 1) {
    for (const CovarianceEntry& entry : input.observations.covariance) {
      const Index a = unit_of_row[entry.row];
      const Index b = unit_of_row[entry.column];
      if (a < 0 || b < 0) continue;
      if (a == b) {
        if (entry.covariance > 0.0) sigma[a] = std::sqrt(entry.covariance);
      } else {
        extra_covariance_.push_back({{std::min(a, b), std::max(a, b)}, entry.covariance});
        if (series[static_cast<std::size_t>(a)] != series[static_cast<std::size_t>(b)]) coupled_ = true;
      }
    }
  }
  setNoise({});
}

Eigen::VectorXd ResidualProblem::toUnits(const Eigen::VectorXd& at_nodes) const {
  Eigen::VectorXd out(size());
  for (Index u = 0; u < size(); ++u) {
    const std::size_t from = node_begin_[static_cast<std::size_t>(u)];
    const std::size_t to = node_begin_[static_cast<std::size_t>(u) + 1];
    double sum = 0.0;
    for (std::size_t k = from; k < to; ++k) sum += at_nodes[node_index_[k]];
    out[u] = sum / static_cast<double>(to - from);
  }
  return out;
}

void ResidualProblem::setNoise(const NoiseModel& model) {
  noise = model;
  const Index n = size();
  block_whitener_.clear();
  blocks_.clear();
  const bool correlated = model.correlated_part > 0.0 && model.correlation_time_s > 0.0;
  diagonal_whitener_ = (sigma * model.scale).cwiseInverse();
  if (correlated || !extra_covariance_.empty()) {
    // One block per series; series that stated covariances couple share one block over all units between them.
    if (coupled_) {
      Index low = n;
      Index high = 0;
      for (const auto& [pair, value] : extra_covariance_) {
        const int a = series[static_cast<std::size_t>(pair.first)];
        const int b = series[static_cast<std::size_t>(pair.second)];
        if (a == b) continue;
        low = std::min(low, series_begin[static_cast<std::size_t>(std::min(a, b))]);
        high = std::max(high, series_begin[static_cast<std::size_t>(std::max(a, b)) + 1]);
      }
      for (int s = 0; s < seriesCount(); ++s) {
        const Index from = series_begin[static_cast<std::size_t>(s)];
        const Index to = series_begin[static_cast<std::size_t>(s) + 1];
        if (to <= low || from >= high) blocks_.emplace_back(from, to);
      }
      blocks_.emplace_back(low, high);
      std::sort(blocks_.begin(), blocks_.end());
    } else {
      for (int s = 0; s < seriesCount(); ++s) {
        blocks_.emplace_back(series_begin[static_cast<std::size_t>(s)], series_begin[static_cast<std::size_t>(s) + 1]);
      }
    }
    for (const auto& [from, to] : blocks_) {
      const Index m = to - from;
      Eigen::MatrixXd c = Eigen::MatrixXd::Zero(m, m);
      for (Index i = 0; i < m; ++i) {
        const double si = sigma[from + i] * model.scale;
        c(i, i) = si * si;
        if (!correlated) continue;
        for (Index j = 0; j < i; ++j) {
          if (series[static_cast<std::size_t>(from + i)] != series[static_cast<std::size_t>(from + j)]) continue;
          const double dt =
              std::abs(time_s[static_cast<std::size_t>(from + i)] - time_s[static_cast<std::size_t>(from + j)]);
          c(i, j) =
              si * sigma[from + j] * model.scale * model.correlated_part * std::exp(-dt / model.correlation_time_s);
          c(j, i) = c(i, j);
        }
      }
      for (const auto& [pair, value] : extra_covariance_) {
        if (pair.first < from || pair.second >= to) continue;
        c(pair.first - from, pair.second - from) += value * model.scale * model.scale;
        c(pair.second - from, pair.first - from) += value * model.scale * model.scale;
      }
      Eigen::LLT<Eigen::MatrixXd> llt(c);
      double jitter = 1e-9;
      while (llt.info() != Eigen::Success && jitter < 10.0) {
        Eigen::MatrixXd raised = c;
        raised.diagonal() *= 1.0 + jitter;
        llt.compute(raised);
        jitter *= 10.0;
      }
      block_whitener_.push_back(llt.matrixL().solve(Eigen::MatrixXd::Identity(m, m)));
    }
  }
  // Whitened constants of the series.
  constants_ = whitened(Eigen::VectorXd::Ones(n));
  if (!coupled_) {
    for (int s = 0; s < seriesCount(); ++s) {
      const Index from = series_begin[static_cast<std::size_t>(s)];
      auto part = constants_.block(from, 0, series_begin[static_cast<std::size_t>(s) + 1] - from, 1);
      part /= part.norm();
    }
  }
  setNuisances(nuisances_);
}

Eigen::MatrixXd ResidualProblem::whitened(const Eigen::MatrixXd& columns) const {
  if (columns.cols() == 0) return columns;  // Eigen's triangular product reads the first element of nothing
  if (blocks_.empty()) return diagonal_whitener_.asDiagonal() * columns;
  Eigen::MatrixXd out(columns.rows(), columns.cols());
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const auto [from, to] = blocks_[b];
    out.middleRows(from, to - from).noalias() =
        block_whitener_[b].triangularView<Eigen::Lower>() * columns.middleRows(from, to - from);
  }
  return out;
}

void ResidualProblem::removeConstants(Eigen::MatrixXd& augmented) const {
  if (coupled_) return;
  for (int s = 0; s < seriesCount(); ++s) {
    const Index from = series_begin[static_cast<std::size_t>(s)];
    const Index count = series_begin[static_cast<std::size_t>(s) + 1] - from;
    const auto unit = constants_.block(from, 0, count, 1);
    auto part = augmented.middleRows(from, count);
    const Eigen::RowVectorXd dot = unit.transpose() * part;
    part.noalias() -= unit * dot;
  }
}

void ResidualProblem::setNuisances(const std::vector<NuisanceColumn>& columns) {
  nuisances_ = columns;
  const Index n = size();
  prior_rows_ =
      std::count_if(columns.begin(), columns.end(), [](const NuisanceColumn& c) { return c.prior_sigma > 0.0; });
  Index constants = coupled_ ? seriesCount() : 0;
  Eigen::MatrixXd raw = Eigen::MatrixXd::Zero(n, static_cast<Index>(columns.size()) + constants);
  for (std::size_t c = 0; c < columns.size(); ++c) raw.col(static_cast<Index>(c)) = columns[c].values;
  for (Index s = 0; s < constants; ++s) {
    const Index from = series_begin[static_cast<std::size_t>(s)];
    raw.col(static_cast<Index>(columns.size()) + s)
        .segment(from, series_begin[static_cast<std::size_t>(s) + 1] - from)
        .setOnes();
  }
  Eigen::MatrixXd augmented = Eigen::MatrixXd::Zero(n + prior_rows_, raw.cols());
  augmented.topRows(n) = whitened(raw);
  Index prior = 0;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].prior_sigma > 0.0) augmented(n + prior++, static_cast<Index>(c)) = 1.0 / columns[c].prior_sigma;
  }
  Eigen::VectorXd before = augmented.colwise().norm();
  removeConstants(augmented);
  // Modified Gram-Schmidt, twice, dropping what depends on the columns before it.
  q_.resize(augmented.rows(), 0);
  Eigen::MatrixXd basis(augmented.rows(), augmented.cols());
  Index used = 0;
  for (Index c = 0; c < augmented.cols(); ++c) {
    Eigen::VectorXd v = augmented.col(c);
    for (int pass = 0; pass < 2; ++pass) {
      v.noalias() -= basis.leftCols(used) * (basis.leftCols(used).transpose() * v);
    }
    const double norm = v.norm();
    if (!(norm > 1e-7 * before[c]) || !(norm > 0.0)) continue;
    basis.col(used++) = v / norm;
  }
  q_ = basis.leftCols(used);
  projected_y_ = projected(y);
}

Eigen::MatrixXd ResidualProblem::projected(const Eigen::MatrixXd& columns) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(size() + prior_rows_, columns.cols());
  out.topRows(size()) = whitened(columns);
  removeConstants(out);
  if (q_.cols() > 0) {
    const Eigen::MatrixXd dots = q_.transpose() * out;
    out.noalias() -= q_ * dots;
  }
  return out;
}

int ResidualProblem::degreesOfFreedom() const noexcept {
  return static_cast<int>(size() + prior_rows_ - q_.cols()) - (coupled_ ? 0 : seriesCount());
}

}  // namespace spindrift
