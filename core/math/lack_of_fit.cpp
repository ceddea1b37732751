// SPDX-License-Identifier: Apache-2.0
#include "core/math/lack_of_fit.h"

#include <Eigen/QR>
#include <algorithm>

#include "core/base/error.h"

namespace spindrift {

Eigen::VectorXd lackOfFitVariance(const Eigen::MatrixXd& A, const Eigen::VectorXd& y, const Eigen::MatrixXd& covariance,
                                  const Eigen::MatrixXd& gain, const std::vector<int>& group, int groups) {
  const Eigen::Index n = y.size();
  SPINDRIFT_ASSERT(A.rows() == n && gain.cols() == n && gain.rows() == A.cols() && covariance.rows() == n &&
                       static_cast<Eigen::Index>(group.size()) == n && groups >= 1,
                   "sizes of a lack of fit do not match");
  // (R V R^T)_ii without a product of n x n matrices.
  const Eigen::VectorXd r = y - A * (gain * y);
  const Eigen::MatrixXd gained = gain * covariance;
  const Eigen::VectorXd explained = covariance.diagonal() - 2.0 * A.cwiseProduct(gained.transpose()).rowwise().sum() +
                                    (A * (gained * gain.transpose())).cwiseProduct(A).rowwise().sum();
  const Eigen::MatrixXd hat = A * gain;
  Eigen::VectorXd excess = Eigen::VectorXd::Zero(groups);
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(groups, groups);
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(groups);
  for (Eigen::Index i = 0; i < n; ++i) {
    const int g = group[static_cast<std::size_t>(i)];
    if (g < 0) continue;
    const double variance = covariance(i, i);
    excess(g) += (r(i) * r(i) - explained(i)) / variance;
    scale(g) += 1.0 / variance;
    for (Eigen::Index j = 0; j < n; ++j) {
      const int h = group[static_cast<std::size_t>(j)];
      const double R = (i == j ? 1.0 : 0.0) - hat(i, j);
      if (h >= 0) M(g, h) += R * R / variance;
    }
  }
  std::vector<Eigen::Index> active;
  for (Eigen::Index g = 0; g < groups; ++g)
    if (scale(g) > 0.0 && M(g, g) > 1e-6 * scale(g)) active.push_back(g);
  // The most negative one is none at all: out, and the rest once more.
  while (!active.empty()) {
    const auto size = static_cast<Eigen::Index>(active.size());
    Eigen::MatrixXd left(size, size);
    Eigen::VectorXd right(size);
    for (Eigen::Index a = 0; a < size; ++a) {
      right(a) = excess(active[static_cast<std::size_t>(a)]);
      for (Eigen::Index b = 0; b < size; ++b)
        left(a, b) = M(active[static_cast<std::size_t>(a)], active[static_cast<std::size_t>(b)]);
    }
    const Eigen::VectorXd s = left.colPivHouseholderQr().solve(right);
    Eigen::Index worst = 0;
    if (s.minCoeff(&worst) >= 0.0) {
      Eigen::VectorXd out = Eigen::VectorXd::Zero(groups);
      for (Eigen::Index a = 0; a < size; ++a) out(active[static_cast<std::size_t>(a)]) = s(a);
      return out;
    }
    active.erase(active.begin() + worst);
  }
  return Eigen::VectorXd::Zero(groups);
}

}  // namespace spindrift
