// SPDX-License-Identifier: Apache-2.0
#include "core/machine/shared_noise.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "core/base/error.h"

namespace spindrift {

void SharedNoise::addFactor(Factor loads) {
  std::stable_sort(loads.begin(), loads.end(), [](const Load& a, const Load& b) { return a.row < b.row; });
  Factor factor;
  for (const Load& l : loads) {
    SPINDRIFT_ASSERT(std::isfinite(l.load), "the load of a cause is a number");
    if (!factor.empty() && factor.back().row == l.row) {
      factor.back().load += l.load;
    } else {
      factor.push_back(l);
    }
  }
  std::erase_if(factor, [](const Load& l) { return l.load == 0.0; });
  if (factor.empty()) return;
  if (of_row_.size() <= factor.back().row) of_row_.resize(factor.back().row + 1);
  for (const Load& l : factor) of_row_[l.row].push_back({factors_.size(), l.load});
  factors_.push_back(std::move(factor));
}

void SharedNoise::append(const SharedNoise& other, std::size_t first_row) {
  for (Factor factor : other.factors_) {
    for (Load& l : factor) l.row += first_row;
    addFactor(std::move(factor));
  }
}

SharedNoise SharedNoise::restrictedTo(const std::vector<std::size_t>& rows) const {
  std::unordered_map<std::size_t, std::size_t> place;
  for (std::size_t k = 0; k < rows.size(); ++k)
    SPINDRIFT_ASSERT(place.emplace(rows[k], k).second, "a row is taken once");
  SharedNoise out;
  for (const Factor& factor : factors_) {
    Factor part;
    for (const Load& l : factor) {
      const auto found = place.find(l.row);
      if (found != place.end()) part.push_back({found->second, l.load});
    }
    out.addFactor(std::move(part));
  }
  return out;
}

void SharedNoise::clear() noexcept {
  factors_.clear();
  of_row_.clear();
}

double SharedNoise::variance(std::size_t row) const noexcept {
  return covariance(row, row);
}

double SharedNoise::covariance(std::size_t a, std::size_t b) const noexcept {
  if (a >= of_row_.size() || b >= of_row_.size()) return 0.0;
  double sum = 0.0;
  auto of_a = of_row_[a].begin();
  auto of_b = of_row_[b].begin();
  while (of_a != of_row_[a].end() && of_b != of_row_[b].end()) {
    if (of_a->row < of_b->row) {
      ++of_a;
    } else if (of_b->row < of_a->row) {
      ++of_b;
    } else {
      sum += (of_a++)->load * (of_b++)->load;
    }
  }
  return sum;
}

double SharedNoise::ownVariance(std::size_t row, double sigma) const noexcept {
  return std::max(0.0, sigma * sigma - variance(row));
}

double SharedNoise::varianceOf(std::span<const Load> combination) const {
  std::unordered_map<std::size_t, double> of_factor;
  for (const Load& part : combination) {
    if (part.row >= of_row_.size()) continue;
    for (const Load& l : of_row_[part.row]) of_factor[l.row] += part.load * l.load;
  }
  double sum = 0.0;
  for (const auto& [factor, load] : of_factor) sum += load * load;
  return sum;
}

Eigen::SparseMatrix<double> SharedNoise::loads(const std::vector<std::size_t>& rows) const {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows[k] >= of_row_.size()) continue;
    for (const Load& l : of_row_[rows[k]]) entries.emplace_back(static_cast<int>(k), static_cast<int>(l.row), l.load);
  }
  Eigen::SparseMatrix<double> out(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(factors_.size()));
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

std::vector<CovarianceEntry> SharedNoise::covariances(const std::vector<double>& sigma) const {
  constexpr double negligible = 1e-12;
  std::vector<CovarianceEntry> out;
  std::vector<double> sum(of_row_.size(), 0.0);
  std::vector<std::size_t> touched;
  for (std::size_t row = 0; row < of_row_.size(); ++row) {
    SPINDRIFT_ASSERT(row < sigma.size(), "shared noise of a row that is not there");
    touched.clear();
    for (const Load& own : of_row_[row]) {
      const Factor& factor = factors_[own.row];
      const auto after =
          std::upper_bound(factor.begin(), factor.end(), row, [](std::size_t r, const Load& l) { return r < l.row; });
      for (auto l = after; l != factor.end(); ++l) {
        if (sum[l->row] == 0.0) touched.push_back(l->row);
        sum[l->row] += own.load * l->load;
      }
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    for (const std::size_t other : touched) {
      if (std::abs(sum[other]) > negligible * sigma[row] * sigma[other]) out.push_back({row, other, sum[other]});
      sum[other] = 0.0;
    }
  }
  return out;
}

}  // namespace spindrift
