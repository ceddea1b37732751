// SPDX-License-Identifier: GPL-3.0-or-later
// Shows the covariance of a fitted ARX model in what it predicts.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "core/base/error.h"
#include "core/thermal/arx.h"

namespace spindrift {

/// Standard uncertainty of every value of ArxModel::stepResponse, by first-order propagation of the covariance (NaN
/// without one).
inline std::vector<double> stepResponseSigma(const ArxModel& model, std::size_t input, std::size_t samples) {
  using Index = Eigen::Index;
  const auto& [a, b, covariance] = std::tie(model.a, model.b, model.covariance);
  SPINDRIFT_ASSERT(input < b.size(), "no such input");
  const auto n = static_cast<Index>(samples);
  const Index na = a.size();
  const Index nb = b[input].size();
  Index at = na;
  for (std::size_t i = 0; i < input; ++i) at += b[i].size();
  if (covariance.rows() < at + nb) return std::vector<double>(samples, std::nan(""));
  const std::vector<double> s = model.stepResponse(input, samples);
  // A(q) ds/da_j = -q^-j s and A(q) ds/db_j = q^-(nk + j) step: every derivative runs through the same denominator.
  Eigen::MatrixXd g = Eigen::MatrixXd::Zero(n, na + nb);
  for (Index k = 0; k < n; ++k) {
    for (Index j = 1; j <= na; ++j) {
      if (k < j) break;
      g(k, j - 1) -= s[static_cast<std::size_t>(k - j)];
      g.row(k) -= a[j - 1] * g.row(k - j);
    }
    for (Index j = 0; j < nb; ++j)
      if (k >= model.order.nk[input] + j) g(k, na + j) += 1.0;
  }
  Eigen::MatrixXd part(na + nb, na + nb);
  part << covariance.topLeftCorner(na, na), covariance.block(0, at, na, nb), covariance.block(at, 0, nb, na),
      covariance.block(at, at, nb, nb);
  const Eigen::VectorXd variance = (g * part).cwiseProduct(g).rowwise().sum();
  std::vector<double> out(samples);
  for (Index k = 0; k < n; ++k) out[static_cast<std::size_t>(k)] = std::sqrt(std::max(0.0, variance[k]));
  return out;
}

}  // namespace spindrift
