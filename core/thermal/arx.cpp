// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/arx.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace spindrift {
namespace {

using Eigen::Index;

/// One regressor: sign * signal(k - lag). Signal 0 is y, 1.. are the inputs; -1 is the constant.
struct Regressor {
  int signal = 0;
  int lag = 0;
  double sign = 1.0;
};

std::vector<std::complex<double>> rootsOf(const Eigen::VectorXd& a) {
  const Index n = a.size();
  if (n == 0) return {};
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(n, n);
  companion.row(0) = -a.transpose();
  for (Index i = 1; i < n; ++i) companion(i, i - 1) = 1.0;
  const Eigen::VectorXcd values = companion.eigenvalues();
  std::vector<std::complex<double>> out(values.data(), values.data() + n);
  std::sort(out.begin(), out.end(), [](const auto& x, const auto& y) { return std::abs(x) > std::abs(y); });
  return out;
}

void checkSignals(std::span<const double> y, const std::vector<std::span<const double>>& inputs) {
  const auto isConstant = [](std::span<const double> v) {
    return std::all_of(v.begin(), v.end(), [&](double x) { return x == v.front(); });
  };
  if (isConstant(y))
    throw InputError("the output is constant, there is nothing to model; allowed: an output that changes.");
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (isConstant(inputs[i])) {
      throw InputError(fmt::format(
          "input {} is constant, its effect cannot be learnt; leave it out or use a range in which it changes.",
          i + 1));
    }
    if (std::equal(y.begin(), y.end(), inputs[i].begin())) {
      throw InputError(fmt::format("input {} is a copy of the output; leave it out.", i + 1));
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (std::equal(inputs[i].begin(), inputs[i].end(), inputs[j].begin())) {
        throw InputError(fmt::format(
            "inputs {} and {} are identical, so their effects cannot be distinguished; leave one of them out.", j + 1,
            i + 1));
      }
    }
  }
  const auto finite = [](std::span<const double> v) {
    return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
  };
  bool all_finite = finite(y);
  for (const auto& u : inputs) all_finite = all_finite && finite(u);
  if (!all_finite)
    throw InputError(
        "a signal has missing values inside the range; resample it with gaps bridged, or cut the range at the gap.");
}

double dot(const double* x, const double* y, Index n) {
  return Eigen::Map<const Eigen::VectorXd>(x, n).dot(Eigen::Map<const Eigen::VectorXd>(y, n));
}

}  // namespace

int ArxOrder::parameters(bool with_constant) const {
  return na + std::accumulate(nb.begin(), nb.end(), 0) + (with_constant ? 1 : 0);
}

ArxModel fitArx(std::span<const double> y, const std::vector<std::span<const double>>& inputs, const ArxOrder& order,
                double period_s, const ArxOptions& options) {
  SPINDRIFT_ASSERT(order.na >= 0 && order.nb.size() == inputs.size() && order.nk.size() == inputs.size(),
                   "orders and inputs differ in number");
  for (const auto& u : inputs) SPINDRIFT_ASSERT(u.size() == y.size(), "input and output differ in length");
  ArxModel model;
  model.order = order;
  model.period_s = period_s;
  std::vector<Regressor> regressors;
  int deepest = order.na;
  for (int j = 1; j <= order.na; ++j) regressors.push_back({0, j, -1.0});
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    for (int j = 0; j < order.nb[i]; ++j) regressors.push_back({static_cast<int>(i) + 1, order.nk[i] + j, 1.0});
    deepest = std::max(deepest, order.nk[i] + order.nb[i] - 1);
  }
  const auto lagged = static_cast<Index>(regressors.size());
  if (options.with_constant) regressors.push_back({-1, 0, 1.0});
  const auto p = static_cast<Index>(regressors.size());
  const auto total = static_cast<Index>(y.size());
  const Index n = total - deepest;
  if (n < 3 * p) {
    throw InputError(
        fmt::format("{} samples are too few for {} parameters; allowed: at least {} samples (a longer range, a shorter "
                    "period or a lower order).",
                    y.size(), p, 3 * p + deepest));
  }
  checkSignals(y, inputs);
  model.equations = static_cast<std::size_t>(n);

  // A common shift of a signal does not change what is asked without the constant, so signals are used as they are.
  const auto data = [&](int signal) {
    return signal == 0 ? y.data() : inputs[static_cast<std::size_t>(signal) - 1].data();
  };
  const auto column = [&](const Regressor& r) { return data(r.signal) + deepest - r.lag; };
  // Normal matrix: along a diagonal of two signals only the edges change.
  Eigen::MatrixXd A(p, p);
  for (Index i = 0; i < lagged; ++i) {
    for (Index j = 0; j <= i; ++j) {
      const Regressor& ri = regressors[i];
      const Regressor& rj = regressors[j];
      const bool follows =
          i > 0 && j > 0 && regressors[i - 1].signal == ri.signal && regressors[j - 1].signal == rj.signal;
      double value;
      if (follows) {
        // Both columns moved by one sample into the past: gain the product before the first row, lose that of the last
        // one.
        const double* x = column(ri);
        const double* z = column(rj);
        value = ri.sign * rj.sign * A(i - 1, j - 1) + x[0] * z[0] - x[n] * z[n];
      } else {
        value = dot(column(ri), column(rj), n);
      }
      A(i, j) = A(j, i) = ri.sign * rj.sign * value;
    }
  }
  const auto target = Eigen::Map<const Eigen::VectorXd>(y.data() + deepest, n);
  Eigen::VectorXd rhs(p);
  for (Index i = 0; i < lagged; ++i) rhs[i] = regressors[i].sign * dot(column(regressors[i]), target.data(), n);
  if (options.with_constant) {
    for (Index i = 0; i < lagged; ++i)
      A(i, p - 1) = A(p - 1, i) =
          regressors[i].sign * Eigen::Map<const Eigen::VectorXd>(column(regressors[i]), n).sum();
    A(p - 1, p - 1) = static_cast<double>(n);
    rhs[p - 1] = target.sum();
  }
  Eigen::VectorXd scale = A.diagonal().cwiseSqrt();
  for (Index i = 0; i < p; ++i)
    if (!(scale[i] > 0.0)) scale[i] = 1.0;
  const Eigen::VectorXd inverse_scale = scale.cwiseInverse();
  const Eigen::MatrixXd S = inverse_scale.asDiagonal() * A * inverse_scale.asDiagonal();
  Eigen::LLT<Eigen::MatrixXd> llt(S);
  const double rcond = llt.info() == Eigen::Success ? llt.rcond() : 0.0;
  model.condition_number = rcond > 0.0 ? 1.0 / rcond : std::numeric_limits<double>::infinity();

  Eigen::VectorXd theta(p);
  Eigen::VectorXd residual(n);
  const auto residualOf = [&](const Eigen::VectorXd& w) {
    residual = target;
    for (Index i = 0; i < lagged; ++i)
      residual.noalias() -= (regressors[i].sign * w[i]) * Eigen::Map<const Eigen::VectorXd>(column(regressors[i]), n);
    if (options.with_constant) residual.array() -= w[p - 1];
  };
  Eigen::MatrixXd inverse;
  bool settled = false;
  if (rcond > 1e-12) {
    const auto solveScaled = [&](const Eigen::VectorXd& g) {
      return Eigen::VectorXd(inverse_scale.cwiseProduct(llt.solve(inverse_scale.cwiseProduct(g))));
    };
    theta = solveScaled(rhs);
    for (int round = 0; round < 4 && !settled; ++round) {
      residualOf(theta);
      Eigen::VectorXd gradient(p);
      for (Index i = 0; i < lagged; ++i)
        gradient[i] = regressors[i].sign * dot(column(regressors[i]), residual.data(), n);
      if (options.with_constant) gradient[p - 1] = residual.sum();
      const Eigen::VectorXd correction = solveScaled(gradient);
      theta += correction;
      settled = correction.cwiseProduct(scale).norm() < 1e-9 * theta.cwiseProduct(scale).norm();
    }
    if (settled)
      inverse = inverse_scale.asDiagonal() * llt.solve(Eigen::MatrixXd::Identity(p, p)) * inverse_scale.asDiagonal();
  }
  if (!settled) {
    Eigen::MatrixXd Phi(n, p);
    for (Index i = 0; i < lagged; ++i)
      Phi.col(i) = regressors[i].sign * Eigen::Map<const Eigen::VectorXd>(column(regressors[i]), n);
    if (options.with_constant) Phi.col(p - 1).setOnes();
    const Eigen::VectorXd lengths = Phi.colwise().norm().cwiseMax(std::numeric_limits<double>::min());
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(Phi * lengths.cwiseInverse().asDiagonal());
    if (qr.rank() < p) {
      model.status = FitStatus::Degenerate;
      model.message = fmt::format(
          "only {} of {} coefficients are determined: inputs tell the same or do not move enough; give fewer inputs or "
          "a lower order.",
          qr.rank(), p);
      return model;
    }
    theta = lengths.cwiseInverse().cwiseProduct(qr.solve(Eigen::VectorXd(target)));
    const Eigen::MatrixXd R = qr.matrixR().topLeftCorner(p, p).triangularView<Eigen::Upper>();
    const Eigen::MatrixXd Rinv = R.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(p, p));
    const Eigen::MatrixXd permuted =
        qr.colsPermutation() * (Rinv * Rinv.transpose()) * qr.colsPermutation().transpose();
    inverse = lengths.cwiseInverse().asDiagonal() * permuted * lengths.cwiseInverse().asDiagonal();
    const Eigen::VectorXd diagonal = R.diagonal().cwiseAbs();
    model.condition_number = std::pow(diagonal.maxCoeff() / diagonal.minCoeff(), 2);
  }
  residualOf(theta);
  const double variance = residual.squaredNorm() / static_cast<double>(n - p);
  model.noise_sigma = std::sqrt(variance);
  model.covariance = variance * inverse;
  model.a = theta.head(order.na);
  Index at = order.na;
  for (const int nb : order.nb) {
    model.b.emplace_back(theta.segment(at, nb));
    at += nb;
  }
  if (options.with_constant) model.c = theta[p - 1];
  model.status = FitStatus::Converged;
  if (!model.stable()) {
    model.message =
        "the fitted model is unstable (a pole lies outside the unit circle): its free run grows without bound; use "
        "stabilised(), a "
        "longer period, a lower order or the output-error method.";
  }
  return model;
}

std::vector<std::complex<double>> ArxModel::poles() const {
  return rootsOf(a);
}

bool ArxModel::stable() const {
  for (const auto& pole : poles())
    if (std::abs(pole) >= 1.0) return false;
  return true;
}

std::pair<double, double> ArxModel::staticGain(std::size_t input) const {
  SPINDRIFT_ASSERT(input < b.size(), "no such input");
  const double denominator = 1.0 + a.sum();
  const double gain = b[input].sum() / denominator;
  if (covariance.rows() == 0) return {gain, std::nan("")};
  Eigen::VectorXd g = Eigen::VectorXd::Zero(covariance.rows());
  g.head(a.size()).setConstant(-gain / denominator);
  Index at = a.size();
  for (std::size_t i = 0; i < input; ++i) at += b[i].size();
  g.segment(at, b[input].size()).setConstant(1.0 / denominator);
  return {gain, std::sqrt(std::max(0.0, g.dot(covariance * g)))};
}

std::vector<ArxModel::TimeConstant> ArxModel::timeConstants() const {
  std::vector<TimeConstant> out;
  const Index na = a.size();
  for (const auto& pole : poles()) {
    if (std::abs(pole.imag()) > 1e-9 || pole.real() <= 0.0 || pole.real() >= 1.0) continue;
    const double z = pole.real();
    // z^na + a1 z^(na-1) + ... = 0: dz/da_j = -z^(na-j) / P'(z).
    double slope = static_cast<double>(na) * std::pow(z, static_cast<double>(na - 1));
    for (Index j = 1; j < na; ++j)
      slope += static_cast<double>(na - j) * a[j - 1] * std::pow(z, static_cast<double>(na - j - 1));
    TimeConstant t;
    t.value_s = -period_s / std::log(z);
    t.sigma_s = std::nan("");
    if (covariance.rows() >= na && slope != 0.0) {
      Eigen::VectorXd g(na);
      for (Index j = 1; j <= na; ++j) g[j - 1] = -std::pow(z, static_cast<double>(na - j)) / slope;
      const double sigma_z = std::sqrt(std::max(0.0, g.dot(covariance.topLeftCorner(na, na) * g)));
      t.sigma_s = sigma_z * period_s / (z * std::log(z) * std::log(z));
    }
    out.push_back(t);
  }
  std::sort(out.begin(), out.end(), [](const TimeConstant& x, const TimeConstant& y) { return x.value_s > y.value_s; });
  return out;
}

std::vector<double> ArxModel::simulate(const std::vector<std::vector<double>>& inputs,
                                       std::span<const double> start) const {
  SPINDRIFT_ASSERT(inputs.size() == b.size() && !inputs.empty(), "wrong number of inputs");
  const auto n = static_cast<Index>(inputs.front().size());
  std::vector<double> y(start.begin(), start.end());
  y.resize(static_cast<std::size_t>(n), 0.0);
  double rest = c;
  for (std::size_t i = 0; i < b.size(); ++i) rest += b[i].sum() * inputs[i].front();
  const double denominator = 1.0 + a.sum();
  rest = denominator != 0.0 ? rest / denominator : 0.0;
  const double before = start.empty() ? rest : start.front();
  const auto past = [&](Index k) { return k >= 0 ? y[static_cast<std::size_t>(k)] : before; };
  for (auto k = static_cast<Index>(std::min(start.size(), y.size())); k < n; ++k) {
    double v = c;
    for (Index j = 1; j <= a.size(); ++j) v -= a[j - 1] * past(k - j);
    for (std::size_t i = 0; i < b.size(); ++i)
      for (Index j = 0; j < b[i].size(); ++j)
        v += b[i][j] * inputs[i][static_cast<std::size_t>(std::max<Index>(0, k - order.nk[i] - j))];
    y[static_cast<std::size_t>(k)] = std::clamp(v, -1e12, 1e12);
  }
  return y;
}

std::vector<double> ArxModel::stepResponse(std::size_t input, std::size_t samples) const {
  ArxModel bare = *this;
  bare.c = 0.0;
  // A leading zero sample carries the state before the step.
  std::size_t lead = 1;
  for (std::size_t i = 0; i < b.size(); ++i) lead = std::max(lead, static_cast<std::size_t>(order.nk[i] + order.nb[i]));
  std::vector<std::vector<double>> u(b.size(), std::vector<double>(samples + lead, 0.0));
  std::fill(u[input].begin() + static_cast<std::ptrdiff_t>(lead), u[input].end(), 1.0);
  const std::vector<double> y = bare.simulate(u, {});
  return {y.begin() + static_cast<std::ptrdiff_t>(lead), y.end()};
}

ArxModel stabilised(const ArxModel& model, double limit) {
  ArxModel out = model;
  std::vector<std::complex<double>> poles = model.poles();
  bool changed = false;
  for (auto& pole : poles) {
    if (std::abs(pole) <= limit) continue;
    pole *= limit / std::abs(pole);
    changed = true;
  }
  if (!changed) return out;
  // Product of (1 - p z^-1).
  std::vector<std::complex<double>> polynomial = {1.0};
  for (const auto& pole : poles) {
    polynomial.push_back(0.0);
    for (std::size_t k = polynomial.size() - 1; k > 0; --k) polynomial[k] -= pole * polynomial[k - 1];
  }
  for (Index j = 0; j < out.a.size(); ++j) out.a[j] = polynomial[static_cast<std::size_t>(j) + 1].real();
  const double before = 1.0 + model.a.sum();
  const double after = 1.0 + out.a.sum();
  if (before != 0.0) {
    const double factor = std::clamp(after / before, -1e3, 1e3);
    for (auto& b : out.b) b *= std::abs(factor);
    out.c *= std::abs(factor);
  }
  out.message = fmt::format("unstable poles were drawn to |z| = {}; judge it in free run before use.", limit);
  return out;
}

}  // namespace spindrift
