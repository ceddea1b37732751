// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/noise_inference.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.h"

namespace spindrift {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double largest_atanh = 4.5;  // a partial autocorrelation of 0.99975

/// What the data say about d if the colour is known.
struct Conditional {
  double log_density = -std::numeric_limits<double>::infinity();  ///< of atanh of the partial autocorrelations
  VectorXd estimate;
  MatrixXd covariance;
  double innovation_sigma = 0.0;
};

class Restricted {
 public:
  Restricted(const MatrixXd& jacobian, const VectorXd& residual, int order)
      : samples_(jacobian.rows()), parameters_(jacobian.cols()), order_(order) {
    // Scaled columns: gains and logarithms of time constants differ by orders of magnitude.
    length_ = jacobian.colwise().norm().cwiseMax(std::numeric_limits<double>::min());
    MatrixXd z(samples_, parameters_ + 1);
    z.leftCols(parameters_) = jacobian * length_.cwiseInverse().asDiagonal();
    z.col(parameters_) = residual;
    head_ = z.topRows(order);
    for (int i = 0; i <= order; ++i)
      for (int j = 0; j <= order; ++j)
        products_.push_back(z.middleRows(order - i, samples_ - order).transpose() *
                            z.middleRows(order - j, samples_ - order));
  }

  [[nodiscard]] Conditional at(const VectorXd& atanh_partial) const {
    Conditional out;
    const Autoregression noise(atanh_partial.array().tanh().matrix());
    VectorXd c(order_ + 1);
    c[0] = 1.0;
    c.tail(order_) = -noise.ar;
    MatrixXd start = head_;
    noise.whiten(start);
    MatrixXd whole = start.transpose() * start;
    for (int i = 0; i <= order_; ++i)
      for (int j = 0; j <= order_; ++j)
        whole += c[i] * c[j] * products_[static_cast<std::size_t>(i * (order_ + 1) + j)];
    const MatrixXd normal = whole.topLeftCorner(parameters_, parameters_);
    const VectorXd right = whole.col(parameters_).head(parameters_);
    const Eigen::LDLT<MatrixXd> solver(normal);
    const VectorXd pivots = solver.vectorD();
    if (solver.info() != Eigen::Success || !(pivots.minCoeff() > 0.0)) return out;
    out.estimate = solver.solve(right);
    const double squares = whole(parameters_, parameters_) - right.dot(out.estimate);
    const auto dof = static_cast<double>(samples_ - parameters_);
    if (!(squares > 0.0)) return out;
    out.innovation_sigma = std::sqrt(squares / dof);
    // log|V| and the density of atanh r for a uniform r.
    const VectorXd rest = (1.0 - noise.partial.array().square()).matrix();
    double colour = 0.0;
    for (int j = 0; j < order_; ++j) colour += (0.5 * (j + 1) + 1.0) * std::log(rest[j]);
    out.log_density = colour - 0.5 * pivots.array().log().sum() - 0.5 * dof * std::log(squares);
    out.covariance = squares / dof * solver.solve(MatrixXd::Identity(parameters_, parameters_));
    out.covariance = length_.cwiseInverse().asDiagonal() * out.covariance * length_.cwiseInverse().asDiagonal();
    out.estimate = out.estimate.cwiseQuotient(length_);
    return out;
  }
  [[nodiscard]] double dof() const { return static_cast<double>(samples_ - parameters_); }

 private:
  Index samples_;
  Index parameters_;
  int order_;
  VectorXd length_;
  MatrixXd head_;
  std::vector<MatrixXd> products_;  ///< of the columns i and j samples back, (order + 1)^2
};

VectorXd bounded(const VectorXd& z) {
  return z.cwiseMax(-largest_atanh).cwiseMin(largest_atanh);
}

/// Highest density by Newton steps on differences; `curvature` returns the negative Hessian, positive definite.
VectorXd highest(const Restricted& problem, int order, MatrixXd& curvature) {
  VectorXd z = VectorXd::Zero(order);
  double value = problem.at(z).log_density;
  for (int j = 0; j < order; ++j) {  // a coarse look along each axis first: the density may have a plateau at white
    for (double trial = -1.5; trial < 3.1; trial += 0.5) {
      VectorXd moved = z;
      moved[j] = trial;
      const double there = problem.at(moved).log_density;
      if (there <= value) continue;
      value = there;
      z = moved;
    }
  }
  for (int round = 0; round < 30; ++round) {
    const double h = 0.01;
    VectorXd gradient(order);
    curvature.resize(order, order);
    const auto density = [&](int i, double di, int j, double dj) {
      VectorXd moved = z;
      moved[i] += di;
      moved[j] += dj;
      return problem.at(moved).log_density;
    };
    for (int i = 0; i < order; ++i) {
      const double up = density(i, h, i, 0.0);
      const double down = density(i, -h, i, 0.0);
      gradient[i] = (up - down) / (2.0 * h);
      curvature(i, i) = -(up - 2.0 * value + down) / (h * h);
      for (int j = 0; j < i; ++j)
        curvature(i, j) = curvature(j, i) =
            -(density(i, h, j, h) - density(i, h, j, -h) - density(i, -h, j, h) + density(i, -h, j, -h)) /
            (4.0 * h * h);
    }
    Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(curvature);
    const VectorXd floor = eigen.eigenvalues().cwiseMax(1.0);
    curvature = eigen.eigenvectors() * floor.asDiagonal() * eigen.eigenvectors().transpose();
    VectorXd step = curvature.ldlt().solve(gradient);
    if (!step.allFinite() || step.norm() < 1e-5) break;
    bool better = false;
    for (int halving = 0; halving < 12 && !better; ++halving, step *= 0.5) {
      const VectorXd next = bounded(z + step);
      const double there = problem.at(next).log_density;
      if (!(there > value)) continue;
      better = true;
      value = there;
      z = next;
    }
    if (!better) break;
  }
  return z;
}

/// Standardised places around the highest density, dense enough for a smooth density in few dimensions.
std::vector<VectorXd> places(int order) {
  const int side = order <= 2 ? 4 : 2;
  const double step = order <= 2 ? 0.8 : 1.2;
  std::vector<VectorXd> out{VectorXd::Zero(order)};
  for (int d = 0; d < order; ++d) {
    std::vector<VectorXd> next;
    for (const VectorXd& p : out) {
      for (int k = -side; k <= side; ++k) {
        next.push_back(p);
        next.back()[d] = step * k;
      }
    }
    out = std::move(next);
  }
  return out;
}

}  // namespace

Autoregression::Autoregression(const VectorXd& partial_autocorrelations) : partial(partial_autocorrelations) {
  const Index p = partial.size();
  lower_ = MatrixXd::Zero(p + 1, p);
  for (Index k = 1; k <= p; ++k) {  // Durbin and Levinson
    const double r = partial[k - 1];
    for (Index j = 1; j < k; ++j) lower_(k, j - 1) = lower_(k - 1, j - 1) - r * lower_(k - 1, k - j - 1);
    lower_(k, k - 1) = r;
  }
  ar = lower_.row(p).transpose();
  start_.resize(p);
  double weight = 1.0;
  for (Index k = p; k-- > 0;) {
    weight *= std::sqrt(std::max(0.0, 1.0 - partial[k] * partial[k]));
    start_[k] = weight;
  }
}

void Autoregression::whiten(MatrixXd& columns) const {
  const Index p = ar.size();
  for (Index c = 0; c < columns.cols(); ++c) {
    auto v = columns.col(c);
    for (Index r = v.size() - 1; r >= p; --r)
      for (Index j = 0; j < p; ++j) v[r] -= ar[j] * v[r - 1 - j];
    for (Index r = std::min(p, v.size()) - 1; r >= 0; --r) {
      for (Index j = 0; j < r; ++j) v[r] -= lower_(r, j) * v[r - 1 - j];
      v[r] *= start_[r];
    }
  }
}

void Autoregression::whiten(VectorXd& column) const {
  MatrixXd one = column;
  whiten(one);
  column = one.col(0);
}

double Autoregression::amplification() const {
  return ar.size() == 0 ? 1.0 : 1.0 / start_[0];
}

NoiseInference inferNoise(const MatrixXd& jacobian, const VectorXd& residual, int order) {
  SPINDRIFT_ASSERT(order >= 0 && order <= 4 && jacobian.rows() == residual.size(),
                   "order outside 0 ... 4, or residual and Jacobian differ in length");
  const Restricted problem(jacobian, residual, order);
  NoiseInference out;
  const Index q = jacobian.cols();
  MatrixXd curvature;
  const VectorXd mode = order > 0 ? highest(problem, order, curvature) : VectorXd();
  const Conditional best = problem.at(mode);
  out.noise = Autoregression(mode.array().tanh().matrix());
  if (!std::isfinite(best.log_density)) {
    out.covariance = MatrixXd::Constant(q, q, std::nan(""));
    out.degrees_of_freedom = VectorXd::Constant(q, 1.0);
    return out;
  }
  out.innovation_sigma = best.innovation_sigma;
  if (order == 0) {
    out.covariance = best.covariance;
    out.degrees_of_freedom = VectorXd::Constant(q, problem.dof());
    return out;
  }
  // The mixture over the colours that the data allow.
  const MatrixXd spread = curvature.inverse().llt().matrixL();
  double total = 0.0;
  VectorXd first = VectorXd::Zero(q);
  MatrixXd second = MatrixXd::Zero(q, q);
  MatrixXd covariance = MatrixXd::Zero(q, q);
  VectorXd squares = VectorXd::Zero(q);
  for (const VectorXd& place : places(order)) {
    const VectorXd z = mode + spread * place;
    if (z.cwiseAbs().maxCoeff() > largest_atanh) continue;
    const Conditional c = problem.at(z);
    const double weight = std::exp(c.log_density - best.log_density);
    if (!(weight > 0.0) || !c.covariance.allFinite()) continue;
    const VectorXd shift = c.estimate - best.estimate;
    total += weight;
    first += weight * shift;
    second += weight * shift * shift.transpose();
    covariance += weight * c.covariance;
    squares += weight * c.covariance.diagonal().cwiseAbs2();
  }
  first /= total;
  covariance /= total;
  const VectorXd variance = covariance.diagonal();
  const VectorXd scatter = squares / total - variance.cwiseAbs2();
  // A mixture of normals over variances of relative scatter w is a Student distribution of 4 + 2 / w degrees of freedom
  // (mean and scatter of its inverse chi-squared variances); the square of its scale is (1 - 2 / dof) of the mean
  // variance. The size of the noise adds its own n - q.
  const VectorXd dof =
      (4.0 + 2.0 * variance.array().square() / scatter.array().max(1e-9 * variance.array().square())).matrix();
  const VectorXd scale = (1.0 - 2.0 * dof.array().inverse()).sqrt().matrix();
  const MatrixXd whole = covariance + second / total - first * first.transpose();
  out.covariance = scale.asDiagonal() * whole * scale.asDiagonal();
  out.degrees_of_freedom = (dof.array().inverse() + 1.0 / problem.dof()).inverse().matrix();
  return out;
}

}  // namespace spindrift
