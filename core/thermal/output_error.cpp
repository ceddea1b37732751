// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/output_error.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

#include "core/math/statistics.h"

namespace spindrift {
namespace {

using Eigen::Index;

struct Layout {
  std::vector<int> input;  ///< of each lag, all inputs in order
  Index lags = 0;
  [[nodiscard]] Index parameters() const { return 1 + 2 * lags; }
};

struct State {
  Eigen::VectorXd theta;  ///< offset, gains, ln tau
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;  ///< of the prediction
  double cost = std::numeric_limits<double>::infinity();
};

class Problem {
 public:
  Problem(std::span<const double> time, std::span<const double> y, const std::vector<OutputErrorInput>& inputs)
      : time_(time), y_(y), inputs_(inputs) {
    for (std::size_t i = 0; i < inputs.size(); ++i)
      for (int k = 0; k < inputs[i].lags; ++k) layout_.input.push_back(static_cast<int>(i));
    layout_.lags = static_cast<Index>(layout_.input.size());
    for (const OutputErrorInput& input : inputs) centre_.push_back(mean(input.values));
    shortest_ = std::log(0.2 * (time.back() - time.front()) / static_cast<double>(time.size()));
    longest_ = std::log(5.0 * (time.back() - time.front()));
  }
  [[nodiscard]] const Layout& layout() const { return layout_; }
  void setNoise(const Eigen::VectorXd& ar) { ar_ = ar; }
  [[nodiscard]] double clamped(double log_tau) const { return std::clamp(log_tau, shortest_, longest_); }

  void evaluate(State& s, bool with_jacobian) const {
    const auto n = static_cast<Index>(y_.size());
    s.residual = Eigen::Map<const Eigen::VectorXd>(y_.data(), n).array() - s.theta[0];
    if (with_jacobian) {
      s.jacobian.resize(n, layout_.parameters());
      s.jacobian.col(0).setOnes();
    }
    for (Index k = 0; k < layout_.lags; ++k) {
      const auto i = static_cast<std::size_t>(layout_.input[static_cast<std::size_t>(k)]);
      const OutputErrorInput& input = inputs_[i];
      const double tau = std::exp(s.theta[1 + layout_.lags + k]);
      const double gain = s.theta[1 + k];
      std::vector<double> x = lagFiltered(time_, input.values, tau, input.hold);
      std::vector<double> difference;
      if (with_jacobian) {
        difference.resize(x.size());
        for (std::size_t r = 0; r < x.size(); ++r) difference[r] = x[r] - input.values[r];
        const std::vector<double> slope = lagFiltered(time_, difference, tau, false);
        s.jacobian.col(1 + layout_.lags + k) = gain * Eigen::Map<const Eigen::VectorXd>(slope.data(), n);
      }
      const auto centred = Eigen::Map<const Eigen::VectorXd>(x.data(), n).array() - centre_[i];
      s.residual.array() -= gain * centred;
      if (with_jacobian) s.jacobian.col(1 + k) = centred.matrix();
    }
    whiten(s.residual);
    if (with_jacobian)
      for (Index c = 0; c < s.jacobian.cols(); ++c) {
        Eigen::VectorXd column = s.jacobian.col(c);
        whiten(column);
        s.jacobian.col(c) = column;
      }
    s.cost = s.residual.squaredNorm();
  }

  /// Best offset and gains for the time constants in theta (they enter linearly).
  void solveLinearPart(State& s) const {
    for (Index k = 0; k < layout_.lags; ++k) s.theta[1 + k] = 0.0;
    s.theta[0] = 0.0;
    evaluate(s, true);
    const Index p = 1 + layout_.lags;
    const Eigen::MatrixXd J = s.jacobian.leftCols(p);
    Eigen::MatrixXd normal = J.transpose() * J;
    normal.diagonal() *= 1.0 + 1e-8;
    s.theta.head(p) = normal.ldlt().solve(J.transpose() * s.residual);
  }

 private:
  void whiten(Eigen::VectorXd& v) const {
    const Index order = ar_.size();
    for (Index r = v.size() - 1; r >= order; --r)
      for (Index j = 0; j < order; ++j) v[r] -= ar_[j] * v[r - 1 - j];
    // The first samples have no past: they count with the size of an innovation.
    for (Index r = 0; r < std::min(order, v.size()); ++r) v[r] *= first_weight();
  }
  [[nodiscard]] double first_weight() const {
    return ar_.size() == 0 ? 1.0 : std::sqrt(std::max(1e-6, 1.0 - std::min(1.0, ar_.squaredNorm())));
  }

  std::span<const double> time_;
  std::span<const double> y_;
  const std::vector<OutputErrorInput>& inputs_;
  std::vector<double> centre_;
  Layout layout_;
  Eigen::VectorXd ar_;
  double shortest_ = 0.0;
  double longest_ = 0.0;
};

bool minimise(const Problem& problem, State& s, int maximum_iterations, int& iterations) {
  problem.evaluate(s, true);
  double damping = 1e-3;
  for (int it = 0; it < maximum_iterations; ++it) {
    ++iterations;
    const Eigen::MatrixXd normal = s.jacobian.transpose() * s.jacobian;
    const Eigen::VectorXd gradient = s.jacobian.transpose() * s.residual;
    bool improved = false;
    for (int attempt = 0; attempt < 12 && !improved; ++attempt) {
      Eigen::MatrixXd damped = normal;
      damped.diagonal() +=
          damping * normal.diagonal() + Eigen::VectorXd::Constant(normal.rows(), 1e-14 * normal.diagonal().maxCoeff());
      State next;
      next.theta = s.theta + damped.ldlt().solve(gradient);
      const Index lags = problem.layout().lags;
      for (Index k = 0; k < lags; ++k) next.theta[1 + lags + k] = problem.clamped(next.theta[1 + lags + k]);
      problem.evaluate(next, false);
      if (std::isfinite(next.cost) && next.cost < s.cost) {
        const double gain = (s.cost - next.cost) / s.cost;
        problem.evaluate(next, true);
        s = std::move(next);
        damping = std::max(1e-9, damping * 0.2);
        improved = true;
        if (gain < 1e-9) return true;
      } else {
        damping *= 5.0;
      }
    }
    if (!improved) return true;
  }
  return false;
}

/// What a least-squares fit takes out of the autocovariance of the noise: residual = noise - J (estimate - truth), so
/// E[r r'] = V - J C J' with C the covariance of the parameters. Without it slow noise looks faster and smaller than it
/// is and the stated uncertainties are too small. `jacobian`: of the simulation, not whitened.
Eigen::VectorXd absorbed(const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& covariance, int order) {
  const Index n = jacobian.rows();
  const Eigen::MatrixXd half = jacobian * covariance;
  Eigen::VectorXd out(order + 1);
  for (int k = 0; k <= order; ++k)
    out[k] = half.topRows(n - k).cwiseProduct(jacobian.bottomRows(n - k)).sum() / static_cast<double>(n - k);
  return out;
}

/// Yule-Walker; `taken`: what the fit took out of the autocovariance (zeros: nothing).
Eigen::VectorXd autoregression(const Eigen::VectorXd& v, int order, const Eigen::VectorXd& taken) {
  const Index n = v.size();
  Eigen::VectorXd r(order + 1);
  for (int k = 0; k <= order; ++k) r[k] = v.tail(n - k).dot(v.head(n - k)) / static_cast<double>(n - k);
  if (!(r[0] > 0.0)) return Eigen::VectorXd::Zero(order);
  // Never more than the residual itself: a fit that absorbs most of the noise says little about it.
  if (taken[0] < r[0]) r += taken;
  Eigen::MatrixXd R(order, order);
  for (int i = 0; i < order; ++i)
    for (int j = 0; j < order; ++j) R(i, j) = r[std::abs(i - j)];
  R.diagonal().array() += 1e-9 * r[0];
  return R.ldlt().solve(r.tail(order));
}

/// Covariance of the parameters from a whitened Jacobian and residual.
Eigen::MatrixXd whitenedCovariance(const State& s) {
  const Eigen::VectorXd length = s.jacobian.colwise().norm().cwiseMax(1e-300);
  const Eigen::MatrixXd scaled = s.jacobian * length.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd normal = scaled.transpose() * scaled;
  const double dof = static_cast<double>(std::max<Index>(1, s.jacobian.rows() - s.jacobian.cols()));
  const Eigen::MatrixXd inverse = (normal + 1e-10 * Eigen::MatrixXd::Identity(normal.rows(), normal.cols())).inverse();
  return s.cost / dof * (length.cwiseInverse().asDiagonal() * inverse * length.cwiseInverse().asDiagonal());
}

double heldOutRms(std::span<const double> measured, std::span<const double> simulated, std::size_t from) {
  double sum = 0.0;
  for (std::size_t i = from; i < measured.size(); ++i)
    sum += (measured[i] - simulated[i]) * (measured[i] - simulated[i]);
  return std::sqrt(sum / static_cast<double>(measured.size() - from));
}

OrderChoice settle(std::vector<OrderCandidate> tried) {
  OrderChoice choice;
  choice.tried = std::move(tried);
  if (choice.tried.empty())
    throw InputError("no order could be fitted to these samples; allowed: a longer range or fewer inputs.");
  double best = std::numeric_limits<double>::infinity();
  for (const OrderCandidate& c : choice.tried) best = std::min(best, c.held_out_rms);
  int smallest = std::numeric_limits<int>::max();
  for (const OrderCandidate& c : choice.tried) {
    const int size = 10 * (c.na + c.nb) + c.nk;
    if (c.held_out_rms > 1.02 * best || size >= smallest) continue;
    smallest = size;
    choice.best = c;
  }
  return choice;
}

}  // namespace

double OutputErrorResult::gainSigma(std::size_t input, std::size_t lag) const {
  Index at = 1 + static_cast<Index>(lag);
  for (std::size_t i = 0; i < input; ++i) at += static_cast<Index>(gains[i].size());
  return std::sqrt(std::max(0.0, covariance(at, at)));
}

double OutputErrorResult::tauSigma_s(std::size_t input, std::size_t lag) const {
  Index at = 1 + static_cast<Index>(lag);
  for (const auto& g : gains) at += static_cast<Index>(g.size());
  for (std::size_t i = 0; i < input; ++i) at += static_cast<Index>(gains[i].size());
  return taus_s[input][lag] * std::sqrt(std::max(0.0, covariance(at, at)));
}

std::pair<double, double> OutputErrorResult::staticGain(std::size_t input) const {
  Index at = 1;
  for (std::size_t i = 0; i < input; ++i) at += static_cast<Index>(gains[i].size());
  const auto n = static_cast<Index>(gains[input].size());
  return {std::accumulate(gains[input].begin(), gains[input].end(), 0.0),
          std::sqrt(std::max(0.0, covariance.block(at, at, n, n).sum()))};
}

OutputErrorResult fitOutputError(std::span<const double> time_s, std::span<const double> y,
                                 const std::vector<OutputErrorInput>& inputs, const OutputErrorOptions& options) {
  SPINDRIFT_ASSERT(time_s.size() == y.size() && !inputs.empty(),
                   "time and output differ in length, or there is no input");
  OutputErrorResult result;
  Index lags = 0;
  for (const OutputErrorInput& input : inputs) {
    SPINDRIFT_ASSERT(input.values.size() == y.size() && input.lags >= 1,
                     "input and output differ in length, or an input has no lag");
    lags += input.lags;
    if (std::all_of(input.values.begin(), input.values.end(), [&](double v) { return v == input.values.front(); })) {
      throw InputError(
          "an input is constant, its effect cannot be learnt; leave it out or use a range in which it changes.");
    }
    for (const double v : input.values)
      if (!std::isfinite(v))
        throw InputError("an input has missing values inside the range; bridge the gaps or cut the range.");
  }
  if (static_cast<Index>(y.size()) < 5 * (1 + 2 * lags)) {
    throw InputError(fmt::format("{} samples are too few for {} parameters; allowed: at least {} samples.", y.size(),
                                 1 + 2 * lags, 5 * (1 + 2 * lags)));
  }
  Problem problem(time_s, y, inputs);
  const double span = time_s.back() - time_s.front();
  const double period = span / static_cast<double>(time_s.size() - 1);
  State best;
  bool converged = false;
  for (int start = 0; start < options.starts; ++start) {
    State s;
    s.theta = Eigen::VectorXd::Zero(problem.layout().parameters());
    // Time constants spread evenly in the logarithm between a few samples and a part of the record; each start shifts
    // them.
    const double low = std::log(4.0 * period);
    const double high = std::log(0.3 * span);
    std::vector<int> seen(inputs.size(), 0);
    for (Index k = 0; k < lags; ++k) {
      const int i = problem.layout().input[static_cast<std::size_t>(k)];
      const int count = inputs[static_cast<std::size_t>(i)].lags;
      const double place =
          (static_cast<double>(seen[static_cast<std::size_t>(i)]++) + (0.5 + start) / (options.starts + 0.5)) / count;
      s.theta[1 + lags + k] = problem.clamped(high - std::min(1.0, place) * (high - low));
    }
    problem.solveLinearPart(s);
    const bool good = minimise(problem, s, options.maximum_iterations, result.iterations);
    if (s.cost < best.cost) {
      best = std::move(s);
      converged = good;
    }
  }
  // Simulation error before whitening, then the colour of the noise, then what the fit itself took out of it.
  for (int round = 0; round < 3 && options.noise_order > 0; ++round) {
    Eigen::VectorXd taken = Eigen::VectorXd::Zero(options.noise_order + 1);
    Eigen::MatrixXd covariance;
    if (round > 0) {
      problem.evaluate(best, true);
      covariance = whitenedCovariance(best);
    }
    problem.setNoise({});
    State plain;
    plain.theta = best.theta;
    problem.evaluate(plain, round > 0);
    if (round > 0) taken = absorbed(plain.jacobian, covariance, options.noise_order);
    result.noise_ar = autoregression(plain.residual, options.noise_order, taken);
    problem.setNoise(result.noise_ar);
    problem.evaluate(best, false);
    converged = minimise(problem, best, options.maximum_iterations, result.iterations);
  }
  problem.evaluate(best, true);
  const Eigen::MatrixXd whitened = best.jacobian;
  const double variance =
      best.cost / static_cast<double>(std::max<Index>(1, static_cast<Index>(y.size()) - problem.layout().parameters()));
  const Eigen::VectorXd length = whitened.colwise().norm();
  problem.setNoise({});
  problem.evaluate(best, false);
  result.rms = std::sqrt(best.cost / static_cast<double>(y.size()));
  result.noise_sigma = result.rms;
  if (length.minCoeff() <= 0.0 || !best.theta.allFinite()) {
    result.status = FitStatus::Degenerate;
    result.message = "a lag has no effect on the output; use fewer lags or inputs.";
    return result;
  }
  const Eigen::MatrixXd scaled = whitened * length.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled.transpose() * scaled);
  if (eigen.eigenvalues().minCoeff() < 1e-11 * eigen.eigenvalues().maxCoeff()) {
    result.status = FitStatus::Degenerate;
    result.message = "time constants or inputs cannot be told apart with these data; use fewer lags or inputs.";
  } else {
    result.status = converged ? FitStatus::Converged : FitStatus::NoConvergence;
    if (!converged) result.message = "the iteration did not settle; use fewer lags or a longer range.";
  }
  const Eigen::VectorXd floor = eigen.eigenvalues().cwiseMax(1e-14 * eigen.eigenvalues().maxCoeff());
  const Eigen::MatrixXd inverse =
      eigen.eigenvectors() * floor.cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  const Eigen::MatrixXd covariance =
      variance * (length.cwiseInverse().asDiagonal() * inverse * length.cwiseInverse().asDiagonal());
  // Order the lags of every input from slow to fast and refer the offset to u = 0.
  const Index p = problem.layout().parameters();
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(p, p);
  T(0, 0) = 1.0;
  result.offset = best.theta[0];
  Index first = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    std::vector<Index> order(static_cast<std::size_t>(inputs[i].lags));
    std::iota(order.begin(), order.end(), first);
    std::sort(order.begin(), order.end(),
              [&](Index a, Index b) { return best.theta[1 + lags + a] > best.theta[1 + lags + b]; });
    const double centre = mean(inputs[i].values);
    result.gains.emplace_back();
    result.taus_s.emplace_back();
    for (std::size_t k = 0; k < order.size(); ++k) {
      result.gains.back().push_back(best.theta[1 + order[k]]);
      result.taus_s.back().push_back(std::exp(best.theta[1 + lags + order[k]]));
      result.offset -= best.theta[1 + order[k]] * centre;
      T(0, 1 + order[k]) = -centre;
      T(1 + first + static_cast<Index>(k), 1 + order[k]) = 1.0;
      T(1 + lags + first + static_cast<Index>(k), 1 + lags + order[k]) = 1.0;
    }
    first += inputs[i].lags;
  }
  result.covariance = T * covariance * T.transpose();
  return result;
}

OrderChoice chooseArxOrder(std::span<const double> y, const std::vector<std::span<const double>>& inputs,
                           double period_s, double held_out_part) {
  const auto cut = static_cast<std::size_t>(static_cast<double>(y.size()) * (1.0 - held_out_part));
  std::vector<std::span<const double>> fit_inputs;
  std::vector<std::vector<double>> all_inputs;
  for (const auto& u : inputs) {
    fit_inputs.push_back(u.first(cut));
    all_inputs.emplace_back(u.begin(), u.end());
  }
  std::vector<OrderCandidate> tried;
  for (int na = 1; na <= 4; ++na) {
    for (int nb = 1; nb <= na; ++nb) {
      for (int nk = 0; nk <= 3; ++nk) {
        ArxOrder order{na, std::vector<int>(inputs.size(), nb), std::vector<int>(inputs.size(), nk)};
        if (cut < static_cast<std::size_t>(10 * order.parameters(true))) continue;
        ArxOptions options;
        options.with_constant = true;
        const ArxModel model = fitArx(y.first(cut), fit_inputs, order, period_s, options);
        if (model.status != FitStatus::Converged || !model.stable()) continue;
        const std::vector<double> simulated = model.simulate(all_inputs, y.first(1));
        tried.push_back({na, nb, nk, heldOutRms(y, simulated, cut)});
      }
    }
  }
  return settle(std::move(tried));
}

OrderChoice chooseOutputErrorOrder(std::span<const double> time_s, std::span<const double> y,
                                   std::vector<OutputErrorInput> inputs, double held_out_part) {
  const auto cut = static_cast<std::size_t>(static_cast<double>(y.size()) * (1.0 - held_out_part));
  std::vector<OrderCandidate> tried;
  for (int lags = 1; lags <= 3; ++lags) {
    std::vector<OutputErrorInput> part = inputs;
    for (OutputErrorInput& input : part) {
      input.values = input.values.first(cut);
      input.lags = lags;
    }
    if (cut < 20 * (1 + 2 * lags * inputs.size())) continue;
    OutputErrorOptions options;
    options.noise_order = 0;
    options.starts = 2;
    options.maximum_iterations = 25;
    const OutputErrorResult fit = fitOutputError(time_s.first(cut), y.first(cut), part, options);
    std::vector<double> simulated(y.size(), fit.offset);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      for (std::size_t k = 0; k < fit.gains[i].size(); ++k) {
        const std::vector<double> x = lagFiltered(time_s, inputs[i].values, fit.taus_s[i][k], inputs[i].hold);
        for (std::size_t r = 0; r < x.size(); ++r) simulated[r] += fit.gains[i][k] * x[r];
      }
    }
    tried.push_back({lags, lags, 0, heldOutRms(y, simulated, cut)});
  }
  return settle(std::move(tried));
}

std::vector<LagTerm> lagsOf(const ArxModel& model, std::string& message) {
  std::vector<double> poles;
  for (const auto& pole : model.poles()) {
    if (std::abs(pole.imag()) > 1e-9 || pole.real() <= 0.0 || pole.real() >= 1.0) {
      message =
          "the model has a pole that is not real and between 0 and 1, so it has no equivalent in lags; use the "
          "response or output-error method for "
          "a compensator.";
      return {};
    }
    poles.push_back(pole.real());
  }
  std::vector<LagTerm> terms;
  for (std::size_t i = 0; i < model.b.size(); ++i) {
    double rest = model.b[i].sum() / (1.0 + model.a.sum());
    for (std::size_t k = 0; k < poles.size(); ++k) {
      double residue = 0.0;
      for (Index j = 0; j < model.b[i].size(); ++j)
        residue += model.b[i][j] * std::pow(poles[k], -(model.order.nk[i] + static_cast<double>(j)));
      for (std::size_t l = 0; l < poles.size(); ++l) {
        if (l == k) continue;
        if (std::abs(poles[l] - poles[k]) < 1e-12) {
          message = "the model has a double pole, so it has no equivalent in separate lags.";
          return {};
        }
        residue /= 1.0 - poles[l] / poles[k];
      }
      const double gain = residue / (1.0 - poles[k]);
      rest -= gain;
      terms.push_back({static_cast<int>(i), -model.period_s / std::log(poles[k]), gain});
    }
    terms.push_back({static_cast<int>(i), 0.0, rest});
  }
  return terms;
}

Eigen::MatrixXd lagCovariance(const ArxModel& model) {
  const Index p = model.covariance.rows();
  const auto coefficients = [&model](Index which, double change) {
    ArxModel moved = model;
    Index at = model.a.size();
    if (which < at) moved.a[which] += change;
    for (Eigen::VectorXd& b : moved.b) {
      if (which >= at && which < at + b.size()) b[which - at] += change;
      at += b.size();
    }
    if (which == at) moved.c += change;
    std::string message;
    const std::vector<LagTerm> terms = lagsOf(moved, message);
    Eigen::VectorXd out(static_cast<Index>(terms.empty() ? 0 : 1 + 2 * terms.size()));
    if (terms.empty()) return out;
    out[0] = moved.c / (1.0 + moved.a.sum());
    for (std::size_t k = 0; k < terms.size(); ++k) {
      out[static_cast<Index>(1 + k)] = terms[k].gain;
      out[static_cast<Index>(1 + terms.size() + k)] = terms[k].tau_s > 0.0 ? std::log(terms[k].tau_s) : 0.0;
    }
    return out;
  };
  const Index size = coefficients(0, 0.0).size();
  if (p == 0 || size == 0) return {};
  Eigen::MatrixXd jacobian(size, p);
  for (Index j = 0; j < p; ++j) {
    const double step = 0.01 * std::sqrt(std::max(1e-30, model.covariance(j, j)));
    const Eigen::VectorXd up = coefficients(j, step);
    const Eigen::VectorXd down = coefficients(j, -step);
    if (up.size() != size || down.size() != size) return {};
    jacobian.col(j) = (up - down) / (2.0 * step);
  }
  return jacobian * model.covariance * jacobian.transpose();
}

}  // namespace spindrift
