// SPDX-License-Identifier: Apache-2.0
#include "core/thermal/output_error.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/math/distributions.h"
#include "core/math/statistics.h"
#include "core/thermal/noise_inference.h"

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
    for (const OutputErrorInput& input : inputs) centre_.push_back(mean(input.values.last(y.size())));
    const double span = time.back() - time[time.size() - y.size()];
    shortest_ = std::log(0.2 * span / static_cast<double>(y.size()));
    longest_ = std::log(5.0 * span);
  }
  [[nodiscard]] const Layout& layout() const { return layout_; }
  void setNoise(const Autoregression& noise) { noise_ = noise; }
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
      const std::vector<double> x = lagFiltered(time_, input.values, tau, input.hold);
      if (with_jacobian) {
        const std::vector<double> slope = lagSensitivity(time_, input.values, tau, input.hold);
        s.jacobian.col(1 + layout_.lags + k) = gain * tailOf(slope);
      }
      const auto centred = tailOf(x).array() - centre_[i];
      s.residual.array() -= gain * centred;
      if (with_jacobian) s.jacobian.col(1 + k) = centred.matrix();
    }
    noise_.whiten(s.residual);
    if (with_jacobian) noise_.whiten(s.jacobian);
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

  /// Time constants from a grid (s): input after input those that leave least, in turn again until none changes. Offset
  /// and gains are free throughout; white noise.
  [[nodiscard]] Eigen::VectorXd fromGrid(const std::vector<double>& grid_s) const {
    const auto n = static_cast<Index>(y_.size());
    const auto m = static_cast<Index>(grid_s.size());
    Eigen::MatrixXd columns(n, static_cast<Index>(inputs_.size()) * m + 2);
    columns.col(0).setOnes();
    columns.col(1) = Eigen::Map<const Eigen::VectorXd>(y_.data(), n);
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      for (Index g = 0; g < m; ++g) {
        const std::vector<double> x =
            lagFiltered(time_, inputs_[i].values, grid_s[static_cast<std::size_t>(g)], inputs_[i].hold);
        columns.col(2 + static_cast<Index>(i) * m + g) = (tailOf(x).array() - centre_[i]).matrix();
      }
    }
    const Eigen::MatrixXd products = columns.transpose() * columns;
    std::vector<Index> chosen;  // grid place of each lag already placed
    const auto left = [&] {
      const auto p = static_cast<Index>(chosen.size()) + 1;
      std::vector<Index> at{0};
      for (std::size_t k = 0; k < chosen.size(); ++k) at.push_back(2 + layout_.input[k] * m + chosen[k]);
      Eigen::MatrixXd normal(p, p);
      Eigen::VectorXd right(p);
      for (Index i = 0; i < p; ++i) {
        right[i] = products(at[static_cast<std::size_t>(i)], 1);
        for (Index j = 0; j < p; ++j)
          normal(i, j) = products(at[static_cast<std::size_t>(i)], at[static_cast<std::size_t>(j)]);
      }
      normal.diagonal() *= 1.0 + 1e-9;
      return products(1, 1) - right.dot(normal.ldlt().solve(right));
    };
    // All combinations of one input, the others as they are: two lags that only work as a pair are found.
    const auto place = [&](std::size_t first, std::size_t count) {
      std::vector<Index> trial(count);
      std::iota(trial.begin(), trial.end(), Index{0});
      std::vector<Index> best_places = trial;
      double best = std::numeric_limits<double>::infinity();
      while (true) {
        std::copy(trial.begin(), trial.end(), chosen.begin() + static_cast<std::ptrdiff_t>(first));
        const double value = left();
        if (value < best) {
          best = value;
          best_places = trial;
        }
        std::size_t digit = count;
        while (digit > 0 && trial[digit - 1] == m - static_cast<Index>(count - digit) - 1) --digit;
        if (digit == 0) break;
        ++trial[digit - 1];
        for (std::size_t k = digit; k < count; ++k) trial[k] = trial[k - 1] + 1;
      }
      std::copy(best_places.begin(), best_places.end(), chosen.begin() + static_cast<std::ptrdiff_t>(first));
    };
    for (int round = 0; round < 4; ++round) {
      const std::vector<Index> before = chosen;
      std::size_t first = 0;
      for (const OutputErrorInput& input : inputs_) {
        const auto count = static_cast<std::size_t>(input.lags);
        if (round == 0) chosen.resize(first + count);
        place(first, count);
        first += count;
      }
      if (chosen == before) break;
    }
    Eigen::VectorXd out(layout_.lags);
    for (std::size_t k = 0; k < chosen.size(); ++k)
      out[static_cast<Index>(k)] = std::log(grid_s[static_cast<std::size_t>(chosen[k])]);
    return out;
  }

 private:
  /// Of values at all times those at which there is an output.
  [[nodiscard]] Eigen::Map<const Eigen::VectorXd> tailOf(const std::vector<double>& values) const {
    return {values.data() + (values.size() - y_.size()), static_cast<Index>(y_.size())};
  }

  std::span<const double> time_;
  std::span<const double> y_;
  const std::vector<OutputErrorInput>& inputs_;
  std::vector<double> centre_;
  Layout layout_;
  Autoregression noise_;
  double shortest_ = 0.0;
  double longest_ = 0.0;
};

/// Levenberg and Marquardt, not Ceres: on 40 made records of 1000 rows that needed 1.8 (normal equations) to 2.3 times
/// (QR) the processor time for the same minimum in the 31 in which both converged (in 3 more it alone did), and the
/// library of the compensator, which this file is part of, would need it too.
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

/// A sentence if two neighbouring time constants of one input may be the same.
std::string mergedLags(const OutputErrorResult& r) {
  Index at = 1;
  for (const auto& g : r.gains) at += static_cast<Index>(g.size());
  for (std::size_t i = 0; i < r.taus_s.size(); ++i) {
    for (std::size_t k = 0; k < r.taus_s[i].size(); ++k, ++at) {
      if (k == 0) continue;
      const double variance = r.covariance(at, at) + r.covariance(at - 1, at - 1) - 2.0 * r.covariance(at, at - 1);
      const double apart = std::log(r.taus_s[i][k - 1] / r.taus_s[i][k]);
      if (apart > r.coverageFactor() * std::sqrt(std::max(0.0, variance))) continue;
      return fmt::format(
          "the time constants {:.4g} s and {:.4g} s of input {} may be identical: their separate gains are not "
          "determined, only the whole response is; use one time constant fewer or a longer range.",
          r.taus_s[i][k - 1], r.taus_s[i][k], i + 1);
    }
  }
  return {};
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

double OutputErrorResult::coverageFactor(double probability) const {
  return studentQuantile(0.5 + 0.5 * probability, degrees_of_freedom);
}

OutputErrorResult fitOutputError(std::span<const double> time_s, std::span<const double> y,
                                 const std::vector<OutputErrorInput>& inputs, const OutputErrorOptions& options) {
  SPINDRIFT_ASSERT(time_s.size() >= y.size() && !inputs.empty(), "an output has no time, or there is no input");
  OutputErrorResult result;
  Index lags = 0;
  for (const OutputErrorInput& input : inputs) {
    SPINDRIFT_ASSERT(input.values.size() == time_s.size() && input.lags >= 1,
                     "input and times differ in length, or an input has no time constant");
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
  const double span = time_s.back() - time_s[time_s.size() - y.size()];
  const double period = span / static_cast<double>(y.size() - 1);
  const double low = std::log(4.0 * period);
  const double high = std::log(0.3 * span);
  std::vector<double> grid;
  constexpr int grid_size = 12;
  for (int g = 0; g < grid_size; ++g) grid.push_back(std::exp(low + (high - low) * g / (grid_size - 1)));
  State best;
  bool converged = false;
  for (int start = 0; start < options.starts; ++start) {
    State s;
    s.theta = Eigen::VectorXd::Zero(problem.layout().parameters());
    if (start == 0) {
      s.theta.tail(lags) = problem.fromGrid(grid).unaryExpr([&](double v) { return problem.clamped(v); });
    } else {
      // Spread evenly in the logarithm; each start shifts them.
      std::vector<int> seen(inputs.size(), 0);
      for (Index k = 0; k < lags; ++k) {
        const auto i = static_cast<std::size_t>(problem.layout().input[static_cast<std::size_t>(k)]);
        const double place = (seen[i]++ + (start - 0.5) / (options.starts - 0.5)) / inputs[i].lags;
        s.theta[1 + lags + k] = problem.clamped(high - std::min(1.0, place) * (high - low));
      }
    }
    problem.solveLinearPart(s);
    const bool good = minimise(problem, s, options.maximum_iterations, result.iterations);
    if (s.cost < best.cost) {
      best = std::move(s);
      converged = good;
    }
  }
  // The colour of the simulation error and the best parameters under it, in turn until they agree.
  NoiseInference inference;
  State plain;
  for (int round = 0; round < 8; ++round) {
    plain.theta = best.theta;
    problem.setNoise({});
    problem.evaluate(plain, true);
    if (plain.jacobian.colwise().norm().minCoeff() <= 0.0) break;
    const Eigen::VectorXd before = result.noise_ar;
    inference = inferNoise(plain.jacobian, plain.residual, options.noise_order);
    result.noise_ar = inference.noise.ar;
    problem.setNoise(inference.noise);
    if (options.noise_order == 0) break;
    problem.evaluate(best, false);
    converged = minimise(problem, best, options.maximum_iterations, result.iterations);
    if (round > 0 && (result.noise_ar - before).norm() < 1e-3) break;
  }
  result.rms = std::sqrt(plain.residual.squaredNorm() / static_cast<double>(y.size()));
  result.noise_sigma = inference.innovation_sigma * inference.noise.amplification();
  problem.evaluate(best, true);
  const Eigen::VectorXd length = best.jacobian.colwise().norm();
  if (length.minCoeff() <= 0.0 || !best.theta.allFinite() || inference.covariance.size() == 0) {
    result.status = FitStatus::Degenerate;
    result.message = "a time constant has no effect on the output; use fewer time constants or inputs.";
    return result;
  }
  const Eigen::MatrixXd scaled = best.jacobian * length.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled.transpose() * scaled);
  if (eigen.eigenvalues().minCoeff() < 1e-11 * eigen.eigenvalues().maxCoeff()) {
    result.status = FitStatus::Degenerate;
    result.message =
        "time constants or inputs cannot be distinguished with these data; use fewer time constants or inputs.";
  } else {
    result.status = converged ? FitStatus::Converged : FitStatus::NoConvergence;
    if (!converged) result.message = "the iteration did not converge; use fewer time constants or a longer range.";
  }
  Eigen::MatrixXd covariance = inference.covariance;
  if (!covariance.allFinite()) {  // degenerate: what is determined keeps its uncertainty, the rest a large one
    const Eigen::VectorXd floor = eigen.eigenvalues().cwiseMax(1e-14 * eigen.eigenvalues().maxCoeff());
    const Eigen::MatrixXd inverse =
        eigen.eigenvectors() * floor.cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
    const double variance = best.jacobian.rows() > 0 ? best.cost / static_cast<double>(y.size()) : 0.0;
    covariance = variance * (length.cwiseInverse().asDiagonal() * inverse * length.cwiseInverse().asDiagonal());
  }
  // Where the noise could not be told from the model, the least that an interval can rest on.
  const Eigen::VectorXd& degrees = inference.degrees_of_freedom;
  result.degrees_of_freedom = degrees.allFinite() && degrees.minCoeff() > 0.0 ? degrees.minCoeff() : 1.0;
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
    const double centre = mean(inputs[i].values.last(y.size()));
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
  if (result.message.empty()) result.message = mergedLags(result);
  return result;
}

}  // namespace spindrift
