// SPDX-License-Identifier: Apache-2.0
// Orders by held-out error, and the lags of an ARX model.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>

#include "core/thermal/output_error.h"

namespace spindrift {
namespace {

using Eigen::Index;

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
  constexpr int largest_order = 4;
  for (int na = 1; na <= largest_order; ++na) {
    for (int nb = 1; nb <= na; ++nb) {
      for (int nk = 0; nk <= 3; ++nk) {
        if (nk + nb - 1 > na) continue;  // a dead time, which no model of time constants has
        ArxOrder order{na, std::vector<int>(inputs.size(), nb), std::vector<int>(inputs.size(), nk)};
        if (cut < static_cast<std::size_t>(10 * order.parameters(true))) continue;
        ArxOptions options;
        options.with_constant = true;
        const ArxModel model = fitArx(y.first(cut), fit_inputs, order, period_s, options);
        if (model.status != FitStatus::Converged || !model.stable()) continue;
        const std::vector<double> simulated = model.simulate(all_inputs, y.first(largest_order));
        tried.push_back({na, nb, nk, heldOutRms(y, simulated, cut)});
      }
    }
  }
  return settle(std::move(tried));
}

OrderChoice chooseOutputErrorOrder(std::span<const double> time_s, std::span<const double> y,
                                   std::vector<OutputErrorInput> inputs, double held_out_part) {
  SPINDRIFT_ASSERT(time_s.size() >= y.size(), "an output without a time");
  const std::size_t before = time_s.size() - y.size();
  const auto cut = static_cast<std::size_t>(static_cast<double>(y.size()) * (1.0 - held_out_part));
  std::vector<OrderCandidate> tried;
  for (int lags = 1; lags <= 3; ++lags) {
    std::vector<OutputErrorInput> part = inputs;
    for (OutputErrorInput& input : part) {
      input.values = input.values.first(before + cut);
      input.lags = lags;
    }
    if (cut < 20 * (1 + 2 * lags * inputs.size())) continue;
    OutputErrorOptions options;
    options.noise_order = 0;
    options.starts = 2;
    options.maximum_iterations = 25;
    const OutputErrorResult fit = fitOutputError(time_s.first(before + cut), y.first(cut), part, options);
    std::vector<double> simulated(y.size(), fit.offset);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      for (std::size_t k = 0; k < fit.gains[i].size(); ++k) {
        const std::vector<double> x = lagFiltered(time_s, inputs[i].values, fit.taus_s[i][k], inputs[i].hold);
        for (std::size_t r = 0; r < y.size(); ++r) simulated[r] += fit.gains[i][k] * x[before + r];
      }
    }
    tried.push_back({lags, lags, 0, heldOutRms(y, simulated, cut)});
  }
  return settle(std::move(tried));
}

std::vector<LagTerm> lagsOf(const ArxModel& model, const std::vector<bool>& hold, std::string& message) {
  SPINDRIFT_ASSERT(hold.size() == model.b.size(), "inputs differ in number");
  std::vector<double> poles;
  for (const auto& pole : model.poles()) {
    if (std::abs(pole.imag()) > 1e-9 || pole.real() <= 0.0 || pole.real() >= 1.0) {
      message =
          "the model has a pole that is not real and between 0 and 1, so it has no equivalent in first-order time "
          "constants; use the response or output-error method for a compensator.";
      return {};
    }
    poles.push_back(pole.real());
  }
  const auto order = static_cast<Index>(poles.size());
  for (std::size_t i = 0; i < model.b.size(); ++i) {
    if (model.order.nk[i] + model.b[i].size() - 1 > order) {
      message =
          "the model has a dead time or more coefficients of an input than poles (nk + nb - 1 > na), so it has no "
          "equivalent in first-order time constants; use a lower order, or the response or output-error method, for a "
          "compensator.";
      return {};
    }
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
          message = "the model has a double pole, so it has no equivalent in separate time constants.";
          return {};
        }
        residue /= 1.0 - poles[l] / poles[k];
      }
      // The lag of one pole has the residue b1 + b0 / p at it, its direct part goes to the rest.
      const double tau_s = -model.period_s / std::log(poles[k]);
      const LagStep lag = lagStep(model.period_s, tau_s, hold[i]);
      const double gain = residue / (lag.b1 + lag.b0 / poles[k]);
      rest -= gain;
      terms.push_back({static_cast<int>(i), tau_s, gain});
    }
    terms.push_back({static_cast<int>(i), 0.0, rest});
  }
  return terms;
}

Eigen::MatrixXd lagCovariance(const ArxModel& model, const std::vector<bool>& hold) {
  const Index p = model.covariance.rows();
  const auto coefficients = [&model, &hold](Index which, double change) {
    ArxModel moved = model;
    Index at = model.a.size();
    if (which < at) moved.a[which] += change;
    for (Eigen::VectorXd& b : moved.b) {
      if (which >= at && which < at + b.size()) b[which - at] += change;
      at += b.size();
    }
    if (which == at) moved.c += change;
    std::string message;
    const std::vector<LagTerm> terms = lagsOf(moved, hold, message);
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
