// SPDX-License-Identifier: Apache-2.0
#include "core/math/split_covariance.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "core/base/error.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// Rows up to which a block is split by its eigenvalues.
constexpr Index most_by_eigenvalues = 1000;

/// Rows that hang together, directly or through others.
class Groups {
 public:
  explicit Groups(std::size_t rows) : parent_(rows) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t find(std::size_t row) {
    while (parent_[row] != row) {
      parent_[row] = parent_[parent_[row]];
      row = parent_[row];
    }
    return row;
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  /// Those of more than one row, or all; rows increasing, groups in order of their first row.
  std::vector<std::vector<std::size_t>> list(bool single) {
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t row = 0; row < parent_.size(); ++row) members[find(row)].push_back(row);
    std::vector<std::vector<std::size_t>> out;
    for (auto& [first, rows] : members)
      if (single || rows.size() > 1) out.push_back(std::move(rows));
    return out;
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Loads over rows of unit variance, and what the diagonal lacks for the correlations to be possible (0: nothing).
struct BlockSplit {
  Eigen::MatrixXd loads;
  double lacking = 0.0;
};

BlockSplit byEigenvalues(const Eigen::MatrixXd& R) {
  const Index n = R.rows();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(R);
  const Eigen::VectorXd& eigenvalues = modes.eigenvalues();
  const double rounding = 4.0 * static_cast<double>(n) * std::numeric_limits<double>::epsilon() * eigenvalues(n - 1);
  BlockSplit out;
  double lambda = eigenvalues(0);
  if (lambda < -rounding) out.lacking = -lambda;
  if (std::abs(lambda) <= rounding) lambda = 0.0;
  Index first = 0;
  while (first < n && !(eigenvalues(first) - lambda > rounding)) ++first;
  out.loads = modes.eigenvectors().rightCols(n - first) *
              (eigenvalues.tail(n - first).array() - lambda).sqrt().matrix().asDiagonal();
  return out;
}

BlockSplit byCholesky(const Eigen::MatrixXd& R) {
  constexpr double least_own = 1.0 / 1024.0;
  constexpr double most_lacking = 1e18;
  BlockSplit out;
  Eigen::LLT<Eigen::MatrixXd> llt;
  double lambda = 0.5;
  for (;;) {
    Eigen::MatrixXd rest = R;
    rest.diagonal().array() -= lambda;
    llt.compute(rest);
    if (llt.info() == Eigen::Success) break;
    if (lambda > least_own) {
      lambda *= 0.5;
    } else if (lambda > 0.0) {
      lambda = 0.0;
    } else {
      lambda = lambda == 0.0 ? -1e-12 : 10.0 * lambda;
      SPINDRIFT_ASSERT(-lambda < most_lacking, "numbers that are not correlations");
    }
  }
  if (lambda < -1e-10) out.lacking = -lambda;
  out.loads = llt.matrixL();
  return out;
}

/// A load below this part of sigma counts as none; a correlation beyond the other is nonsense that stays finite.
constexpr double no_load = 1e-16;
constexpr double no_number = 1e12;

}  // namespace

CovarianceSplit splitCovariance(const std::vector<double>& sigma, const std::vector<CovarianceEntry>& entries) {
  CovarianceSplit out;
  out.sigma = sigma;
  std::map<std::pair<std::size_t, std::size_t>, double> between;
  Groups groups(sigma.size());
  for (const CovarianceEntry& entry : entries) {
    SPINDRIFT_ASSERT(entry.row < sigma.size() && entry.column < sigma.size(),
                     "a covariance of rows that are not there");
    const bool fresh = between.emplace(std::minmax(entry.row, entry.column), entry.covariance).second;
    if (!fresh) continue;
    if (entry.row == entry.column) {
      SPINDRIFT_ASSERT(entry.covariance > 0.0, "a variance is positive");
      out.sigma[entry.row] = std::sqrt(entry.covariance);
    } else if (entry.covariance != 0.0) {
      groups.join(entry.row, entry.column);
    }
  }
  for (const double s : out.sigma) SPINDRIFT_ASSERT(s > 0.0, "a standard deviation is positive");
  std::vector<std::vector<std::size_t>> blocks = groups.list(false);
  if (blocks.empty()) return out;
  std::vector<std::size_t> block_of(sigma.size(), blocks.size());
  std::vector<Index> place(sigma.size(), 0);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (std::size_t i = 0; i < blocks[b].size(); ++i) {
      block_of[blocks[b][i]] = b;
      place[blocks[b][i]] = static_cast<Index>(i);
    }
  }
  std::vector<std::vector<CovarianceEntry>> of_block(blocks.size());
  for (const auto& [pair, value] : between) {
    if (pair.first != pair.second && block_of[pair.first] < blocks.size())
      of_block[block_of[pair.first]].push_back({pair.first, pair.second, value});
  }
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const std::vector<std::size_t>& rows = blocks[b];
    const auto n = static_cast<Index>(rows.size());
    Eigen::MatrixXd R = Eigen::MatrixXd::Identity(n, n);
    for (const CovarianceEntry& e : of_block[b]) {
      const double r = std::clamp(e.covariance / out.sigma[e.row] / out.sigma[e.column], -no_number, no_number);
      R(place[e.row], place[e.column]) = R(place[e.column], place[e.row]) = r;
    }
    const BlockSplit split = n <= most_by_eigenvalues ? byEigenvalues(R) : byCholesky(R);
    if (split.lacking > 0.0) out.indefinite.insert(out.indefinite.end(), rows.begin(), rows.end());
    for (Index f = 0; f < split.loads.cols(); ++f) {
      NoiseFactor factor;
      for (Index i = 0; i < n; ++i) {
        const std::size_t row = rows[static_cast<std::size_t>(i)];
        if (std::abs(split.loads(i, f)) > no_load) factor.push_back({row, out.sigma[row] * split.loads(i, f)});
      }
      if (!factor.empty()) out.factors.push_back(std::move(factor));
    }
  }
  std::sort(out.indefinite.begin(), out.indefinite.end());
  return out;
}

Eigen::MatrixXd sharedLoads(const Eigen::MatrixXd& covariance) {
  const Index n = covariance.rows();
  SPINDRIFT_ASSERT(covariance.cols() == n, "a covariance is square");
  std::vector<Index> rows;
  for (Index i = 0; i < n; ++i)
    if (covariance(i, i) > 0.0) rows.push_back(i);
  if (rows.size() < 2) return Eigen::MatrixXd::Zero(n, 0);
  const auto m = static_cast<Index>(rows.size());
  Eigen::MatrixXd R(m, m);
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < m; ++j) {
      const Index a = rows[static_cast<std::size_t>(i)];
      const Index b = rows[static_cast<std::size_t>(j)];
      R(i, j) = i == j ? 1.0 : covariance(a, b) / std::sqrt(covariance(a, a) * covariance(b, b));
    }
  const Eigen::MatrixXd loads = byEigenvalues(R).loads;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(n, loads.cols());
  for (Index i = 0; i < m; ++i) {
    const Index a = rows[static_cast<std::size_t>(i)];
    out.row(a) = std::sqrt(covariance(a, a)) * loads.row(i);
  }
  return out;
}

Eigen::MatrixXd covarianceRoot(const Eigen::MatrixXd& covariance, double negligible) {
  const Index n = covariance.rows();
  SPINDRIFT_ASSERT(covariance.cols() == n, "a covariance is square");
  if (n == 0) return Eigen::MatrixXd(0, 0);
  // Entries that small change no eigenvalue by more than what is negligible.
  const double least = negligible / static_cast<double>(n);
  Groups groups(static_cast<std::size_t>(n));
  for (Index i = 0; i < n; ++i)
    for (Index j = i + 1; j < n; ++j)
      if (std::abs(covariance(i, j)) > least) groups.join(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  std::vector<Eigen::VectorXd> columns;
  for (const std::vector<std::size_t>& rows : groups.list(true)) {
    const auto m = static_cast<Index>(rows.size());
    const auto at = [&](Index i) { return static_cast<Index>(rows[static_cast<std::size_t>(i)]); };
    Eigen::MatrixXd block(m, m);
    for (Index i = 0; i < m; ++i)
      for (Index j = 0; j < m; ++j) block(i, j) = covariance(at(i), at(j));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(block);
    for (Index k = m - 1; k >= 0 && modes.eigenvalues()(k) > negligible; --k) {
      columns.emplace_back(Eigen::VectorXd::Zero(n));
      for (Index i = 0; i < m; ++i)
        columns.back()(at(i)) = std::sqrt(modes.eigenvalues()(k)) * modes.eigenvectors()(i, k);
    }
  }
  Eigen::MatrixXd out(n, static_cast<Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) out.col(static_cast<Index>(k)) = columns[k];
  return out;
}

}  // namespace spindrift
