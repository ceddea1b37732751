// SPDX-License-Identifier: Apache-2.0
#include "core/workflows/thermal_structures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/json_reader.h"
#include "core/base/unit_text.h"
#include "core/math/distributions.h"
#include "core/math/statistics.h"
#include "core/thermal/arx.h"
#include "core/thermal/output_error.h"

namespace spindrift {
namespace {

struct Bins {
  BinnedSeries all;
  std::vector<double> y;               ///< bridged
  std::vector<std::vector<double>> u;  ///< bridged
  std::vector<bool> hold;
  std::size_t first = 0;  ///< of training
  std::size_t last = 0;   ///< one past
};

Bins makeBins(const TimeSeries& series, const IdentifyRequest& request, const std::vector<std::string>& inputs,
              std::vector<std::string>& notes) {
  Bins b;
  const double to = std::min(request.train.to_s, series.time_s.back() + 1e-6);
  const double span = to - std::max(request.train.from_s, series.time_s.front());
  const double period = request.period_s > 0.0 ? request.period_s : std::max(series.medianPeriod_s(), span / 1000.0);
  TimeSeries part;
  part.time_s = series.time_s;
  Signal y = series.at(request.output);
  // Nothing measured at or after the end of training may reach the bins.
  for (std::size_t r = 0; r < y.values.size(); ++r)
    if (series.time_s[r] >= request.train.to_s) y.values[r] = std::nan("");
  part.signals.push_back(y);
  for (const std::string& name : inputs) part.signals.push_back(series.at(name));
  const TimeSeries grid = resampled(part, period, 1e300);
  b.all.period_s = period;
  b.all.time_s = grid.time_s;
  b.y = bridged(grid.time_s, grid.signals.front().values, false);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const Signal& s = grid.signals.at(i + 1);
    b.hold.push_back(holdsUntilNextRow(s.kind));
    b.u.push_back(bridged(grid.time_s, s.values, b.hold.back()));
  }
  b.first = static_cast<std::size_t>(std::lower_bound(grid.time_s.begin(), grid.time_s.end(), request.train.from_s) -
                                     grid.time_s.begin());
  b.last = static_cast<std::size_t>(std::lower_bound(grid.time_s.begin(), grid.time_s.end(), to) - grid.time_s.begin());
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto values = [&](std::size_t which) {
      return std::span<const double>(b.u[which]).subspan(b.first, b.last - b.first);
    };
    if (std::all_of(values(i).begin(), values(i).end(), [&](double v) { return v == values(i).front(); })) {
      throw InputError({series.file, fmt::format("column {}", inputs[i])},
                       "is constant in the training range, so its effect cannot be learnt; leave it out or train on a "
                       "range in which it changes.");
    }
    if (std::equal(values(i).begin(), values(i).end(), b.y.begin() + static_cast<std::ptrdiff_t>(b.first))) {
      throw InputError({series.file, fmt::format("column {}", inputs[i])},
                       fmt::format("is a copy of the output {}, so a model with it would only repeat the measurement; "
                                   "leave it out.",
                                   request.output));
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (std::equal(values(i).begin(), values(i).end(), values(j).begin())) {
        throw InputError(
            {series.file, fmt::format("column {}", inputs[i])},
            fmt::format("is identical to {}, so their effects cannot be distinguished; leave one of them out.",
                        inputs[j]));
      }
    }
  }
  std::size_t missing = 0;
  for (std::size_t k = b.first; k < b.last; ++k) missing += !std::isfinite(grid.signals.front().values[k]);
  if (missing > 0)
    notes.push_back(fmt::format("{} of {} samples of the output were bridged over gaps.", missing, b.last - b.first));
  if (b.last - b.first < 60) {
    throw InputError({series.file, fmt::format("column {}", request.output)},
                     fmt::format("the training range holds {} samples at a period of {:.6g} s; allowed: at least 60 (a "
                                 "longer range or a shorter --period).",
                                 b.last - b.first, period));
  }
  return b;
}

/// Values at the rows from values on the grid; linear between, held outside.
std::vector<double> atRows(const TimeSeries& series, const std::vector<double>& grid_time,
                           const std::vector<double>& values) {
  TimeSeries grid;
  grid.time_s = grid_time;
  const Signal signal{"v", SignalKind::Other, values};
  std::vector<double> out;
  out.reserve(series.time_s.size());
  for (const double t : series.time_s) out.push_back(grid.valueAt(signal, t));
  return out;
}

void describeInputs(const Bins& b, const TimeSeries& series, const std::vector<std::string>& inputs,
                    ThermalModel& model) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto [low, high] = std::minmax_element(b.u[i].begin() + static_cast<std::ptrdiff_t>(b.first),
                                                 b.u[i].begin() + static_cast<std::ptrdiff_t>(b.last));
    model.inputs.push_back({inputs[i], series.at(inputs[i]).kind, 1.0, 1.0, 0.0, *low, *high});
  }
}

nlohmann::json orderJson(const OrderChoice& choice) {
  nlohmann::json tried = nlohmann::json::array();
  for (const OrderCandidate& c : choice.tried)
    tried.push_back({{"na", c.na}, {"nb", c.nb}, {"nk", c.nk}, {"held_out_rms", jsonNumber(c.held_out_rms)}});
  return tried;
}

/// p-value of Ljung and Box over 20 lags for the residual of the equation: ARX assumes it white.
double equationWhiteness(const ArxModel& model, std::span<const double> y,
                         const std::vector<std::span<const double>>& u) {
  std::vector<double> e;
  std::size_t first = static_cast<std::size_t>(model.a.size());
  for (std::size_t i = 0; i < u.size(); ++i)
    first = std::max(first, static_cast<std::size_t>(model.order.nk[i] + model.order.nb[i]));
  for (std::size_t k = first; k < y.size(); ++k) {
    double v = y[k] - model.c;
    for (Eigen::Index j = 0; j < model.a.size(); ++j) v += model.a[j] * y[k - 1 - static_cast<std::size_t>(j)];
    for (std::size_t i = 0; i < u.size(); ++i)
      for (Eigen::Index j = 0; j < model.b[i].size(); ++j)
        v -= model.b[i][j] * u[i][k - static_cast<std::size_t>(model.order.nk[i] + j)];
    e.push_back(v);
  }
  constexpr std::size_t lags = 20;
  if (e.size() < 5 * lags) return 1.0;
  const double zero = std::inner_product(e.begin(), e.end(), e.begin(), 0.0);
  // What rounding leaves of an exact model is no noise.
  constexpr double rounding = 1e-9;
  double middle = 0.0;
  for (const double v : y) middle += v / static_cast<double>(y.size());
  double whole = 0.0;
  for (const double v : y) whole += (v - middle) * (v - middle);
  if (!(zero > rounding * rounding * whole)) return 1.0;
  const auto n = static_cast<double>(e.size());
  double q = 0.0;
  for (std::size_t lag = 1; lag <= lags; ++lag) {
    const double r = std::inner_product(e.begin() + static_cast<std::ptrdiff_t>(lag), e.end(), e.begin(), 0.0) / zero;
    q += r * r / (n - static_cast<double>(lag));
  }
  return chiSquaredTail(n * (n + 2.0) * q, static_cast<double>(lags));
}

StructuredFit fitByArx(const TimeSeries& series, const IdentifyRequest& request,
                       const std::vector<std::string>& inputs) {
  StructuredFit out;
  const Bins b = makeBins(series, request, inputs, out.notes);
  const auto y = std::span<const double>(b.y).subspan(b.first, b.last - b.first);
  std::vector<std::span<const double>> u;
  for (const auto& v : b.u) u.push_back(std::span<const double>(v).subspan(b.first, b.last - b.first));
  std::array<int, 3> order{};
  if (request.order) {
    order = *request.order;
  } else {
    const OrderChoice choice = chooseArxOrder(y, u, b.all.period_s);
    order = {choice.best.na, choice.best.nb, choice.best.nk};
    out.structure["orders_tried"] = orderJson(choice);
  }
  ArxOptions options;
  options.with_constant = true;
  ArxModel model = fitArx(y, u, {order[0], std::vector<int>(u.size(), order[1]), std::vector<int>(u.size(), order[2])},
                          b.all.period_s, options);
  if (model.status != FitStatus::Converged) throw InputError({series.file, ""}, model.message);
  const bool stable = model.stable();
  if (!stable) {
    model = stabilised(model);
    out.notes.push_back("The ARX fit was unstable: " + model.message);
  }
  const double white = equationWhiteness(model, y, u);
  out.structure["equation_whiteness_p_value"] = white;
  const bool uncertainty_holds = stable && white >= 1e-3;
  out.structure["uncertainty_holds"] = uncertainty_holds;
  if (white < 1e-3) {
    out.notes.push_back(
        "The residual of the ARX equation is not white (noise at the output, or missing dynamics): its coefficients "
        "are "
        "biased and their intervals do not hold; use --method oe or response.");
  }
  // From the first row on, as a ThermalModel runs: what heated the machine before training is part of its history.
  const std::vector<double> simulated = model.simulate(b.u, {});
  out.predicted = atRows(series, b.all.time_s, simulated);
  out.structure["order"] = {{"na", order[0]}, {"nb", order[1]}, {"nk", order[2]}};
  out.structure["period_s"] = b.all.period_s;
  out.structure["a"] = std::vector<double>(model.a.data(), model.a.data() + model.a.size());
  for (const auto& coefficients : model.b)
    out.structure["b"].push_back(std::vector<double>(coefficients.data(), coefficients.data() + coefficients.size()));
  out.structure["c"] = model.c;
  for (const auto& pole : model.poles()) out.structure["poles"].push_back({pole.real(), pole.imag()});
  for (const auto& t : model.timeConstants()) {
    out.structure["time_constants"].push_back(
        {{"value_s", t.value_s}, {"standard_uncertainty_s", jsonNumber(t.sigma_s)}});
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto [gain, sigma] = model.staticGain(i);
    out.structure["static_gain"].push_back(
        {{"input", inputs[i]}, {"value", jsonNumber(gain)}, {"standard_uncertainty", jsonNumber(sigma)}});
  }
  ThermalOutput output;
  output.name = request.output;
  output.unit = unitOfSignal(request.output);
  std::string message;
  output.terms = lagsOf(model, b.hold, message);
  if (!message.empty()) out.notes.push_back(message);
  output.offset = model.c / (1.0 + model.a.sum());
  // An interval that does not hold is none.
  if (!output.terms.empty() && uncertainty_holds) output.covariance = lagCovariance(model, b.hold);
  std::vector<double> left;
  for (std::size_t k = 0; k < y.size(); ++k) left.push_back(y[k] - simulated[b.first + k]);
  output.noise_sigma = rootMeanSquare(left);
  out.model.kind = "arx";
  describeInputs(b, series, inputs, out.model);
  out.model.outputs.push_back(std::move(output));
  out.model.period_s = b.all.period_s;
  return out;
}

StructuredFit fitByOutputError(const TimeSeries& series, const IdentifyRequest& request,
                               const std::vector<std::string>& inputs) {
  StructuredFit out;
  const Bins b = makeBins(series, request, inputs, out.notes);
  // What heated the machine before training is part of its history.
  const auto toEnd = [&](const std::vector<double>& v) { return std::span<const double>(v).first(b.last); };
  const std::span<const double> time_s = toEnd(b.all.time_s);
  const std::span<const double> y = toEnd(b.y).subspan(b.first);
  std::vector<OutputErrorInput> u;
  for (std::size_t i = 0; i < inputs.size(); ++i)
    u.push_back({toEnd(b.u[i]), request.order ? (*request.order)[0] : 1, b.hold[i]});
  if (!request.order) {
    const OrderChoice choice = chooseOutputErrorOrder(time_s, y, u);
    for (OutputErrorInput& input : u) input.lags = choice.best.na;
    out.structure["orders_tried"] = orderJson(choice);
  }
  const OutputErrorResult fit = fitOutputError(time_s, y, u);
  if (fit.gains.empty()) throw InputError({series.file, ""}, fit.message);
  if (fit.status != FitStatus::Converged) {
    out.notes.push_back(fmt::format("Output error: {} ({})", toString(fit.status), fit.message));
  } else if (!fit.message.empty()) {
    out.notes.push_back(fit.message);
  }
  out.model.kind = "output_error";
  describeInputs(b, series, inputs, out.model);
  ThermalOutput output;
  output.name = request.output;
  output.unit = unitOfSignal(request.output);
  output.offset = fit.offset;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto [gain, sigma] = fit.staticGain(i);
    out.structure["static_gain"].push_back(
        {{"input", inputs[i]}, {"value", jsonNumber(gain)}, {"standard_uncertainty", jsonNumber(sigma)}});
    for (std::size_t k = 0; k < fit.gains[i].size(); ++k) {
      output.terms.push_back({static_cast<int>(i), fit.taus_s[i][k], fit.gains[i][k]});
      out.structure["lags"].push_back({{"input", inputs[i]},
                                       {"gain", fit.gains[i][k]},
                                       {"gain_standard_uncertainty", jsonNumber(fit.gainSigma(i, k))},
                                       {"tau_s", fit.taus_s[i][k]},
                                       {"tau_standard_uncertainty_s", jsonNumber(fit.tauSigma_s(i, k))}});
    }
  }
  output.covariance = fit.covariance;
  output.degrees_of_freedom = fit.degrees_of_freedom;
  out.structure["degrees_of_freedom"] = fit.degrees_of_freedom;
  out.structure["coverage_factor_95"] = fit.coverageFactor();
  output.noise_sigma = fit.noise_sigma;
  out.structure["noise_autoregression"] =
      std::vector<double>(fit.noise_ar.data(), fit.noise_ar.data() + fit.noise_ar.size());
  out.model.outputs.push_back(std::move(output));
  out.model.period_s = b.all.period_s;
  out.predicted = out.model.predict(series, 0).value;
  return out;
}

}  // namespace

StructuredFit fitStructured(const TimeSeries& series, const IdentifyRequest& request,
                            const std::vector<std::string>& inputs, const JobContext& job) {
  job.throwIfCancelled();
  StructuredFit fit =
      request.method == "oe" ? fitByOutputError(series, request, inputs) : fitByArx(series, request, inputs);
  fit.model.train_from_s = std::max(request.train.from_s, series.time_s.front());
  fit.model.train_to_s = std::min(request.train.to_s, series.time_s.back());
  fit.model.source = series.file.string();
  return fit;
}

}  // namespace spindrift
